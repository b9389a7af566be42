#include "bake/sheets.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace mimicry {
namespace {

// Points of the surface are far from each other where the way along its edges is longer than this
// times the straight way. Edges make a detour of up to a third; a fold of 45 degrees has 2.6.
constexpr double kFar = 3.5;
constexpr std::size_t kSheetChunk = 512;

// The point of the surface that a vertex of the shell lies over, and the corners of its face.
struct Foot {
  Vec3 position;
  std::array<Index, 3> corners;
};

std::uint64_t pair_key(Index a, Index b) {
  return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint64_t>(b);
}

std::vector<Foot> find_feet(const Shell& shell, const UnitSurface& surface, Executor& executor) {
  const TriangleMesh& mesh = surface.mesh();
  std::vector<Foot> feet(shell.positions.size());
  executor.for_chunks(feet.size(), kSheetChunk, [&](std::size_t begin, std::size_t end, int) {
    Index hint = kNone;
    for (std::size_t v = begin; v < end; ++v) {
      const auto index = static_cast<Index>(v);
      if (index < mesh.vertex_count()) {
        feet[v] = {mesh.position(index), {index, kNone, kNone}};
        continue;
      }
      const auto nearest = surface.nearest(shell.positions[v], hint);
      hint = nearest.surface.face;
      feet[v] = {mesh.position(nearest.surface), mesh.face(hint)};
    }
  });
  for (const Tie& tie : shell.ties) feet[at(tie.vertex)].corners = tie.corners;
  return feet;
}

// Ways along the edges of the surface.
class EdgePaths {
 public:
  explicit EdgePaths(const TriangleMesh& mesh) : mesh_(mesh), start_(at(mesh.vertex_count()) + 1) {
    for (const Face& f : mesh.faces())
      for (const Index v : f) start_[at(v) + 1] += 2;
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    neighbours_.resize(at(start_.back()));
    std::vector<Index> fill(start_.begin(), start_.end() - 1);
    for (const Face& f : mesh.faces())
      for (std::size_t k = 0; k < 3; ++k)
        for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3})
          neighbours_[at(fill[at(f[k])]++)] = f[other];
  }

  struct Scratch {
    std::vector<double> distance;
    std::vector<std::uint32_t> seen;
    std::uint32_t stamp = 0;
    std::vector<std::pair<double, Index>> queue;  // by the least way through a vertex
  };

  // A way from a to b of at most `limit` exists (A*, Hart, Nilsson and Raphael 1968).
  bool reaches(const Foot& a, const Foot& b, double limit, Scratch& scratch) const {
    const auto size = at(mesh_.vertex_count());
    scratch.seen.resize(size, 0);
    scratch.distance.resize(size);
    ++scratch.stamp;
    scratch.queue.clear();
    const auto offer = [&](Index v, double distance) {
      const bool is_known = scratch.seen[at(v)] == scratch.stamp;
      if (is_known && scratch.distance[at(v)] <= distance) return;
      const double whole = distance + (mesh_.position(v) - b.position).norm();
      if (whole > limit) return;
      scratch.seen[at(v)] = scratch.stamp;
      scratch.distance[at(v)] = distance;
      scratch.queue.emplace_back(-whole, v);
      std::push_heap(scratch.queue.begin(), scratch.queue.end());
    };
    for (const Index v : a.corners)
      if (v != kNone) offer(v, (mesh_.position(v) - a.position).norm());
    while (!scratch.queue.empty()) {
      std::pop_heap(scratch.queue.begin(), scratch.queue.end());
      const Index v = scratch.queue.back().second;
      scratch.queue.pop_back();
      if (std::find(b.corners.begin(), b.corners.end(), v) != b.corners.end()) return true;
      const double distance = scratch.distance[at(v)];
      for (auto k = at(start_[at(v)]); k < at(start_[at(v) + 1]); ++k) {
        const Index next = neighbours_[k];
        offer(next, distance + (mesh_.position(next) - mesh_.position(v)).norm());
      }
    }
    return false;
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<Index> start_, neighbours_;
};

bool share_a_corner(const Foot& a, const Foot& b) {
  for (const Index v : a.corners)
    if (v != kNone && std::find(b.corners.begin(), b.corners.end(), v) != b.corners.end())
      return true;
  return false;
}

// Edges of the tetrahedra whose ends lie over parts of the surface that are far from each other;
// sorted keys, the lower vertex first.
std::vector<std::uint64_t> far_edges(const Shell& shell, const UnitSurface& surface,
                                     Executor& executor) {
  const std::vector<Foot> feet = find_feet(shell, surface, executor);
  std::vector<std::uint64_t> edges;
  for (const Tet& t : shell.tets)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!share_a_corner(feet[at(t[i])], feet[at(t[j])]))
          edges.push_back(pair_key(std::min(t[i], t[j]), std::max(t[i], t[j])));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  const EdgePaths paths(surface.mesh());
  std::vector<EdgePaths::Scratch> scratch(static_cast<std::size_t>(executor.threads()));
  std::vector<char> is_far(edges.size(), 0);
  executor.for_chunks(
      edges.size(), kSheetChunk, [&](std::size_t begin, std::size_t end, int worker) {
        for (std::size_t e = begin; e < end; ++e) {
          const Foot& a = feet[static_cast<std::size_t>(edges[e] >> 32)];
          const Foot& b = feet[static_cast<std::size_t>(edges[e] & 0xffffffffU)];
          const double limit = kFar * (a.position - b.position).norm();
          is_far[e] = !paths.reaches(a, b, limit, scratch[static_cast<std::size_t>(worker)]);
        }
      });
  std::size_t kept = 0;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (is_far[e]) edges[kept++] = edges[e];
  edges.resize(kept);
  return edges;
}

