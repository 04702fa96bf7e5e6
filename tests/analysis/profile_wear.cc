// SPDX-License-Identifier: LGPL-2.1-or-later
// Wear that changes profiles: areas are kept, and a ball that slides over a flat cuts its own section into
// it.
#include <tread/analysis/archard_wear.h>
#include <tread/analysis/profile_wear.h>
#include <tread/reference/hertz.h>

#include "check.h"

#include <cmath>
#include <numbers>
#include <numeric>

using namespace tread;

namespace
{
  constexpr double pi = std::numbers::pi;

  double sum(const std::vector<double> &values)
  {
    return std::accumulate(values.begin(), values.end(), 0.);
  }

  /// z(y) through even places of y.
  template <typename Z>
  ProfileCurve curve(const double from, const double to, const unsigned int n, const Z &z)
  {
    std::vector<dealii::Point<2>> points;
    for (unsigned int k = 0; k <= n; ++k)
      {
        const double y = from + (to - from) * k / n;
        points.emplace_back(y, z(y));
      }
    return ProfileCurve(points);
  }

  void areas(tests::Check &check)
  {
    // Half of a circle: lengths of arcs are known.
    constexpr double              radius = 13e-3;
    std::vector<dealii::Point<2>> arc;
    for (unsigned int k = 0; k <= 400; ++k)
      arc.emplace_back(-radius * std::cos(pi * k / 400.), radius * std::sin(pi * k / 400.));
    const ProfileCurve half(arc);
    WornProfile        rail(half, 0.1e-3, WornProfile::Side::below);
    check.relative("points stand for all of an arc", sum(rail.lengths()), pi * radius, 1e-5);

    std::vector<double> hats(rail.size(), 0.);
    rail.add_hat(5e-3, 6e-3, 8e-3, 3e-6, hats);
    rail.add_hat(-1e-3, 0.2e-3, 0.9e-3, 2e-6, hats);
    check.relative("hats keep their areas, at the end of the profile too", sum(hats), 5e-6, 1e-12);
    double              moment = 0., s = 0.;
    std::vector<double> one(rail.size(), 0.);
    rail.add_hat(5e-3, 6e-3, 8e-3, 3e-6, one);
    for (std::size_t k = 0; k < one.size(); ++k)
      {
        moment += one[k] * s;
        s += rail.lengths()[k] * (k == 0 ? 1.5 : 1.); // the first point stands for a half
      }
    check.relative("a hat's middle is a third of the sum of its corners", moment / sum(one), 19e-3 / 3.,
                   2e-3);

    const std::vector<double> soft = rail.smoothed(hats, 2e-3);
    check.relative("smoothing keeps the area", sum(soft), 5e-6, 1e-12);
    std::vector<double> wave(rail.size());
    for (std::size_t k = 0; k < wave.size(); ++k)
      wave[k] = 1. + 0.5 * std::cos(2. * pi * k * 0.1e-3 / 2e-3);
    const std::vector<double> softer = rail.smoothed(wave, 2e-3);
    const std::size_t         crest = 200, valley = 210;
    check.relative("of waves of this length half is left", softer[crest] - softer[valley], 0.5, 0.01);

    std::vector<double> even = rail.lengths();
    for (double &area : even)
      area *= 0.1e-3;
    const WornProfile worn = rail.without(even);
    check.relative("a ring has gone", worn.lost_area(),
                   0.5 * pi * (std::pow(radius, 2) - std::pow(radius - 0.1e-3, 2)), 1e-4);
    check.relative("depth at the top", worn.depths()[worn.size() / 2], 0.1e-3, 1e-4);
    const WornProfile wheel = WornProfile(half, 0.1e-3, WornProfile::Side::above).without(even);
    check.relative("the body above loses outside", wheel.lost_area(),
                   0.5 * pi * (std::pow(radius + 0.1e-3, 2) - std::pow(radius, 2)), 1e-4);
    std::vector<double> far(rail.size(), 0.);
    for (std::size_t k = 0; k < far.size(); ++k)
      far[k] = 9e-3 * rail.lengths()[k];
    bool folds = false;
    try
      {
        rail.without(far);
      }
    catch (const std::runtime_error &)
      {
        folds = true;
      }
    check.that("a profile that folds is refused", folds);
  }

