#include "segment/face_triangulation.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>

namespace mimicry {
namespace {

constexpr int following(int k) {
  return k == 2 ? 0 : k + 1;
}
constexpr int preceding(int k) {
  return k == 0 ? 2 : k - 1;
}
std::pair<Index, Index> edge_key(Index a, Index b) {
  return a < b ? std::pair(a, b) : std::pair(b, a);
}

}  // namespace

FaceTriangulation::FaceTriangulation(std::int64_t snap)
    : snap_(snap), points_{{0, 0}, {kCutGrid, 0}, {0, kCutGrid}}, any_(3, 0) {
  add_triangle(0, 1, 2);
}

Index FaceTriangulation::add_triangle(Index a, Index b, Index c) {
  const auto t = static_cast<Index>(triangles_.size());
  triangles_.push_back({{a, b, c}, {kNone, kNone, kNone}, {false, false, false}});
  for (const Index v : {a, b, c}) any_[at(v)] = t;
  return t;
}

void FaceTriangulation::replace_neighbor(Index t, Index from, Index to) {
  if (t == kNone) return;
  for (Index& n : tri(t).n)
    if (n == from) {
      n = to;
      return;
    }
}

std::vector<FaceTriangulation::Corner> FaceTriangulation::corners_around(Index v) const {
  const auto corner_of = [&](Index t) {
    const auto& corners = tri(t).v;
    return static_cast<int>(std::find(corners.begin(), corners.end(), v) - corners.begin());
  };
  // Clockwise as far as it goes, then all of them counter-clockwise.
  const Index begin = any_[at(v)];
  Index first = begin;
  for (;;) {
    const Index t = tri(first).n[at(corner_of(first))];
    if (t == kNone || t == begin) break;
    first = t;
  }
  std::vector<Corner> corners;
  for (Index t = first; t != kNone;) {
    const int k = corner_of(t);
    corners.push_back({t, k});
    t = tri(t).n[at(preceding(k))];
    if (t == first) break;
  }
  return corners;
}

// The triangle in which the edge runs from a to b; kNone where there is none.
FaceTriangulation::Corner FaceTriangulation::edge_corner(Index a, Index b) const {
  for (const Corner& c : corners_around(a))
    if (tri(c.triangle).v[at(following(c.k))] == b) return c;
  return {kNone, 0};
}

void FaceTriangulation::fix(Index a, Index b) {
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    const Corner c = edge_corner(from, to);
    if (c.triangle != kNone) tri(c.triangle).fixed[at(c.k)] = true;
  }
}

// The triangle that holds a point, with the edge that it lies on, or k = 3.
FaceTriangulation::Corner FaceTriangulation::locate(const CutPoint& p) const {
  const auto side = [&](Index t, int k) {
    return cut_orientation(points_[at(tri(t).v[at(k)])], points_[at(tri(t).v[at(following(k))])],
                           p);
  };
  const auto found = [&](Index t) {
    Corner c{t, 3};
    for (int k = 0; k < 3; ++k) {
      const std::int64_t s = side(t, k);
      if (s < 0) return Corner{kNone, k};
      if (s == 0) c.k = k;
    }
    return c;
  };
  Index t = last_;
  // A walk may go in circles where the triangulation is not Delaunay's; then all are looked at.
  for (std::size_t steps = 0; steps < 2 * triangles_.size() && t != kNone; ++steps) {
    const Corner c = found(t);
    if (c.triangle != kNone) return last_ = t, c;
    t = tri(t).n[at(c.k)];
  }
  for (t = 0; at(t) < triangles_.size(); ++t) {
    const Corner c = found(t);
    if (c.triangle != kNone) return last_ = t, c;
  }
  return {kNone, 0};
}

Index FaceTriangulation::add_point(const CutPoint& p) {
  const Corner c = locate(p);
  const auto v = static_cast<Index>(points_.size());
  points_.push_back(p);
  any_.push_back(c.triangle);
  if (c.k == 3)
    split_triangle(c.triangle, v);
  else
    split_edge(c.triangle, c.k, v);
  return v;
}

