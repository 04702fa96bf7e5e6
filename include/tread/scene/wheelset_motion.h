// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_wheelset_motion_h
#define tread_scene_wheelset_motion_h

#include <tread/track/wheel_hub.h>

#include <functional>
#include <string>

namespace tread
{
  /// Motion of a wheelset across its track over time, read from a table. SI units.
  class WheelsetMotion
  {
  public:
    /// @param file as 'Guidance/File' describes it. @throws InputError
    explicit WheelsetMotion(const std::string &file);

    /// End of the table, s.
    double end() const
    {
      return last;
    }

    /// At a time from 0 to end(); the last row is kept after it. Columns that the table does not have are
    /// those of `otherwise`; y is that of the wheelset in its track.
    Across at(double time, const Across &otherwise) const;

    /// Between two rows, m/s.
    double largest_lateral_speed() const
    {
      return lateral_speed;
    }

    bool has_angular_velocity() const
    {
      return bool(angular_velocity);
    }
    bool has_roll() const
    {
      return bool(roll);
    }

  private:
    using Curve = std::function<double(double)>;
    double last = 0., lateral_speed = 0.;
    Curve  shift, yaw, roll, angular_velocity; ///< empty: not in the table
  };
} // namespace tread

#endif
