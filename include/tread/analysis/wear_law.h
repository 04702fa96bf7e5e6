// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_wear_law_h
#define tread_analysis_wear_law_h

#include <tread/base/section.h>

#include <memory>
#include <string>
#include <vector>

namespace tread
{
  /// How much a surface loses where another one slides over it.
  ///
  /// A new law is a header like archard_wear.h, its line in wear_law.cc and a test.
  class WearLaw
  {
  public:
    virtual ~WearLaw() = default;

    /// What slides, over a short time at one place.
    struct Sliding
    {
      double work     = 0.; ///< of friction, J
      double normal   = 0.; ///< normal force over the sliding distance, J
      double distance = 0.; ///< slid, m
      double duration = 0.; ///< s
      double area     = 0.; ///< m^2
    };

    /// Volume that each of both surfaces loses, m^3.
    virtual double volume(const Sliding &sliding) const = 0;
  };

  /// What a scene has to know of a law to offer it.
  struct WearLawEntry
  {
    std::string name, description;
    /// Add the parameters that only this law has to the section `Damage`.
    void (*declare)(Section &section);
    /// @param section with the values of its own parameters; null: no wear
    std::shared_ptr<const WearLaw> (*make)(const dealii::ParameterHandler &section);
  };

  /// All laws, the usual one first.
  const std::vector<WearLawEntry> &wear_laws();

  /// Add the parameters that single laws have to the section `Damage`, which was entered.
  void declare_wear_laws(Section &section);
} // namespace tread

#endif
