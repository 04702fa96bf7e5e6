// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_friction_law_h
#define tread_contact_friction_law_h

namespace tread
{
  /// How much tangential impulse a contact can carry.
  class FrictionLaw
  {
  public:
    virtual ~FrictionLaw() = default;

    /// Friction coefficient at a slip speed (m/s).
    virtual double coefficient(const double slip_speed) const = 0;
  };

  /// One coefficient for stick and slip (Coulomb 1785).
  class CoulombFriction : public FrictionLaw
  {
  public:
    explicit CoulombFriction(const double coefficient)
      : value(coefficient)
    {
    }

    double coefficient(const double) const override
    {
      return value;
    }

  private:
    double value;
  };
} // namespace tread

#endif
