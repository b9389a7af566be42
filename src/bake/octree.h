#pragma once

#include <array>
#include <optional>
#include <vector>

#include <mimicry/base/parallel.h>
#include <mimicry/base/types.h>

#include "bake/unit_mesh.h"

namespace mimicry {

/// A cube of the octree: its lower corner in units of the finest cell, its side in the same.
struct OctreeCell {
  std::array<std::int32_t, 3> corner;
  std::int32_t side;
};

struct OctreeNode {
  Vec3 position;
  double distance;  ///< from the surface
  double local;     ///< size of the surface's triangles at the closest point
  double side;      ///< of the cell that it came from
};

struct Octree {
  static constexpr int kDepth = 20;
  double half_side = 1.0;  ///< of the root, around the origin
  std::vector<OctreeCell> cells;

  double unit() const { return 2.0 * half_side / (1 << kDepth); }
  Vec3 position(double x, double y, double z) const {
    return Vec3(x, y, z) * unit() - Vec3::Constant(half_side);
  }
};

/// How large a cell may be.
struct Grading {
  double offset = 0.05;   ///< cells that come this near to the surface are kept
  double smallest = 0.0;  ///< cells are not split below this
  double largest = 0.0;   ///< nor left above this
  double side = 1.0;      ///< of a cell at the surface, in local sizes of its triangles
  double slope = 0.0;     ///< growth of the side with the distance from the surface
  std::size_t most_cells = 400000;
};

/// The leaves within `offset` of the surface, in a fixed order: a cell is split while it is larger
/// than `side` times the local size of the triangles, plus slope times the distance beyond it.
/// local_size: #V, unit mesh. nullopt where there would be more than most_cells.
std::optional<Octree> make_octree(const UnitSurface& surface, const std::vector<double>& local_size,
                                  const Grading& grading, double half_side, Executor& executor);

/// The corners and, where `centres`, the centres of the cells, each once. They are points of the
/// Delaunay grid: where several lie on one sphere the ties are exact, and no slivers come of
/// rounding.
std::vector<OctreeNode> octree_nodes(const Octree& octree, const UnitSurface& surface,
                                     const std::vector<double>& local_size, bool centres,
                                     Executor& executor);

/// Mean length of the edges at each vertex; the mean over the mesh where there is none.
std::vector<double> local_sizes(const TriangleMesh& mesh);

}  // namespace mimicry
