#include "io/polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace mimicry {
namespace {

// Sines of angles below which corners count as on a line: of coordinates in single precision, and
// of rounding in double.
constexpr double kFlatFan = 1e-7;
constexpr double kRounding = 1e-12;
constexpr std::int32_t kLeafSize = 16;

/// 1 where c is to the left of the line from a to b, -1 to the right, 0 on it.
int side(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y());
  const double right = (b.y() - a.y()) * (c.x() - a.x());
  const double area = left - right;
  if (std::abs(area) <= kRounding * (std::abs(left) + std::abs(right))) return 0;
  return area > 0.0 ? 1 : -1;
}

Vec3 normal_of(std::span<const Index> corners, std::span<const Vec3> positions) {
  const auto at = [&](std::size_t k) { return positions[static_cast<std::size_t>(corners[k])]; };
  const Vec3 origin = at(0);
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    normal += (at(k) - origin).cross(at(k + 1) - origin);
  return normal;
}

}  // namespace

bool fan_covers(std::span<const Index> corners, std::span<const Vec3> positions) {
  const Vec3 normal = normal_of(corners, positions);
  const double size = normal.norm();
  if (!(size > 0.0) || !std::isfinite(size)) return true;
  const auto from_first = [&](std::size_t k) -> Vec3 {
    return positions[static_cast<std::size_t>(corners[k])] -
           positions[static_cast<std::size_t>(corners[0])];
  };
  const Vec3 start = from_first(1);
  Vec3 a = start;
  bool half_way = false;  // the fan has turned by more than half a turn
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Vec3 b = from_first(k);
    if (!(a.cross(b).dot(normal) > kFlatFan * a.norm() * b.norm() * size)) return false;
    const bool beyond = start.cross(b).dot(normal) < 0.0;
    if (half_way && !beyond) return false;  // it goes round more than once
    half_way = beyond;
    a = b;
  }
  return true;
}

// Along the normal onto the plane of two axes: corners of an upright polygon keep their digits.
void EarCutter::project(std::span<const Index> corners, std::span<const Vec3> positions) {
  const Vec3 normal = normal_of(corners, positions);
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(u, v);
  const double lean_u = normal[u] / normal[axis], lean_v = normal[v] / normal[axis];
  const Vec3 origin = positions[static_cast<std::size_t>(corners[0])];
  points_.clear();
  for (const Index corner : corners) {
    const Vec3 d = positions[static_cast<std::size_t>(corner)] - origin;
    points_.emplace_back(d[u] - lean_u * d[axis], d[v] - lean_v * d[axis]);
  }
}

std::int32_t EarCutter::build(std::int32_t first, std::int32_t end, std::int32_t parent) {
  const auto number = static_cast<std::int32_t>(nodes_.size());
  Node node{{}, first, end, parent, kNone, kNone, 0};
  for (std::int32_t k = first; k < end; ++k) {
    const auto corner = static_cast<std::size_t>(order_[static_cast<std::size_t>(k)]);
    node.box.extend(points_[corner]);
    node.blockers += blocks_[corner];
  }
  nodes_.push_back(node);
  if (end - first <= kLeafSize) {
    for (std::int32_t k = first; k < end; ++k)
      leaf_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])] = number;
    return number;
  }
  const Point extent = node.box.sizes();
  const int axis = extent.x() >= extent.y() ? 0 : 1;
  const std::int32_t middle = first + (end - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end,
                   [&](std::int32_t a, std::int32_t b) {
                     const double x = points_[static_cast<std::size_t>(a)][axis];
                     const double y = points_[static_cast<std::size_t>(b)][axis];
                     return x != y ? x < y : a < b;
                   });
  const std::int32_t left = build(first, middle, number);
  const std::int32_t right = build(middle, end, number);
  nodes_[static_cast<std::size_t>(number)].left = left;
  nodes_[static_cast<std::size_t>(number)].right = right;
  return number;
}

