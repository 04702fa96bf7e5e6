// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_mortar_h
#define tread_contact_mortar_h

#include <tread/contact/contact_surfaces.h>

#include <vector>

namespace tread
{
  /// One weighted constraint: the multiplier of one slave node and all nodes that it couples.
  struct MortarRow
  {
    unsigned int slave;      ///< surface node that carries the multiplier
    Vector3      normal;     ///< outward from the slave surface, unit length
    double       area;       ///< integral of the dual function, m^2
    std::size_t  begin, end; ///< its range of MortarCoupling::entries
  };

  struct MortarEntry
  {
    unsigned int node; ///< surface node
    double       coefficient;
  };

  /// Weighted gaps and relative velocities between a slave surface and those of the masters:
  /// gap_j = normal_j . sum_i c_ji x_i, positive when open, u_j = sum_i c_ji v_i, sum_i c_ji = 0.
  ///
  /// c = (M - D) / area with D_jk = int psi_j N_k^slave, M_jl = int psi_j N_l^master and dual
  /// functions psi_j = sum_k A_jk N_k, int psi_j N_k = delta_jk int N_k over a whole slave face
  /// (Wohlmuth 2000; Popp, Gitterle, Gee & Wall 2010). Faces are cut against each other in the
  /// plane of the slave face (Puso & Laursen 2004) and integrated exactly to degree 4. On slave faces that
  /// the master surface covers only in part psi_j = N_j.
  struct MortarCoupling
  {
    std::vector<MortarRow>   rows;
    std::vector<MortarEntry> entries;
    /// Nodes with gaps below this share of the reach are candidates for contact at once: the rest of it is
    /// what there is until others may touch.
    static constexpr double candidates = 0.5;
    double time_to_touch; ///< shortest gap over closing speed of faces beyond that share of the reach, s
  };

  /// Couple slave_body's surface to those of all other bodies. Collective: each rank integrates a share of
  /// the faces and gets all rows.
  /// @param x, v positions and velocities of all surface nodes.
  /// @param search_reach faces further apart than this (m) are not looked at.
  /// @param reach slave nodes get a row if a face around them is nearer than this (m) to the master surface,
  /// and at least half of their faces is covered by it.
  MortarCoupling couple(const ContactSurfaces      &surfaces,
                        const std::vector<Vector3> &x,
                        const std::vector<Vector3> &v,
                        const unsigned int          slave_body,
                        const double                search_reach,
                        const double                reach);
} // namespace tread

#endif