// For each corner of a tetrahedron the lowest of the corners that it hangs together with.
using Groups = std::array<std::size_t, 4>;

Groups groups_of(const Tet& t, const std::vector<std::uint64_t>& far) {
  Groups group = {0, 1, 2, 3};
  for (std::size_t i = 1; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::uint64_t key = pair_key(std::min(t[i], t[j]), std::max(t[i], t[j]));
      if (std::binary_search(far.begin(), far.end(), key)) continue;
      const std::size_t low = std::min(group[i], group[j]), high = std::max(group[i], group[j]);
      for (std::size_t& g : group)
        if (g == high) g = low;
    }
  return group;
}

// What corner v is to the part of the surface that corner x lies over, for each far edge in both
// directions: v itself or one of its copies. Views of v that meet in a tetrahedron are one.
class Views {
 public:
  explicit Views(const std::vector<std::uint64_t>& far) {
    for (const std::uint64_t key : far) {
      keys_.push_back(key);
      keys_.push_back(key << 32 | key >> 32);
    }
    std::sort(keys_.begin(), keys_.end());
    parent_.resize(keys_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    is_itself_.resize(keys_.size(), false);
  }
  void unite(Index v, Index x, Index y) {
    const std::size_t a = root(number(v, x)), b = root(number(v, y));
    const std::size_t low = std::min(a, b), high = std::max(a, b);
    parent_[high] = low;
    if (is_itself_[high]) is_itself_[low] = true;
  }
  void make_itself(Index v, Index x) { is_itself_[root(number(v, x))] = true; }
  // nullopt where v is itself.
  std::optional<std::size_t> copy(Index v, Index x) {
    const std::size_t r = root(number(v, x));
    if (is_itself_[r]) return std::nullopt;
    return r;
  }
  std::size_t size() const { return keys_.size(); }

 private:
  std::size_t number(Index v, Index x) const {
    return static_cast<std::size_t>(std::lower_bound(keys_.begin(), keys_.end(), pair_key(v, x)) -
                                    keys_.begin());
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::vector<std::uint64_t> keys_;
  std::vector<std::size_t> parent_;
  std::vector<bool> is_itself_;
};

}  // namespace

void separate_sheets(Shell& shell, const UnitSurface& surface, Executor& executor) {
  const std::vector<std::uint64_t> far = far_edges(shell, surface, executor);
  if (far.empty()) return;
  std::vector<bool> has_far(shell.positions.size(), false);
  for (const std::uint64_t key : far) {
    has_far[static_cast<std::size_t>(key >> 32)] = true;
    has_far[static_cast<std::size_t>(key & 0xffffffffU)] = true;
  }
  struct Candidate {
    std::size_t tet;
    Groups group;
  };
  std::vector<Candidate> candidates;
  Views views(far);
  for (std::size_t i = 0; i < shell.tets.size(); ++i) {
    const Tet& t = shell.tets[i];
    if (std::none_of(t.begin(), t.end(), [&](Index v) { return has_far[at(v)]; })) continue;
    const Groups group = groups_of(t, far);
    candidates.push_back({i, group});
    for (std::size_t v = 0; v < 4; ++v)
      for (std::size_t x = 0; x < 4; ++x) {
        if (x == v) continue;
        if (group[x] == group[v]) {
          const std::uint64_t key = pair_key(std::min(t[v], t[x]), std::max(t[v], t[x]));
          if (std::binary_search(far.begin(), far.end(), key)) views.make_itself(t[v], t[x]);
        } else if (const std::size_t first = group[x]; first != x) {
          views.unite(t[v], t[first], t[x]);
        }
      }
  }

  std::vector<Index> number(views.size(), kNone);
  std::vector<Tet> copies;
  std::vector<bool> is_replaced(shell.tets.size(), false);
  for (const auto& [tet, group] : candidates) {
    if (group == Groups{}) continue;
    const Tet& t = shell.tets[tet];
    const auto first = static_cast<std::ptrdiff_t>(copies.size());
    for (std::size_t g = 0; g < 4; ++g) {
      if (group[g] != g) continue;
      Tet copy = t;
      for (std::size_t v = 0; v < 4; ++v) {
        if (group[v] == g) continue;
        const auto view = views.copy(t[v], t[g]);
        if (!view) continue;
        Index& n = number[*view];
        if (n == kNone) {
          n = static_cast<Index>(shell.positions.size());
          shell.positions.push_back(Vec3(shell.positions[at(t[v])]));
          shell.copy_of.push_back(t[v]);
        }
        copy[v] = n;
      }
      if (std::find(copies.begin() + first, copies.end(), copy) == copies.end())
        copies.push_back(copy);
    }
    is_replaced[tet] = true;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < shell.tets.size(); ++i)
    if (!is_replaced[i]) shell.tets[kept++] = shell.tets[i];
  shell.tets.resize(kept);
  shell.tets.insert(shell.tets.end(), copies.begin(), copies.end());
  shell.overlapping_tets = static_cast<Index>(copies.size());
}

}  // namespace mimicry
