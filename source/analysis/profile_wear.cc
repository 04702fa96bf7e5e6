// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/profile_wear.h>
#include <tread/analysis/steady_damage.h>
#include <tread/base/format.h>
#include <tread/geometry/patch_surfaces.h>
#include <tread/reference/all_cores.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace tread
{
  namespace
  {
    double sum(const std::vector<double> &values)
    {
      return std::accumulate(values.begin(), values.end(), 0.);
    }

    /// values += factor * others
    void add(std::vector<double> &values, const double factor, const std::vector<double> &others)
    {
      values.resize(others.size(), 0.);
      for (std::size_t k = 0; k < others.size(); ++k)
        values[k] += factor * others[k];
    }

    std::vector<double> times(const double factor, const std::vector<double> &values)
    {
      std::vector<double> list;
      add(list, factor, values);
      return list;
    }

    double highest(const std::vector<double> &values)
    {
      return values.empty() ? 0. : *std::max_element(values.begin(), values.end());
    }

    /// Areas that are lost at this rate while the pressure gives way: the solution v of (1 - time J) v =
    /// areas, with the derivative J of the losses by the depths, by which points exchange area the more the
    /// nearer they are: waves along the profile give way in proportion to their wave number, whose kernel is
    /// 1 over pi and the square of the distance. @param yielding of the points, times their lengths; @param
    /// time share of all
    std::vector<double> given_way(const WornProfile         &profile,
                                  const std::vector<double> &areas,
                                  const std::vector<double> &yielding,
                                  const double               time)
    {
      const std::vector<double> lengths = profile.lengths();
      std::vector<std::size_t>  points; // those that are touched
      std::vector<double>       places, root;
      double                    s = 0.;
      for (std::size_t k = 0; k < areas.size(); ++k)
        {
          s += k > 0 ? profile.points()[k].distance(profile.points()[k - 1]) : 0.;
          if (yielding[k] > 0.)
            {
              points.push_back(k);
              places.push_back(s);
              root.push_back(std::sqrt(time * yielding[k] / lengths[k] / dealii::numbers::PI));
            }
        }
      const std::size_t n = points.size();
      if (n == 0)
        return areas;
      dealii::LAPACKFullMatrix<double> matrix(n, n);
      dealii::Vector<double>           depths(n);
      for (std::size_t i = 0; i < n; ++i)
        {
          matrix(i, i) += lengths[points[i]];
          depths[i] = areas[points[i]];
          for (std::size_t j = 0; j < i; ++j)
            {
              const double exchange = root[i] * root[j] * lengths[points[i]] * lengths[points[j]] /
                                      std::pow(places[i] - places[j], 2);
              matrix(i, j) = matrix(j, i) = -exchange;
              matrix(i, i) += exchange;
              matrix(j, j) += exchange;
            }
        }
      matrix.set_property(dealii::LAPACKSupport::symmetric);
      matrix.compute_cholesky_factorization();
      matrix.solve(depths);
      std::vector<double> list = areas;
      for (std::size_t i = 0; i < n; ++i)
        list[points[i]] = depths[i] * lengths[points[i]];
      return list;
    }

    double total_weight(const std::vector<WearContact> &contacts)
    {
      double total = 0.;
      for (const WearContact &contact : contacts)
        total += contact.weight;
      return total;
    }
  } // namespace


  ProfileWear::ProfileWear(const ProfileWearParameters    &parameters,
                           const std::vector<WearContact> &all_contacts,
                           const ProfileCurve             &wheel,
                           const ProfileCurve             &rail)
    : p(parameters)
    , contacts(all_contacts)
    , rail_profile(rail, p.spacing, WornProfile::Side::below)
    , wheel_profile(wheel, p.spacing, WornProfile::Side::above)
  {
    const double total = total_weight(contacts);
    for (WearContact &contact : contacts)
      contact.weight /= total;
    if (!p.origin)
      {
        const WheelOnRail at_start(wheel, rail.turned(p.rail_angle), p.radius, p.gauge);
        p.origin = WheelOnRail::RailOrigin{at_start.rail_origin_y(), at_start.rail_origin_z()};
      }
    rail_work.assign(rail_profile.size(), 0.);
    wheel_work.assign(wheel_profile.size(), 0.);
  }


  WheelOnRail ProfileWear::surfaces(const WornProfile &wheel, const WornProfile &rail) const
  {
    return WheelOnRail(WheelSurface(wheel.curve()),
                       std::make_shared<PrismSurface>(rail.curve().turned(p.rail_angle)), p.radius, p.gauge,
                       p.origin);
  }


  WheelOnRail ProfileWear::surfaces() const
  {
    return surfaces(wheel_profile, rail_profile);
  }


  void ProfileWear::add_patch(const WheelPatch   &patch,
                              const WheelContact &whole,
                              const double        angular_velocity,
                              const WheelOnRail  &surfaces,
                              const WornProfile  &wheel,
                              const WornProfile  &rail,
                              const WearContact  &contact,
                              Answer             &answer) const
  {
    const PatchSurfaces            heights(surfaces, whole.position, patch.region);
    const reference::PlanarResult &s        = patch.solution;
    const std::vector<PatchNode>   elements = elements_in_contact(patch);
    const auto                     on_rail  = [&](const double y) {
      return heights.rail(0., y).parameter;
    };
    const auto on_wheel = [&](const double y) {
      return heights.wheel(0., y).profile_s;
    };
    // Each line of elements is a hat from the middle of the line before to that of the line behind it.
    const auto add_line = [&](const WornProfile &profile, const std::function<double(double)> &at,
                              const double y, const double area, std::vector<double> &areas) {
      const double one = at(y - s.grid.dy), other = at(y + s.grid.dy);
      profile.add_hat(std::min(one, other), std::clamp(at(y), std::min(one, other), std::max(one, other)),
                      std::max(one, other), area, areas);
    };
    // Mean pressure of a line, and the stiffness against waves across it that are short.
    const auto pressure_of = [&](const double y) {
      const auto   first = s.pressure.begin() + s.grid.n_x * std::llround((y - s.grid.y_first) / s.grid.dy);
      const double n =
        std::count_if(first, first + s.grid.n_x, [](const double value) { return value > 0.; });
      return std::accumulate(first, first + s.grid.n_x, 0.) / n;
    };
    const double stiffness =
      0.5 * reference::combine(contact.rolling.wheel, contact.rolling.rail).hertz_modulus();
    WearPatch row{};
    for (const SurfacePlace &line : steady_damage(elements, contact.rolling.speed, p.law.get(), 0.5, 1.))
      {
        add_line(rail, on_rail, line.y, line.wear_depth * line.area, answer.rates.rail_area);
        add_line(rail, on_rail, line.y, line.friction_work * line.area, answer.rates.rail_work);
        add_line(rail, on_rail, line.y, line.wear_depth * line.area * stiffness / pressure_of(line.y),
                 answer.rates.rail_yielding);
        row.work += line.friction_work * line.area;
        row.rail_area += line.wear_depth * line.area;
      }
    if (const double wheel_speed = angular_velocity * patch.rolling_radius; p.turns > 0.)
      for (const SurfacePlace &line : steady_damage(elements, wheel_speed, p.law.get(), 0.5, 1.))
        {
          add_line(wheel, on_wheel, line.y, line.wear_depth * line.area, answer.rates.wheel_area);
          add_line(wheel, on_wheel, line.y, line.friction_work * line.area, answer.rates.wheel_work);
          add_line(wheel, on_wheel, line.y, line.wear_depth * line.area * stiffness / pressure_of(line.y),
                   answer.rates.wheel_yielding);
        }
    for (std::size_t j = 0; j < s.grid.n_y; ++j)
      {
        const auto   first = s.pressure.begin() + j * s.grid.n_x;
        const double force = std::accumulate(first, first + s.grid.n_x, 0.) * s.grid.element_area();
        if (force > 0.)
          add_line(rail, on_rail, s.grid.y(j), force, answer.force);
      }
    const double y_middle  = 0.5 * (s.y_begin + s.y_end);
    row.patch              = answer.patches.size();
    row.rail_y             = rail.curve().at(on_rail(y_middle)).y;
    row.wheel_y            = surfaces.wheel().at(on_wheel(y_middle)).y;
    row.angle              = patch.angle();
    row.normal_force       = s.normal_force;
    row.longitudinal_force = s.longitudinal_force;
    row.lateral_force      = s.lateral_force;
    row.max_pressure       = s.max_pressure;
    row.length             = s.x_end - s.x_begin;
    row.width              = s.y_end - s.y_begin;
    row.creepage           = patch.creepage;
    row.lateral_creepage   = patch.lateral_creepage;
    row.spin               = patch.spin;
    row.sink_by_others     = patch.sink_by_others / patch.region.overlap;
    row.angular_velocity   = angular_velocity;
    row.turn               = patch.turn;
    row.element            = s.grid.dy;
    row.climbs             = surfaces.is_beyond_flank(patch.wheel_s);
    answer.patches.push_back(row);
    answer.work += row.work;
    answer.max_pressure = std::max(answer.max_pressure, row.max_pressure);
  }


  ProfileWear::Answer ProfileWear::solve(const WearContact &contact,
                                         const WheelOnRail &surfaces,
                                         const WornProfile &wheel,
                                         const WornProfile &rail,
                                         const double       rolling_radius) const
  {
    const auto at_radius = [&](const double radius) {
      WheelRolling rolling = contact.rolling;
      if (contact.creepage)
        rolling.angular_velocity = (1. + *contact.creepage) * rolling.speed / radius;
      return rolling;
    };
    const auto answer_of = [&](const WheelRolling &rolling) {
      return contact.both_wheels
               ? contact_of_both_wheels(surfaces, rolling, contact.position, 2. * contact.load).own
               : contact_under_load(surfaces, rolling, contact.position, contact.load);
    };
    const auto radius_of = [](const WheelContact &whole) {
      double force = 0., moment = 0.;
      for (const WheelPatch &patch : whole.patches)
        {
          force += patch.solution.normal_force;
          moment += patch.solution.normal_force * patch.rolling_radius;
        }
      return moment / force;
    };
    // The radius at which the wheel rolled at the state before; at the first one that of a wheel which rolls
    // at its nominal radius.
    const double       radius  = !contact.creepage     ? p.radius
                                 : rolling_radius > 0. ? rolling_radius
                                                       : radius_of(answer_of(at_radius(p.radius)));
    const WheelRolling rolling = at_radius(radius);
    const WheelContact whole   = answer_of(rolling);
    if (!has_begun && !contact.both_wheels)
      require_other_wheel_clear(surfaces, whole.position);
    Answer answer;
    answer.force.assign(rail.size(), 0.);
    const std::vector<double> on_wheel(wheel.size(), 0.);
    answer.rates  = {answer.force, on_wheel, answer.force, on_wheel, answer.force, on_wheel};
    answer.radius = radius_of(whole);
    for (const WheelPatch &patch : whole.patches)
      add_patch(patch, whole, rolling.angular_velocity, surfaces, wheel, rail, contact, answer);
    return answer;
  }


  ProfileWear::Block ProfileWear::solve(const WornProfile &wheel, const WornProfile &rail) const
  {
    Block block;
    block.answers.resize(contacts.size());
    std::vector<std::string> reasons(contacts.size());
    const WheelOnRail        here = surfaces(wheel, rail);
    reference::on_all_cores(contacts.size(), 0, [&] {
      // Each thread has its own, which keep the search of their last position.
      return [&, own = here](const std::size_t k) {
        try
          {
            const double radius = k < last.answers.size() ? last.answers[k].radius : 0.;
            block.answers[k]    = solve(contacts[k], own, wheel, rail, radius);
          }
        catch (const std::exception &error)
          {
            reasons[k] = error.what();
          }
      };
    });
    for (std::size_t k = 0; k < contacts.size(); ++k)
      if (!reasons[k].empty())
        throw std::runtime_error(
          format("contact %zu (shift %g mm, yaw %g mrad, %g kN) has no answer after %.4g of all passages: ",
                 k + 1, 1e3 * contacts[k].position.shift, 1e3 * contacts[k].position.yaw,
                 1e-3 * contacts[k].load, progress) +
          reasons[k]);

    for (std::size_t k = 0; k < contacts.size(); ++k)
      {
        Answer      &answer = block.answers[k];
        const double weight = contacts[k].weight;
        add(block.rates.rail_area, p.passages * weight, answer.rates.rail_area);
        add(block.rates.rail_work, p.passages * weight, answer.rates.rail_work);
        add(block.rates.wheel_area, p.turns * weight, answer.rates.wheel_area);
        add(block.rates.wheel_work, p.turns * weight, answer.rates.wheel_work);
        // Where both bodies wear, the gap changes by what both lose.
        const double both = p.passages > 0. && p.turns > 0. ? 2. : 1.;
        add(block.rates.rail_yielding, both * p.passages * weight, answer.rates.rail_yielding);
        add(block.rates.wheel_yielding, both * p.turns * weight, answer.rates.wheel_yielding);
        answer.rates = {};
        for (WearPatch &patch : answer.patches)
          patch.contact = k;
        block.mean_work += weight * answer.work;
        block.mean_max_pressure += weight * answer.max_pressure;
        block.max_pressure = std::max(block.max_pressure, answer.max_pressure);
      }
    for (auto *areas : {&block.rates.rail_area, &block.rates.rail_yielding})
      *areas = rail.smoothed(*areas, p.smoothing);
    for (auto *areas : {&block.rates.wheel_area, &block.rates.wheel_yielding})
      *areas = wheel.smoothed(*areas, p.smoothing);
    return block;
  }


  double ProfileWear::change(const Block &before, const Block &after) const
  {
    double mean = 0.;
    for (std::size_t k = 0; k < contacts.size(); ++k)
      {
        const std::vector<double> &a = before.answers[k].force, &b = after.answers[k].force;
        double                     changed = 0.;
        for (std::size_t i = 0; i < a.size(); ++i)
          changed += std::abs(b[i] - a[i]);
        mean += contacts[k].weight * changed / sum(a);
      }
    return mean;
  }


  double ProfileWear::deepest(const Rates &rates) const
  {
    double depth = 0.;
    for (const auto &[profile, areas] :
         {std::pair{&rail_profile, &rates.rail_area}, std::pair{&wheel_profile, &rates.wheel_area}})
      {
        const std::vector<double> lengths = profile->lengths();
        for (std::size_t k = 0; k < lengths.size(); ++k)
          depth = std::max(depth, (*areas)[k] / lengths[k]);
      }
    return depth;
  }


  void ProfileWear::keep_state()
  {
    WornState state{progress, rail_profile.points(), wheel_profile.points(), rail_work, wheel_work, {}};
    for (const Answer &answer : last.answers)
      state.patches.insert(state.patches.end(), answer.patches.begin(), answer.patches.end());
    kept.push_back(state);
  }


  void ProfileWear::begin()
  {
    constexpr double first_depth = 1e-6; // m: some shares of what surfaces give way by
    last                         = solve(wheel_profile, rail_profile);
    const double deep            = deepest(last.rates);
    if (!(deep > 0.))
      throw std::runtime_error("nothing wears: no contact slips");
    share     = std::min(1., first_depth / deep);
    has_begun = true;
    done.push_back({0., 0., 0., 0., 0., 0., last.mean_work, last.max_pressure, last.mean_max_pressure});
    keep_state();
  }


  void ProfileWear::advance()
  {
    if (!has_begun)
      return begin();
    if (is_done())
      return;
    // To the next state that is kept, in steps as even as they can be.
    const double end = std::min(1., double(kept.size()) / p.states), left = end - progress;
    const double least = p.least_step / deepest(last.rates);
    double       taken = share >= left ? left : std::min(share, 0.5 * left);
    while (true)
      {
        constexpr double gamma = 1.; // L-stable and positive
        // The areas that a surface loses by the first stage, and in all by both stages.
        const auto first = [&](const WornProfile &profile, std::vector<double> Rates::*areas,
                               std::vector<double> Rates::*yielding) {
          return given_way(profile, last.rates.*areas, last.rates.*yielding, gamma * taken);
        };
        const std::vector<double> rail_first = first(rail_profile, &Rates::rail_area, &Rates::rail_yielding),
                                  wheel_first =
                                    first(wheel_profile, &Rates::wheel_area, &Rates::wheel_yielding);
        Block middle;
        try
          {
            middle = solve(wheel_profile.without(times(taken, wheel_first)),
                           rail_profile.without(times(taken, rail_first)));
          }
        catch (const std::runtime_error &)
          {
            if (taken <= least)
              throw;
            constexpr double shorter = 0.25; // after which a contact may have an answer again
            taken                    = std::max(least, shorter * taken);
            ++refused;
            continue;
          }
        const double     changed     = change(last, middle);
        const bool       is_too_much = changed > p.change;
        constexpr double safety = 0.8, shortest = 0.2, longest = 2.;
        const double     factor = std::clamp(safety * p.change / std::max(changed, 1e-12), shortest, longest);
        if (is_too_much && taken > least)
          {
            taken = std::max(least, factor * taken);
            ++refused;
            continue;
          }
        forced += is_too_much;
        const auto both = [&](const WornProfile &profile, const std::vector<double> &stage,
                              std::vector<double> Rates::*areas, std::vector<double> Rates::*yielding) {
          std::vector<double> second = middle.rates.*areas;
          add(second, -2., stage);
          second                   = given_way(profile, second, last.rates.*yielding, gamma * taken);
          std::vector<double> lost = times(1.5 * taken, stage);
          add(lost, 0.5 * taken, second);
          return lost;
        };
        rail_profile =
          rail_profile.without(both(rail_profile, rail_first, &Rates::rail_area, &Rates::rail_yielding));
        wheel_profile =
          wheel_profile.without(both(wheel_profile, wheel_first, &Rates::wheel_area, &Rates::wheel_yielding));
        for (const Rates *rates : std::initializer_list<const Rates *>{&last.rates, &middle.rates})
          {
            add(rail_work, 0.5 * taken, rates->rail_work);
            add(wheel_work, 0.5 * taken, rates->wheel_work);
            rail_lost.area += 0.5 * taken * sum(rates->rail_area);
            rail_lost.work += 0.5 * taken * sum(rates->rail_work);
            wheel_lost.area += 0.5 * taken * sum(rates->wheel_area);
            wheel_lost.work += 0.5 * taken * sum(rates->wheel_work);
          }
        const bool reaches_end = taken == left;
        progress               = reaches_end ? end : progress + taken;
        // A step that was cut off at a state says nothing about the next one.
        share = std::max(std::max(least, factor * taken), reaches_end && !is_too_much ? share : 0.);
        last  = solve(wheel_profile, rail_profile);
        done.push_back({progress, changed, highest(rail_profile.depths()), highest(wheel_profile.depths()),
                        rail_profile.lost_area(), wheel_profile.lost_area(), last.mean_work,
                        last.max_pressure, last.mean_max_pressure});
        if (reaches_end)
          keep_state();
        return;
      }
  }


  void ProfileWear::serialize(Archive &archive)
  {
    rail_profile.serialize(archive);
    wheel_profile.serialize(archive);
    Rates &rates = last.rates;
    archive.same(rail_work, wheel_work, rates.rail_area, rates.wheel_area, rates.rail_work, rates.wheel_work,
                 rates.rail_yielding, rates.wheel_yielding);
    archive.same(last.mean_work, last.max_pressure, last.mean_max_pressure, progress, share, refused, forced,
                 rail_lost, wheel_lost, done, has_begun);
    std::size_t n_answers = last.answers.size(), n_states = kept.size();
    archive.same(n_answers, n_states);
    last.answers.resize(n_answers);
    for (Answer &answer : last.answers)
      archive.same(answer.force, answer.patches, answer.radius, answer.work, answer.max_pressure);
    kept.resize(n_states);
    for (WornState &state : kept)
      archive.same(state.progress, state.rail, state.wheel, state.rail_work, state.wheel_work, state.patches);
  }
} // namespace tread
