#include "geodesic/site.h"

#include <cassert>
#include <cmath>
#include <string>

#include <mimicry/base/error.h>

namespace mimicry {
namespace {

// Of barycentric coordinates that a caller gives.
constexpr double kTolerance = 1e-6;

int corner_of(const TriangleMesh& mesh, Index face, Index vertex) {
  for (int k = 0; k < 3; ++k)
    if (mesh.face(face)[static_cast<std::size_t>(k)] == vertex) return k;
  return -1;
}

bool holds(const TriangleMesh& mesh, Index face, const SurfacePoint& p) {
  if (face == p.face) return true;
  const Site site = site_of(mesh, p);
  if (site.kind == Site::Kind::face) return false;
  if (site.kind == Site::Kind::vertex) return corner_of(mesh, face, site.index) >= 0;
  const Face& own = mesh.face(p.face);
  const auto k = static_cast<std::size_t>(HalfEdges::corner(site.index));
  return corner_of(mesh, face, own[k]) >= 0 && corner_of(mesh, face, own[(k + 1) % 3]) >= 0;
}

}  // namespace

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

bool is_on(const TriangleMesh& mesh, const SurfacePoint& p) {
  return p.face >= 0 && p.face < mesh.face_count() && !repeats_corner(mesh.face(p.face)) &&
         p.bary.allFinite() && p.bary.minCoeff() >= -kTolerance &&
         std::abs(p.bary.sum() - 1.0) <= kTolerance;
}

void check_surface_point(const TriangleMesh& mesh, const SurfacePoint& p, std::string_view what) {
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

Index shared_face(const TriangleMesh& mesh, const HalfEdges& half_edges, const SurfacePoint& a,
                  const SurfacePoint& b) {
  if (holds(mesh, a.face, b)) return a.face;
  if (holds(mesh, b.face, a)) return b.face;
  const Site site = site_of(mesh, a);
  if (site.kind == Site::Kind::edge) {
    const Index twin = half_edges.twin(site.index);
    if (twin >= 0 && holds(mesh, HalfEdges::face(twin), b)) return HalfEdges::face(twin);
  }
  if (site.kind != Site::Kind::vertex) return kNone;
  const Index first = 3 * a.face + corner_of(mesh, a.face, site.index);
  Index h = first;
  do {
    if (holds(mesh, HalfEdges::face(h), b)) return HalfEdges::face(h);
    h = half_edges.ccw(h);
  } while (h >= 0 && h != first);
  if (h >= 0) return kNone;
  for (h = half_edges.cw(first); h >= 0; h = half_edges.cw(h))
    if (holds(mesh, HalfEdges::face(h), b)) return HalfEdges::face(h);
  return kNone;
}

SurfacePoint in_face(const TriangleMesh& mesh, const SurfacePoint& p, Index face) {
  if (p.face == face) return p;
  assert(holds(mesh, face, p));
  SurfacePoint q{face, Vec3::Zero()};
  for (int k = 0; k < 3; ++k) {
    const int corner = corner_of(mesh, face, mesh.face(p.face)[static_cast<std::size_t>(k)]);
    if (corner >= 0) q.bary[corner] = p.bary[k];
  }
  q.bary /= q.bary.sum();
  return q;
}

SurfacePoint vertex_point(const HalfEdges& half_edges, Index vertex) {
  const Index h = half_edges.outgoing(vertex);
  if (h < 0) return {};
  SurfacePoint p{HalfEdges::face(h), Vec3::Zero()};
  p.bary[HalfEdges::corner(h)] = 1.0;
  return p;
}

}  // namespace mimicry
