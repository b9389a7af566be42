#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <mimicry/mesh/half_edges.h>

#include "geodesic/site.h"

namespace mimicry {

/// The exact search of `LocalPathFinder`: windows in the order of a lower bound of the whole path.
class PathSearch {
 public:
  enum class Outcome { shortest, gave_up, unreachable };

  PathSearch(const TriangleMesh& mesh, const HalfEdges& half_edges);

  Outcome run(const SurfacePoint& from, const SurfacePoint& to, std::size_t most_windows);
  /// Of the best path found; kInfinity without one.
  double length() const { return best_; }
  std::size_t windows() const { return nodes_.size(); }
  /// Appends the best path's crossings.
  void append_crossings(std::vector<Crossing>& crossings);

 private:
  /// A window, or a vertex as the end of a path. Coordinates are in the frame of `entered`: its
  /// tail at (0, 0), its head at (length, 0), its face above, the source at (x, -y).
  struct Node {
    double begin, end, x, y, length;
    double sigma;   ///< distance of the source; of the vertex
    Index entered;  ///< a vertex: a half-edge that leaves it
    Index parent;   ///< node, kNone at the first point
    Index vertex;   ///< kNone for a window
  };
  struct Entry {
    double key;
    Index node;
    bool operator<(const Entry& other) const {
      return key != other.key ? key > other.key : node > other.node;
    }
  };

  bool holds_target(Index face) const;
  double vertex_distance(Index v) const {
    return stamps_[static_cast<std::size_t>(v)] == stamp_ ? distances_[static_cast<std::size_t>(v)]
                                                          : kInfinity;
  }
  /// A point in the frame of h, unfolded to above the edge whatever face it is in.
  Vec2 in_frame(Index h, double length, const Vec3& p) const;
  void push(double key, Index node);
  void start(const SurfacePoint& from);
  void reach(Index v, double distance, Index leaving, Index parent);
  void leave_vertex(Index node);
  void expand(Index node);
  /// The window [begin, end] of half-edge h with its source on h's side, in the frame of h.
  void add_window(Index h, double length, double begin, double end, double x, double y,
                  double sigma, Index parent);

  const TriangleMesh& mesh_;
  const HalfEdges& half_edges_;
  std::vector<Node> nodes_;
  std::vector<Entry> heap_;
  std::vector<double> distances_;      // #V, valid where stamped
  std::vector<std::uint32_t> stamps_;  // #V
  std::uint32_t stamp_ = 0;
  Site target_site_;
  Vec3 target_ = Vec3::Zero();
  Index target_faces_[2] = {kNone, kNone};
  double best_ = kInfinity;
  Index best_node_ = kNone;
};

}  // namespace mimicry