/// Outlines that wind more than once have ears all the same, which overlap.
bool EarCutter::turns_once() const {
  Point last = points_.front() - points_.back();
  for (std::size_t k = points_.size() - 1; k > 0 && last.isZero(0.0); --k)
    last = points_[k] - points_[k - 1];
  double turned = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point along = points_[k + 1 < points_.size() ? k + 1 : 0] - points_[k];
    if (along.isZero(0.0)) continue;
    turned += std::atan2(last.x() * along.y() - last.y() * along.x(), last.dot(along));
    last = along;
  }
  return turned < 3.0 * std::numbers::pi;
}

void EarCutter::stop_blocking(std::int32_t corner) {
  const auto c = static_cast<std::size_t>(corner);
  if (!blocks_[c]) return;
  blocks_[c] = false;
  for (std::int32_t n = leaf_[c]; n != kNone; n = nodes_[static_cast<std::size_t>(n)].parent)
    --nodes_[static_cast<std::size_t>(n)].blockers;
}

int EarCutter::turn(std::int32_t corner) const {
  const auto c = static_cast<std::size_t>(corner);
  return side(points_[static_cast<std::size_t>(previous_[c])], points_[c],
              points_[static_cast<std::size_t>(next_[c])]);
}

void EarCutter::offer(std::int32_t corner) {
  const auto c = static_cast<std::size_t>(corner);
  const int way = turn(corner);
  if (way > 0) stop_blocking(corner);
  if (way <= 0 && rule_ != Rule::any) return;
  const Point& a = points_[static_cast<std::size_t>(previous_[c])];
  const Point& b = points_[c];
  const Point& d = points_[static_cast<std::size_t>(next_[c])];
  const double longest =
      std::max({(b - a).squaredNorm(), (d - b).squaredNorm(), (a - d).squaredNorm()});
  const double area = (b - a).x() * (d - a).y() - (b - a).y() * (d - a).x();
  heap_.push_back({longest > 0.0 ? area / longest : 0.0, corner, version_[c]});
  std::push_heap(heap_.begin(), heap_.end());
}

/// Whether an edge at `other`, which stands where a corner of the triangle does, runs into it.
bool EarCutter::enters(std::int32_t other, const std::int32_t (&triangle)[3]) const {
  const auto at = [&](std::int32_t c) -> const Point& {
    return points_[static_cast<std::size_t>(c)];
  };
  const auto o = static_cast<std::size_t>(other);
  for (int k = 0; k < 3; ++k) {
    const Point& corner = at(triangle[k]);
    if (corner != at(other)) continue;
    for (const std::int32_t end : {previous_[o], next_[o]})
      if (side(corner, at(triangle[(k + 1) % 3]), at(end)) > 0 &&
          side(corner, at(end), at(triangle[(k + 2) % 3])) > 0)
        return true;
    return false;
  }
  return true;  // it stands on an edge
}

bool EarCutter::blocks(std::int32_t other, const std::int32_t (&triangle)[3]) const {
  if (other == triangle[0] || other == triangle[1] || other == triangle[2]) return false;
  bool on_edge = false;
  for (int k = 0; k < 3; ++k) {
    const int where = side(points_[static_cast<std::size_t>(triangle[k])],
                           points_[static_cast<std::size_t>(triangle[(k + 1) % 3])],
                           points_[static_cast<std::size_t>(other)]);
    if (where < 0) return false;
    on_edge = on_edge || where == 0;
  }
  if (!on_edge) return true;
  return rule_ == Rule::proper && enters(other, triangle);
}

