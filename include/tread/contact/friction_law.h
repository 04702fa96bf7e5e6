// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_friction_law_h
#define tread_contact_friction_law_h

#include <tread/base/section.h>

#include <memory>
#include <string>
#include <vector>

namespace tread
{
  /// How much tangential impulse a contact can carry: a node adheres while it is below coefficient(0.) times
  /// the normal impulse, and a node that slips at the speed s has coefficient(s) times it, against the slip.
  ///
  /// A new law is a header like exponential_friction.h, its line in friction_law.cc and a test.
  class FrictionLaw
  {
  public:
    virtual ~FrictionLaw() = default;

    /// Friction coefficient at a slip speed (m/s), which is never negative.
    virtual double coefficient(const double slip_speed) const = 0;

    /// How the coefficient mu that a node has follows that of its slip speed s, d mu/dt = -max(s,
    /// speed)/distance (mu - coefficient(s)), from coefficient(0.) when it comes to touch (Vollebregt &
    /// Schuttelaars 2012).
    struct Memory
    {
      double distance = 0.; ///< m; 0: at once
      double speed    = 0.; ///< m/s
    };
    virtual Memory memory() const
    {
      return {};
    }

    /// Whether it is the same at any slip speed.
    virtual bool is_constant() const
    {
      return false;
    }

    /// Slip speed s (m/s) at the end of a step of a node that friction cannot hold: the least root of
    /// s + stopping coefficient(s) = free_slip. Where the law falls so steeply that there are several
    /// (stopping |coefficient'| > 1), that is the one which a node reaches from adhesion; a node that can
    /// adhere does so and does not ask.
    ///
    /// This one brackets the root between 0 and free_slip. Convex laws have no other there, and neither have
    /// those that are nowhere steep: a law that is neither must override it.
    /// @param free_slip its slip speed without tangential impulse, m/s; above stopping * coefficient(0.)
    /// @param stopping what a tangential impulse as large as the normal one would change it by, m/s
    virtual double slip(const double free_slip, const double stopping) const;

  protected:
    /// The root of s + stopping coefficient(s) = free_slip between two speeds of which the first is too low
    /// and the second is not. @returns the nearest end if it is not between them.
    double slip_between(double lower, double upper, const double free_slip, const double stopping) const;
  };

  /// One coefficient for adhesion and slip (Coulomb 1785).
  class CoulombFriction : public FrictionLaw
  {
  public:
    static constexpr const char *name        = "Coulomb";
    static constexpr const char *description = "one coefficient for adhesion and slip";

    static void declare(Section &)
    {
    }

    static std::shared_ptr<const FrictionLaw> make(const double coefficient, const dealii::ParameterHandler &)
    {
      return std::make_shared<CoulombFriction>(coefficient);
    }

    explicit CoulombFriction(const double coefficient)
      : value(coefficient)
    {
    }

    double coefficient(const double) const override
    {
      return value;
    }

    bool is_constant() const override
    {
      return true;
    }

    double slip(const double free_slip, const double stopping) const override
    {
      return free_slip - stopping * value;
    }

  private:
    double value;
  };

  /// What a scene has to know of a law to offer it.
  struct FrictionLawEntry
  {
    std::string name, description;
    /// Add the parameters that only this law has to the section of the contact.
    void (*declare)(Section &section);
    /// @param coefficient without slip, which all laws have
    /// @param section with the values of its own parameters
    /// @throws std::invalid_argument with a line for the user
    std::shared_ptr<const FrictionLaw> (*make)(const double                    coefficient,
                                               const dealii::ParameterHandler &section);
  };

  /// All laws, the usual one first.
  const std::vector<FrictionLawEntry> &friction_laws();

  /// Add the parameters that single laws have to the section of the contact, which was entered.
  void declare_friction_laws(Section &section);

  /// The law of this name. @see FrictionLawEntry::make
  std::shared_ptr<const FrictionLaw> make_friction_law(const std::string              &name,
                                                       const double                    coefficient,
                                                       const dealii::ParameterHandler &section);
} // namespace tread

#endif
