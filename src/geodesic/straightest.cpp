#include <algorithm>
#include <cmath>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/paths.h>

#include "geodesic/plane.h"
#include "geodesic/site.h"
#include "geodesic/tolerances.h"

namespace mimicry {
namespace {

// A path closer to a vertex than this part of the edge passes through it.
constexpr double kAtVertex = 1e-10;

// A face in the plane: the tail of half-edge `base` at (0, 0), its head on the x axis. x, y are the
// axes in space.
struct Flat {
  Index base = kNone;
  Vec2 corners[3];
  Vec3 origin = Vec3::Zero();
  Vec3 x = Vec3::Zero();
  Vec3 y = Vec3::Zero();

  Flat(const TriangleMesh& mesh, Index h) : base(h) {
    const Index f = HalfEdges::face(h);
    const int k = HalfEdges::corner(h);
    origin = mesh.corner(f, k);
    const Vec3 along = mesh.corner(f, (k + 1) % 3) - origin;
    const Vec3 apex = mesh.corner(f, (k + 2) % 3) - origin;
    const double length = along.norm();
    const double longest = std::max({length, apex.norm(), (apex - along).norm()});
    x = length > 0.0 ? Vec3(along / length) : Vec3(apex.normalized());
    const Vec3 up = apex - apex.dot(x) * x;
    const double height = up.norm();
    y = height > 0.0 ? Vec3(up / height) : x.unitOrthogonal();
    corners[0] = Vec2::Zero();
    corners[1] = Vec2(length, 0.0);
    corners[2] = Vec2(apex.dot(x), std::max(height, kLeastHeight * longest));
  }
  Index half_edge(int k) const {
    return 3 * HalfEdges::face(base) + (HalfEdges::corner(base) + k) % 3;
  }
  Vec2 flat(const Vec3& v) const { return {v.dot(x), v.dot(y)}; }
  Vec3 space(const Vec2& v) const { return v.x() * x + v.y() * y; }
  Vec2 flat(const SurfacePoint& p) const {
    const int k = HalfEdges::corner(base);
    return p.bary[k] * corners[0] + p.bary[(k + 1) % 3] * corners[1] +
           p.bary[(k + 2) % 3] * corners[2];
  }
  SurfacePoint point(const Vec2& p) const {
    SurfacePoint result{HalfEdges::face(base), Vec3::Zero()};
    const int k = HalfEdges::corner(base);
    const double apex = std::clamp(p.y() / corners[2].y(), 0.0, 1.0);
    const double head =
        corners[1].x() > 0.0
            ? std::clamp((p.x() - apex * corners[2].x()) / corners[1].x(), 0.0, 1.0 - apex)
            : 0.0;
    result.bary[k] = 1.0 - apex - head;
    result.bary[(k + 1) % 3] = head;
    result.bary[(k + 2) % 3] = apex;
    return result;
  }
};

double corner_angle(const TriangleMesh& mesh, Index h) {
  const Index f = HalfEdges::face(h);
  const int k = HalfEdges::corner(h);
  const Vec3 a = mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k);
  const Vec3 b = mesh.corner(f, (k + 2) % 3) - mesh.corner(f, k);
  const double sine = a.cross(b).norm();
  const double cosine = a.dot(b);
  return sine == 0.0 && cosine == 0.0 ? 0.0 : std::atan2(sine, cosine);
}

double total_angle(const TriangleMesh& mesh, const HalfEdges& half_edges, Index vertex) {
  double total = 0.0;
  const Index first = half_edges.outgoing(vertex);
  Index h = first;
  do {
    total += corner_angle(mesh, h);
    h = half_edges.ccw(h);
  } while (h >= 0 && h != first);
  return total;
}

class Walk {
 public:
  Walk(const TriangleMesh& mesh, const HalfEdges& half_edges, std::vector<Crossing>* crossings)
      : mesh_(mesh), half_edges_(half_edges), crossings_(crossings) {}

  Trace run(const SurfacePoint& from, const Vec3& direction, double length);

 private:
  TraceStop start(const SurfacePoint& from, const Vec3& direction, Flat& best);
  Trace stop(TraceStop why, const Flat& flat) const {
    const Vec3 d = flat.space(direction_);
    return {why, flat.point(at_), d, walked_};
  }

