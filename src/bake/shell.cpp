#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <mimicry/bake/shell.h>

#include "bake/octree.h"
#include "bake/recovery.h"
#include "bake/sheets.h"
#include "bake/unit_mesh.h"

namespace mimicry::bake {
namespace {

// Keeps the tetrahedra that reach into the shell, and the vertices that they use.
void keep_near(Shell& shell, const Delaunay& delaunay, const std::vector<double>& distances,
               std::vector<Tie> ties, Index surface_vertices, double offset) {
  for (Index c = 0; c < delaunay.cell_count(); ++c) {
    if (!delaunay.is_tet(c)) continue;
    const Tet& t = delaunay.cell(c).v;
    std::array<Vec3, 4> p;
    double nearest = kInfinity;
    for (std::size_t k = 0; k < 4; ++k) {
      p[k] = shell.positions[at(t[k])];
      nearest = std::min(nearest, distances[at(t[k])]);
    }
    double longest = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, (p[i] - p[j]).squaredNorm());
    // A point of the tetrahedron that is nearer to the surface than its corners lies within its
    // longest edge over sqrt(3) of one of them, at right angles to the way to the surface.
    if (nearest > offset && nearest * nearest - longest / 3.0 > offset * offset) continue;
    // Without thickness but for the rounding to the grid: there is nothing inside.
    constexpr double kThin = 1e-11;
    const double volume = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
    if (volume > kThin * longest * std::sqrt(longest)) shell.tets.push_back(t);
  }
  std::vector<Index> number(shell.positions.size(), kNone);
  for (const Tet& t : shell.tets)
    for (const Index v : t) number[at(v)] = 0;
  Index next = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (static_cast<Index>(v) >= surface_vertices && number[v] == kNone) continue;
    shell.positions[at(next)] = shell.positions[v];
    number[v] = next++;
  }
  shell.positions.resize(at(next));
  for (Tet& t : shell.tets)
    for (Index& v : t) v = number[at(v)];
  for (Tie& tie : ties) {
    tie.vertex = number[at(tie.vertex)];
    if (tie.vertex != kNone) shell.ties.push_back(tie);
  }
  shell.added_vertices = static_cast<Index>(shell.ties.size());
}

// Far more than what the usual offset takes; memory would end at some ten times as many.
std::size_t most_cells(const TriangleMesh& mesh) {
  return std::max<std::size_t>(400000, 8 * at(mesh.face_count()));
}

}  // namespace

Shell make_shell(const TriangleMesh& mesh, const ShellOptions& options, Executor& executor,
                 const ProgressCallback& progress) {
  assert(options.offset > 0.0);
  report(progress, "shell", 0.0);
  const double half_side = grid_half_side(options.offset);
  const Surface surface(mesh);
  const std::vector<double> sizes = local_sizes(mesh);
  Grading grading;
  grading.offset = options.offset;
  grading.smallest = options.offset / 24.0;
  grading.largest = options.offset;
  grading.side = 2.0;
  grading.slope = 1.0;
  grading.most_cells = most_cells(mesh);
  const Octree octree = make_octree(surface, sizes, grading, half_side, executor);
  report(progress, "shell", 0.2);
  const std::vector<OctreeNode> nodes = octree_nodes(octree, surface, sizes, true, executor);
  report(progress, "shell", 0.4);

  Shell shell;
  shell.positions.assign(mesh.positions().begin(), mesh.positions().end());
  std::vector<double> distances(shell.positions.size(), 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const OctreeNode& node = nodes[i];
    // Nearer points would take the surface's edges apart.
    constexpr double kClear = 0.6;
    if (node.distance < kClear * std::clamp(node.local, grading.smallest, grading.largest))
      continue;
    shell.positions.push_back(node.position);
    distances.push_back(node.distance);
  }
  std::vector<GridPoint> grid(shell.positions.size());
  for (std::size_t v = 0; v < grid.size(); ++v) grid[v] = to_grid(shell.positions[v], half_side);
  Delaunay delaunay;
  delaunay.insert(grid);
  report(progress, "shell", 0.7);

  Recovery recovery(surface, delaunay, shell.positions, distances, half_side, executor);
  const std::size_t most = 3 * grid.size() + 20000;
  for (shell.rounds = 0; recovery.round(); ++shell.rounds) {
    report(progress, "shell", 0.7 + 0.3 * shell.rounds / options.most_rounds);
    if (shell.rounds == options.most_rounds || shell.positions.size() > most) {
      shell.hit_a_cap = true;
      break;
    }
  }
  recovery.count();
  shell.missing_edges = recovery.missing_edges();
  shell.pierced_faces = recovery.pierced_faces();
  shell.crossing_faces = recovery.crossing_faces();
  shell.hit_a_cap = shell.hit_a_cap || recovery.hit_shortest();
  keep_near(shell, delaunay, distances, recovery.ties(), mesh.vertex_count(), options.offset);
  separate_sheets(shell, surface, executor);
  return shell;
}

