// SPDX-License-Identifier: LGPL-2.1-or-later
// The parts of a model: what holds, carries and drives its bodies.
#include <tread/analysis/seat_modes.h>
#include <tread/dynamics/parts/added_mass.h>
#include <tread/dynamics/parts/nodes.h>
#include <tread/dynamics/parts/rail_base.h>
#include <tread/dynamics/parts/rail_on_beam.h>
#include <tread/dynamics/parts/supports.h>
#include <tread/dynamics/parts/track_beyond.h>
#include <tread/dynamics/parts/wheel.h>
#include <tread/model/model.h>
#include <tread/model/parts.h>
#include <tread/model/rail_hold.h>
#include <tread/scene/parts.h>
#include <tread/scene/track_parts.h>
#include <tread/track/track_beam.h>

#include <algorithm>

namespace tread
{
  namespace
  {
    /// The rail on its supports, with what lies beyond the ends of its cells.
    void put_rail_on_supports(Model &model)
    {
      const Scene      &scene    = model.scene;
      const Mesh       &mesh     = model.mesh;
      ExplicitDynamics &dynamics = model.dynamics;
      model.supports             = make_supports(scene, mesh);
      if (!model.supports)
        return;
      Supports &supports = *model.supports;
      for (const int number : recorded_supports(scene))
        supports.add_probe(mid_span_beside(scene, number));
      auto beyond = track_beyond(scene);
      if (beyond && scene.track.has_solid_sleepers())
        {
          TrackParameters alike = track_parameters(scene);
          alike.exceptions.clear();
          (*beyond)[0].sleeper = (*beyond)[1].sleeper =
            modes_at_seat(mesh, rail_body, supports.solid_sleepers.front(), support_positions(scene).front(),
                          alike, materials(scene), solid_parameters(scene));
        }
      dynamics.add<RailOnSupports>(supports, scene.rail.material.elastic(), beyond);
      if (beyond)
        dynamics.add<RailOnTrackBeyond>(rail_body, scene.rail.material.elastic(), *beyond);
    }

    void hold_rail_of(Model &model)
    {
      ExplicitDynamics &dynamics = model.dynamics;
      hold_rail(model.scene, model.mesh, model.supports.get(),
                {[&](const std::vector<unsigned int> &nodes) { dynamics.fix_nodes(nodes); },
                 [&](const std::vector<unsigned int> &nodes, const unsigned int direction) {
                   dynamics.guide_nodes(nodes, direction);
                 },
                 [&](const std::function<double(const dealii::Point<3> &)> &rate) {
                   dynamics.add<DampedNodes>(rail_body, rate);
                 }});
    }

    void put_wheels_on_hubs(Model &model)
    {
      ExplicitDynamics &dynamics = model.dynamics;
      for (RollingWheel &wheel : model.wheels)
        {
          dynamics.guide_nodes(dynamics.boundary_nodes(wheel.body, Boundary::side), 1);
          const CarriesBody &carrier =
            dynamics.add<WheelOnHub>(wheel.hub, wheel.body, wheel.hub.motion.angular_velocity);
          if (model.solid.may_add_mass())
            dynamics.add<AddedMassOnWheel>(carrier);
        }
    }

    void put_rail_on_base(Model &model)
    {
      if (!model.scene.track.runs_along())
        return;
      model.rail_base = std::make_unique<RailBase>(model.scene.track.co_running);
      model.dynamics.add<RailOnBase>(*model.rail_base, rail_body);
    }

    void put_rail_on_beam(Model &model)
    {
      if (model.scene.track.is_beam())
        model.rail_on_beam = &model.dynamics.add<RailOnBeam>(beam_under_rail(model.scene), rail_body);
    }

    void vary_friction(Model &model)
    {
      const Scene          &scene   = model.scene;
      const ContactSection &section = scene.contact;
      if (!section.friction_places.empty() || section.varies_across())
        model.contact.prescribed.vary_friction([&scene](const Vector3 place) {
          return scene.contact.friction_factor(place[0]) *
                 (scene.contact.varies_across() ? scene.stance().factor_across(place) : 1.);
        });
      if (!section.friction_pressures.empty())
        model.contact.vary_friction_with_pressure(
          [&scene](const double pressure) { return scene.contact.pressure_factor(pressure); });
    }

    /// Lateral creepage and spin of wheels whose axles do neither.
    void impose_sliding(Model &model)
    {
      const MotionSection &motion = model.scene.motion;
      if (motion.lateral_creepage == 0. && motion.spin == 0.)
        return;
      model.contact.prescribed.impose_sliding([&model](const Vector3 place, const unsigned int body) {
        const MotionSection &motion = model.scene.motion;
        const auto           wheel  = std::find_if(model.wheels.begin(), model.wheels.end(),
                                                   [&](const RollingWheel &w) { return w.body == body; });
        // The sliding is a velocity, at the middle of the step: there the hub will be half a step further.
        const WheelHub::Motion &hub = wheel->hub.motion;
        const double x = place[0] - (hub.x + 0.5 * model.dynamics.state.time_step * hub.velocity_x),
                     y = place[1] - model.scene.shapes().first_contact.y;
        return motion.speed * Vector3{-motion.spin * y, motion.lateral_creepage + motion.spin * x, 0., 0.};
      });
    }
  } // namespace


  const std::vector<void (*)(Model &)> &model_parts()
  {
    static const std::vector<void (*)(Model &)> list{
      put_rail_on_supports, hold_rail_of,  put_wheels_on_hubs, put_rail_on_base,
      put_rail_on_beam,     vary_friction, impose_sliding};
    return list;
  }
} // namespace tread
