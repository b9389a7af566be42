#include "bake/shell.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <mimicry/base/error.h>

#include "bake/octree.h"
#include "bake/recovery.h"
#include "bake/sheets.h"
#include "bake/unit_mesh.h"

namespace mimicry {
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

// What a bake takes goes with the number of the shell's vertices, 2 to 3 kB each and some time in
// every iteration. Sound meshes take up to 3 a face at the usual offset; four times as many where
// the shell is half as thick.
double most_vertices(const TriangleMesh& mesh, double offset) {
  const double thin = std::max(1.0, 0.05 / offset);
  return (40000.0 + 3.0 * mesh.face_count()) * thin * thin;
}

// Where sheets are close, tetrahedra between them come once for each: more than these, at some 0.6
// kB each, are made again of fewer nodes.
double most_tets(const TriangleMesh& mesh, double offset) {
  const double thin = std::max(1.0, 0.05 / offset);
  return (400000.0 + 15.0 * mesh.face_count()) * thin * thin;
}

// Far more than what the usual offset takes; memory would end at some ten times as many.
std::size_t most_cells(const TriangleMesh& mesh) {
  return std::max<std::size_t>(400000, 8 * at(mesh.face_count()));
}

Error too_many_cells(const TriangleMesh& mesh, double offset) {
  return Error(ErrorKind::invalid_input, "bake: a shell that reaches " + std::to_string(offset) +
                                             " of the diagonal takes more than " +
                                             std::to_string(most_cells(mesh)) +
                                             " cells around this mesh; give a larger offset");
}

// How often edges of the surface cross its faces, up to about `most`, and which faces those are.
struct SelfCrossings {
  double count = 0.0;
  Index faces = 0;
};

SelfCrossings self_crossings(const UnitSurface& surface, double most, Executor& executor,
                             const ProgressCallback& progress) {
  const TriangleMesh& mesh = surface.mesh();
  std::vector<std::array<Index, 2>> edges;
  edges.reserve(3 * at(mesh.face_count()));
  for (const Face& f : mesh.faces())
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back({std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])});
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  // Blocks of chunks, so that the answer does not depend on the number of threads.
  constexpr std::size_t kEdgeChunk = 64, kBlock = 64 * kEdgeChunk;
  SelfCrossings found;
  std::vector<std::vector<Index>> crossed(kBlock / kEdgeChunk);
  std::vector<bool> is_crossed(at(mesh.face_count()), false);
  for (std::size_t first = 0; first < edges.size() && found.count <= most; first += kBlock) {
    report(progress, "shell", 0.0);
    for (auto& faces : crossed) faces.clear();
    executor.for_chunks(std::min(kBlock, edges.size() - first), kEdgeChunk,
                        [&](std::size_t begin, std::size_t end, int) {
                          for (std::size_t e = first + begin; e < first + end; ++e) {
                            const auto [a, b] = edges[e];
                            surface.crossings(mesh.position(a), mesh.position(b),
                                              [&, a = a, b = b](Index f, double, const Vec3&) {
                                                for (const Index v : mesh.face(f))
                                                  if (v == a || v == b) return;
                                                crossed[begin / kEdgeChunk].push_back(f);
                                              });
                          }
                        });
    for (const auto& faces : crossed) {
      found.count += static_cast<double>(faces.size());
      for (const Index f : faces) is_crossed[at(f)] = true;
    }
  }
  found.faces = static_cast<Index>(std::count(is_crossed.begin(), is_crossed.end(), true));
  return found;
}

// The octree's nodes that stand clear of the surface, as fine as the surface's triangles where that
// is not too many.
std::vector<OctreeNode> nodes_around(const UnitSurface& surface, double offset, double half_side,
                                     double most, Executor& executor,
                                     const ProgressCallback& progress) {
  const TriangleMesh& mesh = surface.mesh();
  const std::vector<double> sizes = local_sizes(mesh);
  Grading grading;
  grading.offset = offset;
  grading.smallest = offset / 24.0;
  grading.largest = offset;
  grading.side = 2.0;
  grading.slope = 1.0;
  for (;; grading.smallest = std::min(2.0 * grading.smallest, grading.largest)) {
    report(progress, "shell", 0.0);
    const bool is_last = grading.smallest == grading.largest;
    grading.most_cells =
        is_last ? most_cells(mesh) : std::min(most_cells(mesh), static_cast<std::size_t>(most));
    const auto octree = make_octree(surface, sizes, grading, half_side, executor);
    if (!octree) {
      if (is_last) throw too_many_cells(mesh, offset);
      continue;
    }
    report(progress, "shell", 0.2);
    std::vector<OctreeNode> nodes = octree_nodes(*octree, surface, sizes, true, executor);
    std::erase_if(nodes, [&grading](const OctreeNode& node) {
      // Nearer points would take the surface's edges apart.
      constexpr double kClear = 0.6;
      return node.distance < kClear * std::clamp(node.local, grading.smallest, grading.largest);
    });
    if (is_last || static_cast<double>(nodes.size()) + mesh.vertex_count() <= most) return nodes;
  }
}