Shell make_lattice_shell(const TriangleMesh& mesh, const ShellOptions& options, Executor& executor,
                         const ProgressCallback& progress) {
  report(progress, "lattice", 0.0);
  const double half_side = grid_half_side(options.offset);
  const Surface surface(mesh);
  const std::vector<double> sizes(at(mesh.vertex_count()), 0.0);
  Grading grading;
  grading.offset = options.offset;
  grading.smallest = grading.largest = options.offset / 4.0;
  grading.most_cells = most_cells(mesh);
  Octree octree = make_octree(surface, sizes, grading, half_side, executor);
  report(progress, "lattice", 0.5);

  Shell shell;
  shell.is_lattice = true;
  shell.positions.assign(mesh.positions().begin(), mesh.positions().end());
  // Corners are named by their place in units of the cells' common side, 21 bits each.
  const std::int32_t side = octree.cells.front().side;
  const auto key = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return static_cast<std::uint64_t>(x << 42 | y << 21 | z);
  };
  std::vector<std::uint64_t> corners;
  for (const OctreeCell& cell : octree.cells)
    for (int k = 0; k < 8; ++k)
      corners.push_back(key(cell.corner[0] / side + (k & 1), cell.corner[1] / side + (k >> 1 & 1),
                            cell.corner[2] / side + (k >> 2)));
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const auto number = [&](std::uint64_t k) {
    return mesh.vertex_count() +
           static_cast<Index>(std::lower_bound(corners.begin(), corners.end(), k) -
                              corners.begin());
  };
  for (const std::uint64_t k : corners) {
    const auto x = static_cast<double>(k >> 42), y = static_cast<double>(k >> 21 & 0x1fffff),
               z = static_cast<double>(k & 0x1fffff);
    shell.positions.push_back(octree.position(x * side, y * side, z * side));
  }
  // Kuhn's six tetrahedra: from the lower to the upper corner along the axes in each order.
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  const auto corners_of = [&](std::array<std::int32_t, 3> place, const int* order) {
    Tet t;
    t[0] = number(key(place[0], place[1], place[2]));
    for (std::size_t k = 0; k < 3; ++k) {
      ++place[static_cast<std::size_t>(order[k])];
      t[k + 1] = number(key(place[0], place[1], place[2]));
    }
    return t;
  };
  for (const OctreeCell& cell : octree.cells)
    for (int o = 0; o < 6; ++o) {
      Tet t = corners_of({cell.corner[0] / side, cell.corner[1] / side, cell.corner[2] / side},
                         kOrders[o]);
      if (o >= 3) std::swap(t[2], t[3]);
      shell.tets.push_back(t);
    }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = (mesh.position(v) + Vec3::Constant(half_side)) / (octree.unit() * side);
    const Vec3 lower = p.array().floor();
    const Vec3 part = p - lower;
    std::array<int, 3> order = {0, 1, 2};
    std::sort(order.begin(), order.end(),
              [&part](int a, int b) { return part[a] != part[b] ? part[a] > part[b] : a < b; });
    SoftConstraint binding;
    binding.vertices =
        corners_of({static_cast<std::int32_t>(lower[0]), static_cast<std::int32_t>(lower[1]),
                    static_cast<std::int32_t>(lower[2])},
                   order.data());
    binding.weights = {1.0 - part[order[0]], part[order[0]] - part[order[1]],
                       part[order[1]] - part[order[2]], part[order[2]]};
    binding.row = v;
    shell.bindings.push_back(binding);
  }
  return shell;
}

Shell make_some_shell(const TriangleMesh& mesh, const ShellOptions& options, Executor& executor,
                      const ProgressCallback& progress) {
  Shell shell = make_shell(mesh, options, executor, progress);
  constexpr double kBad = 0.01;
  const double most = kBad * mesh.face_count() + 2.0;
  if (shell.missing_edges <= 1.5 * most && shell.pierced_faces <= most) return shell;
  Shell lattice = make_lattice_shell(mesh, options, executor, progress);
  lattice.rounds = shell.rounds;
  lattice.missing_edges = shell.missing_edges;
  lattice.pierced_faces = shell.pierced_faces;
  lattice.crossing_faces = shell.crossing_faces;
  lattice.hit_a_cap = shell.hit_a_cap;
  return lattice;
}

}  // namespace mimicry::bake
