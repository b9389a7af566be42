#include "bake/recovery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace mimicry {
namespace {

// Pieces are not cut below this part of the diagonal.
constexpr double kShortest = 2e-5;
// Piercings this near to a side of the face (barycentric) are put on the side.
constexpr double kOnSide = 1e-4;
// Of the distance of a vertex from the surface, this much is taken for clear: an edge may go
// straight through, its ends' distances adding up to its length.
constexpr double kSure = 0.99;
constexpr std::size_t kNone64 = static_cast<std::size_t>(-1);

std::uint64_t ends_key(Index u, Index v) {
  const auto [low, high] = std::minmax(u, v);
  return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high);
}

constexpr std::array<std::array<std::size_t, 2>, 6> kEdges = {
    {{0, 1}, {2, 3}, {0, 2}, {1, 3}, {0, 3}, {1, 2}}};

}  // namespace

Recovery::Recovery(const UnitSurface& surface, Delaunay& delaunay, std::vector<Vec3>& positions,
                   std::vector<double>& distances, double half_side, Executor& executor)
    : surface_(surface),
      mesh_(surface.mesh()),
      delaunay_(delaunay),
      positions_(positions),
      distances_(distances),
      half_side_(half_side),
      executor_(executor),
      free_end_(delaunay.vertex_count()),
      crossing_(at(mesh_.face_count()), false) {
  find_segments();
  first_face_.assign(at(mesh_.vertex_count()) + 1, 0);
  for (const Face& f : mesh_.faces())
    for (const Index v : f) ++first_face_[at(v) + 1];
  for (std::size_t v = 0; v < at(mesh_.vertex_count()); ++v) first_face_[v + 1] += first_face_[v];
  faces_at_.resize(at(mesh_.face_count()) * 3);
  std::vector<Index> fill(first_face_.begin(), first_face_.end() - 1);
  for (Index f = 0; f < mesh_.face_count(); ++f)
    for (const Index v : mesh_.face(f)) faces_at_[at(fill[at(v)]++)] = f;
}

void Recovery::find_segments() {
  std::vector<std::uint64_t> keys;
  keys.reserve(at(mesh_.face_count()) * 3);
  for (const Face& f : mesh_.faces())
    for (std::size_t k = 0; k < 3; ++k) keys.push_back(ends_key(f[k], f[(k + 1) % 3]));
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for (const std::uint64_t key : keys) {
    const auto a = static_cast<Index>(key >> 32);
    const auto b = static_cast<Index>(key & 0xffffffffU);
    segments_.push_back({a, b, a, b, 0.0, 1.0, kNone});
  }
}

std::vector<Recovery::Cut> Recovery::missing() {
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    Segment& s = segments_[i];
    if (s.witness != kNone && delaunay_.cell(s.witness).has(s.u) &&
        delaunay_.cell(s.witness).has(s.v))
      continue;
    s.witness = delaunay_.find_edge(s.u, s.v);
    if (s.witness == kNone) cuts.push_back({i, 0.5 * (s.from + s.to)});
  }
  return cuts;
}

// Whether v is a corner of the face or was added on it or its sides.
bool Recovery::lies_on(Index v, Index face) const {
  const Face& f = mesh_.face(face);
  const auto is_corner = [&f](Index x) { return x == f[0] || x == f[1] || x == f[2]; };
  if (v < mesh_.vertex_count()) return is_corner(v);
  if (v < free_end_) return false;
  for (const Index c : ties_[at(v - free_end_)].corners)
    if (c != kNone && !is_corner(c)) return false;
  return true;
}

// The edge u v lies in a face of the surface.
bool Recovery::share_a_face(Index u, Index v) const {
  const auto corner_of = [this](Index x) {
    return x < mesh_.vertex_count() ? x
           : x >= free_end_         ? ties_[at(x - free_end_)].corners[0]
                                    : kNone;
  };
  const auto faces_around = [this](Index x) { return first_face_[at(x) + 1] - first_face_[at(x)]; };
  Index corner = corner_of(u);
  const Index other = corner_of(v);
  if (corner == kNone || other == kNone) return false;
  if (faces_around(other) < faces_around(corner)) corner = other;
  for (auto k = at(first_face_[at(corner)]); k < at(first_face_[at(corner) + 1]); ++k)
    if (lies_on(u, faces_at_[k]) && lies_on(v, faces_at_[k])) return true;
  return false;
}

