// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_on_demand_h
#define tread_recorders_on_demand_h

#include <tread/recorders/recorder.h>

#include <memory>
#include <vector>

namespace tread
{
  struct Model;
  struct WindowPlace;

  /// What makes recorders that a run has where its scene asks for them; else they give none. In the order in
  /// which the recorders act. A new one is a line in on_demand.cc.
  const std::vector<std::unique_ptr<Recorder> (*)(Model &, const WindowPlace &)> &recorders_on_demand();
} // namespace tread

#endif
