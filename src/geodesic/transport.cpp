#include <cmath>
#include <numbers>

#include <mimicry/geodesic/paths.h>

#include "geodesic/site.h"

namespace mimicry {
namespace {

double signed_angle(const Vec3& from, const Vec3& to, const Vec3& normal) {
  const double sine = normal.dot(from.cross(to));
  const double cosine = from.dot(to);
  return sine == 0.0 && cosine == 0.0 ? 0.0 : std::atan2(sine, cosine);
}

class Carrier {
 public:
  Carrier(const TriangleMesh& mesh, const HalfEdges& half_edges, Index face, const Vec3& vector)
      : mesh_(mesh), half_edges_(half_edges), face_(face) {
    const Vec3 area = mesh.area_vector(face);
    const double size = area.norm();
    normal_ = size > 0.0 ? Vec3(area / size) : Vec3::UnitZ();
    vector_ = vector - vector.dot(normal_) * normal_;
  }

  Index face() const { return face_; }
  const Vec3& vector() const { return vector_; }

  // Over half-edge h of this face.
  void over_edge(Index h) {
    const Vec3 e = edge(h);
    const double along = vector_.dot(e);
    const double left = vector_.dot(normal_.cross(e));
    face_ = HalfEdges::face(half_edges_.twin(h));
    normal_ = normal_of(face_);
    vector_ = along * e + left * normal_.cross(e);
  }

  // Around vertex v into a face that holds it. `before` and `after` point from the vertex to the
  // path's points on both sides; either may vanish.
  void around_vertex(Index v, Index to_face, const Vec3& before, const Vec3& after) {
    if (face_ == to_face) return;
    Angles from;
    Angles to;
    double total = 0.0;
    const Index first = half_edges_.outgoing(v);
    Index h = first;
    do {
      const Index f = HalfEdges::face(h);
      if (f == face_) from = {total, h};
      if (f == to_face) to = {total, h};
      const Vec3 a = edge(h);
      const Vec3 b = -edge(HalfEdges::previous(h));
      total += std::abs(signed_angle(a, b, normal_of(f)));
      h = half_edges_.ccw(h);
    } while (h >= 0 && h != first);
    if (from.leaving < 0 || to.leaving < 0 || !(total > 0.0)) return;  // another fan
    const double scale = half_edges_.is_boundary_vertex(v) ? 1.0 : 2.0 * std::numbers::pi / total;
    // Around the vertex, in parts of its total angle: the way back, the way on.
    const auto polar = [&](const Angles& at, const Vec3& normal, const Vec3& d) {
      return scale *
             (at.start + (d.squaredNorm() > 0.0 ? signed_angle(edge(at.leaving), d, normal) : 0.0));
    };
    const Vec3 back = before.squaredNorm() > 0.0 ? before : edge(from.leaving);
    const Vec3 on = after.squaredNorm() > 0.0 ? after : edge(to.leaving);
    const Vec3 to_normal = normal_of(to_face);
    const double turned = polar(to, to_normal, on) - polar(from, normal_, back);
    const double angle = signed_angle(back, vector_, normal_) - turned;
    const double length = vector_.norm();
    const Vec3 x = on.normalized();
    face_ = to_face;
    normal_ = to_normal;
    vector_ = length * (std::cos(angle) * x + std::sin(angle) * normal_.cross(x));
  }

 private:
  struct Angles {
    double start = 0.0;
    Index leaving = kNone;
  };

  Vec3 edge(Index h) const {
    const Vec3 e = mesh_.position(half_edges_.head(h)) - mesh_.position(half_edges_.tail(h));
    const double length = e.norm();
    return length > 0.0 ? Vec3(e / length) : e;
  }
  // Where a face has no area, that of the face before.
  Vec3 normal_of(Index f) const {
    const Vec3 area = mesh_.area_vector(f);
    const double size = area.norm();
    return size > 0.0 ? Vec3(area / size) : normal_;
  }

  const TriangleMesh& mesh_;
  const HalfEdges& half_edges_;
  Index face_;
  Vec3 normal_ = Vec3::Zero();
  Vec3 vector_ = Vec3::Zero();
};

bool holds(const TriangleMesh& mesh, const HalfEdges& half_edges, Index face,
           const SurfacePoint& p) {
  if (p.face == face) return true;
  const Site site = site_of(mesh, p);
  if (site.kind == Site::Kind::edge) {
    const Index twin = half_edges.twin(site.index);
    return twin >= 0 && HalfEdges::face(twin) == face;
  }
  if (site.kind == Site::Kind::face) return false;
  for (const Index v : mesh.face(face))
    if (v == site.index) return true;
  return false;
}

}  // namespace

Vec3 parallel_transport(const Surface& surface, const SurfacePoint& from,
                        std::span<const Crossing> crossings, const SurfacePoint& to,
                        const Vec3& vector) {
  const TriangleMesh& mesh = surface.mesh();
  const HalfEdges& half_edges = surface.half_edges();
  check_surface_point(mesh, from, "first point");
  check_surface_point(mesh, to, "last point");
  Carrier carrier(mesh, half_edges, from.face, vector);
  // Each point of the path is left by the face that holds it and the next one.
  for (std::size_t i = 0; i <= crossings.size() + 1; ++i) {
    const auto point = [&](std::size_t k) {
      return k == 0 ? from : k == crossings.size() + 1 ? to : surface_point(crossings[k - 1]);
    };
    const SurfacePoint p = point(i);
    const Site site = site_of(mesh, p);
    const bool is_last = i == crossings.size() + 1;
    if (site.kind == Site::Kind::face) continue;
    const auto fits = [&](Index f) {
      return is_last ? f == to.face : holds(mesh, half_edges, f, point(i + 1));
    };
    if (fits(carrier.face())) continue;
    if (site.kind == Site::Kind::edge) {
      Index h = site.index;
      if (HalfEdges::face(h) != carrier.face()) h = half_edges.twin(h);
      if (h >= 0 && HalfEdges::face(h) == carrier.face() && half_edges.has_twin(h))
        carrier.over_edge(h);
      continue;
    }
    const Vec3 at = mesh.position(site.index);
    const Vec3 before = i == 0 ? Vec3(Vec3::Zero()) : Vec3(mesh.position(point(i - 1)) - at);
    const Vec3 after = is_last ? Vec3(Vec3::Zero()) : Vec3(mesh.position(point(i + 1)) - at);
    const Index first = half_edges.outgoing(site.index);
    Index h = first;
    do {
      if (fits(HalfEdges::face(h))) {
        carrier.around_vertex(site.index, HalfEdges::face(h), before, after);
        break;
      }
      h = half_edges.ccw(h);
    } while (h >= 0 && h != first);
  }
  return carrier.vector();
}

}  // namespace mimicry
