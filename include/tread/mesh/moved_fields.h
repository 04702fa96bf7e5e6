// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_moved_fields_h
#define tread_mesh_moved_fields_h

#include <tread/mesh/mesh.h>

#include <vector>

namespace tread
{
  /// Nodal fields of a mesh at the nodes of another that refines the same coarse cells otherwise: nodes that
  /// both have keep their values, new ones have those of the trilinear field in the cell where they are.
  /// @param fields of the nodes of `from`, hanging nodes included. @returns as many of the nodes of `to`,
  /// copies on all ranks alike. All ranks receive the cells of all. Collective.
  /// @throws std::logic_error if the meshes have other coarse cells
  std::vector<NodalField> moved_fields(const Mesh                            &from,
                                       const std::vector<const NodalField *> &fields,
                                       const Mesh                            &to);
} // namespace tread

#endif
