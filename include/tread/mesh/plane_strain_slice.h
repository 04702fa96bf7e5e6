// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_plane_strain_slice_h
#define tread_mesh_plane_strain_slice_h

#include <tread/mesh/mesh_file.h>

namespace tread
{
  /// Whether a rail from a file lies between two planes of symmetry along the path. Its running surface may
  /// be touched up to them and goes on behind them as its own image: a wheel with the same section all over
  /// its width then loads it as in plane strain.
  inline bool is_slice(const MeshFile &mesh)
  {
    const MeshFile::Range across = mesh.range(1);
    bool                  ends[2]{};
    for (const NamedFace &face : mesh.faces)
      if (face.boundary == Boundary::side)
        ends[mesh.vertices[face.vertices[0]][1] > 0.5 * (across.begin + across.end)] = true;
    return ends[0] && ends[1];
  }
} // namespace tread

#endif
