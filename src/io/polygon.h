#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// Whether the triangles (0, k, k + 1) of a polygon cover it once, seen along its normal (Newell's:
/// the sum of their area vectors), and none is flat. True of convex polygons without three corners
/// on a line; also where there is nothing to tell it by: no area, or corners that are not finite.
/// O(corners).
bool fan_covers(std::span<const Index> corners, std::span<const Vec3> positions);

/// Cuts a polygon into triangles by its ears (Meisters 1975), seen along its normal. The ear of the
/// best shape is cut first, and flat ones only where nothing else is left, so that three corners
/// on a line do no harm. Polygons that touch themselves (a hole that is joined to the outline by a
/// doubled edge) are cut as what they enclose. Keeps its memory from polygon to polygon.
class EarCutter {
 public:
  /// corners: four or more, with a normal (`fan_covers` is false). Fills `triangles` with two fewer
  /// than corners, turned as the polygon. False where the polygon crosses itself: then some
  /// triangles overlap. O(n sqrt n), n corners, whatever their places: corners in a triangle are
  /// looked for in a k-d tree, and no longer looked for after 2,000 steps a corner, which only
  /// polygons take that touch themselves in one place again and again.
  bool cut(std::span<const Index> corners, std::span<const Vec3> positions,
           std::vector<Face>& triangles);

 private:
  using Point = Eigen::Vector2d;
  // What an ear must be. Ears of a polygon that does not touch or cross itself are all `proper`.
  enum class Rule { proper, nothing_inside, convex, any };
  struct Node {
    Eigen::AlignedBox2d box;
    std::int32_t first, end;  // of order_
    std::int32_t parent, left, right;
    std::int32_t blockers;
  };
  struct Candidate {
    double quality;
    std::int32_t corner;
    std::uint32_t version;
    bool operator<(const Candidate& other) const {
      return quality != other.quality ? quality < other.quality : corner > other.corner;
    }
  };

  void project(std::span<const Index> corners, std::span<const Vec3> positions);
  std::int32_t build(std::int32_t first, std::int32_t end, std::int32_t parent);
  void stop_blocking(std::int32_t corner);
  bool turns_once() const;
  int turn(std::int32_t corner) const;
  void offer(std::int32_t corner);
  bool is_ear(std::int32_t corner);
  bool blocks(std::int32_t other, const std::int32_t (&triangle)[3]) const;
  bool enters(std::int32_t other, const std::int32_t (&triangle)[3]) const;

  std::vector<Point> points_;
  std::vector<std::int32_t> previous_, next_;  // along what is left of the polygon
  std::vector<std::uint32_t> version_;         // raised when a corner's neighbours change
  std::vector<std::int32_t> order_, leaf_;     // corners as the tree has them; leaf of a corner
  std::vector<bool> blocks_;                   // is left, and not convex
  std::vector<Node> nodes_;
  std::vector<Candidate> heap_;
  Rule rule_ = Rule::proper;
  std::int64_t steps_left_ = 0;
};

}  // namespace mimicry
