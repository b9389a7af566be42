#include <algorithm>

#include <mimicry/geodesic/plane_section.h>

namespace mimicry::geodesic {
namespace {

// A barycentric coordinate below this lies on the opposite edge.
constexpr double kOnEdge = 1e-7;

// Calls visit(face) for every face that contains p: one in the inside of a face, two on an edge,
// the fan of a vertex; the point's own face comes first.
template <class Visit>
void for_each_face_at(const HalfEdges& half_edges, const SurfacePoint& p, Visit&& visit) {
  visit(p.face);
  int corner = -1;
  int off_edge = -1;
  int zeros = 0;
  for (int k = 0; k < 3; ++k) {
    if (p.bary[k] >= kOnEdge)
      corner = k;
    else
      off_edge = k, ++zeros;
  }
  if (zeros == 1) {
    const Index twin = half_edges.twin(3 * p.face + (off_edge + 1) % 3);
    if (twin >= 0) visit(HalfEdges::face(twin));
  } else if (zeros == 2) {
    const Index start = 3 * p.face + corner;
    Index h = half_edges.ccw(start);
    for (; h >= 0 && h != start; h = half_edges.ccw(h)) visit(HalfEdges::face(h));
    if (h >= 0) return;
    for (h = half_edges.cw(start); h >= 0; h = half_edges.cw(h)) visit(HalfEdges::face(h));
  }
}

bool contains(const HalfEdges& half_edges, const SurfacePoint& p, Index face) {
  bool found = false;
  for_each_face_at(half_edges, p, [&](Index f) { found = found || f == face; });
  return found;
}

struct Plane {
  const TriangleMesh& mesh;
  Vec3 origin;
  Vec3 normal;
  double side(Index vertex) const { return normal.dot(mesh.position(vertex) - origin); }
};

// The section enters and leaves a face through the two half-edges whose ends are on different
// sides.
bool crosses(const Plane& plane, const HalfEdges& half_edges, Index h) {
  return (plane.side(half_edges.tail(h)) >= 0.0) != (plane.side(half_edges.head(h)) >= 0.0);
}

Crossing crossing_of(const Plane& plane, const HalfEdges& half_edges, Index h) {
  const double a = plane.side(half_edges.tail(h));
  const double b = plane.side(half_edges.head(h));
  return {h, std::clamp(a / (a - b), 0.0, 1.0)};
}

struct Walk {
  bool arrived = false;
  double length = 0.0;
};

Walk walk(const Plane& plane, const HalfEdges& half_edges, const SurfacePoint& to,
          const Vec3& to_position, Index exit, double longest, std::vector<Crossing>& crossings) {
  Walk result;
  Vec3 at = plane.origin;
  // A section meets each half-edge once at most; the count ends a walk that rounding lets circle.
  Index h = exit;
  for (Index step = 0; step < half_edges.count(); ++step) {
    const Crossing c = crossing_of(plane, half_edges, h);
    const Vec3 next = position(plane.mesh, c);
    result.length += (next - at).norm();
    if (!(result.length <= longest)) return result;
    at = next;
    crossings.push_back(c);
    const Index twin = half_edges.twin(h);
    if (twin < 0) return result;
    if (contains(half_edges, to, HalfEdges::face(twin))) {
      result.arrived = true;
      result.length += (to_position - at).norm();
      return result;
    }
    h = HalfEdges::next(twin);
    if (!crosses(plane, half_edges, h)) h = HalfEdges::next(h);
  }
  return result;
}

}  // namespace

PlaneSection trace_plane_section(const TriangleMesh& mesh, const HalfEdges& half_edges,
                                 const SurfacePoint& from, const SurfacePoint& to,
                                 const Vec3& normal, std::vector<Crossing>& crossings,
                                 const PlaneSectionOptions& options) {
  const Vec3 a = mesh.position(from);
  const Vec3 b = mesh.position(to);
  const double distance = (b - a).norm();
  bool shares_face = false;
  for_each_face_at(half_edges, from,
                   [&](Index f) { shares_face = shares_face || contains(half_edges, to, f); });
  if (shares_face) return {true, distance};

  const Plane plane{mesh, a, (b - a).cross(normal)};
  if (!(plane.normal.squaredNorm() > 0.0)) return {};
  const std::size_t base = crossings.size();
  double longest = options.longest_ratio * distance;
  PlaneSection best;
  for_each_face_at(half_edges, from, [&](Index f) {
    for (int k = 0; k < 3; ++k) {
      const Index exit = 3 * f + k;
      if (!crosses(plane, half_edges, exit)) continue;
      const std::size_t start = crossings.size();
      const Walk walked = walk(plane, half_edges, to, b, exit, longest, crossings);
      if (walked.arrived && (!best.found || walked.length < best.length)) {
        crossings.erase(crossings.begin() + static_cast<std::ptrdiff_t>(base),
                        crossings.begin() + static_cast<std::ptrdiff_t>(start));
        best = {true, walked.length};
        longest = walked.length;
      } else {
        crossings.resize(start);
      }
    }
  });
  return best;
}

}  // namespace mimicry::geodesic