void FaceTriangulation::split_triangle(Index t, Index p) {
  const Triangle old = tri(t);
  const Index b = add_triangle(old.v[1], old.v[2], p);
  const Index c = add_triangle(old.v[2], old.v[0], p);
  tri(t) = {{old.v[0], old.v[1], p}, {old.n[0], b, c}, {old.fixed[0], false, false}};
  tri(b) = {{old.v[1], old.v[2], p}, {old.n[1], c, t}, {old.fixed[1], false, false}};
  tri(c) = {{old.v[2], old.v[0], p}, {old.n[2], t, b}, {old.fixed[2], false, false}};
  replace_neighbor(old.n[1], t, b);
  replace_neighbor(old.n[2], t, c);
  any_[at(p)] = any_[at(old.v[0])] = any_[at(old.v[1])] = t;
}

// Of each of the two triangles (u, v, w) at the edge: (u, p, w) stays in its place.
void FaceTriangulation::split_edge(Index t, int k, Index p) {
  const Triangle one = tri(t);
  const auto a = at(k), b = at(following(k)), c = at(preceding(k));
  const Index u = one.v[a], v = one.v[b], w = one.v[c];
  const Index other = one.n[a];
  const bool fixed = one.fixed[a];
  const Index far = add_triangle(p, v, w);
  tri(t) = {{u, p, w}, {kNone, far, one.n[c]}, {fixed, false, one.fixed[c]}};
  tri(far) = {{p, v, w}, {kNone, one.n[b], t}, {fixed, one.fixed[b], false}};
  replace_neighbor(one.n[b], t, far);
  any_[at(p)] = any_[at(u)] = any_[at(w)] = t;
  if (other == kNone) return;
  const Triangle two = tri(other);
  const auto& n = two.n;
  const int j = static_cast<int>(std::find(n.begin(), n.end(), t) - n.begin());
  const auto e = at(following(j)), f = at(preceding(j));  // runs from v to u
  const Index x = two.v[f];
  const Index near = add_triangle(p, u, x);
  tri(other) = {{v, p, x}, {far, near, two.n[f]}, {fixed, false, two.fixed[f]}};
  tri(near) = {{p, u, x}, {t, two.n[e], other}, {fixed, two.fixed[e], false}};
  replace_neighbor(two.n[e], other, near);
  tri(t).n[0] = near;
  tri(far).n[0] = other;
  any_[at(v)] = any_[at(x)] = other;
}

bool FaceTriangulation::can_flip(Index t, int k) const {
  const Triangle& one = tri(t);
  const Index other = one.n[at(k)];
  if (other == kNone || one.fixed[at(k)]) return false;
  const auto& n = tri(other).n;
  const int j = static_cast<int>(std::find(n.begin(), n.end(), t) - n.begin());
  const Index x = one.v[at(k)], y = one.v[at(following(k))], c = one.v[at(preceding(k))];
  const Index d = tri(other).v[at(preceding(j))];
  return turn(c, x, d) > 0 && turn(d, y, c) > 0;
}

// (x, y, c) and (y, x, d) become (c, x, d) and (d, y, c).
void FaceTriangulation::flip(Index t, int k) {
  const Triangle one = tri(t);
  const Index other = one.n[at(k)];
  const Triangle two = tri(other);
  const int j = static_cast<int>(std::find(two.n.begin(), two.n.end(), t) - two.n.begin());
  const auto k1 = at(following(k)), k2 = at(preceding(k));
  const auto j1 = at(following(j)), j2 = at(preceding(j));
  const Index x = one.v[at(k)], y = one.v[k1], c = one.v[k2], d = two.v[j2];
  tri(t) = {{c, x, d}, {one.n[k2], two.n[j1], other}, {one.fixed[k2], two.fixed[j1], false}};
  tri(other) = {{d, y, c}, {two.n[j2], one.n[k1], t}, {two.fixed[j2], one.fixed[k1], false}};
  replace_neighbor(two.n[j1], other, t);
  replace_neighbor(one.n[k1], t, other);
  any_[at(c)] = any_[at(x)] = any_[at(d)] = t;
  any_[at(y)] = other;
}

