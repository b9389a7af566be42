#include "bake/delaunay.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>
#include <tuple>
#include <utility>

#include "bake/morton.h"

namespace mimicry {
namespace {

// Face i of a cell, opposite vertex i, ordered so that (face, vertex i) is positive.
constexpr std::size_t kFace[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

// Random rounds, each about twice as large as the one before, along the Morton curve within each.
std::vector<Index> insertion_order(std::span<const GridPoint> points, Index first) {
  struct Key {
    int round;
    std::uint64_t place;
    Index v;
  };
  const auto count = static_cast<Index>(points.size()) - first;
  std::vector<Key> keys(static_cast<std::size_t>(count));
  const int rounds =
      std::max(1, static_cast<int>(std::bit_width(static_cast<unsigned>(count))) - 6);
  for (Index k = 0; k < count; ++k) {
    const Index v = first + k;
    const GridPoint& p = points[static_cast<std::size_t>(v)];
    const std::uint64_t random = mix_bits(static_cast<std::uint64_t>(v)) | 1u << 30;
    const int round = rounds - std::min(rounds, static_cast<int>(std::countr_zero(random)));
    constexpr int kDrop = kGridBits - 21;
    keys[static_cast<std::size_t>(k)] = {
        round,
        morton(static_cast<std::uint64_t>(p[0] >> kDrop), static_cast<std::uint64_t>(p[1] >> kDrop),
               static_cast<std::uint64_t>(p[2] >> kDrop)),
        v};
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    if (a.round != b.round) return a.round < b.round;
    return a.place != b.place ? a.place < b.place : a.v < b.v;
  });
  std::vector<Index> order(keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k) order[k] = keys[k].v;
  return order;
}

bool collinear(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  std::int64_t u[3], v[3];
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
  }
  return u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0];
}

}  // namespace

Index Delaunay::new_cell() {
  if (!free_.empty()) {
    const Index c = free_.back();
    free_.pop_back();
    return c;
  }
  cells_.emplace_back();
  made_.push_back(0);
  seen_.push_back(0);
  return cell_count() - 1;
}

// The first tetrahedron and its four ghosts.
bool Delaunay::start(std::span<const Index> order) {
  std::array<Index, 4> v;
  int found = 0;
  for (const Index candidate : order) {
    const GridPoint& p = point(candidate);
    const bool fits = found == 0 || (found == 1 && p != point(v[0])) ||
                      (found == 2 && !collinear(point(v[0]), point(v[1]), p)) ||
                      (found == 3 && orientation(point(v[0]), point(v[1]), point(v[2]), p) != 0);
    if (!fits) continue;
    v[static_cast<std::size_t>(found++)] = candidate;
    if (found == 4) break;
  }
  if (found < 4) return false;
  if (orientation(point(v[0]), point(v[1]), point(v[2]), point(v[3])) < 0) std::swap(v[2], v[3]);

  const Index c = new_cell();
  std::array<Index, 4> ghosts;
  for (Index& g : ghosts) g = new_cell();
  cells_[static_cast<std::size_t>(c)] = {v, ghosts};
  for (std::size_t i = 0; i < 4; ++i) {
    // Two corners swapped: seen from the other side. Ghost i keeps the places of its vertices but
    // for the swapped pair, and has infinity where vertex i was.
    const std::size_t a = i == 0 ? 1 : 0;
    const std::size_t b = i <= 1 ? 2 : 1;
    Cell& ghost = cells_[static_cast<std::size_t>(ghosts[i])];
    ghost.v = v;
    ghost.v[i] = kNone;
    std::swap(ghost.v[a], ghost.v[b]);
    ghost.n = ghosts;
    ghost.n[i] = c;
    std::swap(ghost.n[a], ghost.n[b]);
  }
  for (const Index x : v) incident_[static_cast<std::size_t>(x)] = c;
  last_ = c;
  return true;
}

// A tetrahedron that holds p, or a ghost whose hull face has p beyond it. The walk over Delaunay
// tetrahedra always ends.
Index Delaunay::locate(const GridPoint& p, Index from) const {
  Index c = from;
  if (!is_tet(c)) {
    const Cell& ghost = cell(c);
    c = ghost.n[static_cast<std::size_t>(std::find(ghost.v.begin(), ghost.v.end(), kNone) -
                                         ghost.v.begin())];
  }
  Index previous = kNone;
  while (is_tet(c)) {
    const Cell& x = cell(c);
    Index next = kNone;
    for (std::size_t i = 0; i < 4 && next == kNone; ++i) {
      if (x.n[i] == previous) continue;
      const auto& f = kFace[i];
      if (orientation(point(x.v[f[0]]), point(x.v[f[1]]), point(x.v[f[2]]), p) < 0) next = x.n[i];
    }
    if (next == kNone) break;
    previous = c;
    c = next;
  }
  return c;
}

