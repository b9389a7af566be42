#include "curve/self_crossing.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include "geodesic/site.h"

namespace mimicry {
namespace {

// Touching counts: areas below this (of the face's own coordinates) are none.
constexpr double kTouch = 1e-12;

struct Segment {
  Index face;
  std::size_t node;
  Vec2 from, to;  // barycentrics 1 and 2
};

double area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

int side(double x) {
  return x > kTouch ? 1 : x < -kTouch ? -1 : 0;
}

bool meet(const Segment& s, const Segment& t) {
  const Eigen::Array2d low = s.from.array().min(s.to.array()).max(t.from.array().min(t.to.array()));
  const Eigen::Array2d high =
      s.from.array().max(s.to.array()).min(t.from.array().max(t.to.array()));
  if (low.x() > high.x() + kTouch || low.y() > high.y() + kTouch) return false;
  return side(area(s.from, s.to, t.from)) * side(area(s.from, s.to, t.to)) <= 0 &&
         side(area(t.from, t.to, s.from)) * side(area(t.from, t.to, s.to)) <= 0;
}

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> self_crossing(const RefinedCurve& curve,
                                                                 const TriangleMesh& mesh) {
  using Pair = std::pair<std::size_t, std::size_t>;
  const std::size_t count = curve.nodes.size();
  // Neighbours on the curve share a node.
  const auto follows = [&](std::size_t i, std::size_t j) {
    return j - i < 2 || (curve.closed && i == 0 && j + 2 == count);
  };
  std::optional<Pair> first;
  const auto found = [&](std::size_t i, std::size_t j) {
    const Pair pair = std::minmax(i, j);
    if (!first || pair < *first) first = pair;
  };

  std::vector<Segment> segments;
  std::map<Index, std::size_t> at_vertex;
  for (std::size_t i = 0; i < count; ++i) {
    const Site site = site_of(mesh, curve.nodes[i].point);
    // In two faces that share but the vertex, segments through it have no face in common.
    if (site.kind == Site::Kind::vertex && !(curve.closed && i + 1 == count)) {
      const auto [place, is_new] = at_vertex.try_emplace(site.index, i);
      if (!is_new) found(place->second, i);
    }
    const Index face = curve.faces[i];
    if (face == kNone || i + 1 >= count) continue;
    const Vec3 from = in_face(mesh, curve.nodes[i].point, face).bary;
    const Vec3 to = in_face(mesh, curve.nodes[i + 1].point, face).bary;
    segments.push_back({face, i, from.tail<2>(), to.tail<2>()});
  }
  std::stable_sort(segments.begin(), segments.end(),
                   [](const Segment& a, const Segment& b) { return a.face < b.face; });
  for (std::size_t begin = 0; begin < segments.size();) {
    std::size_t end = begin;
    while (end < segments.size() && segments[end].face == segments[begin].face) ++end;
    for (std::size_t a = begin; a < end; ++a)
      for (std::size_t b = a + 1; b < end; ++b)
        if (!follows(segments[a].node, segments[b].node) && meet(segments[a], segments[b]))
          found(segments[a].node, segments[b].node);
    begin = end;
  }
  return first;
}

}  // namespace mimicry
