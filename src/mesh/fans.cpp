#include "mesh/fans.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

#include <mimicry/mesh/half_edges.h>

#include "mesh/edge_pairs.h"
#include "mesh/sets.h"

namespace mimicry {
namespace {

class FanFinder {
 public:
  FanFinder(const TriangleMesh& mesh, const std::vector<Index>& place, const PlaceEdges& edges,
            const KeptFaces& faces)
      : mesh_(mesh), place_(place), edges_(edges), faces_(faces) {
    result_.twins.assign(3 * at(mesh.face_count()), kNone);
  }

  Fans run() {
    pair_half_edges();
    join_corners();
    while (separate()) join_corners();
    return std::move(result_);
  }

 private:
  void pair(Index a, Index b) {
    result_.twins[at(a)] = b;
    result_.twins[at(b)] = a;
  }

  void pair_half_edges() {
    std::vector<EdgeSide> rest;
    std::vector<Index> sorted;
    for (std::size_t e = 0; e < edges_.count(); ++e) {
      // Neighbours by number first.
      rest.clear();
      edges_.by_number(edges_.edge(e), sorted, [&](std::span<const Index> run) {
        if (run.size() == 2 &&
            edges_.runs_up(run[0], faces_.turned) != edges_.runs_up(run[1], faces_.turned))
          pair(run[0], run[1]);
        else
          for (const Index h : run) rest.push_back({h, edges_.runs_up(h, faces_.turned)});
      });
      if (rest.size() > 2) pair_own_parts(rest);
      std::sort(rest.begin(), rest.end(),
                [](const EdgeSide& a, const EdgeSide& b) { return a.h < b.h; });
      for (const auto& [a, b] : pair_sides(mesh_, faces_.turned, rest)) pair(a, b);
    }
  }

  // The two faces of a part that comes to this edge with two are neighbours: bodies and sheets that
  // touch others there go on.
  void pair_own_parts(std::vector<EdgeSide>& sides) {
    const auto part = [this](const EdgeSide& side) { return faces_.part[at(side.h / 3)]; };
    std::sort(sides.begin(), sides.end(), [&](const EdgeSide& a, const EdgeSide& b) {
      return std::tuple(part(a), a.h) < std::tuple(part(b), b.h);
    });
    std::vector<EdgeSide> rest;
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t end = i + 1;
      while (end < sides.size() && part(sides[end]) == part(sides[i])) ++end;
      if (end - i == 2 && sides[i].forward != sides[i + 1].forward)
        pair(sides[i].h, sides[i + 1].h);
      else
        rest.insert(rest.end(), sides.begin() + static_cast<std::ptrdiff_t>(i),
                    sides.begin() + static_cast<std::ptrdiff_t>(end));
      i = end;
    }
    sides = std::move(rest);
  }

  // Corner 3 f + k in the order of the file's corners; half-edge h leaves corner h of a face that
  // is not turned. What one half-edge leaves the other runs to.
  static Index next_corner(Index c) { return HalfEdges::next(c); }

  void join_corners() {
    Sets fans(3 * mesh_.face_count());
    for (Index h = 0; h < 3 * mesh_.face_count(); ++h) {
      const Index t = result_.twins[at(h)];
      if (t < h) continue;
      // By place, so that it holds for turned faces, too.
      const bool same_way = place_of_corner(h) == place_of_corner(t);
      fans.join(h, same_way ? t : next_corner(t));
      fans.join(next_corner(h), same_way ? next_corner(t) : t);
    }
    result_.fan.resize(at(3 * mesh_.face_count()));
    for (Index c = 0; c < 3 * mesh_.face_count(); ++c) result_.fan[at(c)] = fans.root(c);
  }

  Index place_of_corner(Index c) const { return place_[at(mesh_.face(c / 3)[at(c % 3)])]; }

