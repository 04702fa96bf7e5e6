// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_measured_profile_h
#define tread_geometry_measured_profile_h

#include <tread/geometry/profile_file.h>

#include <optional>

namespace tread
{
  /// How a file's y is taken: turned round where it is mirrored, then moved; and how the points are smoothed.
  struct ProfilePlacement
  {
    bool   is_mirrored = false;
    double shift       = 0.; ///< m
    double smoothing   = 0.; ///< m: of waves of this length half is left; 0: none
  };

  /// A measured profile as it is used: from low to high y, placed, z up and, of a wheel, the flange at y < 0.
  /// Lengths in m.
  struct MeasuredProfile
  {
    std::vector<ProfilePoint> points;
    std::vector<ProfilePoint> measured; ///< the same before they were smoothed

    bool has_flange = false; ///< of a wheel
    /// y of the back of the flange, of a wheel whose points reach it.
    std::optional<double> flange_back;
    double                largest_change = 0.; ///< by smoothing, at right angles to the curve
    double                y_of_change    = 0.; ///< where
    double                noise   = 0.; ///< standard deviation of what is left of it within 20 mm of y = 0
    double                spacing = 0.; ///< usual distance of the points there

    /// Pressure that presses the noise flat, Pa: errors that are independent from point to point are waves of
    /// twice their distance, which take pi E* A / wavelength (Westergaard 1939; Johnson 1985, section 13.2).
    /// @param modulus of Hertz, of both bodies, Pa
    double pressure_of_noise(const double modulus) const;

    /// From so much of the largest pressure on it is said: by about so much that pressure is then wrong.
    static constexpr double warned_noise = 0.025;

    /// What a user should know, one line each with the file's name.
    std::vector<std::string> remarks;
  };

  /// @param body rail or wheel
  /// @throws std::runtime_error, one line with file, line and cause, also where the points cannot be the
  /// profile of such a body: another unit, points that turn back, spikes, heads that are no heads, a flange
  /// that is none
  MeasuredProfile read_measured_profile(const std::string      &file,
                                        const ProfileBody       body,
                                        const ProfilePlacement &placement);
} // namespace tread

#endif
