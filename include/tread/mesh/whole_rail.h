// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_whole_rail_h
#define tread_mesh_whole_rail_h

#include <tread/geometry/rail_profile.h>
#include <tread/mesh/body.h>
#include <tread/mesh/fine_zone.h>
#include <tread/mesh/rail_body.h>

namespace tread
{
  /// A rail with its full section: head, web and foot.
  struct WholeRail
  {
    double  x_begin            = -0.3;   ///< (m)
    double  x_end              = 0.3;    ///< (m)
    double  coarsest_cell_size = 0.0125; ///< upper bound of the coarse cells' edge in the head's section (m)
    double  longest_row        = 0.04;   ///< upper bound of the coarse cells' length away from the path (m)
    double  contact_half_width = 0.0245; ///< as of RailHead (m)
    double  contact_margin     = 0.02; ///< top faces up to this beyond the path are in reach of the wheel (m)
    RailTop top;
  };

  /// The whole rail. Chart: (x, s, -depth), shaped like the letter I. In the head s is the arc length along
  /// the running surface as in make_rail_head, and its bottom follows the underside; web and foot lie below,
  /// their sides on the outline. Base of the foot: support; cut faces: end; top in reach: contact.
  Body make_whole_rail(const RailProfile &profile, const WholeRail &rail, const FineZones &zones);
} // namespace tread

#endif