  // Neighbours are told by their vertices alone: where an edge between the same two fans has other
  // half-edges than one pair, the first pair stays, the others are opened, and faces that still
  // stand there are cut out. True where something was; each time there are fewer pairs.
  bool separate() {
    bool any = false;
    loosened_.assign(result_.fan.size(), false);
    loose_at_.clear();
    std::vector<std::pair<std::pair<Index, Index>, Index>> keyed;
    for (std::size_t e = 0; e < edges_.count(); ++e) {
      if (edges_.edge(e).size() <= 2 && all_paired(edges_.edge(e))) continue;
      keyed.clear();
      for (const Index h : edges_.edge(e))
        keyed.push_back({std::minmax({result_.fan[at(h)], result_.fan[at(next_corner(h))]}), h});
      std::sort(keyed.begin(), keyed.end());
      for (std::size_t i = 0; i < keyed.size();) {
        std::size_t end = i + 1;
        while (end < keyed.size() && keyed[end].first == keyed[i].first) ++end;
        if (end - i > 1) any |= separate_one({keyed.data() + i, end - i});
        i = end;
      }
    }
    for (Index h = 0; h < 3 * mesh_.face_count(); ++h)
      if (loosened_[at(result_.fan[at(h)])] || loosened_[at(result_.fan[at(next_corner(h))])])
        if (is_loose(h)) any |= open(h);
    return any;
  }

  // A pair that was made by place, or that folds a sheet onto itself.
  bool is_loose(Index h) const {
    const Index t = result_.twins[at(h)];
    if (t < 0) return false;
    return edges_.ends(h) != edges_.ends(t) || is_fold(mesh_, faces_.turned, h, t);
  }
  // Of the pairs that this round begins with.
  bool has_loose_pair(Index fan) {
    if (loose_at_.empty()) {
      loose_at_.assign(result_.fan.size(), false);
      for (Index h = 0; h < 3 * mesh_.face_count(); ++h)
        if (is_loose(h))
          loose_at_[at(result_.fan[at(h)])] = loose_at_[at(result_.fan[at(next_corner(h))])] = true;
    }
    return loose_at_[at(fan)];
  }

  bool all_paired(std::span<const Index> edge) const {
    return std::all_of(edge.begin(), edge.end(),
                       [this](Index h) { return result_.twins[at(h)] >= 0; });
  }

  bool separate_one(std::span<const std::pair<std::pair<Index, Index>, Index>> sides) {
    if (sides.size() == 2) {
      const Index a = sides[0].second, b = sides[1].second;
      if (result_.twins[at(a)] == b) return false;
      if (result_.twins[at(a)] == kNone && result_.twins[at(b)] == kNone &&
          edges_.runs_up(a, faces_.turned) != edges_.runs_up(b, faces_.turned))
        return false;  // nothing else is there: they will close the surface
    }
    // Two pairs that run between the same two fans: what joined the fans is undone.
    std::size_t paired = 0;
    for (const auto& [fans, h] : sides) paired += result_.twins[at(h)] >= 0;
    if (paired >= 4) {
      const auto& [low, high] = sides.front().first;
      for (const Index fan : {low, high})
        if (has_loose_pair(fan)) {
          loosened_[at(fan)] = true;
          return false;  // opened below
        }
    }
    Index kept = kNone;
    for (const auto& [fans, h] : sides)
      if (kept == kNone && result_.twins[at(h)] >= 0) kept = h;
    bool any = false;
    for (const auto& [fans, h] : sides) {
      if (h == kept || (kept != kNone && h == result_.twins[at(kept)])) continue;
      if (result_.twins[at(h)] >= 0)
        any |= open(h);
      else
        for (Index k = 0; k < 3; ++k) any |= open(3 * (h / 3) + k);
    }
    return any;
  }

  bool open(Index h) {
    const Index t = result_.twins[at(h)];
    if (t < 0) return false;
    result_.twins[at(h)] = result_.twins[at(t)] = kNone;
    return true;
  }

  const TriangleMesh& mesh_;
  const std::vector<Index>& place_;
  const PlaceEdges& edges_;
  const KeptFaces& faces_;
  Fans result_;
  std::vector<bool> loosened_, loose_at_;  // #H, for a round of `separate`: fans by their root
};

}  // namespace

Fans find_fans(const TriangleMesh& mesh, const std::vector<Index>& place, const PlaceEdges& edges,
               const KeptFaces& faces) {
  return FanFinder(mesh, place, edges, faces).run();
}

}  // namespace mimicry