// A triangle at a convex corner is an ear where no corner that is not convex is in it. One that is
// no ear stays none until its neighbours change: what is left of the polygon only shrinks.
bool EarCutter::is_ear(std::int32_t corner) {
  if (rule_ == Rule::convex || rule_ == Rule::any || steps_left_ <= 0) return true;
  const auto c = static_cast<std::size_t>(corner);
  const std::int32_t triangle[3] = {previous_[c], corner, next_[c]};
  const Point* const t[3] = {&points_[static_cast<std::size_t>(triangle[0])], &points_[c],
                             &points_[static_cast<std::size_t>(triangle[2])]};
  Eigen::AlignedBox2d box(*t[0]);
  box.extend(*t[1]).extend(*t[2]);
  // Wholly to the right of an edge, by more than rounding.
  const auto beside = [&](const Eigen::AlignedBox2d& b) {
    for (int k = 0; k < 3; ++k) {
      const Point& from = *t[k];
      const Point along = *t[(k + 1) % 3] - from;
      const Point nearest(along.y() > 0.0 ? b.min().x() : b.max().x(),
                          along.x() > 0.0 ? b.max().y() : b.min().y());
      if (side(from, *t[(k + 1) % 3], nearest) < 0) return true;
    }
    return false;
  };
  std::int32_t stack[64];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[--depth])];
    steps_left_ -= node.left == kNone ? node.end - node.first : 1;
    if (node.blockers == 0 || !box.intersects(node.box) || beside(node.box)) continue;
    if (node.left != kNone) {
      stack[depth++] = node.left;
      stack[depth++] = node.right;
      continue;
    }
    for (std::int32_t k = node.first; k < node.end; ++k) {
      const std::int32_t other = order_[static_cast<std::size_t>(k)];
      if (blocks_[static_cast<std::size_t>(other)] && blocks(other, triangle)) return false;
    }
  }
  return true;
}

bool EarCutter::cut(std::span<const Index> corners, std::span<const Vec3> positions,
                    std::vector<Face>& triangles) {
  triangles.clear();
  project(corners, positions);
  const auto n = static_cast<std::int32_t>(corners.size());
  const auto size = corners.size();
  previous_.resize(size);
  next_.resize(size);
  for (std::int32_t c = 0; c < n; ++c) {
    previous_[static_cast<std::size_t>(c)] = (c + n - 1) % n;
    next_[static_cast<std::size_t>(c)] = (c + 1) % n;
  }
  version_.assign(size, 0);
  blocks_.resize(size);
  for (std::int32_t c = 0; c < n; ++c) blocks_[static_cast<std::size_t>(c)] = turn(c) <= 0;
  order_.resize(size);
  std::iota(order_.begin(), order_.end(), 0);
  leaf_.resize(size);
  nodes_.clear();
  build(0, n, kNone);
  rule_ = Rule::proper;
  steps_left_ = 2000 * static_cast<std::int64_t>(n);
  heap_.clear();
  for (std::int32_t c = 0; c < n; ++c) offer(c);

  bool simple = turns_once();
  std::int32_t some = 0;  // a corner that is left
  const auto put = [&](std::int32_t c) {
    const auto at = [&](std::int32_t k) { return corners[static_cast<std::size_t>(k)]; };
    triangles.push_back({at(previous_[static_cast<std::size_t>(c)]), at(c),
                         at(next_[static_cast<std::size_t>(c)])});
  };
  for (std::int32_t left = n; left > 3;) {
    if (heap_.empty()) {
      rule_ = static_cast<Rule>(static_cast<int>(rule_) + 1);
      std::int32_t c = some;
      do {
        offer(c);
        c = next_[static_cast<std::size_t>(c)];
      } while (c != some);
      continue;
    }
    std::pop_heap(heap_.begin(), heap_.end());
    const Candidate best = heap_.back();
    heap_.pop_back();
    const auto c = static_cast<std::size_t>(best.corner);
    if (best.version != version_[c] || !is_ear(best.corner)) continue;
    simple = simple && (rule_ < Rule::convex || (rule_ == Rule::any && turn(best.corner) == 0));
    put(best.corner);
    stop_blocking(best.corner);
    ++version_[c];
    const std::int32_t before = previous_[c], after = next_[c];
    next_[static_cast<std::size_t>(before)] = after;
    previous_[static_cast<std::size_t>(after)] = before;
    some = after;
    --left;
    for (const std::int32_t neighbour : {before, after}) {
      ++version_[static_cast<std::size_t>(neighbour)];
      offer(neighbour);
    }
  }
  put(some);
  return simple && steps_left_ > 0;
}

}  // namespace mimicry