void Recovery::sort_segments() {
  by_ends_.clear();
  for (std::size_t s = 0; s < segments_.size(); ++s)
    by_ends_.emplace_back(ends_key(segments_[s].u, segments_[s].v), s);
  std::sort(by_ends_.begin(), by_ends_.end());
}

std::size_t Recovery::segment_of(Index u, Index v) const {
  const auto it =
      std::lower_bound(by_ends_.begin(), by_ends_.end(), std::pair{ends_key(u, v), std::size_t{0}});
  return it != by_ends_.end() && it->first == ends_key(u, v) ? it->second : kNone64;
}

// Edges of new tetrahedra that cross faces of the surface: the points to add there.
bool Recovery::find_piercings(std::vector<Piercing>& piercings, std::vector<Cut>& cuts) {
  std::vector<std::uint64_t> edges;
  for (Index c = 0; c < delaunay_.cell_count(); ++c) {
    if (!delaunay_.is_tet(c) || delaunay_.made_in(c) <= checked_) continue;
    const auto& v = delaunay_.cell(c).v;
    for (const auto& [i, j] : kEdges) {
      // No surface stands nearer to the ends than they are from it.
      const double clear = kSure * (distances_[at(v[i])] + distances_[at(v[j])]);
      if (clear * clear < (positions_[at(v[i])] - positions_[at(v[j])]).squaredNorm())
        edges.push_back(ends_key(v[i], v[j]));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  struct Found {
    std::vector<Piercing> piercings;
    std::vector<Index> crossings;
  };
  constexpr std::size_t kEdgeChunk = 1024;
  std::vector<Found> found((edges.size() + kEdgeChunk - 1) / kEdgeChunk);
  executor_.for_chunks(edges.size(), kEdgeChunk, [&](std::size_t begin, std::size_t end, int) {
    Found& mine = found[begin / kEdgeChunk];
    for (std::size_t e = begin; e < end; ++e) {
      const auto u = static_cast<Index>(edges[e] >> 32);
      const auto v = static_cast<Index>(edges[e] & 0xffffffffU);
      const Vec3& p = positions_[at(u)];
      const Vec3& q = positions_[at(v)];
      const double length = (q - p).norm();
      if (!(length > 0.0)) continue;
      const Vec3 from = p + (q - p) * (kSure * distances_[at(u)] / length);
      const Vec3 to = q + (p - q) * (kSure * distances_[at(v)] / length);
      const bool in_surface = share_a_face(u, v);
      surface_.crossings(from, to, [&](Index face, double, const Vec3& bary) {
        if (lies_on(u, face) || lies_on(v, face)) return;
        if (in_surface)
          mine.crossings.push_back(face);
        else
          mine.piercings.push_back({face, bary.cwiseMax(0.0), length});
      });
    }
  });
  std::vector<Piercing> all;
  for (const Found& f : found) {
    all.insert(all.end(), f.piercings.begin(), f.piercings.end());
    for (const Index face : f.crossings) crossing_[at(face)] = true;
  }
  // By face; of piercings close to each other the first is enough.
  std::stable_sort(all.begin(), all.end(),
                   [](const Piercing& a, const Piercing& b) { return a.face < b.face; });
  pierced_faces_ = 0;
  for (std::size_t k = 0, first = 0; k < all.size(); ++k) {
    if (k == 0 || all[k].face != all[k - 1].face) {
      first = piercings.size();
      ++pierced_faces_;
    }
    const Index f = all[k].face;
    const Vec3 place = mesh_.position(SurfacePoint{f, all[k].bary});
    bool apart = true;
    for (std::size_t other = first; other < piercings.size() && apart; ++other) {
      const Vec3 there = mesh_.position(SurfacePoint{f, piercings[other].bary});
      constexpr double kApart = 0.5;
      apart = (place - there).norm() > kApart * all[k].spacing;
    }
    if (!apart) {
      left_out_ = true;
      continue;
    }
    int least = 0;
    const double smallest = all[k].bary.minCoeff(&least);
    if (smallest > kOnSide) {
      piercings.push_back(all[k]);
      continue;
    }
    // On a side: where its pieces say.
    const Index a = mesh_.face(f)[at((least + 1) % 3)];
    const Index b = mesh_.face(f)[at((least + 2) % 3)];
    const double weight = all[k].bary[(least + 2) % 3] /
                          (all[k].bary[(least + 1) % 3] + all[k].bary[(least + 2) % 3]);
    const double parameter = a < b ? weight : 1.0 - weight;
    const auto [low, high] = std::minmax(a, b);
    const auto it = std::upper_bound(
        segments_.begin(), segments_.end(), Segment{kNone, kNone, low, high, parameter, 0.0, kNone},
        [](const Segment& x, const Segment& y) {
          return std::tie(x.a, x.b, x.from) < std::tie(y.a, y.b, y.from);
        });
    if (it == segments_.begin()) continue;
    const Segment& s = *(it - 1);
    if (s.a == low && s.b == high && parameter > s.from && parameter < s.to)
      cuts.push_back({static_cast<std::size_t>(it - 1 - segments_.begin()), parameter});
  }
  return !all.empty();
}

// Where the surface is flat, four of its vertices may span a tetrahedron without thickness, whose
// upper side has an edge of the surface as diagonal and its lower side another edge: the diagonals'
// crossing is added to the edge.
void Recovery::find_flat_crossings(std::vector<Cut>& cuts) {
  for (Index c = 0; c < delaunay_.cell_count(); ++c) {
    if (!delaunay_.is_tet(c) || delaunay_.made_in(c) <= checked_) continue;
    const auto& v = delaunay_.cell(c).v;
    if (std::any_of(v.begin(), v.end(), [this](Index x) { return distances_[at(x)] > 0.0; }))
      continue;
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = positions_[at(v[k])];
    double longest = 0.0;
    for (const auto& [i, j] : kEdges) longest = std::max(longest, (p[i] - p[j]).norm());
    const double volume = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
    // Grid steps against the size of the tetrahedron.
    const double step = 2.0 * half_side_ / (1 << kGridBits);
    if (volume > 20.0 * step * longest * longest) continue;
    for (std::size_t e = 0; e < 6; e += 2) {
      const auto [i, j] = kEdges[e];
      const auto [k, l] = kEdges[e + 1];
      const Vec3 x = p[j] - p[i], y = p[l] - p[k], w = p[k] - p[i];
      const Vec3 normal = x.cross(y);
      const double area2 = normal.squaredNorm();
      if (!(area2 > 1e-12 * x.squaredNorm() * y.squaredNorm())) continue;
      const double s = w.cross(y).dot(normal) / area2;
      const double t = w.cross(x).dot(normal) / area2;
      constexpr double kEnd = 1e-3;
      if (!(s > kEnd && s < 1.0 - kEnd && t > kEnd && t < 1.0 - kEnd)) continue;
      const std::size_t first = segment_of(v[i], v[j]), second = segment_of(v[k], v[l]);
      const auto cut = [&](std::size_t segment, Index start, double along) {
        const Segment& piece = segments_[segment];
        const double part = piece.u == start ? along : 1.0 - along;
        cuts.push_back({segment, piece.from + part * (piece.to - piece.from)});
      };
      if (first != kNone64 && second == kNone64 && !share_a_face(v[k], v[l])) cut(first, v[i], s);
      if (second != kNone64 && first == kNone64 && !share_a_face(v[i], v[j])) cut(second, v[k], t);
    }
  }
}

bool Recovery::add(const std::vector<Cut>& cuts, const std::vector<Piercing>& piercings) {
  std::vector<GridPoint> grid;
  std::vector<std::size_t> whose;  // segment of the first points
  std::vector<double> parameters;
  std::size_t last = kNone64;
  std::vector<Cut> ordered = cuts;
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Cut& x, const Cut& y) { return x.segment < y.segment; });
  const auto place = [this](const Segment& s, double t) -> Vec3 {
    return (1.0 - t) * mesh_.position(s.a) + t * mesh_.position(s.b);
  };
  for (const Cut& cut : ordered) {
    if (cut.segment == last) {  // one cut a round
      left_out_ = true;
      continue;
    }
    const Segment& s = segments_[cut.segment];
    const Vec3 p = place(s, cut.parameter);
    if ((p - place(s, s.from)).norm() < kShortest || (p - place(s, s.to)).norm() < kShortest) {
      hit_shortest_ = true;
      continue;
    }
    last = cut.segment;
    whose.push_back(cut.segment);
    parameters.push_back(cut.parameter);
    grid.push_back(to_grid(p, half_side_));
    positions_.push_back(p);
    const Vec3 weights(1.0 - cut.parameter, cut.parameter, 0.0);
    ties_.push_back({delaunay_.vertex_count() + static_cast<Index>(grid.size()) - 1,
                     {s.a, s.b, kNone},
                     weights});
  }
  for (const Piercing& piercing : piercings) {
    const Vec3 bary = piercing.bary / piercing.bary.sum();
    const Vec3 p = mesh_.position(SurfacePoint{piercing.face, bary});
    grid.push_back(to_grid(p, half_side_));
    positions_.push_back(p);
    ties_.push_back({delaunay_.vertex_count() + static_cast<Index>(grid.size()) - 1,
                     mesh_.face(piercing.face), bary});
  }
  distances_.resize(positions_.size(), 0.0);
  if (grid.empty()) return false;
  const Index first = delaunay_.vertex_count();
  const std::vector<Index> numbers = delaunay_.insert(grid);
  bool added = false;
  for (std::size_t k = 0; k < grid.size(); ++k)
    added = added || numbers[k] == first + static_cast<Index>(k);
  for (std::size_t k = 0; k < whose.size(); ++k) {
    // A place that is taken (surfaces that touch, say) cannot be added again.
    if (numbers[k] != first + static_cast<Index>(k)) {
      hit_shortest_ = true;
      continue;
    }
    Segment& s = segments_[whose[k]];
    Segment rest = s;
    s.to = rest.from = parameters[k];
    s.v = rest.u = numbers[k];
    segments_.push_back(rest);
  }
  std::sort(segments_.begin(), segments_.end(), [](const Segment& x, const Segment& y) {
    return std::tie(x.a, x.b, x.from) < std::tie(y.a, y.b, y.from);
  });
  return added;
}

bool Recovery::round() {
  std::vector<Cut> cuts = missing();
  missing_edges_ = static_cast<Index>(cuts.size());
  std::vector<Piercing> piercings;
  if (!cuts.empty() && !hit_shortest_) return add(cuts, piercings);
  sort_segments();
  left_out_ = false;
  find_piercings(piercings, cuts);
  find_flat_crossings(cuts);
  const std::uint32_t checked = delaunay_.batch();
  const bool added = add(cuts, piercings);
  // What was left out may outlive this round: those tetrahedra are looked at again.
  if (!left_out_) checked_ = checked;
  return added;
}

void Recovery::count(double most_edges) {
  missing_edges_ = static_cast<Index>(missing().size());
  if (missing_edges_ > most_edges) return;
  std::vector<Piercing> piercings;
  std::vector<Cut> cuts;
  checked_ = 0;
  sort_segments();
  find_piercings(piercings, cuts);
  cuts.clear();
  find_flat_crossings(cuts);
  missing_edges_ += static_cast<Index>(cuts.size());
  crossing_faces_ = static_cast<Index>(std::count(crossing_.begin(), crossing_.end(), true));
}

}  // namespace mimicry
