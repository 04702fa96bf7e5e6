// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_prescribed_contact_h
#define tread_contact_prescribed_contact_h

#include <tread/base/simd.h>
#include <tread/contact/until_refresh.h>

#include <functional>
#include <utility>

namespace tread
{
  /// What the user of a contact prescribes from place to place: tractions, sliding, factors of the friction
  /// law. It is no part of the stored state.
  class PrescribedContact
  {
  public:
    using Sliding = std::function<Vector3(const Vector3 place, const unsigned int master)>;

    /// @param until_refresh of the contact, which lives as long as this
    explicit PrescribedContact(UntilRefresh &until_refresh)
      : until_refresh(until_refresh)
    {
    }
    PrescribedContact(const PrescribedContact &)            = delete;
    PrescribedContact &operator=(const PrescribedContact &) = delete;

    /// Prescribe tangential tractions instead of finding them, from the next refresh on, which becomes due by
    /// this call. The function gives the traction on the master surface over the pressure at the position of
    /// a slave node in the mesh (m), which does not move from one element of a table to the next. An empty
    /// function restores the friction law.
    void give_tractions(std::function<Vector3(const Vector3)> over_pressure)
    {
      tractions = std::move(over_pressure);
      until_refresh.make_due();
    }

    /// Impose sliding on the pairs: a velocity (m/s) of master over slave surface that adds to what their
    /// nodes do, as if the surfaces themselves flowed; its part along the normal is left out. Lateral
    /// creepage and spin of a wheel whose axle does neither. The function is given the position of a slave
    /// node in the mesh (m) and the master body; an empty one imposes nothing. @returns the one before
    Sliding impose_sliding(Sliding velocity)
    {
      return std::exchange(imposed, std::move(velocity));
    }

    /// Friction differs from place to place: a factor of the law's coefficient at the position of a slave
    /// node in the mesh (m), from the next refresh on.
    void vary_friction(std::function<double(const Vector3)> factor)
    {
      factor_of_place = std::move(factor);
      until_refresh.make_due();
    }

    /// Another factor of the law's coefficient at a slave node, by its number among the surfaces', from the
    /// next refresh on, or from Contact::renew_friction(), which is to be called when it has changed.
    void vary_friction_with_node(std::function<double(unsigned int)> factor)
    {
      factor_of_node = std::move(factor);
      until_refresh.make_due();
    }

    // What the contact asks. Places are those of slave nodes in the mesh, m.

    bool has_tractions() const
    {
      return bool(tractions);
    }
    /// On the master surface. @pre has_tractions()
    Vector3 traction_over_pressure(const Vector3 place) const
    {
      return tractions(place);
    }
    bool has_sliding() const
    {
      return bool(imposed);
    }
    /// Of master over slave surface, m/s. @pre has_sliding()
    Vector3 sliding(const Vector3 place, const unsigned int master) const
    {
      return imposed(place, master);
    }
    bool varies_friction() const
    {
      return factor_of_place || factor_of_node;
    }
    /// Of the law's coefficient at a slave node.
    double friction_factor(const Vector3 place, const unsigned int node) const
    {
      return (factor_of_place ? factor_of_place(place) : 1.) * (factor_of_node ? factor_of_node(node) : 1.);
    }

  private:
    UntilRefresh                         &until_refresh;
    std::function<Vector3(const Vector3)> tractions;
    Sliding                               imposed;
    std::function<double(const Vector3)>  factor_of_place;
    std::function<double(unsigned int)>   factor_of_node;
  };
} // namespace tread

#endif
