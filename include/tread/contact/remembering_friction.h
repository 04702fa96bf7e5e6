// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_remembering_friction_h
#define tread_contact_remembering_friction_h

#include <tread/contact/friction_law.h>

#include <memory>
#include <utility>

namespace tread
{
  /// Another law with a memory that follows from the scene.
  class RememberingFriction : public FrictionLaw
  {
  public:
    RememberingFriction(std::shared_ptr<const FrictionLaw> law, const Memory &memory)
      : law(std::move(law))
      , kept(memory)
    {
    }

    double coefficient(const double slip_speed) const override
    {
      return law->coefficient(slip_speed);
    }

    Memory memory() const override
    {
      return kept;
    }

    bool is_constant() const override
    {
      return law->is_constant();
    }

    double slip(const double free_slip, const double stopping) const override
    {
      return law->slip(free_slip, stopping);
    }

  private:
    const std::shared_ptr<const FrictionLaw> law;
    const Memory                             kept;
  };
} // namespace tread

#endif