// From a straight toward b: to the next vertex on the way, or to a fixed edge.
FaceTriangulation::Walk FaceTriangulation::walk(Index a, Index b) const {
  Walk way;
  const auto ahead = [&](Index v) {
    const CutPoint &p = points_[at(a)], &q = points_[at(b)], &r = points_[at(v)];
    const auto dx = static_cast<double>(q.x - p.x), dy = static_cast<double>(q.y - p.y);
    return dx * static_cast<double>(r.x - p.x) + dy * static_cast<double>(r.y - p.y) > 0.0;
  };
  Corner edge{kNone, 0};
  for (const Corner& c : corners_around(a)) {
    const Index x = tri(c.triangle).v[at(following(c.k))];
    const Index y = tri(c.triangle).v[at(preceding(c.k))];
    const std::int64_t right = turn(a, b, x), left = turn(a, b, y);
    for (const auto& [v, side] : {std::pair(x, right), std::pair(y, left)})
      if (side == 0 && ahead(v)) {
        way.reached = v;
        way.along_edge = true;
        return way;
      }
    if (right < 0 && left > 0) edge = {c.triangle, following(c.k)};
  }
  while (edge.triangle != kNone) {
    const Index x = tri(edge.triangle).v[at(edge.k)];
    const Index y = tri(edge.triangle).v[at(following(edge.k))];
    if (tri(edge.triangle).fixed[at(edge.k)]) {
      way.wall = edge;
      return way;
    }
    way.crossed.emplace_back(x, y);
    const Index next = tri(edge.triangle).n[at(edge.k)];
    if (next == kNone) break;
    const auto& n = tri(next).n;
    const int j = static_cast<int>(std::find(n.begin(), n.end(), edge.triangle) - n.begin());
    const Index z = tri(next).v[at(preceding(j))];  // the edge runs from y to x here
    const std::int64_t side = turn(a, b, z);
    if (side == 0) {
      way.reached = z;
      return way;
    }
    edge = {next, side > 0 ? following(j) : preceding(j)};
  }
  return way;
}

// Makes a-b an edge by flipping those that cross it (Sloan 1993); none of them is fixed, and no
// vertex lies on the way.
void FaceTriangulation::free_way(Index a, Index b, std::vector<std::pair<Index, Index>> crossed) {
  std::deque<std::pair<Index, Index>> open(crossed.begin(), crossed.end());
  while (!open.empty()) {
    const auto [x, y] = open.front();
    open.pop_front();
    const Corner c = edge_corner(x, y);
    if (!can_flip(c.triangle, c.k)) {
      open.emplace_back(x, y);
      continue;
    }
    const Index other = tri(c.triangle).n[at(c.k)];
    const Index p = tri(c.triangle).v[at(preceding(c.k))];
    flip(c.triangle, c.k);
    const Index q = tri(other).v[0];
    if (edge_key(p, q) == edge_key(a, b) || p == a || p == b || q == a || q == b) continue;
    if ((turn(a, b, p) > 0) != (turn(a, b, q) > 0)) open.emplace_back(p, q);
  }
}

// The point where a-b crosses a fixed edge, made or found at one of its ends; kNone where the grid
// has no place for it.
Index FaceTriangulation::split_wall(Index a, Index b, const Corner& wall) {
  const Triangle& one = tri(wall.triangle);
  const Index u = one.v[at(wall.k)], v = one.v[at(following(wall.k))];
  const Index w = one.v[at(preceding(wall.k))];
  const auto from = static_cast<double>(turn(u, v, a)), to = static_cast<double>(turn(u, v, b));
  const double s = from / (from - to);
  const CutPoint &pa = points_[at(a)], &pb = points_[at(b)];
  const CutPoint p{pa.x + std::llround(s * static_cast<double>(pb.x - pa.x)),
                   pa.y + std::llround(s * static_cast<double>(pb.y - pa.y))};
  const auto reach = [&](Index i) {
    const CutPoint& q = points_[at(i)];
    return std::max({std::abs(q.x - p.x), std::abs(q.y - p.y), std::abs(q.x + q.y - p.x - p.y)});
  };
  const Index nearer = reach(u) <= reach(v) ? u : v;
  if (reach(nearer) <= snap_) return nearer;
  const Index other = one.n[at(wall.k)];
  const auto& n = tri(other).n;
  const int j = static_cast<int>(std::find(n.begin(), n.end(), wall.triangle) - n.begin());
  const Index x = tri(other).v[at(preceding(j))];
  const auto positive = [&](Index i, Index k) {
    return cut_orientation(points_[at(i)], p, points_[at(k)]) > 0;
  };
  if (!positive(u, w) || !positive(w, v) || !positive(v, x) || !positive(x, u)) return kNone;
  const auto made = static_cast<Index>(points_.size());
  points_.push_back(p);
  any_.push_back(wall.triangle);
  split_edge(wall.triangle, wall.k, made);
  splits_[edge_key(u, v)] = made;
  ++crossings_;
  return made;
}

