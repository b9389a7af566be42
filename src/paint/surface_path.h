#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

/// A path between two points as straight segments inside faces. Its memory is kept between paths.
class SurfacePath {
 public:
  /// Steps between nodes that share no face are left out: nothing on the surface joins them.
  void set(const Surface& surface, const SurfacePoint& from, std::span<const Crossing> crossings,
           const SurfacePoint& to);
  double length() const { return segments_.empty() ? 0.0 : segments_.back().end; }
  /// The point at a length from the start; the path has one (`length` > 0).
  SurfacePoint point_at(double s) const;

 private:
  struct Segment {
    Index face;
    Vec3 from, to;  // barycentric
    double begin, end;
  };
  std::vector<Segment> segments_;
};

}  // namespace mimicry