bool Delaunay::in_conflict(Index c, const GridPoint& p) const {
  const Cell* x = &cell(c);
  for (std::size_t i = 0; i < 4; ++i) {
    if (x->v[i] != kNone) continue;
    const auto& f = kFace[i];
    const int side = orientation(point(x->v[f[0]]), point(x->v[f[1]]), point(x->v[f[2]]), p);
    if (side != 0) return side > 0;
    // In the plane of the hull face: its circle is where the tetrahedron's sphere cuts the plane.
    x = &cell(x->n[i]);
    break;
  }
  return in_sphere(point(x->v[0]), point(x->v[1]), point(x->v[2]), point(x->v[3]), p) > 0;
}

// Cells at the same edge of the cavity's hull are neighbours.
void Delaunay::join_rims() {
  std::sort(rims_.begin(), rims_.end(), [](const Rim& a, const Rim& b) {
    return std::tie(a.low, a.high, a.cell) < std::tie(b.low, b.high, b.cell);
  });
  for (std::size_t k = 0; k + 1 < rims_.size(); k += 2) {
    const Rim &a = rims_[k], &b = rims_[k + 1];
    cells_[static_cast<std::size_t>(a.cell)].n[static_cast<std::size_t>(a.slot)] = b.cell;
    cells_[static_cast<std::size_t>(b.cell)].n[static_cast<std::size_t>(b.slot)] = a.cell;
  }
}

Index Delaunay::insert_one(Index v) {
  const GridPoint p = point(v);
  const Index home = locate(p, last_);
  for (const Index u : cell(home).v)
    if (u >= 0 && point(u) == p) return u;

  // The cavity: all cells whose sphere holds p. It is connected and star-shaped seen from p, and as
  // cells with p exactly on their sphere stay, no new tetrahedron is flat.
  ++stamp_;
  cavity_.assign(1, home);
  facets_.clear();
  seen_[static_cast<std::size_t>(home)] = stamp_;
  for (std::size_t k = 0; k < cavity_.size(); ++k) {
    const Index c = cavity_[k];
    for (int i = 0; i < 4; ++i) {
      const Index n = cell(c).n[static_cast<std::size_t>(i)];
      if (seen_[static_cast<std::size_t>(n)] == stamp_) continue;
      if (in_conflict(n, p)) {
        seen_[static_cast<std::size_t>(n)] = stamp_;
        cavity_.push_back(n);
      } else {
        facets_.push_back({c, i});
      }
    }
  }

  // Vertices of the cavity's hull are numbered so that edges can be matched through a table. Each
  // directed edge is met once from either side: what was entered is taken out again.
  touched_.clear();
  for (const Facet& facet : facets_) {
    for (int k = 0; k < 4; ++k) {
      if (k == facet.opposite) continue;
      Index& number =
          local_[static_cast<std::size_t>(cell(facet.cell).v[static_cast<std::size_t>(k)] + 1)];
      if (number != kNone) continue;
      number = static_cast<Index>(touched_.size());
      touched_.push_back(cell(facet.cell).v[static_cast<std::size_t>(k)]);
    }
  }
  const std::size_t width = touched_.size();
  const bool is_wide = width > kWidestTable;
  if (!is_wide && table_.size() < width * width) table_.resize(width * width, kNone);
  rims_.clear();

  for (const Facet& facet : facets_) {
    const Index made = new_cell();
    const Cell old = cell(facet.cell);
    Cell fresh = old;
    const auto opposite = static_cast<std::size_t>(facet.opposite);
    fresh.v[opposite] = v;
    Cell& beyond = cells_[static_cast<std::size_t>(old.n[opposite])];
    *std::find(beyond.n.begin(), beyond.n.end(), facet.cell) = made;
    for (std::size_t j = 0; j < 3; ++j) {
      // Across the new face opposite corner f[j] runs the edge of the two other corners.
      const auto& f = kFace[opposite];
      const Index from = local_[static_cast<std::size_t>(old.v[f[(j + 1) % 3]] + 1)];
      const Index to = local_[static_cast<std::size_t>(old.v[f[(j + 2) % 3]] + 1)];
      const std::size_t slot = f[j];
      if (is_wide) {
        rims_.push_back({std::min(from, to), std::max(from, to), made, static_cast<int>(slot)});
        continue;
      }
      Index& met = table_[static_cast<std::size_t>(to) * width + static_cast<std::size_t>(from)];
      if (met != kNone) {
        const auto other = static_cast<std::size_t>(met / 4);
        fresh.n[slot] = met / 4;
        cells_[other].n[static_cast<std::size_t>(met % 4)] = made;
        met = kNone;
      } else {
        table_[static_cast<std::size_t>(from) * width + static_cast<std::size_t>(to)] =
            made * 4 + static_cast<Index>(slot);
      }
    }
    cells_[static_cast<std::size_t>(made)] = fresh;
    made_[static_cast<std::size_t>(made)] = batch_;
    for (const Index u : fresh.v)
      if (u >= 0) incident_[static_cast<std::size_t>(u)] = made;
    last_ = made;
  }
  join_rims();
  for (const Index u : touched_) local_[static_cast<std::size_t>(u + 1)] = kNone;
  for (const Index c : cavity_) {
    cells_[static_cast<std::size_t>(c)].v.fill(kFree);
    free_.push_back(c);
  }
  return v;
}