// Along edges that are there, as few as may be: always possible.
void FaceTriangulation::lead_along_edges(Index a, Index b, Chain& chain) {
  std::vector<Index> before(points_.size(), kNone);
  std::deque<Index> open{b};
  before[at(b)] = b;
  while (before[at(a)] == kNone) {
    const Index v = open.front();
    open.pop_front();
    for (const Corner& c : corners_around(v))
      for (const int k : {following(c.k), preceding(c.k)}) {
        const Index w = tri(c.triangle).v[at(k)];
        if (before[at(w)] != kNone) continue;
        before[at(w)] = v;
        open.push_back(w);
      }
  }
  for (; a != b; a = before[at(a)]) {
    fix(a, before[at(a)]);
    chain.push_back(before[at(a)]);
  }
}

// Fixes a chain of edges from a to b and appends its points after a. `detours` are the steps that
// are left before the grid is taken to be too coarse for straight ones.
void FaceTriangulation::lead(Index a, Index b, std::size_t& detours, Chain& chain) {
  while (a != b) {
    if (detours == 0) return lead_along_edges(a, b, chain);
    --detours;
    Walk way = walk(a, b);
    Index next = way.reached;
    if (next != kNone && splits_.count(edge_key(a, next))) {
      expand(a, next, chain);
    } else if (next != kNone) {
      if (!way.along_edge) free_way(a, next, std::move(way.crossed));
      fix(a, next);
      chain.push_back(next);
    } else {
      if (way.wall.triangle != kNone) next = split_wall(a, b, way.wall);
      if (next == kNone || next == a) return lead_along_edges(a, b, chain);
      lead(a, next, detours, chain);
    }
    a = next;
  }
}

void FaceTriangulation::add_segment(Index a, Index b) {
  const auto key = edge_key(a, b);
  if (a == b || chains_.count(key)) return;
  Chain chain{key.first};
  std::size_t detours = 4 * triangles_.size() + 64;
  lead(key.first, key.second, detours, chain);
  chains_[key] = std::move(chain);
}

void FaceTriangulation::expand(Index a, Index b, Chain& chain) const {
  const auto split = splits_.find(edge_key(a, b));
  if (split == splits_.end()) {
    chain.push_back(b);
    return;
  }
  expand(a, split->second, chain);
  expand(split->second, b, chain);
}

FaceTriangulation::Chain FaceTriangulation::chain(Index a, Index b) const {
  const Chain& made = chains_.at(edge_key(a, b));
  Chain whole{made.front()};
  for (std::size_t i = 1; i < made.size(); ++i) expand(made[i - 1], made[i], whole);
  if (whole.front() != a) std::reverse(whole.begin(), whole.end());
  return whole;
}

void FaceTriangulation::improve(const std::function<bool(Index, Index, Index, Index)>& needs_flip) {
  // Every pass but the last flips something; the bound is for angles that round.
  for (int pass = 0; pass < 20; ++pass) {
    bool flipped = false;
    for (Index t = 0; at(t) < triangles_.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        if (!can_flip(t, k)) continue;
        const Index other = tri(t).n[at(k)];
        const auto& n = tri(other).n;
        const int j = static_cast<int>(std::find(n.begin(), n.end(), t) - n.begin());
        const auto& v = tri(t).v;
        if (!needs_flip(v[at(k)], v[at(following(k))], v[at(preceding(k))],
                        tri(other).v[at(preceding(j))]))
          continue;
        flip(t, k);
        flipped = true;
      }
    if (!flipped) return;
  }
}

}  // namespace mimicry