  const TriangleMesh& mesh_;
  const HalfEdges& half_edges_;
  std::vector<Crossing>* crossings_;
  Vec2 at_ = Vec2::Zero();
  Vec2 direction_ = Vec2::Zero();
  bool skip_[3] = {false, false, false};  // edges that the walk stands on
  double walked_ = 0.0;
};

// Chooses the face and lays it out with the walk's point and direction.
TraceStop Walk::start(const SurfacePoint& from, const Vec3& direction, Flat& best) {
  const double least = 1e-12 * direction.norm();
  const Site site = site_of(mesh_, from);
  double inside_part = least;  // of the direction, in the best face that it leads into
  double side_part = least;    // along the best edge, where it leads into no face
  bool inside = false;
  bool beside = false;
  // A face around the point, its half-edge `base` leaving the vertex or holding the edge point.
  const auto consider = [&](Index base, const Vec2& at, bool is_vertex) {
    const Flat flat(mesh_, base);
    const Vec2 d = flat.flat(direction);
    if (d.y() >= 0.0 && (!is_vertex || cross(d, flat.corners[2]) >= 0.0)) {
      if (!(d.norm() > inside_part)) return;
      inside = true;
      inside_part = d.norm();
      direction_ = d.normalized();
    } else {
      if (inside) return;
      const Vec2 sides[2] = {flat.corners[1], is_vertex ? flat.corners[2] : Vec2(-flat.corners[1])};
      bool better = false;
      for (const Vec2& side : sides) {
        const double part = side.norm() > 0.0 ? d.dot(side.normalized()) : 0.0;
        if (!(part > side_part)) continue;
        side_part = part;
        direction_ = side.normalized();
        better = beside = true;
      }
      if (!better) return;
    }
    best = flat;
    at_ = at;
    skip_[0] = true;
    skip_[1] = false;
    skip_[2] = is_vertex;
  };
  bool is_boundary = false;
  if (site.kind == Site::Kind::face) {
    best = Flat(mesh_, 3 * from.face);
    at_ = best.flat(from);
    const Vec2 d = best.flat(direction);
    inside = d.norm() > least;
    if (inside) direction_ = d.normalized();
  } else if (site.kind == Site::Kind::edge) {
    const double length = (mesh_.position(half_edges_.head(site.index)) -
                           mesh_.position(half_edges_.tail(site.index)))
                              .norm();
    consider(site.index, Vec2(site.t * length, 0.0), false);
    const Index twin = half_edges_.twin(site.index);
    is_boundary = twin < 0;
    if (!inside && twin >= 0) consider(twin, Vec2((1.0 - site.t) * length, 0.0), false);
  } else {
    int k = 0;
    while (mesh_.face(from.face)[static_cast<std::size_t>(k)] != site.index) ++k;
    const Index first = 3 * from.face + k;
    is_boundary = half_edges_.is_boundary_vertex(site.index);
    consider(first, Vec2::Zero(), true);
    if (!inside) {
      Index h = half_edges_.ccw(first);
      for (; h >= 0 && h != first; h = half_edges_.ccw(h)) consider(h, Vec2::Zero(), true);
      if (h < 0)
        for (h = half_edges_.cw(first); h >= 0; h = half_edges_.cw(h))
          consider(h, Vec2::Zero(), true);
    }
  }
  if (inside) return TraceStop::complete;
  if (!beside) return TraceStop::no_direction;
  return is_boundary ? TraceStop::boundary : TraceStop::complete;
}

Trace Walk::run(const SurfacePoint& from, const Vec3& direction, double length) {
  const Face& corners = mesh_.face(from.face);
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
    return {TraceStop::no_direction, from, Vec3::Zero(), 0.0};  // nor has it neighbours
  Flat flat(mesh_, 3 * from.face);
  const TraceStop started = start(from, direction, flat);
  if (started == TraceStop::no_direction) return {started, from, Vec3::Zero(), 0.0};
  if (started == TraceStop::boundary || length == 0.0)
    return {started, from, flat.space(direction_), 0.0};

  // Faces without size are passed without a step forward, each at most once from each side; more
  // than that goes in circles.
  const auto most_idle = static_cast<std::size_t>(half_edges_.count());
  const std::size_t most_steps = 100000 + 100 * most_idle;
  std::size_t idle = 0;
  for (std::size_t step = 0; step < most_steps && idle <= most_idle; ++step) {
    int exit = -1;
    double nearest = kInfinity;
    for (int k = 0; k < 3; ++k) {
      if (skip_[k]) continue;
      const Vec2 edge = flat.corners[(k + 1) % 3] - flat.corners[k];
      const double out = -cross(edge, direction_);
      if (!(out > 0.0)) continue;
      const double s = std::max(cross(edge, at_ - flat.corners[k]), 0.0) / out;
      if (s < nearest) nearest = s, exit = k;
    }
    if (exit < 0) {  // along a side of the face, or no area: to the corner ahead
      double far = -kInfinity;
      int corner = 0;
      for (int k = 0; k < 3; ++k) {
        const double ahead = direction_.dot(flat.corners[k] - at_);
        if (ahead > far) far = ahead, corner = k;
      }
      exit = skip_[corner] ? (corner + 2) % 3 : corner;
      nearest = std::max(far, 0.0);
    }
    if (walked_ + nearest >= length) {
      at_ += (length - walked_) * direction_;
      walked_ = length;
      return stop(TraceStop::complete, flat);
    }
    at_ += nearest * direction_;
    idle = walked_ + nearest > walked_ ? 0 : idle + 1;
    walked_ += nearest;

    const Vec2 edge = flat.corners[(exit + 1) % 3] - flat.corners[exit];
    const double edge_length = edge.norm();
    double u =
        edge_length > 0.0
            ? std::clamp(edge.dot(at_ - flat.corners[exit]) / (edge_length * edge_length), 0.0, 1.0)
            : 0.0;
    Index h = flat.half_edge(exit);
    if (u <= kAtVertex || u >= 1.0 - kAtVertex) {
      // Around the vertex by half of its total angle, from where the walk came from.
      const Index leaving = u <= kAtVertex ? h : HalfEdges::next(h);
      const Index vertex = half_edges_.tail(leaving);
      const int corner = u <= kAtVertex ? exit : (exit + 1) % 3;
      at_ = flat.corners[corner];
      if (half_edges_.is_nonmanifold_vertex(vertex)) return stop(TraceStop::non_manifold, flat);
      if (half_edges_.is_boundary_vertex(vertex)) return stop(TraceStop::boundary, flat);
      if (crossings_ != nullptr) crossings_->push_back({half_edges_.outgoing(vertex), 0.0});
      const Vec2 side = flat.corners[(corner + 1) % 3] - at_;
      const double from_side =
          std::clamp(std::atan2(cross(side, -direction_), side.dot(-direction_)), 0.0,
                     corner_angle(mesh_, leaving));
      double turn = from_side + 0.5 * total_angle(mesh_, half_edges_, vertex);
      Index into = leaving;
      for (Index steps = 0; steps < half_edges_.count(); ++steps) {
        const double angle = corner_angle(mesh_, into);
        if (turn <= angle) break;
        turn -= angle;
        into = half_edges_.ccw(into);
      }
      flat = Flat(mesh_, into);
      at_ = Vec2::Zero();
      direction_ = Vec2(std::cos(turn), std::sin(turn));
      skip_[0] = skip_[2] = true;
      skip_[1] = false;
      continue;
    }
    const Index twin = half_edges_.twin(h);
    if (twin < 0) return stop(TraceStop::boundary, flat);
    if (crossings_ != nullptr) crossings_->push_back({h, u});
    const Vec2 e = edge / edge_length;
    flat = Flat(mesh_, twin);
    at_ = Vec2((1.0 - u) * edge_length, 0.0);
    direction_ = Vec2(-e.dot(direction_), -cross(e, direction_));
    skip_[0] = true;
    skip_[1] = skip_[2] = false;
  }
  return stop(TraceStop::held_up, flat);
}

// Neither is its square's sum with two others infinite.
bool is_finite(double x) {
  return std::isfinite(x) && std::abs(x) < 1e150;
}

}  // namespace

Trace trace_straightest(const Surface& surface, const SurfacePoint& from, const Vec3& direction,
                        double length, std::vector<Crossing>* crossings) {
  const TriangleMesh& mesh = surface.mesh();
  const HalfEdges& half_edges = surface.half_edges();
  check_surface_point(mesh, from, "start");
  if (!is_finite(direction.x()) || !is_finite(direction.y()) || !is_finite(direction.z()))
    throw Error(ErrorKind::invalid_input, "straightest geodesic: its direction must be finite");
  if (!std::isfinite(length) || length < 0.0)
    throw Error(ErrorKind::invalid_input, "straightest geodesic: length " + std::to_string(length) +
                                              "; it must be finite and at least 0");
  return Walk(mesh, half_edges, crossings).run(normalised(from), direction, length);
}

}  // namespace mimicry
