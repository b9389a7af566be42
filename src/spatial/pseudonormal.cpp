#include "spatial/pseudonormal.h"

namespace mimicry {

Vec3 pseudonormal(const Target& target, const SurfacePoint& p) {
  int corner = 0, off = 0, zeros = 0;
  for (int k = 0; k < 3; ++k) {
    if (p.bary[k] >= kOnEdge)
      corner = k;
    else
      off = k, ++zeros;
  }
  const TriangleMesh& mesh = target.mesh();
  if (zeros == 2)
    return target.vertex_normals()[static_cast<std::size_t>(
        mesh.face(p.face)[static_cast<std::size_t>(corner)])];
  const Vec3 normal = face_normal(mesh, p.face);
  const Index twin = zeros == 1 ? target.half_edges().twin(3 * p.face + (off + 1) % 3) : kNone;
  if (twin < 0) return normal;
  const Vec3 sum = normal + face_normal(mesh, HalfEdges::face(twin));
  const double length = sum.norm();
  return length > 1e-12 ? Vec3(sum / length) : normal;
}

std::optional<Vec3> distance_gradient(const Target& target, const Vec3& y, Index hint) {
  const auto closest = target.closest_point(y, kInfinity, hint);
  if (!closest) return std::nullopt;
  const double near = kOnSurface * target.diagonal();
  if (closest->distance > near) return Vec3((y - closest->position) / closest->distance);
  return pseudonormal(target, closest->surface);
}

}  // namespace mimicry
