#include <algorithm>
#include <cmath>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/exponential_map.h>
#include <mimicry/mesh/surface.h>

#include "geodesic/site.h"
#include "geodesic/unfold.h"

namespace mimicry {
namespace {

// What rounding alone takes across a bound is left as it is.
constexpr double kRounding = 1e-9;

// A unit vector orthogonal to `normal`, near v.
Vec3 in_plane(const Vec3& v, const Vec3& normal) {
  const Vec3 part = v - v.dot(normal) * normal;
  const double size = part.norm();
  return size > 1e-12 * v.norm() ? Vec3(part / size) : normal.unitOrthogonal();
}

// A unit vector turned as the least rotation turns one normal into the other.
Vec3 turned(const Vec3& v, const Vec3& from, const Vec3& to) {
  const Vec3 sum = from + to;
  const double size = sum.squaredNorm();
  if (size < 1e-12) return in_plane(v, to);  // opposite: no least rotation
  return in_plane(v - 2.0 * v.dot(to) / size * sum, to);
}

// A vector of space laid in the tangent plane with its length kept.
Vec2 laid(const Vec3& v, const Vec3& x_axis, const Vec3& normal) {
  const Vec2 flat(v.dot(x_axis), v.dot(normal.cross(x_axis)));
  const double size = flat.norm();
  return size > 1e-12 * v.norm() ? Vec2(flat * (v.norm() / size)) : Vec2(v.norm(), 0.0);
}

}  // namespace

DiscreteExponentialMap::DiscreteExponentialMap(const Surface& surface)
    : surface_(surface),
      mesh_(surface_.mesh()),
      half_edges_(surface_.half_edges()),
      normals_(surface_.vertex_normals()),
      stamps_(normals_.size(), 0),
      states_(normals_.size()),
      keys_(normals_.size()),
      from_(normals_.size()),
      bounds_(normals_.size()),
      x_axes_(normals_.size()),
      places_(normals_.size()) {}

template <class Visit>
void DiscreteExponentialMap::for_each_neighbour(Index vertex, Visit&& visit) const {
  const Index first = half_edges_.outgoing(vertex);
  if (first < 0) return;  // faces that repeat a corner are all it has
  Index h = first;
  Index last = kNone;
  do {
    visit(half_edges_.head(h));
    last = h;
    h = half_edges_.ccw(h);
  } while (h >= 0 && h != first);
  if (h < 0) visit(half_edges_.tail(HalfEdges::previous(last)));
}

void DiscreteExponentialMap::reach(Index vertex, const Vec2& place, double key, double bound,
                                   Index from) {
  const auto i = static_cast<std::size_t>(vertex);
  bounds_[i] = bound;
  if (stamps_[i] == stamp_ && !(key < keys_[i])) return;
  stamps_[i] = stamp_;
  states_[i] = reached;
  keys_[i] = key;
  from_[i] = from;
  places_[i] = place;
  heap_.push_back({key, vertex});
  std::push_heap(heap_.begin(), heap_.end());
}

// What the face of half-edge h, which leaves q, says when its other two vertices are settled.
bool DiscreteExponentialMap::unfold(Index h, Vec2& place) const {
  const Index a = half_edges_.head(h);
  const Index b = half_edges_.tail(HalfEdges::previous(h));
  if (!is_settled(a) || !is_settled(b)) return false;
  return unfolded_place(places_[at(a)], places_[at(b)], mesh_.position(a), mesh_.position(b),
                        mesh_.position(half_edges_.tail(h)), place);
}

// A shortest way is no longer than any along edges: where faces are slivers or the surface crosses
// itself, unfolding says so.
void DiscreteExponentialMap::settle(Index vertex) {
  const auto i = static_cast<std::size_t>(vertex);
  states_[i] = settled;
  const double straight = (mesh_.position(vertex) - patch_.origin).norm();
  const double most = std::max(bounds_[i], straight);
  const double length = places_[i].norm();
  if (length > (1.0 + kRounding) * most) places_[i] *= most / length;
}

// Nor is any way shorter than the straight line. This is not passed on: what is a little too short
// near the centre would lengthen all that lies behind it.
Vec2 DiscreteExponentialMap::no_shorter_than_straight(Index vertex) const {
  const Vec2& place = places_[static_cast<std::size_t>(vertex)];
  const Vec3 straight = mesh_.position(vertex) - patch_.origin;
  const double least = straight.norm();
  const double length = place.norm();
  if (length >= (1.0 - kRounding) * least) return place;
  return length > 0.0 ? Vec2(place * (least / length))
                      : laid(straight, patch_.x_axis, patch_.normal);
}

void DiscreteExponentialMap::update(Index vertex, Index from) {
  const auto i = static_cast<std::size_t>(vertex);
  if (is_settled(vertex) || (stamps_[i] == stamp_ && from_[i] == kNone)) return;
  const double least = keys_[static_cast<std::size_t>(from)];
  const double along = bounds_[static_cast<std::size_t>(from)] +
                       (mesh_.position(vertex) - mesh_.position(from)).norm();
  const double bound = stamps_[i] == stamp_ ? std::min(bounds_[i], along) : along;
  Vec2 best = Vec2::Zero();
  double distance = kInfinity;
  const Index first = half_edges_.outgoing(vertex);
  Index h = first;
  do {
    // Faces without the newly settled vertex have said what they know.
    const bool is_news =
        half_edges_.head(h) == from || half_edges_.tail(HalfEdges::previous(h)) == from;
    Vec2 place;
    if (is_news && unfold(h, place) && place.norm() < distance)
      best = place, distance = place.norm();
    h = half_edges_.ccw(h);
  } while (h >= 0 && h != first);
  if (distance == kInfinity) {
    // No face says anything yet: the mean of what the settled neighbours say, by nearness. It waits
    // for as long as the way along the edge takes, in case a face still does.
    Vec2 sum = Vec2::Zero();
    double weights = 0.0;
    for_each_neighbour(vertex, [&](Index neighbour) {
      if (!is_settled(neighbour)) return;
      const auto n = static_cast<std::size_t>(neighbour);
      const Vec3 edge = mesh_.position(vertex) - mesh_.position(neighbour);
      const double weight = 1.0 / std::max(edge.norm(), 1e-300);
      sum += weight * (places_[n] + laid(edge, x_axes_[n], normals_[n]));
      weights += weight;
      distance = std::min(distance, places_[n].norm() + edge.norm());
    });
    if (!(weights > 0.0)) {  // a fan that touches here: its way back is not among the neighbours
      const auto n = static_cast<std::size_t>(from);
      const Vec3 edge = mesh_.position(vertex) - mesh_.position(from);
      sum = places_[n] + laid(edge, x_axes_[n], normals_[n]);
      weights = 1.0;
      distance = places_[n].norm() + edge.norm();
    }
    best = sum / weights;
  }
  // Keys within the bound are in the order in which ways along edges arrive.
  if (distance > (1.0 + kRounding) * bound) distance = bound;
  reach(vertex, best, std::max(distance, least), bound, from);
}

const ExponentialPatch& DiscreteExponentialMap::compute(const SurfacePoint& point, double radius,
                                                        const Vec3& x_hint) {
  check_surface_point(mesh_, point, "centre");
  if (std::isnan(radius) || radius <= 0.0)
    throw Error(ErrorKind::invalid_input, "exponential map: its radius must be above 0");
  const SurfacePoint p = normalised(point);
  if (++stamp_ == 0) {
    std::fill(stamps_.begin(), stamps_.end(), 0u);
    stamp_ = 1;
  }
  heap_.clear();
  patch_.vertices.clear();
  patch_.coordinates.clear();
  patch_.origin = mesh_.position(p);
  patch_.normal = interpolated_normal(mesh_, normals_, p);
  if (patch_.normal.isZero(0.0)) patch_.normal = Vec3::UnitZ();  // no area, no plane: any will do
  patch_.x_axis = in_plane(x_hint, patch_.normal);
  patch_.y_axis = patch_.normal.cross(patch_.x_axis);

  const Site site = site_of(mesh_, p);
  const auto reach_from_centre = [&](Index v) {
    const Vec3 to = mesh_.position(v) - patch_.origin;
    reach(v, laid(to, patch_.x_axis, patch_.normal), to.norm(), to.norm(), kNone);
  };
  if (site.kind == Site::Kind::vertex) {
    reach_from_centre(site.index);
    for_each_neighbour(site.index, reach_from_centre);
    // Of another fan that touches here, where p is in that.
    for (const Index v : mesh_.face(p.face)) reach_from_centre(v);
  } else {
    for (const Index v : mesh_.face(p.face)) reach_from_centre(v);
    if (site.kind == Site::Kind::edge && half_edges_.has_twin(site.index))
      reach_from_centre(half_edges_.tail(HalfEdges::previous(half_edges_.twin(site.index))));
  }
  while (!heap_.empty()) {
    const Entry top = heap_.front();
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
    const auto i = static_cast<std::size_t>(top.vertex);
    if (states_[i] == settled || top.key != keys_[i]) continue;
    settle(top.vertex);
    const auto parent = static_cast<std::size_t>(from_[i]);
    x_axes_[i] = from_[i] == kNone ? turned(patch_.x_axis, patch_.normal, normals_[i])
                                   : turned(x_axes_[parent], normals_[parent], normals_[i]);
    const Vec2 place = no_shorter_than_straight(top.vertex);
    if (place.norm() > radius) continue;
    patch_.vertices.push_back(top.vertex);
    patch_.coordinates.push_back(place);
    for_each_neighbour(top.vertex, [&](Index n) { update(n, top.vertex); });
  }
  return patch_;
}

}  // namespace mimicry
