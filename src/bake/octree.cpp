#include "bake/octree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bake/morton.h"

namespace mimicry {
namespace {

constexpr std::size_t kCellChunk = 256;

double size_at(const UnitSurface& surface, const std::vector<double>& local_size,
               const NearestTriangle& nearest) {
  double size = 0.0;
  for (int k = 0; k < 3; ++k)
    size += nearest.surface.bary[k] * local_size[static_cast<std::size_t>(surface.mesh().face(
                                          nearest.surface.face)[static_cast<std::size_t>(k)])];
  return size;
}

}  // namespace

std::vector<double> local_sizes(const TriangleMesh& mesh) {
  std::vector<double> sum(static_cast<std::size_t>(mesh.vertex_count()), 0.0);
  std::vector<Index> count(sum.size(), 0);
  double all = 0.0;
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const double length = (mesh.corner(f, k) - mesh.corner(f, (k + 1) % 3)).norm();
      all += length;
      for (const int end : {k, (k + 1) % 3}) {
        const auto v = static_cast<std::size_t>(mesh.face(f)[static_cast<std::size_t>(end)]);
        sum[v] += length;
        ++count[v];
      }
    }
  for (std::size_t v = 0; v < sum.size(); ++v)
    sum[v] = count[v] > 0 ? sum[v] / count[v] : all / (3.0 * mesh.face_count());
  return sum;
}

std::optional<Octree> make_octree(const UnitSurface& surface, const std::vector<double>& local_size,
                                  const Grading& grading, double half_side, Executor& executor) {
  Octree octree;
  octree.half_side = half_side;
  struct Pending {
    OctreeCell cell;
    Index hint;
    bool keep = false;
    bool split = false;
  };
  std::vector<Pending> level(1), next;
  level[0] = {{{0, 0, 0}, 1 << Octree::kDepth}, kNone};
  while (!level.empty()) {
    executor.for_chunks(level.size(), kCellChunk, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) {
        Pending& p = level[i];
        const double half = 0.5 * p.cell.side;
        const Vec3 centre = octree.position(p.cell.corner[0] + half, p.cell.corner[1] + half,
                                            p.cell.corner[2] + half);
        const auto nearest = surface.nearest(centre, p.hint);
        p.hint = nearest.surface.face;
        const double distance = std::sqrt(nearest.distance2);
        const double side = p.cell.side * octree.unit();
        p.keep = distance <= grading.offset + 0.5 * std::sqrt(3.0) * side;
        const double local =
            std::clamp(size_at(surface, local_size, nearest), grading.smallest, grading.largest);
        const double beyond = std::max(0.0, distance - 0.5 * side - local);
        const double wanted =
            std::min(grading.side * local + grading.slope * beyond, grading.largest);
        p.split = p.keep && side > wanted && p.cell.side > 1;
      }
    });
    next.clear();
    for (const Pending& p : level) {
      if (!p.keep) continue;
      if (!p.split) {
        octree.cells.push_back(p.cell);
        continue;
      }
      if (octree.cells.size() + next.size() > grading.most_cells) return std::nullopt;
      const std::int32_t half = p.cell.side / 2;
      for (int k = 0; k < 8; ++k) {
        Pending child{};
        child.cell = {{p.cell.corner[0] + (k & 1) * half, p.cell.corner[1] + (k >> 1 & 1) * half,
                       p.cell.corner[2] + (k >> 2) * half},
                      half};
        child.hint = p.hint;
        next.push_back(child);
      }
    }
    std::swap(level, next);
  }
  return octree;
}

std::vector<OctreeNode> octree_nodes(const Octree& octree, const UnitSurface& surface,
                                     const std::vector<double>& local_size, bool centres,
                                     Executor& executor) {
  // Coordinates doubled so that centres are whole numbers.
  struct Place {
    std::uint64_t key;
    std::array<std::int32_t, 3> at;
    std::int32_t side;
  };
  std::vector<Place> places;
  places.reserve(octree.cells.size() * 9);
  for (const OctreeCell& cell : octree.cells) {
    const auto add = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
      const std::array<std::int32_t, 3> at = {2 * cell.corner[0] + x, 2 * cell.corner[1] + y,
                                              2 * cell.corner[2] + z};
      // The root's far side is one beyond what the key can hold: it folds, which only costs
      // locality.
      places.push_back({morton(static_cast<std::uint64_t>(at[0]), static_cast<std::uint64_t>(at[1]),
                               static_cast<std::uint64_t>(at[2])),
                        at, cell.side});
    };
    for (int k = 0; k < 8; ++k)
      add((k & 1) * 2 * cell.side, (k >> 1 & 1) * 2 * cell.side, (k >> 2) * 2 * cell.side);
    if (centres) add(cell.side, cell.side, cell.side);
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    if (a.key != b.key) return a.key < b.key;
    return a.at != b.at ? a.at < b.at : a.side < b.side;
  });
  // Of a place that several cells share the smallest cell counts.
  places.erase(std::unique(places.begin(), places.end(),
                           [](const Place& a, const Place& b) { return a.at == b.at; }),
               places.end());
  std::vector<OctreeNode> nodes(places.size());
  executor.for_chunks(places.size(), kCellChunk, [&](std::size_t begin, std::size_t end, int) {
    Index hint = kNone;
    for (std::size_t i = begin; i < end; ++i) {
      const auto& at = places[i].at;
      OctreeNode& node = nodes[i];
      node.position = octree.position(0.5 * at[0], 0.5 * at[1], 0.5 * at[2]);
      const auto nearest = surface.nearest(node.position, hint);
      hint = nearest.surface.face;
      node.distance = std::sqrt(nearest.distance2);
      node.local = size_at(surface, local_size, nearest);
      node.side = places[i].side * octree.unit();
    }
  });
  return nodes;
}

}  // namespace mimicry
