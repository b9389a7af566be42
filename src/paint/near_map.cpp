#include "paint/near_map.h"

#include <algorithm>
#include <cmath>

#include "geodesic/plane.h"
#include "geodesic/unfold.h"

namespace mimicry {
namespace {

constexpr double kRounding = 1e-9;
// An edge that is this many times as long in the plane as in space was reached by two ways around
// the object. (On a sphere, an edge across at 2.3 radii.)
constexpr double kTorn = 3.0;

double squared_distance_to_segment(const Vec2& a, const Vec2& b) {
  const Vec2 edge = b - a;
  const double square = edge.squaredNorm();
  const double t = square > 0.0 ? std::clamp(-a.dot(edge) / square, 0.0, 1.0) : 0.0;
  return (a + t * edge).squaredNorm();
}

double distance_to_face(const std::array<Vec2, 3>& c) {
  const double ab = cross(c[0], c[1]), bc = cross(c[1], c[2]), ca = cross(c[2], c[0]);
  if ((ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0)) return 0.0;
  return std::sqrt(
      std::min({squared_distance_to_segment(c[0], c[1]), squared_distance_to_segment(c[1], c[2]),
                squared_distance_to_segment(c[2], c[0])}));
}

}  // namespace

NearMap::NearMap(const PaintAtlas& atlas)
    : atlas_(atlas),
      mesh_(atlas.surface().mesh()),
      half_edges_(atlas.surface().half_edges()),
      face_stamps_(at(mesh_.face_count()), 0),
      stamps_(at(mesh_.vertex_count()), 0),
      settled_(stamps_.size()),
      keys_(stamps_.size()),
      bounds_(stamps_.size()),
      places_(stamps_.size()),
      stretch_(stamps_.size()) {}

std::array<Vec2, 3> NearMap::corners(Index face) const {
  std::array<Vec2, 3> c;
  const Face& vertices = mesh_.face(face);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t v = at(vertices[k]);
    c[k] = stretch_[v] > 1.0f ? Vec2(double(stretch_[v]) * places_[v]) : places_[v];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double length =
        (mesh_.position(vertices[(k + 1) % 3]) - mesh_.position(vertices[k])).squaredNorm();
    if ((c[(k + 1) % 3] - c[k]).squaredNorm() <= kTorn * kTorn * length) continue;
    const auto nearest = std::min_element(c.begin(), c.end(), [](const Vec2& a, const Vec2& b) {
      return a.squaredNorm() < b.squaredNorm();
    });
    if (!(nearest->squaredNorm() > 0.0)) break;
    const Vec2 direction = nearest->normalized();
    for (Vec2& corner : c) corner = corner.norm() * direction;
    break;
  }
  return c;
}

bool NearMap::place(const SurfacePoint& p, Vec2& result) const {
  if (!is_listed(p.face)) return false;
  const std::array<Vec2, 3> c = corners(p.face);
  result = p.bary[0] * c[0] + p.bary[1] * c[1] + p.bary[2] * c[2];
  return true;
}

// The face as it lies in space.
void NearMap::lay_centre(const SurfacePoint& centre) {
  Vec3 normal = face_normal(mesh_, centre.face);
  if (normal.isZero(0.0)) {
    const Vec3 edge = mesh_.corner(centre.face, 1) - mesh_.corner(centre.face, 0);
    normal = edge.squaredNorm() > 0.0 ? edge.unitOrthogonal() : Vec3::UnitZ();
  }
  x_axis_ = normal.unitOrthogonal();
  y_axis_ = normal.cross(x_axis_);
  for (const Index v : mesh_.face(centre.face)) {
    const Vec3 to = mesh_.position(v) - origin_;
    reach(v, in_plane(to), to.norm(), to.norm());
    settled_[at(v)] = 1;
  }
}

void NearMap::reach(Index vertex, const Vec2& place, double key, double bound) {
  const std::size_t i = at(vertex);
  if (stamps_[i] == stamp_) {
    bounds_[i] = std::min(bounds_[i], bound);
    if (!(key < keys_[i])) return;
  } else {
    stamps_[i] = stamp_;
    bounds_[i] = bound;
  }
  settled_[i] = 0;
  stretch_[i] = 1.0f;
  keys_[i] = key;
  places_[i] = place;
  heap_.push_back({key, vertex});
  std::push_heap(heap_.begin(), heap_.end());
}

