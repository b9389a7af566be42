#include "geodesic/path_search.h"

#include <mimicry/geodesic/paths.h>

#include "geodesic/tolerances.h"

namespace mimicry {

// Relative differences below this are rounding.
static constexpr double kSameLength = 1e-12;

PathSearch::PathSearch(const TriangleMesh& mesh, const HalfEdges& half_edges)
    : mesh_(mesh),
      half_edges_(half_edges),
      distances_(static_cast<std::size_t>(mesh.vertex_count())),
      stamps_(static_cast<std::size_t>(mesh.vertex_count()), 0) {
  // Up to the default bound no search allocates.
  nodes_.reserve(LocalPathOptions{}.most_windows + 64);
  heap_.reserve(LocalPathOptions{}.most_windows + 64);
}

bool PathSearch::holds_target(Index face) const {
  if (face == target_faces_[0] || face == target_faces_[1]) return true;
  if (target_site_.kind != Site::Kind::vertex) return false;
  const Face& f = mesh_.face(face);
  return f[0] == target_site_.index || f[1] == target_site_.index || f[2] == target_site_.index;
}

Vec2 PathSearch::in_frame(Index h, double length, const Vec3& p) const {
  const Vec3& tail = mesh_.position(half_edges_.tail(h));
  const Vec3 along = (mesh_.position(half_edges_.head(h)) - tail) / length;
  const Vec3 to = p - tail;
  const double x = to.dot(along);
  return {x, (to - x * along).norm()};
}

void PathSearch::push(double key, Index node) {
  heap_.push_back({key, node});
  std::push_heap(heap_.begin(), heap_.end());
}

void PathSearch::reach(Index v, double distance, Index leaving, Index parent) {
  if (!(distance < vertex_distance(v) * (1.0 - 1e-15))) return;
  const auto i = static_cast<std::size_t>(v);
  distances_[i] = distance;
  stamps_[i] = stamp_;
  const double key = distance + (mesh_.position(v) - target_).norm();
  if (!(key < best_)) return;
  nodes_.push_back({0.0, 0.0, 0.0, 0.0, 0.0, distance, leaving, parent, v});
  push(key, static_cast<Index>(nodes_.size()) - 1);
}

void PathSearch::add_window(Index h, double length, double begin, double end, double x, double y,
                            double sigma, Index parent) {
  const Index entered = half_edges_.twin(h);
  if (entered < 0 || !(end - begin > kLeastWidth * length)) return;
  y = std::max(y, kLeastHeight * length);
  const double d_begin = sigma + std::sqrt((begin - x) * (begin - x) + y * y);
  const double d_end = sigma + std::sqrt((end - x) * (end - x) + y * y);
  // Xin and Wang's filter: from an end of the edge everything behind the window is nearer.
  if (vertex_distance(half_edges_.tail(h)) + end < d_end * (1.0 - kSameLength)) return;
  if (vertex_distance(half_edges_.head(h)) + (length - begin) < d_begin * (1.0 - kSameLength))
    return;

  const double b0 = length - end;
  const double b1 = length - begin;
  const double sx = length - x;
  // No way over this window is shorter than to its best point and then straight through space.
  const Vec2 t = in_frame(entered, length, target_);
  const double cross = sx + (t.x() - sx) * (y / (y + t.y()));
  double key;
  const bool straight = cross >= b0 - kSameLength * length && cross <= b1 + kSameLength * length;
  if (straight) {
    key = sigma + std::sqrt((t.x() - sx) * (t.x() - sx) + (t.y() + y) * (t.y() + y));
  } else {
    const double c = cross < b0 ? b0 : b1;
    key = sigma + std::sqrt((c - sx) * (c - sx) + y * y) +
          std::sqrt((t.x() - c) * (t.x() - c) + t.y() * t.y());
  }
  if (!(key < best_)) return;
  const auto node = static_cast<Index>(nodes_.size());
  nodes_.push_back({b0, b1, sx, y, length, sigma, entered, parent, kNone});
  if (straight && holds_target(HalfEdges::face(entered))) {
    best_ = key;
    best_node_ = node;
  } else {
    push(key, node);
  }
}

void PathSearch::expand(Index number) {
  const Node w = nodes_[static_cast<std::size_t>(number)];
  const Index right = HalfEdges::next(w.entered);
  const Index left = HalfEdges::previous(w.entered);
  const Vec3& a = mesh_.position(half_edges_.tail(w.entered));
  const Vec3& b = mesh_.position(half_edges_.tail(right));
  const Vec3& c = mesh_.position(half_edges_.tail(left));
  const Vec3 along = (b - a) / w.length;
  const Vec3 to_apex = c - a;
  const double cx = to_apex.dot(along);
  const double left_length = to_apex.norm();
  const double right_length = (c - b).norm();
  // From the shorter side: the longer one nearly along the edge leaves a height of rounding.
  const double cy = std::max(along.cross(left_length < right_length ? to_apex : Vec3(c - b)).norm(),
                             kLeastHeight * std::max({w.length, left_length, right_length}));
  const double qx = cx - w.x;
  const double qy = cy + w.y;
  // > 0: the apex lies to the left of the ray.
  const double from_begin = (w.begin - w.x) * qy - w.y * qx;
  const double from_end = (w.end - w.x) * qy - w.y * qx;
  const bool reaches_left = from_begin < 0.0;
  const bool reaches_right = from_end > 0.0;
  if (reaches_left && reaches_right) {
    reach(half_edges_.tail(left), w.sigma + std::sqrt(qx * qx + qy * qy), left, number);
  } else {
    // Just outside by rounding: around the window's end, which is never too short.
    const double e = reaches_left ? w.end : w.begin;
    const double off = std::abs(reaches_left ? from_end : from_begin);
    if (off <= 1e-9 * ((e - w.x) * qx + w.y * qy))
      reach(half_edges_.tail(left),
            w.sigma + std::sqrt((e - w.x) * (e - w.x) + w.y * w.y) +
                std::sqrt((cx - e) * (cx - e) + cy * cy),
            left, number);
  }
  if (reaches_left && left_length > 0.0) {
    // Where a ray meets the edge, from 0 at the tail of `entered` to 1 at the apex.
    const auto hit = [&](double at) {
      const double run = cx * w.y + cy * (w.x - at);
      return run > 0.0 ? std::clamp(w.y * at / run, 0.0, 1.0) : 1.0;
    };
    const double u0 = hit(w.begin);
    const double u1 = reaches_right ? 1.0 : hit(w.end);
    const double ex = -cx / left_length;
    const double ey = -cy / left_length;
    add_window(left, left_length, left_length * (1.0 - u1), left_length * (1.0 - u0),
               ex * (w.x - cx) + ey * (-w.y - cy), ex * (-w.y - cy) - ey * (w.x - cx), w.sigma,
               number);
  }
  if (reaches_right && right_length > 0.0) {
    const auto hit = [&](double at) {
      const double run = (w.length - cx) * w.y + cy * (at - w.x);
      return run > 0.0 ? std::clamp(w.y * (w.length - at) / run, 0.0, 1.0) : 1.0;
    };
    const double u0 = reaches_left ? 1.0 : hit(w.begin);
    const double u1 = hit(w.end);
    const double ex = along.dot(c - b) / right_length;
    const double ey = cy / right_length;
    add_window(right, right_length, right_length * u1, right_length * u0,
               ex * (w.x - w.length) - ey * w.y, -ex * w.y - ey * (w.x - w.length), w.sigma,
               number);
  }
}

// Every vertex that is reached may be passed: those where no shortest path bends are left alone by
// the bound alone.
void PathSearch::leave_vertex(Index number) {
  const Node n = nodes_[static_cast<std::size_t>(number)];
  if (n.sigma != vertex_distance(n.vertex)) return;
  const Vec3& v = mesh_.position(n.vertex);
  const auto leave_into = [&](Index h) {
    if (holds_target(HalfEdges::face(h))) {
      const double length = n.sigma + (v - target_).norm();
      if (length < best_) best_ = length, best_node_ = number;
    }
    const Index opposite = HalfEdges::next(h);
    const Index back = HalfEdges::previous(h);
    const Vec3& a = mesh_.position(half_edges_.tail(opposite));
    const Vec3& b = mesh_.position(half_edges_.tail(back));
    reach(half_edges_.tail(opposite), n.sigma + (a - v).norm(), opposite, number);
    reach(half_edges_.tail(back), n.sigma + (b - v).norm(), back, number);
    const double length = (b - a).norm();
    if (!(length > 0.0)) return;
    const Vec2 s = in_frame(opposite, length, v);
    add_window(opposite, length, 0.0, length, s.x(), s.y(), n.sigma, number);
  };
  Index h = n.entered;
  do {
    leave_into(h);
    h = half_edges_.ccw(h);
  } while (h >= 0 && h != n.entered);
  if (h >= 0) return;
  for (h = half_edges_.cw(n.entered); h >= 0; h = half_edges_.cw(h)) leave_into(h);
}

void PathSearch::start(const SurfacePoint& from) {
  const Site site = site_of(mesh_, from);
  if (site.kind == Site::Kind::vertex) {
    int k = 0;
    while (mesh_.face(from.face)[static_cast<std::size_t>(k)] != site.index) ++k;
    reach(site.index, 0.0, 3 * from.face + k, kNone);
    return;
  }
  const Vec3 p = mesh_.position(from);
  const auto leave_into = [&](Index face, Index own_edge) {
    for (int k = 0; k < 3; ++k)
      reach(half_edges_.tail(3 * face + k), (p - mesh_.corner(face, k)).norm(), 3 * face + k,
            kNone);
    for (int k = 0; k < 3; ++k) {
      const Index h = 3 * face + k;
      const double length = (mesh_.corner(face, (k + 1) % 3) - mesh_.corner(face, k)).norm();
      if (h == own_edge || !(length > 0.0)) continue;
      const Vec2 s = in_frame(h, length, p);
      add_window(h, length, 0.0, length, s.x(), s.y(), 0.0, kNone);
    }
  };
  if (site.kind == Site::Kind::face) {
    leave_into(site.index, kNone);
  } else {
    leave_into(HalfEdges::face(site.index), site.index);
    const Index twin = half_edges_.twin(site.index);
    if (twin >= 0) leave_into(HalfEdges::face(twin), twin);
  }
}

PathSearch::Outcome PathSearch::run(const SurfacePoint& from, const SurfacePoint& to,
                                    std::size_t most_windows) {
  if (++stamp_ == 0) {
    std::fill(stamps_.begin(), stamps_.end(), 0u);
    stamp_ = 1;
  }
  nodes_.clear();
  heap_.clear();
  best_ = kInfinity;
  best_node_ = kNone;
  target_ = mesh_.position(to);
  target_site_ = site_of(mesh_, to);
  target_faces_[0] = to.face;
  target_faces_[1] = kNone;
  if (target_site_.kind == Site::Kind::edge) {
    const Index twin = half_edges_.twin(target_site_.index);
    if (twin >= 0) target_faces_[1] = HalfEdges::face(twin);
  }

  start(from);
  while (!heap_.empty()) {
    const Entry top = heap_.front();
    if (!(top.key < best_)) break;
    if (nodes_.size() > most_windows) return Outcome::gave_up;
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
    if (nodes_[static_cast<std::size_t>(top.node)].vertex != kNone)
      leave_vertex(top.node);
    else
      expand(top.node);
  }
  return best_ < kInfinity ? Outcome::shortest : Outcome::unreachable;
}

void PathSearch::append_crossings(std::vector<Crossing>& crossings) {
  const std::size_t first = crossings.size();
  Vec3 p = target_;
  Index last_vertex = target_site_.kind == Site::Kind::vertex ? target_site_.index : kNone;
  const auto add_vertex = [&](Index v) {
    if (v != last_vertex) crossings.push_back({half_edges_.outgoing(v), 0.0});
    last_vertex = v;
  };
  for (Index i = best_node_; i != kNone; i = nodes_[static_cast<std::size_t>(i)].parent) {
    const Node& n = nodes_[static_cast<std::size_t>(i)];
    if (n.vertex != kNone) {
      // The path starts here where the first point is this vertex.
      if (n.parent != kNone || n.sigma > 0.0) add_vertex(n.vertex);
      p = mesh_.position(n.vertex);
      continue;
    }
    const Vec2 to = in_frame(n.entered, n.length, p);
    const double x = std::clamp(n.x + (to.x() - n.x) * (n.y / (n.y + to.y())), n.begin, n.end);
    const double t = std::clamp(x / n.length, 0.0, 1.0);
    constexpr double kAtEnd = 1e-12;
    const Crossing c{n.entered, t};
    p = mimicry::position(mesh_, c);
    if (t <= kAtEnd || t >= 1.0 - kAtEnd) {
      add_vertex(t <= kAtEnd ? half_edges_.tail(n.entered) : half_edges_.head(n.entered));
    } else {
      crossings.push_back(c);
      last_vertex = kNone;
    }
  }
  std::reverse(crossings.begin() + static_cast<std::ptrdiff_t>(first), crossings.end());
}

}  // namespace mimicry
