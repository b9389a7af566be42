#include <cmath>
#include <numbers>
#include <optional>

#include <mimicry/curve/projected_curve.h>

#include "geodesic/site.h"

namespace mimicry {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

double wrapped(double angle) {
  return angle > std::numbers::pi    ? angle - kTwoPi
         : angle < -std::numbers::pi ? angle + kTwoPi
                                     : angle;
}

double signed_angle(const Vec3& from, const Vec3& to, const Vec3& normal) {
  return std::atan2(normal.dot(from.cross(to)), from.dot(to));
}

struct Deviation {
  NodeUse use = NodeUse::measured;
  double angle = 0.0;
  double normalised = 0.0;
};

class Turns {
 public:
  Turns(const TriangleMesh& mesh, const HalfEdges& half_edges)
      : mesh_(mesh), half_edges_(half_edges) {}

  // Along `in` in one face to a point, along `out` in another face from it.
  Deviation at(const SurfacePoint& p, Index face_in, const Vec3& in, Index face_out,
               const Vec3& out) const {
    if (in.squaredNorm() == 0.0 || out.squaredNorm() == 0.0) return {NodeUse::undefined};
    const Site site = site_of(mesh_, p);
    if (site.kind == Site::Kind::vertex) return at_vertex(site.index, face_in, in, face_out, out);
    if (face_in == face_out) {
      const double angle = signed_angle(in, out, face_normal_or_zero(face_in));
      return {NodeUse::measured, angle, angle};
    }
    if (site.kind == Site::Kind::edge) return at_edge(site.index, face_in, in, face_out, out);
    return {NodeUse::undefined};
  }

 private:
  Vec3 face_normal_or_zero(Index f) const {
    const Vec3 area = mesh_.area_vector(f);
    const double size = area.norm();
    return size > 0.0 ? Vec3(area / size) : area;
  }
  Vec3 edge(Index h) const {
    return mesh_.position(half_edges_.head(h)) - mesh_.position(half_edges_.tail(h));
  }

  Deviation at_edge(Index h, Index face_in, const Vec3& in, Index face_out, const Vec3& out) const {
    const Index twin = half_edges_.twin(h);
    if (twin < 0) return {NodeUse::undefined};
    const auto beside = [&](Index f) {
      return f == HalfEdges::face(h) || f == HalfEdges::face(twin);
    };
    if (!beside(face_in) || !beside(face_out)) return {NodeUse::undefined};
    // Seen from above, both faces have the edge in the same direction.
    const Vec3 along = edge(h);
    const double angle = wrapped(signed_angle(along, out, face_normal_or_zero(face_out)) -
                                 signed_angle(along, in, face_normal_or_zero(face_in)));
    return {NodeUse::measured, angle, angle};
  }

  Deviation at_vertex(Index v, Index face_in, const Vec3& in, Index face_out,
                      const Vec3& out) const {
    if (half_edges_.is_nonmanifold_vertex(v)) return {NodeUse::undefined};
    if (half_edges_.is_boundary_vertex(v)) return {NodeUse::boundary};
    const Index first = half_edges_.outgoing(v);
    double total = 0.0;
    std::optional<double> back;  // counter-clockwise from `first`
    std::optional<double> ahead;
    Index h = first;
    do {
      const Index f = HalfEdges::face(h);
      const Vec3 start = edge(h);
      const Vec3 normal = face_normal_or_zero(f);
      if (f == face_in) back = total + signed_angle(start, -in, normal);
      if (f == face_out) ahead = total + signed_angle(start, out, normal);
      total += signed_angle(start, -edge(HalfEdges::previous(h)), normal);
      h = half_edges_.ccw(h);
    } while (h != first);
    if (!back || !ahead || !(total > 0.0)) return {NodeUse::undefined};
    double left = *back - *ahead;
    if (left < 0.0) left += total;
    const double angle = 0.5 * total - left;
    return {NodeUse::measured, angle, angle * kTwoPi / total};
  }

  const TriangleMesh& mesh_;
  const HalfEdges& half_edges_;
};

}  // namespace

CurveCurvature curvature(const RefinedCurve& curve, const Surface& surface) {
  const TriangleMesh& mesh = surface.mesh();
  const HalfEdges& half_edges = surface.half_edges();
  const std::size_t count = curve.nodes.size();
  CurveCurvature result;
  result.uses.assign(count, NodeUse::end);
  result.turning.assign(count, 0.0);
  result.deviation.assign(count, 0.0);
  result.normalised.assign(count, 0.0);
  const Turns turns(mesh, half_edges);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const bool joint = i == 0 && curve.closed;
    if (i == 0 && !joint) continue;
    const std::size_t before = joint ? count - 2 : i - 1;
    const Index face_in = curve.faces[before];
    const Index face_out = curve.faces[i];
    if (face_in == kNone || face_out == kNone) continue;
    // The last node of a closed curve is the first up to snapping: its own position belongs to its
    // segment.
    const Vec3 in = curve.nodes[before + 1].position - curve.nodes[before].position;
    const Vec3 out = curve.nodes[i + 1].position - curve.nodes[i].position;
    const Deviation d = turns.at(curve.nodes[i].point, face_in, in, face_out, out);
    result.uses[i] = d.use;
    result.turning[i] = std::atan2(in.cross(out).norm(), in.dot(out));
    result.deviation[i] = d.angle;
    result.normalised[i] = d.normalised;
    result.total_turning += result.turning[i];
    result.total_deviation += d.angle;
    result.total_absolute_deviation += std::abs(d.angle);
    result.total_normalised += d.normalised;
    result.total_absolute_normalised += std::abs(d.normalised);
    result.boundary_nodes += d.use == NodeUse::boundary ? 1 : 0;
    result.undefined_nodes += d.use == NodeUse::undefined ? 1 : 0;
  }
  return result;
}

}  // namespace mimicry
