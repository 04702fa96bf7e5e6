// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_measured_profiles_h
#define tread_scene_measured_profiles_h

#include <tread/geometry/measured_profile.h>
#include <tread/output/summary.h>
#include <tread/scene/scene.h>

#include <string>
#include <vector>

namespace tread
{
  class RunFolder;

  /// The measured profiles that a scene names, as they are used: none, that of the wheel, of the rail, or
  /// both.
  class MeasuredProfiles
  {
  public:
    /// @throws InputError
    explicit MeasuredProfiles(const Scene &scene);

    /// What a user must know of them, one line each: points that were left out, a wheel whose flange is not
    /// in its file, and noise of so much that pressing it flat takes a noticeable share of the pressure.
    /// @param with_noise false where other words say so
    std::vector<std::string> warnings(const bool with_noise = true) const;

    /// How far smoothing moved each profile, one line each.
    std::vector<std::string> smoothing() const;

    /// Keys of the summary: how far smoothing moved each profile.
    void summarise(Summary &summary) const;

    /// measured_wheel.csv and measured_rail.csv: all points as they are used, and as they were measured.
    void write(const RunFolder &folder) const;

  private:
    struct Named
    {
      std::string     body, parameter, file;
      double          length; ///< of smoothing, m
      MeasuredProfile profile;
    };
    std::vector<Named> profiles;
    double             modulus  = 0.; ///< of Hertz, of both bodies, Pa
    double             pressure = 0.; ///< of Hertz, or a usual one, Pa
  };
} // namespace tread

#endif