std::vector<Index> Delaunay::insert(std::span<const GridPoint> points) {
  ++batch_;
  const Index first = vertex_count();
  points_.insert(points_.end(), points.begin(), points.end());
  incident_.resize(points_.size(), kNone);
  local_.resize(points_.size() + 1, kNone);
  // All points so far lie in a plane until there is a cell: then they are inserted now.
  const Index from = cells_.empty() ? 0 : first;
  const std::vector<Index> order = insertion_order(points_, from);
  std::vector<Index> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), first);
  if (cells_.empty() && !start(order)) return numbers;
  std::vector<Index> same(points_.size() - static_cast<std::size_t>(from));
  for (const Index v : order) {
    Index& s = same[static_cast<std::size_t>(v - from)];
    s = incident_[static_cast<std::size_t>(v)] != kNone ? v : insert_one(v);
  }
  for (std::size_t k = 0; k < numbers.size(); ++k)
    numbers[k] = same[static_cast<std::size_t>(numbers[k] - from)];
  return numbers;
}

// The first cell around v that is accepted.
template <class Accept>
Index Delaunay::find_in_star(Index v, Accept&& accept) const {
  const Index first = incident_[static_cast<std::size_t>(v)];
  if (first == kNone) return kNone;
  ++stamp_;
  stack_.assign(1, first);
  seen_[static_cast<std::size_t>(first)] = stamp_;
  while (!stack_.empty()) {
    const Index c = stack_.back();
    stack_.pop_back();
    const Cell& x = cell(c);
    if (accept(x)) return c;
    for (std::size_t i = 0; i < 4; ++i) {
      if (x.v[i] == v) continue;
      const Index n = x.n[i];
      if (seen_[static_cast<std::size_t>(n)] == stamp_) continue;
      seen_[static_cast<std::size_t>(n)] = stamp_;
      stack_.push_back(n);
    }
  }
  return kNone;
}

// The stars of both ends are searched in step, so that the smaller one decides: a hub of many
// thousand edges is not gone round for each of them.
Index Delaunay::find_edge(Index u, Index v) const {
  struct Star {
    Index centre, other;
    std::vector<Index>& stack;
    std::uint32_t stamp;
  };
  Star stars[2] = {{u, v, stack_, ++stamp_}, {v, u, other_stack_, ++stamp_}};
  const auto push = [this](Star& star, Index c) {
    if (seen_[static_cast<std::size_t>(c)] == star.stamp) return;
    seen_[static_cast<std::size_t>(c)] = star.stamp;
    star.stack.push_back(c);
  };
  for (Star& star : stars) {
    star.stack.clear();
    const Index first = incident_[static_cast<std::size_t>(star.centre)];
    if (first == kNone) return kNone;
    push(star, first);
  }
  for (std::size_t turn = 0;; turn = 1 - turn) {
    Star& star = stars[turn];
    if (star.stack.empty()) return kNone;
    const Index c = star.stack.back();
    star.stack.pop_back();
    const Cell& x = cell(c);
    if (x.has(star.other)) return c;
    for (std::size_t i = 0; i < 4; ++i)
      if (x.v[i] != star.centre) push(star, x.n[i]);
  }
}

bool Delaunay::has_face(Index a, Index b, Index c) const {
  return find_in_star(a, [b, c](const Cell& x) { return x.has(b) && x.has(c); }) != kNone;
}

std::vector<Tet> Delaunay::tets() const {
  std::vector<Tet> out;
  for (Index c = 0; c < cell_count(); ++c)
    if (is_tet(c)) out.push_back(cell(c).v);
  return out;
}

}  // namespace mimicry