// The corner beyond half-edge h of a listed face.
void NearMap::propose(Index h) {
  const Index twin = half_edges_.twin(h);
  const Index a = half_edges_.tail(twin), b = half_edges_.head(twin);
  const Index q = half_edges_.tail(HalfEdges::previous(twin));
  const Vec3 &pa = mesh_.position(a), &pb = mesh_.position(b), &pq = mesh_.position(q);
  const double bound =
      std::min(bounds_[at(a)] + (pq - pa).norm(), bounds_[at(b)] + (pq - pb).norm());
  const double least = std::min(keys_[at(a)], keys_[at(b)]);
  Vec2 place;
  if (unfolded_place(places_[at(a)], places_[at(b)], pa, pb, pq, place))
    return reach(q, place, std::max(std::min(place.norm(), bound), least), bound);
  const Vec2 image = places_[at(b)] - places_[at(a)];
  const Vec3 edge = pb - pa;
  const double length = edge.norm(), size = image.norm();
  place = 0.5 * (places_[at(a)] + places_[at(b)]);
  if (length > 0.0 && size > 0.0) {
    const Vec2 along = image / size;
    const double x = (pq - pa).dot(edge) / length, y = (pq - pa).cross(edge).norm() / length;
    place += (x - 0.5 * length) * along + y * Vec2(-along.y(), along.x());
  }
  // It waits as long as the way along edges takes, in case another face knows better.
  reach(q, place, std::max(bound, least), bound);
}

void NearMap::settle(Index vertex) {
  const std::size_t i = at(vertex);
  settled_[i] = 1;
  const double straight = (mesh_.position(vertex) - origin_).norm();
  const double most = std::max(bounds_[i], straight);
  double length = places_[i].norm();
  if (length > (1.0 + kRounding) * most) {
    places_[i] *= most / length;
    length = most;
  }
  // What is too short is not passed on: it would lengthen all that lies behind it.
  if (length > 0.0 && length < (1.0 - kRounding) * straight)
    stretch_[i] = static_cast<float>(straight / length);
}

void NearMap::list(Index face) {
  waiting_.push_back(face);
  while (!waiting_.empty()) {
    const Index f = waiting_.back();
    waiting_.pop_back();
    if (is_listed(f)) continue;
    const Face& v = mesh_.face(f);
    if (!is_settled(v[0]) || !is_settled(v[1]) || !is_settled(v[2])) continue;
    const double reach_of_face = radius_ + 2.0 * atlas_.texel_length(f);
    const std::array<Vec2, 3> c = corners(f);
    if (distance_to_face(c) > reach_of_face) continue;
    face_stamps_[at(f)] = stamp_;
    faces_.push_back(f);
    for (int k = 0; k < 3; ++k) {
      const Index h = 3 * f + k;
      if (!half_edges_.has_twin(h)) continue;
      if (squared_distance_to_segment(c[at(k)], c[at((k + 1) % 3)]) > reach_of_face * reach_of_face)
        continue;
      const Index twin = half_edges_.twin(h);
      if (is_settled(half_edges_.tail(HalfEdges::previous(twin))))
        waiting_.push_back(HalfEdges::face(twin));
      else
        propose(h);
    }
  }
}

void NearMap::compute(const SurfacePoint& centre, double radius) {
  if (++stamp_ == 0) {
    std::fill(stamps_.begin(), stamps_.end(), 0u);
    std::fill(face_stamps_.begin(), face_stamps_.end(), 0u);
    stamp_ = 1;
  }
  heap_.clear();
  faces_.clear();
  radius_ = radius;
  origin_ = mesh_.position(centre);
  lay_centre(centre);
  heap_.clear();
  list(centre.face);
  while (!heap_.empty()) {
    const Entry top = heap_.front();
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
    if (is_settled(top.vertex) || top.key != keys_[at(top.vertex)]) continue;
    settle(top.vertex);
    const Index first = half_edges_.outgoing(top.vertex);
    Index h = first;
    do {
      list(HalfEdges::face(h));
      h = half_edges_.ccw(h);
    } while (h >= 0 && h != first);
  }
}

std::size_t NearMap::memory_bytes() const {
  const std::size_t of_vertex = sizeof(std::uint32_t) + sizeof(std::uint8_t) + 2 * sizeof(double) +
                                sizeof(Vec2) + sizeof(float);
  return stamps_.size() * of_vertex +
         (face_stamps_.size() + faces_.capacity() + waiting_.capacity()) * sizeof(Index) +
         heap_.capacity() * sizeof(Entry);
}

}  // namespace mimicry
