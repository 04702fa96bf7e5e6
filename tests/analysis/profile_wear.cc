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

namespace analysis_profile_wear
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
    double              moment = 0.;
    std::vector<double> one(rail.size(), 0.);
    rail.add_hat(5e-3, 6e-3, 8e-3, 3e-6, one);
    for (std::size_t k = 0; k < one.size(); ++k)
      moment += one[k] * k * rail.lengths()[60];
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

  constexpr double ball_radius = 50e-3, load = 500., coefficient = 1e-4, hardness = 1e9, young = 210e9,
                   poisson = 0.3;

  reference::HertzEllipse hertz()
  {
    return reference::hertz_sphere(ball_radius, 0.5 * young / (1. - poisson * poisson), load);
  }

  /// Area that the flat loses in a passage, however it is distributed (Archard 1953).
  constexpr double per_passage = coefficient / hardness * load;

  /// Passages after which the groove has the section of the ball to this depth.
  double passages_to(const double depth)
  {
    return 4. / 3. * depth * std::sqrt(2. * ball_radius * depth) / per_passage;
  }

  ProfileWearParameters of_ball(const double passages)
  {
    ProfileWearParameters p;
    p.law                 = std::make_shared<ArchardWear>(coefficient, hardness);
    p.passages            = passages;
    p.spacing             = 0.1e-3;
    p.smoothing           = 0.3e-3;
    p.change              = 0.15;
    p.radius              = ball_radius;
    p.gauge.back_distance = 0.;
    p.gauge.back_position = 0.;
    p.origin              = WheelOnRail::RailOrigin{0., 0.};
    return p;
  }

  /// A ball that is dragged over a flat in straight lines.
  ProfileWear ball_on_flat(const ProfileWearParameters &p, const double element)
  {
    WearContact contact;
    contact.rolling.friction = 0.3;
    contact.rolling.wheel = contact.rolling.rail = {young, poisson};
    contact.rolling.speed                        = 1.;
    contact.rolling.angular_velocity             = 0.;
    contact.rolling.element_x = contact.rolling.element_y = element;
    contact.load                                          = load;
    return ProfileWear(
      p, {contact},
      curve(-10e-3, 10e-3, 400,
            [](const double y) { return ball_radius - std::sqrt(ball_radius * ball_radius - y * y); }),
      curve(-10e-3, 10e-3, 100, [](double) { return 0.; }));
  }

  /// Depths after all passages, by points of the flat.
  std::vector<double> worn(ProfileWear &wear)
  {
    while (!wear.is_done())
      wear.advance();
    return wear.rail().depths();
  }

  /// Largest difference of two lists over the largest of the second one.
  double difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    double largest = 0., all = 0.;
    for (std::size_t k = 0; k < a.size(); ++k)
      {
        largest = std::max(largest, std::abs(a[k] - b[k]));
        all     = std::max(all, b[k]);
      }
    return largest / all;
  }

  /// Largest difference of curvatures from those of the ball in the middle of the groove, over them.
  double zigzag(const ProfileWear &wear, const double within)
  {
    const std::vector<double> depths = wear.rail().depths();
    const auto               &points = wear.rail().points();
    double                    worst  = 0.;
    for (std::size_t k = 1; k + 1 < depths.size(); ++k)
      if (std::abs(points[k][0]) < within)
        {
          const double bend =
            (depths[k - 1] - 2. * depths[k] + depths[k + 1]) / std::pow(points[k][0] - points[k - 1][0], 2);
          worst = std::max(worst, std::abs(bend * ball_radius + 1.));
        }
    return worst;
  }

  void early(tests::Check &check)
  {
    // The first passages take what Hertz's pressure takes: the square of the ellipse over the width.
    const reference::HertzEllipse h = hertz();
    const double                  a = h.semi_axis_x, depth = 1e-3 * h.approach;
    const double                  middle = 0.75 * per_passage / a; // of an area with the section 1 - y^2/a^2
    ProfileWear                   wear   = ball_on_flat(of_ball(depth / middle), a / 20.);
    const std::vector<double>     depths = worn(wear);
    check.relative("first passages: depth in the middle", depths[depths.size() / 2], depth,
                   0.03); // smoothed over 0.3 mm
    check.relative("and their area", wear.rail_loss().area, 4. / 3. * a * depth, 2e-3);
  }

  void groove(tests::Check &check)
  {
    const double deep = 3. * hertz().approach, half = std::sqrt(2. * ball_radius * deep),
                 passages            = passages_to(deep);
    const double              fine   = hertz().semi_axis_x / 6.;
    ProfileWear               wear   = ball_on_flat(of_ball(passages), fine);
    const std::vector<double> depths = worn(wear);
    check.relative("area by Archard's law", wear.rail_loss().area, per_passage * passages, 2e-3);
    check.relative("area between the profiles", wear.rail().lost_area(), wear.rail_loss().area, 1e-4);
    check.relative("work of friction behind it", wear.rail_loss().work * coefficient / hardness / 0.3,
                   wear.rail_loss().area, 2e-3);
    // The ball still sinks in elastically beyond its groove, by a ninth of what it sank into the flat.
    check.relative("the groove is as deep as the ball's section", wear.steps().back().rail_depth, deep, 0.02);
    std::vector<double> section(depths.size());
    for (std::size_t k = 0; k < section.size(); ++k)
      section[k] = std::max(0., deep - 0.5 * std::pow(wear.rail().points()[k][0], 2) / ball_radius);
    check.below("and has its shape, largest difference over the depth", difference(depths, section), 0.04);
    check.below("no zigzag: curvature against the ball's", zigzag(wear, 0.6 * half), 0.1);
    check.that("nothing is as steep as when it began",
               wear.steps().back().max_pressure < 0.8 * wear.steps().front().max_pressure);
    // Regression: 18 where the pressure gives way within a step, 24 without.
    check.that("few steps", wear.steps().size() <= 21);

    for (const double coarser : {0.6, 1.5})
      {
        ProfileWear other = ball_on_flat(of_ball(passages), coarser * fine);
        check.below("elements " + std::to_string(coarser) + " times as large",
                    difference(worn(other), depths), 0.02);
        check.below("no zigzag with these", zigzag(other, 0.6 * half), 0.15);
      }
    auto halved      = of_ball(passages);
    halved.change    = 0.07;
    ProfileWear slow = ball_on_flat(halved, 1.5 * fine), quick = ball_on_flat(of_ball(passages), 1.5 * fine);
    check.below("half the change in a step, about twice as many", difference(worn(slow), worn(quick)), 0.01);
    check.that("which are more", slow.steps().size() > 1.5 * quick.steps().size());
  }
} // namespace analysis_profile_wear


TREAD_TEST(analysis_profile_wear)(tests::Check &check, const tests::Arguments &)
{
  areas(check);
  early(check);
  groove(check);
}
