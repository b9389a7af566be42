#pragma once

#include <span>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// Rectangles of steps + 3 by steps + 2 texels, each of which holds two faces, in the order in
/// which they are placed: largest first, from left to right, rows from the top.
struct CellRow {
  int steps, x, y;
  int count;  ///< of rectangles side by side
};

/// The corner of a face opposite its longest edge; the first of equals.
int corner_of_largest_angle(const TriangleMesh& mesh, Index face);

/// #F: texel steps of each face's legs, at least 1, as many as have room in a texture of this size
/// at one density; 0 for faces that repeat a corner. Empty where there is no room for one each.
std::vector<int> cell_steps(const TriangleMesh& mesh, int size);

/// Places `counts[s]` faces of s steps each. Empty where they have no room.
std::vector<CellRow> place_rows(std::span<const int> counts, int size);

/// Whether this many faces of one step each have room.
bool has_room(int faces, int size);

}  // namespace mimicry
