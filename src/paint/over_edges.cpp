#include "paint/over_edges.h"

#include <cmath>

namespace mimicry {
namespace {

// A texel beyond an edge passes few faces, unless they are slivers, where any is as good.
constexpr int kMostSteps = 16;
// What rounding leaves of a coordinate that is 0.
constexpr double kNegative = 1e-12;

SurfacePoint clamped(Index face, const Vec3& bary) {
  const Vec3 positive = bary.cwiseMax(0.0);
  return {face, positive / positive.sum()};
}

// A point of the plane of half-edge h's face, in the barycentric coordinates of the twin's face
// laid beside it. False where that has no size.
bool unfold(const Surface& surface, Index h, const Vec3& bary, Vec3& result) {
  const TriangleMesh& mesh = surface.mesh();
  const Index g = surface.half_edges().twin(h);
  const int k = HalfEdges::corner(h), l = HalfEdges::corner(g);
  const Index f = HalfEdges::face(h), to = HalfEdges::face(g);
  const Vec3 edge = mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k);
  const double length = edge.norm();
  const Vec3 near = mesh.corner(f, (k + 2) % 3) - mesh.corner(f, k);
  const Vec3 far = mesh.corner(to, (l + 2) % 3) - mesh.corner(f, k);
  const double far_height = far.cross(edge).norm() / length;
  if (!(length > 0.0 && far_height > 0.0)) return false;
  // Along the edge from its tail, and across it away from the face.
  const double along = bary[(k + 1) % 3] * length + bary[(k + 2) % 3] * near.dot(edge) / length;
  const double across = -bary[(k + 2) % 3] * near.cross(edge).norm() / length;
  const double top = across / far_height;
  const double head = (along - top * far.dot(edge) / length) / length;
  result[(l + 2) % 3] = top;
  result[l] = head;  // the twin leaves the edge's head
  result[(l + 1) % 3] = 1.0 - top - head;
  return result.allFinite();
}

}  // namespace

SurfacePoint over_edges(const Surface& surface, Index face, const Vec3& bary) {
  Vec3 b = bary;
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::Index lowest;
    if (b.minCoeff(&lowest) >= -kNegative) break;
    const Index h = 3 * face + static_cast<Index>((lowest + 1) % 3);  // opposite that corner
    Vec3 next;
    if (!surface.half_edges().has_twin(h) || !unfold(surface, h, b, next)) break;
    b = next;
    face = HalfEdges::face(surface.half_edges().twin(h));
  }
  return clamped(face, b);
}

}  // namespace mimicry
