#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include <mimicry/base/types.h>

namespace mimicry {

/// Barycentric coordinates in a face are whole numbers of this: orientations are exact in 64 bits,
/// and the coordinates are numbers of double precision without rounding.
inline constexpr std::int64_t kCutGrid = std::int64_t{1} << 30;

/// A point of a face: its barycentric coordinates 1 and 2 on the grid.
struct CutPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;

  Vec3 bary() const {
    constexpr double kStep = 1.0 / static_cast<double>(kCutGrid);
    return {static_cast<double>(kCutGrid - x - y) * kStep, static_cast<double>(x) * kStep,
            static_cast<double>(y) * kStep};
  }
  auto operator<=>(const CutPoint&) const = default;
};

/// Twice the area of a triangle of grid points, exact: positive where it runs counter-clockwise.
constexpr std::int64_t cut_orientation(const CutPoint& a, const CutPoint& b, const CutPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// One face cut along segments: a triangulation of its points in which every segment is a chain of
/// edges. Every triangle has a positive area on the grid at all times: whatever is decided is
/// decided exactly, and where a crossing cannot be placed on the grid the segment is led through a
/// neighbour instead.
class FaceTriangulation {
 public:
  using Chain = std::vector<Index>;
  struct Triangle {
    std::array<Index, 3> v;     // counter-clockwise
    std::array<Index, 3> n;     // across the edge from v[k] to v[k + 1]; kNone
    std::array<bool, 3> fixed;  // a segment runs along that edge
  };

  /// Crossings closer than `snap` (grid steps) to the end of the segment that they are on become
  /// that end.
  explicit FaceTriangulation(std::int64_t snap);

  /// A point on the edge from corner k to the next, or inside the face (k = kNone); none may lie
  /// where another does. Its number: corners are 0, 1, 2. All points come before all segments.
  Index add_point(const CutPoint& p);
  /// A segment between two points, which do not lie on one edge of the face.
  void add_segment(Index a, Index b);
  /// The chain of points that a segment became, both ends included.
  Chain chain(Index a, Index b) const;
  /// Exchanges edges that no segment runs along where that makes angles better: `needs_flip` is
  /// asked of the corners of two triangles (a, b, c) and (b, a, d).
  void improve(const std::function<bool(Index, Index, Index, Index)>& needs_flip);

  const std::vector<CutPoint>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Places where segments cross that became points of their own.
  std::size_t crossings() const { return crossings_; }

 private:
  struct Corner {
    Index triangle;
    int k;
  };
  struct Walk {
    Index reached = kNone;  // the vertex on the way, or kNone: a fixed edge is crossed
    bool along_edge = false;
    std::vector<std::pair<Index, Index>> crossed;  // right and left ends
    Corner wall{kNone, 0};                         // the fixed edge, on this side
  };

  std::int64_t turn(Index a, Index b, Index c) const {
    return cut_orientation(points_[at(a)], points_[at(b)], points_[at(c)]);
  }
  Triangle& tri(Index t) { return triangles_[at(t)]; }
  const Triangle& tri(Index t) const { return triangles_[at(t)]; }
  Index add_triangle(Index a, Index b, Index c);
  void replace_neighbor(Index t, Index from, Index to);
  Corner edge_corner(Index a, Index b) const;
  std::vector<Corner> corners_around(Index v) const;
  Corner locate(const CutPoint& p) const;
  void split_triangle(Index t, Index p);
  void split_edge(Index t, int k, Index p);
  bool can_flip(Index t, int k) const;
  void flip(Index t, int k);
  void fix(Index a, Index b);
  Walk walk(Index a, Index b) const;
  void free_way(Index a, Index b, std::vector<std::pair<Index, Index>> crossed);
  Index split_wall(Index a, Index b, const Corner& wall);
  void lead_along_edges(Index a, Index b, Chain& chain);
  void lead(Index a, Index b, std::size_t& detours, Chain& chain);
  void expand(Index a, Index b, Chain& chain) const;

  std::int64_t snap_;
  std::vector<CutPoint> points_;
  std::vector<Triangle> triangles_;
  std::vector<Index> any_;                           // #points; a triangle that has it as a corner
  mutable Index last_ = 0;                           // where the last point was
  std::map<std::pair<Index, Index>, Chain> chains_;  // of segments, as they were made
  std::map<std::pair<Index, Index>, Index> splits_;  // fixed edges that were: the point in them
  std::size_t crossings_ = 0;
};

}  // namespace mimicry
