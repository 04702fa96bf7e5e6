// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_geometry_surface_h
#define tread_geometry_surface_h

#include <tread/geometry/profile_curve.h>
#include <tread/geometry/wheel_deviation.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tread
{
  /// A place of a section.
  struct OnSection
  {
    std::size_t curve;    ///< of the section's pieces
    double      s;        ///< parameter on it, m
    double      z, slope; ///< m, dz/dy
  };

  /// The highest place of a section over y; nothing where there is none.
  std::optional<OnSection> highest_over(const std::vector<ProfileCurve> &sections, double y);

  /// The running surface of a rail or of a wheel: a section that may change along the way. The way is x of a
  /// rail (m) and the angle about the axle of a wheel (rad). y is lateral, the gauge face and the flange at
  /// low y; z of a rail points up, of a wheel it is the nominal radius less its own. Lengths in m.
  class Surface
  {
  public:
    virtual ~Surface() = default;

    /// What it is, for messages: "38 slices of nose.csv".
    virtual std::string in_words() const = 0;

    /// What may be wrong with what it is made of, a line each; empty: nothing was seen.
    virtual std::vector<std::string> doubts() const;

    /// Where it is known: along the way, and the largest range of y.
    struct Extent
    {
      double along_begin, along_end, y_begin, y_end;
      bool   includes(const double along) const
      {
        return along >= along_begin && along <= along_end;
      }
    };
    virtual Extent extent() const = 0;

    /// Whether all sections are the same: a prism, or a body of revolution.
    virtual bool is_constant() const = 0;

    /// The section there, from low to high y. It may have several pieces; none beyond the ends.
    virtual std::vector<ProfileCurve> sections(double along) const = 0;

    /// Height over the plane with its derivatives, of several the highest; nothing where there is none.
    struct Height
    {
      double z, by_along, by_y;
    };
    std::optional<Height> height(double along, double y) const;

    /// The body to which a place belongs, such as "nose" or "wing"; empty where all is one.
    virtual std::string body(double along, double y) const;
  };

  /// Of a rail that has the same profile at every x.
  class PrismSurface : public Surface
  {
  public:
    explicit PrismSurface(const ProfileCurve &profile);

    std::string               in_words() const override;
    Extent                    extent() const override;
    bool                      is_constant() const override;
    std::vector<ProfileCurve> sections(double along) const override;

  private:
    ProfileCurve profile;
  };

  /// Of a wheel: a profile that is turned about the axle, with a deviation from it or without.
  class WheelSurface : public Surface
  {
  public:
    explicit WheelSurface(const ProfileCurve &profile, std::shared_ptr<const WheelDeviation> deviation = {});

    std::string               in_words() const override;
    Extent                    extent() const override;
    bool                      is_constant() const override;
    std::vector<ProfileCurve> sections(double along) const override;

    const ProfileCurve &profile() const
    {
      return round;
    }
    /// 0 where there is none.
    WheelDeviation::Value deviation(double angle, double y) const
    {
      return more ? more->at(angle, y) : WheelDeviation::Value{0., 0., 0.};
    }

  private:
    ProfileCurve                          round;
    std::shared_ptr<const WheelDeviation> more;
  };
} // namespace tread

#endif