  constexpr double ball_radius = 50e-3, load = 500., coefficient = 1e-4, hardness = 1e9;

  ProfileWearParameters of_ball(const double passages)
  {
    ProfileWearParameters p;
    p.law                 = std::make_shared<ArchardWear>(coefficient, hardness);
    p.passages            = passages;
    p.spacing             = 0.05e-3;
    p.smoothing           = 0.3e-3;
    p.radius              = ball_radius;
    p.gauge.back_distance = 0.;
    p.gauge.back_position = 0.;
    p.origin              = WheelOnRail::RailOrigin{0., 0.};
    return p;
  }

  /// A ball that is dragged over a flat.
  ProfileWear ball_on_flat(const ProfileWearParameters &p, const double element = 0.)
  {
    WearContact contact;
    contact.rolling.friction         = 0.3;
    contact.rolling.wheel            = {210e9, 0.3};
    contact.rolling.rail             = {210e9, 0.3};
    contact.rolling.speed            = 1.;
    contact.rolling.angular_velocity = 0.;
    contact.rolling.element_x = contact.rolling.element_y = element;
    contact.load                                          = load;
    return ProfileWear(
      p, {contact},
      curve(-10e-3, 10e-3, 400,
            [](const double y) { return ball_radius - std::sqrt(ball_radius * ball_radius - y * y); }),
      curve(-10e-3, 10e-3, 100, [](double) { return 0.; }));
  }

  void run(ProfileWear &wear)
  {
    while (!wear.is_done() || wear.steps().empty())
      wear.advance();
  }

  void ball(tests::Check &check)
  {
    // Archard: the area is coefficient over hardness times load and passages, however it is distributed.
    const double per_passage = coefficient / hardness * load;
    // Depth of a groove of the ball's section with this area: 2/3 of depth and width; and how far Hertz's
    // ball sinks in.
    const reference::HertzEllipse hertz =
      reference::hertz_sphere(ball_radius, 0.5 * 210e9 / (1. - 0.3 * 0.3), load);
    const double deep     = 12. * hertz.approach,
                 passages = 4. / 3. * deep * std::sqrt(2. * ball_radius * deep) / per_passage;
    auto parameters       = of_ball(passages);
    parameters.states     = 2;
    ProfileWear wear      = ball_on_flat(parameters);
    while (!wear.is_done() || wear.steps().empty())
      {
        wear.advance();
        const auto &s = wear.steps().back();
        std::printf("%.6f %.6f change %.4f depth %.4f um p %.1f MPa area %.6g\n", s.progress, s.share,
                    s.change, 1e6 * s.rail_depth, 1e-6 * s.max_pressure, s.rail_area);
        std::fflush(stdout);
      }
    check.relative("area by Archard's law", wear.rail_loss().area, per_passage * passages, 2e-3);
    check.relative("area between the profiles", wear.rail().lost_area(), wear.rail_loss().area, 1e-3);
    check.relative("friction's work behind it", wear.rail_loss().work * coefficient / hardness / 0.3,
                   wear.rail_loss().area, 1e-9);
    check.relative("the groove is as deep as the ball's section", wear.steps().back().rail_depth, deep, 0.05);
    std::printf("%zu steps, %u refused, %u forced; hertz %g um, deep %g um\n", wear.steps().size(),
                wear.n_refused(), wear.n_forced(), 1e6 * hertz.approach, 1e6 * deep);
    for (const WearStep &s : wear.steps())
      std::printf("%.4f %.5f change %.4f depth %.4f um p %.1f MPa area %.6g\n", s.progress, s.share, s.change,
                  1e6 * s.rail_depth, 1e-6 * s.max_pressure, s.rail_area);
    const auto depths = wear.rail().depths();
    for (std::size_t k = 0; k < depths.size(); ++k)
      if (std::abs(wear.rail().points()[k][0]) < 3e-3 && k % 1 == 0)
        std::printf("%8.4f %8.4f\n", 1e3 * wear.rail().points()[k][0], 1e6 * depths[k]);
  }
} // namespace


void run_test(tests::Check &check, const tests::Arguments &)
{
  areas(check);
  ball(check);
}