// What may be missing of a surface that stands in its shell.
double most_missing_faces(const TriangleMesh& mesh) {
  return 0.01 * mesh.face_count() + 2.0;
}
double most_missing_edges(const TriangleMesh& mesh) {
  return 1.5 * most_missing_faces(mesh);
}
bool stands(const Shell& shell, const TriangleMesh& mesh) {
  return shell.missing_edges <= most_missing_edges(mesh) &&
         shell.pierced_faces <= most_missing_faces(mesh);
}

// make_shell of at most so many nodes and vertices before what recovery adds.
Shell shell_of(const TriangleMesh& mesh, const ShellOptions& options, double most_nodes,
               Executor& executor, const ProgressCallback& progress) {
  const double half_side = grid_half_side(options.offset);
  const UnitSurface surface(mesh);
  const std::vector<OctreeNode> nodes =
      nodes_around(surface, options.offset, half_side, most_nodes, executor, progress);
  report(progress, "shell", 0.4);

  Shell shell;
  shell.positions.assign(mesh.positions().begin(), mesh.positions().end());
  std::vector<double> distances(shell.positions.size(), 0.0);
  for (const OctreeNode& node : nodes) {
    shell.positions.push_back(node.position);
    distances.push_back(node.distance);
  }
  std::vector<GridPoint> grid(shell.positions.size());
  for (std::size_t v = 0; v < grid.size(); ++v) grid[v] = to_grid(shell.positions[v], half_side);
  Delaunay delaunay;
  delaunay.insert(grid);
  report(progress, "shell", 0.7);

  Recovery recovery(surface, delaunay, shell.positions, distances, half_side, executor);
  const std::size_t most = grid.size() + 10000 + 2 * at(mesh.face_count());
  for (shell.rounds = 0; recovery.round(); ++shell.rounds) {
    report(progress, "shell", 0.7 + 0.3 * shell.rounds / options.most_rounds);
    if (shell.rounds == options.most_rounds || shell.positions.size() > most) {
      shell.hit_a_cap = true;
      break;
    }
  }
  recovery.count(most_missing_edges(mesh));
  shell.missing_edges = recovery.missing_edges();
  shell.pierced_faces = recovery.pierced_faces();
  shell.crossing_faces = recovery.crossing_faces();
  shell.hit_a_cap = shell.hit_a_cap || recovery.hit_shortest();
  if (!stands(shell, mesh)) return shell;
  keep_near(shell, delaunay, distances, recovery.ties(), mesh.vertex_count(), options.offset);
  separate_sheets(shell, surface, executor);
  return shell;
}

}  // namespace

Shell make_shell(const TriangleMesh& mesh, const ShellOptions& options, Executor& executor,
                 const ProgressCallback& progress) {
  assert(options.offset > 0.0);
  const double most = most_vertices(mesh, options.offset);
  Shell shell;
  for (const double part : {1.0, 0.5, 0.25}) {
    shell = shell_of(mesh, options, part * most, executor, progress);
    if (static_cast<double>(shell.tets.size()) <= most_tets(mesh, options.offset)) return shell;
  }
  shell.hit_a_cap = true;
  shell.tets.clear();
  return shell;
}

Shell make_lattice_shell(const TriangleMesh& mesh, const ShellOptions& options, Executor& executor,
                         const ProgressCallback& progress) {
  report(progress, "lattice", 0.0);
  const double half_side = grid_half_side(options.offset);
  const UnitSurface surface(mesh);
  const std::vector<double> sizes(at(mesh.vertex_count()), 0.0);
  Grading grading;
  grading.offset = options.offset;
  grading.smallest = grading.largest = options.offset / 4.0;
  const double thin = std::max(1.0, 0.05 / options.offset);
  grading.most_cells = static_cast<std::size_t>(40000.0 * thin * thin);
  std::optional<Octree> found = make_octree(surface, sizes, grading, half_side, executor);
  while (!found) {
    if (grading.smallest >= options.offset) throw too_many_cells(mesh, options.offset);
    grading.smallest = grading.largest = 2.0 * grading.smallest;
    found = make_octree(surface, sizes, grading, half_side, executor);
  }
  const Octree& octree = *found;
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
  // So many crossings cannot be made to stand in the tetrahedra: each brings points that take
  // others apart, and the attempt grows without end.
  const double most_crossings = 100.0 + 0.5 * mesh.face_count();
  const SelfCrossings crossings =
      self_crossings(UnitSurface(mesh), most_crossings, executor, progress);
  if (crossings.count > most_crossings) {
    Shell lattice = make_lattice_shell(mesh, options, executor, progress);
    lattice.crossing_faces = crossings.faces;
    return lattice;
  }
  Shell shell = make_shell(mesh, options, executor, progress);
  if (!shell.tets.empty()) return shell;
  Shell lattice = make_lattice_shell(mesh, options, executor, progress);
  lattice.rounds = shell.rounds;
  lattice.missing_edges = shell.missing_edges;
  lattice.pierced_faces = shell.pierced_faces;
  lattice.crossing_faces = shell.crossing_faces;
  lattice.hit_a_cap = shell.hit_a_cap;
  return lattice;
}

}  // namespace mimicry
