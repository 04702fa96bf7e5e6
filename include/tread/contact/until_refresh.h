// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_contact_until_refresh_h
#define tread_contact_until_refresh_h

namespace tread
{
  /// How long the pairs of a contact that were found last may stay.
  struct UntilRefresh
  {
    double time = 0., due = 0.;                 ///< since the last one, and when the next must be, s
    double closing_speed = 0.;                  ///< largest speeds of both bodies' nodes, added, m/s
    double travelled = 0., allowed_travel = 0.; ///< by that speed, m

    bool is_due() const
    {
      return time >= due || travelled >= allowed_travel;
    }
    /// However short time and way were.
    void make_due()
    {
      due = 0.;
    }
  };
} // namespace tread

#endif
