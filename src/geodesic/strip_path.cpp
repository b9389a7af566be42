#include "geodesic/strip_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geodesic/plane.h"

namespace mimicry {
namespace {

double angle_between(const Vec3& a, const Vec3& b) {
  const double sine = a.cross(b).norm();
  const double cosine = a.dot(b);
  return sine == 0.0 && cosine == 0.0 ? 0.0 : std::atan2(sine, cosine);
}

}  // namespace

StripPath::StripPath(const TriangleMesh& mesh, const HalfEdges& half_edges)
    : mesh_(mesh), half_edges_(half_edges) {}

// A* over faces, through the middles of edges.
bool StripPath::find_strip(const SurfacePoint& from, const SurfacePoint& to) {
  const auto faces = static_cast<std::size_t>(mesh_.face_count());
  costs_.resize(faces);
  entered_.resize(faces);
  stamps_.resize(faces, 0);
  if (++stamp_ == 0) {
    std::fill(stamps_.begin(), stamps_.end(), 0u);
    stamp_ = 1;
  }
  heap_.clear();
  strip_.clear();
  const Vec3 target = mesh_.position(to);
  const auto middle = [&](Index h) -> Vec3 { return mimicry::position(mesh_, Crossing{h, 0.5}); };
  const auto visit = [&](Index face, double cost, double ahead, Index entered) {
    const auto f = static_cast<std::size_t>(face);
    if (stamps_[f] == stamp_ && !(cost < costs_[f])) return;
    stamps_[f] = stamp_;
    costs_[f] = cost;
    entered_[f] = entered;
    heap_.push_back({cost + ahead, cost, face});
    std::push_heap(heap_.begin(), heap_.end());
  };
  visit(from.face, 0.0, 0.0, kNone);
  while (!heap_.empty()) {
    const Entry top = heap_.front();
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
    if (top.cost != costs_[static_cast<std::size_t>(top.face)]) continue;
    if (top.face == to.face) {
      for (Index h = entered_[static_cast<std::size_t>(top.face)]; h != kNone;
           h = entered_[static_cast<std::size_t>(HalfEdges::face(h))]) {
        h = half_edges_.twin(h);
        strip_.push_back(h);
      }
      std::reverse(strip_.begin(), strip_.end());
      return true;
    }
    const Index entered = entered_[static_cast<std::size_t>(top.face)];
    const Vec3 at = entered == kNone ? mesh_.position(from) : middle(entered);
    for (int k = 0; k < 3; ++k) {
      const Index h = 3 * top.face + k;
      if (h == entered || !half_edges_.has_twin(h)) continue;
      const Vec3 m = middle(h);
      visit(HalfEdges::face(half_edges_.twin(h)), top.cost + (m - at).norm(), (target - m).norm(),
            half_edges_.twin(h));
    }
  }
  return false;
}

// The shortest path within the strip: bends_, params_ and length_.
void StripPath::pull_tight(const SurfacePoint& from, const SurfacePoint& to) {
  const auto [start, end] = unfold(from, to);
  find_bends(start, end);
  cross_edges(start, end);
  // Measured in space: where an edge has no length the unfolding has no direction to go on in.
  length_ = 0.0;
  Vec3 last = mesh_.position(from);
  for (std::size_t i = 0; i < strip_.size(); ++i) {
    const Vec3 next = mimicry::position(mesh_, Crossing{strip_[i], params_[i]});
    length_ += (next - last).norm();
    last = next;
  }
  length_ += (mesh_.position(to) - last).norm();
}

// heads_ and tails_: the strip laid out in the plane; and where its ends lie there.
std::pair<Vec2, Vec2> StripPath::unfold(const SurfacePoint& from, const SurfacePoint& to) {
  const std::size_t n = strip_.size();
  heads_.resize(n);
  tails_.resize(n);
  // Lays out the face behind each crossed edge: a point given in 3-D, above or below the edge.
  const auto lay = [&](Index h, const Vec2& tail, const Vec2& head, const Vec3& p,
                       double side) -> Vec2 {
    const Vec3& a = mesh_.position(half_edges_.tail(h));
    const Vec3 edge = mesh_.position(half_edges_.head(h)) - a;
    const double length = edge.norm();
    if (!(length > 0.0)) return tail + Vec2((p - a).norm(), 0.0);
    const Vec3 along = edge / length;
    const double x = (p - a).dot(along);
    const double y = side * ((p - a) - x * along).norm();
    const Vec2 e = (head - tail) / std::max((head - tail).norm(), 1e-300);
    return tail + x * e + y * Vec2(-e.y(), e.x());
  };
  const Index first = strip_.front();
  tails_[0] = Vec2::Zero();
  heads_[0] = Vec2(
      (mesh_.position(half_edges_.head(first)) - mesh_.position(half_edges_.tail(first))).norm(),
      0.0);
  const Vec2 start = lay(first, tails_[0], heads_[0], mesh_.position(from), 1.0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Index h = strip_[i];
    const Index next = strip_[i + 1];
    const Index twin = half_edges_.twin(h);
    const Index apex = half_edges_.tail(HalfEdges::previous(twin));
    const Vec2 p = lay(h, tails_[i], heads_[i], mesh_.position(apex), -1.0);
    // In the face behind, the next crossed edge shares the head or the tail of this one.
    if (next == HalfEdges::next(twin)) {  // from the tail of h to the apex
      tails_[i + 1] = tails_[i];
      heads_[i + 1] = p;
    } else {
      tails_[i + 1] = p;
      heads_[i + 1] = heads_[i];
    }
  }
  return {start, lay(strip_[n - 1], tails_[n - 1], heads_[n - 1], mesh_.position(to), -1.0)};
}

// The funnel: going out of a face its half-edge's head is on the left.
void StripPath::find_bends(const Vec2& start, const Vec2& end) {
  const std::size_t n = strip_.size();
  bends_.clear();
  Vec2 apex = start;
  Vec2 left = heads_[0];
  Vec2 right = tails_[0];
  std::size_t left_at = 0;
  std::size_t right_at = 0;
  for (std::size_t i = 1; i <= n; ++i) {
    const Vec2 l = i < n ? heads_[i] : end;
    const Vec2 r = i < n ? tails_[i] : end;
    if (cross(right - apex, r - apex) >= 0.0) {
      if (apex == right || cross(left - apex, r - apex) <= 0.0) {
        right = r;
        right_at = i;
      } else {
        bends_.push_back({left_at, true, left});
        apex = left;
        i = left_at;
        left = right = apex;
        right_at = left_at;
        continue;
      }
    }
    if (cross(left - apex, l - apex) <= 0.0) {
      if (apex == left || cross(right - apex, l - apex) >= 0.0) {
        left = l;
        left_at = i;
      } else {
        bends_.push_back({right_at, false, right});
        apex = right;
        i = right_at;
        left = right = apex;
        left_at = right_at;
        continue;
      }
    }
  }
}

// params_: where the way over the bends crosses each edge.
void StripPath::cross_edges(const Vec2& start, const Vec2& end) {
  const std::size_t n = strip_.size();
  params_.resize(n);
  Vec2 a = start;
  std::size_t portal = 0;
  for (std::size_t k = 0; k <= bends_.size(); ++k) {
    const Vec2 b = k < bends_.size() ? bends_[k].at : end;
    const std::size_t last = k < bends_.size() ? bends_[k].portal + 1 : n;
    for (; portal < last; ++portal) {
      const Vec2 edge = heads_[portal] - tails_[portal];
      const double run = cross(edge, b - a);
      const double t = cross(a - tails_[portal], b - a);
      params_[portal] = run != 0.0 ? std::clamp(t / run, 0.0, 1.0)
                        : (b - tails_[portal]).squaredNorm() < (b - heads_[portal]).squaredNorm()
                            ? 0.0
                            : 1.0;
      if (k < bends_.size() && portal == bends_[k].portal)
        params_[portal] = bends_[k].at_head ? 1.0 : 0.0;
    }
    a = b;
  }
}

double StripPath::corner_angle(Index h) const {
  const Vec3& v = mesh_.position(half_edges_.tail(h));
  return angle_between(mesh_.position(half_edges_.head(h)) - v,
                       mesh_.position(half_edges_.tail(HalfEdges::previous(h))) - v);
}

// Finds a bend whose other side has an angle below pi and moves the strip there.
bool StripPath::move_around_a_vertex(const SurfacePoint& from, const SurfacePoint& to) {
  for (const Bend& bend : bends_) {
    const Index h = strip_[bend.portal];
    const Index v = bend.at_head ? half_edges_.head(h) : half_edges_.tail(h);
    const auto meets = [&](std::size_t i) {
      return (bend.at_head ? half_edges_.head(strip_[i]) : half_edges_.tail(strip_[i])) == v;
    };
    std::size_t first = bend.portal;
    std::size_t last = bend.portal;
    while (first > 0 && meets(first - 1)) --first;
    while (last + 1 < strip_.size() && meets(last + 1)) ++last;
    const Vec3& at = mesh_.position(v);
    const Vec3 before =
        (first > 0 ? mimicry::position(mesh_, Crossing{strip_[first - 1], params_[first - 1]})
                   : mesh_.position(from)) -
        at;
    const Vec3 after =
        (last + 1 < strip_.size()
             ? mimicry::position(mesh_, Crossing{strip_[last + 1], params_[last + 1]})
             : mesh_.position(to)) -
        at;

    // Around v from the face before to the face after, on the side away from the strip.
    other_way_.clear();
    const Index face_after = HalfEdges::face(half_edges_.twin(strip_[last]));
    Index face = HalfEdges::face(strip_[first]);
    double angle = 0.0;
    bool blocked = false;
    // In the face before: the half-edge that leaves v, and the edge to cross.
    Index leaving = bend.at_head ? HalfEdges::next(strip_[first]) : strip_[first];
    for (std::size_t turns = 0; face != face_after; ++turns) {
      // The strip turns around a head counter-clockwise and around a tail clockwise; the other way
      // is the opposite.
      const Index out = bend.at_head ? leaving : HalfEdges::previous(leaving);
      const Vec3 edge = mimicry::position(mesh_, Crossing{out, bend.at_head ? 1.0 : 0.0}) - at;
      angle += other_way_.empty() ? angle_between(before, edge) : corner_angle(leaving);
      const Index twin = half_edges_.twin(out);
      if (twin < 0 || turns > strip_.size() + 1000) {
        blocked = true;
        break;
      }
      other_way_.push_back(out);
      face = HalfEdges::face(twin);
      leaving = bend.at_head ? HalfEdges::next(twin) : twin;
      if (face == face_after) angle += angle_between(edge, after);
    }
    if (blocked) continue;
    if (other_way_.empty()) angle = angle_between(before, after);
    if (!(angle < std::numbers::pi - 1e-9)) continue;

    const auto at_first = strip_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto at_end = strip_.begin() + static_cast<std::ptrdiff_t>(last) + 1;
    strip_.insert(strip_.erase(at_first, at_end), other_way_.begin(), other_way_.end());
    // Out and straight back again is no step.
    std::size_t kept = 0;
    for (const Index crossed : strip_) {
      if (kept > 0 && half_edges_.twin(crossed) == strip_[kept - 1])
        --kept;
      else
        strip_[kept++] = crossed;
    }
    strip_.resize(kept);
    return true;
  }
  return false;
}

bool StripPath::run(const SurfacePoint& from, const SurfacePoint& to) {
  length_ = kInfinity;
  if (!find_strip(from, to)) return false;
  // Every move shortens the path; the count is for rounding.
  const std::size_t most_moves = 20 * strip_.size() + 1000;
  for (std::size_t moves = 0; !strip_.empty(); ++moves) {
    const double before = length_;
    pull_tight(from, to);
    if (moves == most_moves || length_ > before * (1.0 + 1e-9)) break;
    if (!move_around_a_vertex(from, to)) break;
  }
  if (strip_.empty()) length_ = (mesh_.position(from) - mesh_.position(to)).norm();
  return true;
}

void StripPath::append_crossings(std::vector<Crossing>& crossings) const {
  Index last_vertex = kNone;
  for (std::size_t i = 0; i < strip_.size(); ++i) {
    constexpr double kAtEnd = 1e-12;
    const double t = params_[i];
    if (t > kAtEnd && t < 1.0 - kAtEnd) {
      crossings.push_back({strip_[i], t});
      last_vertex = kNone;
      continue;
    }
    const Index v = t <= kAtEnd ? half_edges_.tail(strip_[i]) : half_edges_.head(strip_[i]);
    if (v != last_vertex) crossings.push_back({half_edges_.outgoing(v), 0.0});
    last_vertex = v;
  }
}

}  // namespace mimicry
