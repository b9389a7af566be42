#include <cmath>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/site.h>

namespace mimicry::geodesic {

Site site_of(const TriangleMesh& mesh, const SurfacePoint& p) {
  for (int k = 0; k < 3; ++k)
    if (p.bary[(k + 1) % 3] <= kOnEdge && p.bary[(k + 2) % 3] <= kOnEdge)
      return {Site::Kind::vertex, mesh.face(p.face)[static_cast<std::size_t>(k)], 0.0};
  for (int k = 0; k < 3; ++k)
    if (p.bary[k] <= kOnEdge) {
      const double a = p.bary[(k + 1) % 3];
      const double b = p.bary[(k + 2) % 3];
      return {Site::Kind::edge, 3 * p.face + (k + 1) % 3, b / (a + b)};
    }
  return {Site::Kind::face, p.face, 0.0};
}

void check_surface_point(const TriangleMesh& mesh, const SurfacePoint& p, std::string_view what) {
  constexpr double kTolerance = 1e-6;
  const auto fail = [&](const std::string& why) {
    throw Error(ErrorKind::invalid_input, std::string(what) + ": " + why);
  };
  if (p.face < 0 || p.face >= mesh.face_count())
    fail("face " + std::to_string(p.face) + " is not among the mesh's " +
         std::to_string(mesh.face_count()) + " faces");
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(p.bary[k]) || p.bary[k] < -kTolerance || p.bary[k] > 2.0)
      fail("barycentric coordinate " + std::to_string(k) + " is " + std::to_string(p.bary[k]) +
           "; they must be at least 0");
  if (std::abs(p.bary.sum() - 1.0) > kTolerance)
    fail("barycentric coordinates sum to " + std::to_string(p.bary.sum()) + "; they must sum to 1");
}

SurfacePoint normalised(const SurfacePoint& p) {
  const Vec3 bary = p.bary.cwiseMax(0.0);
  return {p.face, bary / bary.sum()};
}

SurfacePoint vertex_point(const HalfEdges& half_edges, Index vertex) {
  const Index h = half_edges.outgoing(vertex);
  if (h < 0) return {};
  SurfacePoint p{HalfEdges::face(h), Vec3::Zero()};
  p.bary[HalfEdges::corner(h)] = 1.0;
  return p;
}

}  // namespace mimicry::geodesic
