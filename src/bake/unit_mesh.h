#pragma once

#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

#include "bake/delaunay.h"
#include "spatial/bvh.h"
#include "spatial/surface_search.h"

namespace mimicry {

/// The target as the bake works on it: centred, with a diagonal of 1, vertices that fall on one
/// point of the grid joined, repeated faces and faces with two equal corners dropped.
struct UnitMesh {
  TriangleMesh mesh;
  std::vector<Index> joined;  ///< #V of the target: its vertex in `mesh`
  std::vector<Index> first;   ///< #V of `mesh`: the first vertex of the target that it stands for
  Vec3 centre = Vec3::Zero();
  double diagonal = 1.0;

  Vec3 to_target(const Vec3& p) const { return centre + diagonal * p; }
};

/// Half the side of the cube, around the origin, that the grid covers: the mesh is within 0.5 of
/// it, the shell within `offset` of the mesh, and its outermost cells reach less than as much
/// again.
inline double grid_half_side(double offset) {
  return 0.5 + 4.0 * offset;
}

GridPoint to_grid(const Vec3& p, double half_side);

/// Throws Error(invalid_input) where there is nothing to bake: no face with area, or a vertex that
/// is not finite.
UnitMesh make_unit_mesh(const TriangleMesh& target, double half_side);

/// Closest points and edge crossings of the unit mesh.
class UnitSurface {
 public:
  explicit UnitSurface(const TriangleMesh& mesh);
  const TriangleMesh& mesh() const { return mesh_; }
  NearestTriangle nearest(const Vec3& p, Index hint) const {
    return nearest_triangle(bvh_, p, kInfinity, hint, [this](Index f) { return triangle(f); });
  }
  /// visit(face, t, bary) for each face that the segment meets at from + t (to - from).
  template <class Visit>
  void crossings(const Vec3& from, const Vec3& to, Visit&& visit) const {
    const double length = (to - from).norm();
    if (!(length > 0.0)) return;
    const Ray ray(from, (to - from) / length);
    bvh_.along(ray.origin(), ray.direction(), length,
               [&](Index face, const Triangle& candidate, double bound) {
                 const auto hit = ray.hit(candidate);
                 if (hit && hit->t <= length) visit(face, hit->t / length, hit->bary);
                 return bound;
               });
  }

 private:
  Triangle triangle(Index f) const {
    return {mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2)};
  }
  const TriangleMesh& mesh_;
  Bvh<3, Triangle> bvh_;
};

}  // namespace mimicry
