#include "bake/unit_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include <mimicry/base/error.h>

namespace mimicry {

GridPoint to_grid(const Vec3& p, double half_side) {
  GridPoint g;
  for (int k = 0; k < 3; ++k) {
    // The octree's nodes are points of the grid.
    constexpr double kHalf = 1 << (kGridBits - 1);
    const double x = (p[k] / half_side + 1.0) * kHalf;
    g[static_cast<std::size_t>(k)] =
        static_cast<std::int32_t>(std::lround(std::clamp(x, 0.0, 2.0 * kHalf - 1.0)));
  }
  return g;
}

UnitMesh make_unit_mesh(const TriangleMesh& target, double half_side) {
  UnitMesh unit;
  Eigen::AlignedBox3d box;
  for (Index v = 0; v < target.vertex_count(); ++v) {
    // Not compared before they are known to be numbers: comparisons with NaN raise a flag.
    constexpr double kMost = 1e100;
    const Vec3& p = target.position(v);
    bool usable = true;
    for (int k = 0; k < 3; ++k) usable = usable && std::isfinite(p[k]) && std::abs(p[k]) < kMost;
    if (!usable)
      throw Error(ErrorKind::invalid_input,
                  "bake: vertex " + std::to_string(v) + " is not finite; repair the mesh");
    box.extend(target.position(v));
  }
  const auto nothing = [] {
    return Error(ErrorKind::invalid_input,
                 "bake: the mesh has no face with area; there is no surface to draw on");
  };
  if (box.isEmpty() || target.face_count() == 0) throw nothing();
  unit.centre = 0.5 * (box.min() + box.max());
  const double widest = box.sizes().maxCoeff();
  if (!(widest > 0.0)) throw nothing();
  unit.diagonal = widest * (box.sizes() / widest).norm();

  const auto count = static_cast<std::size_t>(target.vertex_count());
  std::vector<GridPoint> grid(count);
  std::vector<Index> order(count);
  for (std::size_t v = 0; v < count; ++v)
    grid[v] = to_grid((target.positions()[v] - unit.centre) / unit.diagonal, half_side);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&grid](Index a, Index b) {
    const auto& p = grid[static_cast<std::size_t>(a)];
    const auto& q = grid[static_cast<std::size_t>(b)];
    return p != q ? p < q : a < b;
  });
  // The first of each place, in the order of the target's numbers.
  std::vector<Index> leader(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto v = static_cast<std::size_t>(order[k]);
    const bool same = k > 0 && grid[static_cast<std::size_t>(order[k - 1])] == grid[v];
    leader[v] = same ? leader[static_cast<std::size_t>(order[k - 1])] : order[k];
  }
  unit.joined.resize(count);
  std::vector<Vec3> positions;
  for (std::size_t v = 0; v < count; ++v) {
    if (leader[v] == static_cast<Index>(v)) {
      unit.joined[v] = static_cast<Index>(positions.size());
      unit.first.push_back(static_cast<Index>(v));
      positions.push_back((target.positions()[v] - unit.centre) / unit.diagonal);
    } else {
      unit.joined[v] = unit.joined[static_cast<std::size_t>(leader[v])];
    }
  }
  std::vector<std::pair<Face, Index>> keyed;
  for (Index f = 0; f < target.face_count(); ++f) {
    Face face;
    for (std::size_t k = 0; k < 3; ++k)
      face[k] = unit.joined[static_cast<std::size_t>(target.face(f)[k])];
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    std::sort(face.begin(), face.end());
    keyed.emplace_back(face, f);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<Index> kept;
  for (std::size_t k = 0; k < keyed.size(); ++k)
    if (k == 0 || keyed[k].first != keyed[k - 1].first) kept.push_back(keyed[k].second);
  std::sort(kept.begin(), kept.end());
  std::vector<Face> faces;
  bool any_area = false;
  for (const Index f : kept) {
    Face& face = faces.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      face[k] = unit.joined[static_cast<std::size_t>(target.face(f)[k])];
    any_area = any_area || has_area({positions[static_cast<std::size_t>(face[0])],
                                     positions[static_cast<std::size_t>(face[1])],
                                     positions[static_cast<std::size_t>(face[2])]});
  }
  if (!any_area) throw nothing();
  unit.mesh = TriangleMesh(std::move(positions), std::move(faces));
  return unit;
}

UnitSurface::UnitSurface(const TriangleMesh& mesh)
    : mesh_(mesh), bvh_(mesh.face_count(), [this](Index f) { return triangle(f); }) {}

}  // namespace mimicry
