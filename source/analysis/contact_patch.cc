// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/contact_patch.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread
{
  namespace
  {
    /// Of a Hertzian ellipse with the semi-axis a: a^2 over the second moment of pressure, int p x^2 / int p.
    constexpr double hertzian_moment = 5.;

    /// The measures of a patch, of which a mean can be taken.
    constexpr double PatchMeasures::*all_measures[] = {&PatchMeasures::area,
                                                       &PatchMeasures::max_pressure,
                                                       &PatchMeasures::adhesion_share,
                                                       &PatchMeasures::max_shear,
                                                       &PatchMeasures::max_slip,
                                                       &PatchMeasures::frictional_power,
                                                       &PatchMeasures::semi_axis_x,
                                                       &PatchMeasures::semi_axis_y,
                                                       &PatchMeasures::pressure_semi_axis_x,
                                                       &PatchMeasures::pressure_semi_axis_y,
                                                       &PatchMeasures::normal_force,
                                                       &PatchMeasures::longitudinal_force,
                                                       &PatchMeasures::lateral_force,
                                                       &PatchMeasures::spin_moment,
                                                       &PatchMeasures::x_middle,
                                                       &PatchMeasures::y_middle,
                                                       &PatchMeasures::x_of_pressure,
                                                       &PatchMeasures::y_of_pressure};
  } // namespace


  double PatchNode::shear_size() const
  {
    return std::hypot(shear[0], shear[1]);
  }


  double PatchNode::slip_speed() const
  {
    return std::hypot(slip[0], slip[1]);
  }


  std::vector<PatchNode> patch_nodes(const std::vector<ContactNodeState> &states,
                                     const double                         centre_x,
                                     const double                         time_step)
  {
    std::vector<PatchNode> patch;
    for (const ContactNodeState &state : states)
      {
        const double  normal     = dot(state.impulse, state.normal);
        const Vector3 tangential = state.impulse - normal * state.normal;
        const double  scale      = 1. / (state.area * time_step);
        PatchNode     node;
        node.position = state.position - Vector3{centre_x, 0., 0., 0.};
        node.area     = state.area;
        node.pressure = scale * normal;
        node.adhesion = state.adhesion;
        for (unsigned int d = 0; d < 2; ++d)
          {
            node.shear[d] = scale * tangential[d];
            node.slip[d]  = state.slip[d];
          }
        patch.push_back(node);
      }
    return patch;
  }


  PatchMeasures measure(const std::vector<PatchNode> &patch)
  {
    PatchMeasures m;
    if (patch.empty())
      return m;
    constexpr double largest = std::numeric_limits<double>::max();
    double           force = 0., first[2] = {0., 0.}, second[2] = {0., 0.}, low[2] = {largest, largest},
           high[2] = {-largest, -largest};
    for (const PatchNode &node : patch)
      {
        m.area += node.area;
        m.adhesion_share += node.adhesion ? node.area : 0.;
        m.max_pressure = std::max(m.max_pressure, node.pressure);
        m.max_shear    = std::max(m.max_shear, node.shear_size());
        m.max_slip     = std::max(m.max_slip, node.slip_speed());
        m.frictional_power -= (node.shear[0] * node.slip[0] + node.shear[1] * node.slip[1]) * node.area;
        const double f = node.pressure * node.area;
        force += f;
        m.longitudinal_force += node.shear[0] * node.area;
        m.lateral_force += node.shear[1] * node.area;
        m.spin_moment += (node.position[0] * node.shear[1] - node.position[1] * node.shear[0]) * node.area;
        for (unsigned int d = 0; d < 2; ++d)
          {
            first[d] += f * node.position[d];
            second[d] += f * node.position[d] * node.position[d];
            low[d]  = std::min(low[d], node.position[d]);
            high[d] = std::max(high[d], node.position[d]);
          }
      }
    m.normal_force = force;
    m.x_middle     = 0.5 * (low[0] + high[0]);
    m.y_middle     = 0.5 * (low[1] + high[1]);
    m.adhesion_share /= m.area;
    const double cell       = std::sqrt(m.area / patch.size());
    m.semi_axis_x           = 0.5 * (high[0] - low[0] + cell);
    m.semi_axis_y           = 0.5 * (high[1] - low[1] + cell);
    const auto from_moments = [&](const unsigned int d) {
      const double mean = first[d] / force;
      return std::sqrt(hertzian_moment * std::max(0., second[d] / force - mean * mean));
    };
    m.pressure_semi_axis_x = from_moments(0);
    m.pressure_semi_axis_y = from_moments(1);
    m.x_of_pressure        = force > 0. ? first[0] / force : 0.;
    m.y_of_pressure        = force > 0. ? first[1] / force : 0.;
    return m;
  }


  void PatchAverage::add(const std::vector<ContactNodeState> &states,
                         const double                         centre_x,
                         const double                         time_step)
  {
    const std::vector<PatchNode> patch = patch_nodes(states, centre_x, time_step);
    for (std::size_t i = 0; i < patch.size(); ++i)
      {
        Sum &sum = sums[states[i].node];
        ++sum.in_contact;
        sum.adhesive += patch[i].adhesion;
        sum.values.position += states[i].position;
        sum.values.area += patch[i].area;
        sum.values.pressure += patch[i].pressure;
        for (unsigned int d = 0; d < 2; ++d)
          {
            sum.values.shear[d] += patch[i].shear[d];
            sum.values.slip[d] += patch[i].slip[d];
          }
        const double x = patch[i].position[0];
        sum.x += x;
        sum.xx += x * x;
        for (unsigned int d = 0; d < 2; ++d)
          {
            sum.sx[d] += patch[i].slip[d] * x;
            sum.ss += patch[i].slip[d] * patch[i].slip[d];
          }
      }
    const PatchMeasures m = measure(patch);
    for (double PatchMeasures::*member : all_measures)
      measure_sums.*member += m.*member;
    centre_sum += centre_x;
    ++steps;
  }


  std::vector<PatchNode> PatchAverage::nodes() const
  {
    std::vector<PatchNode> patch;
    for (const auto &[number, sum] : sums)
      {
        PatchNode node = sum.values;
        node.position  = (1. / sum.in_contact) * node.position - Vector3{centre_sum / steps, 0., 0., 0.};
        node.area /= sum.in_contact;
        node.pressure /= steps;
        for (unsigned int d = 0; d < 2; ++d)
          {
            node.shear[d] /= steps;
            node.slip[d] /= sum.in_contact;
          }
        node.adhesion = 2 * sum.adhesive > sum.in_contact;
        patch.push_back(node);
      }
    return patch;
  }


  double PatchAverage::slip_chatter() const
  {
    double squares = 0., n = 0., largest = 0.;
    for (const PatchNode &node : nodes())
      largest = std::max(largest, node.slip_speed());
    for (const auto &[number, sum] : sums)
      {
        // A line through two points says nothing.
        if (sum.in_contact < 3)
          continue;
        const double spread = sum.xx - sum.x * sum.x / sum.in_contact;
        double       rest   = sum.ss;
        for (unsigned int d = 0; d < 2; ++d)
          {
            const double together = sum.sx[d] - sum.values.slip[d] * sum.x / sum.in_contact;
            rest -= sum.values.slip[d] * sum.values.slip[d] / sum.in_contact +
                    (spread > 0. ? together * together / spread : 0.);
          }
        squares += std::max(0., rest);
        n += sum.in_contact;
      }
    return n > 0. && largest > 0. ? std::sqrt(squares / n) / largest : 0.;
  }


  PatchMeasures PatchAverage::measures() const
  {
    PatchMeasures m = measure_sums;
    if (steps > 0)
      for (double PatchMeasures::*member : all_measures)
        m.*member /= steps;
    return m;
  }


  void PatchAverage::serialize(Archive &archive)
  {
    archive.same(sums, measure_sums, centre_sum, steps);
  }
} // namespace tread
