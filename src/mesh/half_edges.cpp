#include <algorithm>
#include <cstdint>
#include <utility>

#include <mimicry/mesh/half_edges.h>

namespace mimicry {
namespace {

struct KeyedHalfEdge {
  std::uint64_t key;  // both ends, the smaller first
  Index h;
};

}  // namespace

HalfEdges::HalfEdges(const TriangleMesh& mesh) {
  const auto half_edges = static_cast<std::size_t>(mesh.face_count()) * 3;
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
  twins_.assign(half_edges, kNone);
  tails_.reserve(half_edges);
  for (const Face& f : mesh.faces()) tails_.insert(tails_.end(), f.begin(), f.end());

  // Half-edges are put in buckets by their smaller end, then each small bucket is sorted by the
  // other end: linear in practice, and the order inside an edge is that of the numbers.
  // Faces that repeat a corner have no neighbours.
  std::vector<bool> no_part(static_cast<std::size_t>(mesh.face_count()), false);
  for (Index f = 0; f < mesh.face_count(); ++f) no_part[at(f)] = repeats_corner(mesh.face(f));
  const auto counts = [&no_part](Index h) { return !no_part[at(face(h))]; };
  std::vector<Index> start(vertices + 1, 0);
  for (Index h = 0; h < count(); ++h)
    if (counts(h)) ++start[static_cast<std::size_t>(std::min(tail(h), head(h))) + 1];
  for (std::size_t v = 0; v < vertices; ++v) start[v + 1] += start[v];
  std::vector<KeyedHalfEdge> keyed(half_edges);
  {
    std::vector<Index> fill(start.begin(), start.end() - 1);
    for (Index h = 0; h < count(); ++h) {
      if (!counts(h)) continue;
      const auto [low, high] = std::minmax({tail(h), head(h)});
      const auto slot = static_cast<std::size_t>(fill[static_cast<std::size_t>(low)]++);
      keyed[slot] = {static_cast<std::uint64_t>(high), h};
    }
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto first = keyed.begin() + start[v];
    const auto last = keyed.begin() + start[v + 1];
    std::sort(first, last, [](const KeyedHalfEdge& a, const KeyedHalfEdge& b) {
      return a.key != b.key ? a.key < b.key : a.h < b.h;
    });
    for (auto run = first; run != last;) {
      auto end = run + 1;
      while (end != last && end->key == run->key) ++end;
      const auto size = end - run;
      if (size == 2 && tail(run[0].h) != tail(run[1].h)) {
        twins_[static_cast<std::size_t>(run[0].h)] = run[1].h;
        twins_[static_cast<std::size_t>(run[1].h)] = run[0].h;
      } else if (size > 1) {
        for (auto it = run; it != end; ++it) twins_[static_cast<std::size_t>(it->h)] = kNonManifold;
        manifold_ = false;
      }
      run = end;
    }
  }

  outgoing_.assign(vertices, kNone);
  nonmanifold_.assign(vertices, false);
  for (Index h = 0; h < count(); ++h) {
    if (!counts(h)) continue;
    Index& out = outgoing_[static_cast<std::size_t>(tail(h))];
    if (out == kNone || (!has_twin(h) && has_twin(out))) out = h;
  }
  // A vertex is manifold when one turn from `outgoing` meets every half-edge that leaves it.
  std::vector<Index> leaving(vertices, 0);
  for (Index h = 0; h < count(); ++h)
    if (counts(h)) ++leaving[static_cast<std::size_t>(tail(h))];
  for (std::size_t v = 0; v < vertices; ++v) {
    Index met = 0;
    for (Index h = outgoing_[v]; h >= 0 && met <= leaving[v];) {
      ++met;
      h = ccw(h);
      if (h == outgoing_[v]) break;
    }
    nonmanifold_[v] = met != leaving[v];
    if (nonmanifold_[v]) manifold_ = false;
  }
}

}  // namespace mimicry
