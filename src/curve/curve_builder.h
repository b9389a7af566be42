#pragma once

#include <cstddef>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

/// What joins two points of a curve; of two that no path joins, a chord.
PieceKind kind_of(PathLabel label);

/// Appends points to a curve as they are drawn, and joins each to the one before by the shortest
/// path on the surface (geodesic/paths.h). What has been appended never changes.
class CurveBuilder {
 public:
  explicit CurveBuilder(const Surface& surface);

  /// Forgets the curve and keeps its memory.
  void clear();
  /// Room for this many points, and for 16 crossings a point: up to there `append` does not
  /// allocate.
  void reserve(std::size_t points);

  /// The next point appended is not joined to the last one.
  void break_here() { broken_ = true; }
  void append(const CurvePoint& point);

  const ProjectedCurve& curve() const { return curve_; }

 private:
  Piece join(const CurvePoint& from, const CurvePoint& to);

  LocalPathFinder paths_;
  ProjectedCurve curve_;
  bool broken_ = false;
};

}  // namespace mimicry
