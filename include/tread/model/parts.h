// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_model_parts_h
#define tread_model_parts_h

#include <vector>

namespace tread
{
  struct Model;

  /// What adds to a model that is being made, which has its mesh and its wheels, the parts that its scene
  /// asks for, and tells its contact what the scene prescribes there. In the order in which the parts act. A
  /// new part is a line in parts.cc. Each is called by all ranks alike.
  const std::vector<void (*)(Model &)> &model_parts();
} // namespace tread

#endif
