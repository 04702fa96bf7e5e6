// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/output/summary_keys.h>
#include <tread/recorders/end_of_way.h>

#include <algorithm>

namespace tread
{
  namespace
  {
    const bool keys_of_ripple_are_known = know_summary_keys(
      SummaryGroup::first_wheel,
      {{"normal_force_ripple_share", "Largest deviation of the normal force of a step from its mean over the "
                                     "last 10 mm of the path, over this mean"},
       {"tangential_force_ripple_share",
        "Amplitude of the force along and across the rail about straight lines over the last 10 mm of the "
        "path, that of a sine with the same mean square, over the mean normal force"}});
  } // namespace


  void MeanForce::add(const Vector3 force)
  {
    ++n;
    sum += force;
    low  = std::min(low, force[2]);
    high = std::max(high, force[2]);
  }


  double MeanForce::ripple() const
  {
    const double normal = is_empty() ? 0. : mean()[2];
    return normal > 0. ? std::max(high - normal, normal - low) / normal : 0.;
  }


  EndOfWay::EndOfWay(const Model &model)
    : model(model)
    , forces(model.wheels.size())
  {
  }


  Vector3 EndOfWay::force_on(const RollingWheel &wheel) const
  {
    const MeanForce &force = forces[wheel.number];
    return force.is_empty() ? model.force_on(wheel) : force.mean();
  }


  void EndOfWay::add_step()
  {
    const double end = model.scene.path_end();
    if (!(model.position() <= end && model.position() >= end - length))
      return;
    for (const RollingWheel &wheel : model.wheels)
      forces[wheel.number].add(model.force_on(wheel));
    tangential.add(model.position(), model.force_on(model.wheels.front()));
  }


  void EndOfWay::forget_solution()
  {
    forces.assign(forces.size(), MeanForce());
    tangential = ForceRipple();
  }


  void EndOfWay::finish(Report &report)
  {
    report.summary.set("normal_force_ripple_share", normal_ripple());
    report.summary.set("tangential_force_ripple_share", tangential.share());
  }


  void EndOfWay::serialize(Archive &archive)
  {
    for (MeanForce &force : forces)
      force.serialize(archive);
    tangential.serialize(archive);
  }
} // namespace tread
