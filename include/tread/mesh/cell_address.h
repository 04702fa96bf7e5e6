// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_mesh_cell_address_h
#define tread_mesh_cell_address_h

#include <array>
#include <cstdint>

namespace tread
{
  /// The place of a cell in the octree: the coarse cell, and from there the number of the child on each
  /// level. It does not depend on ranks, and means the same in all meshes that refine the same coarse cells.
  /// Children and corners have the same order: a child touches the corner of its parent with its own number.
  class CellAddress
  {
  public:
    static constexpr unsigned int max_levels = 12;

    CellAddress() = default;

    /// @param children numbers 0 to 7 from the coarse cell on, at most max_levels of them
    template <typename Children>
    CellAddress(const std::uint64_t coarse, const Children &children)
      : code(coarse << bits_of_path | 1)
    {
      for (const unsigned int child : children)
        code = this->child(child).code;
    }

    CellAddress child(const unsigned int number) const
    {
      CellAddress down;
      down.code = coarse_part() | path() << 3 | number;
      return down;
    }
    /// @pre not is_coarse()
    CellAddress parent() const
    {
      CellAddress up;
      up.code = coarse_part() | path() >> 3;
      return up;
    }
    /// Its number among the children of its parent.
    unsigned int number() const
    {
      return path() & 7;
    }
    bool is_coarse() const
    {
      return path() == 1;
    }
    auto operator<=>(const CellAddress &) const = default;

  private:
    /// Three bits a level, and a one before them all that says where they begin.
    static constexpr unsigned int bits_of_path = 3 * max_levels + 1;

    std::uint64_t path() const
    {
      return code & ((std::uint64_t(1) << bits_of_path) - 1);
    }
    std::uint64_t coarse_part() const
    {
      return code & ~((std::uint64_t(1) << bits_of_path) - 1);
    }

    std::uint64_t code = 1;
  };
} // namespace tread

#endif
