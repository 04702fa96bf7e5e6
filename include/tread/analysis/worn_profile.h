// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_worn_profile_h
#define tread_analysis_worn_profile_h

#include <tread/base/archive.h>
#include <tread/geometry/profile_curve.h>

#include <vector>

namespace tread
{
  /// The profile of a running surface as points that move into the body while it wears. Each point stands for
  /// the part of the profile that is nearer to it than to its neighbours. Lengths in m, areas, which are
  /// volumes on a metre of way, in m^2.
  class WornProfile
  {
  public:
    /// On which side of the profile, which runs from low to high y, the body lies.
    enum class Side
    {
      below, ///< a rail
      above  ///< a wheel, whose z points to the axle
    };

    /// @param spacing of the points along the profile, at most
    WornProfile(const ProfileCurve &curve, double spacing, Side side);

    const std::vector<dealii::Point<2>> &points() const
    {
      return now;
    }
    const std::vector<dealii::Point<2>> &points_at_start() const
    {
      return start;
    }
    ProfileCurve curve() const
    {
      return ProfileCurve(now);
    }
    std::size_t size() const
    {
      return now.size();
    }

    /// What each point stands for along the profile, m.
    std::vector<double> lengths() const;

    /// An area that is distributed along the profile as a hat: nothing at `begin` and `end`, most at
    /// `middle`, all by the length of the chords. Added to those of the points; what lies beyond the ends is
    /// added to the points there.
    void add_hat(double begin, double middle, double end, double area, std::vector<double> &areas) const;

    /// Areas of the points spread along the profile by a Gaussian, of whose waves with this length (m) half
    /// is left. Their sum stays.
    std::vector<double> smoothed(const std::vector<double> &areas, double length) const;

    /// The profile after each point has lost its area at right angles to the profile.
    /// @throws std::runtime_error where it folds: points come nearer than a third of their distance
    WornProfile without(const std::vector<double> &areas) const;

    /// What has gone at each point since the start: its distance from there, m.
    std::vector<double> depths() const;
    /// Area between the profile and that at the start, by their points (m^2).
    double lost_area() const;

    void serialize(Archive &archive);

  private:
    std::vector<double> chords() const; ///< of the points from the first one on, m

    Side                          side;
    std::vector<dealii::Point<2>> start, now;
  };
} // namespace tread

#endif
