#include <algorithm>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/curve/edit.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/mesh/surface.h>

#include "curve/curve_builder.h"

namespace mimicry {

ProjectedCurve slice(const ProjectedCurve& curve, std::size_t first, std::size_t end) {
  if (first >= end || end > curve.points.size())
    throw Error(ErrorKind::invalid_input,
                "points " + std::to_string(first) + " to " + std::to_string(end) +
                    " cannot be cut from a curve of " + std::to_string(curve.points.size()) +
                    " points; give a range inside it");
  const auto at = [](auto& list, std::size_t i) {
    return list.begin() + static_cast<std::ptrdiff_t>(i);
  };
  ProjectedCurve part;
  part.points.assign(at(curve.points, first), at(curve.points, end));
  part.pieces.assign(at(curve.pieces, first), at(curve.pieces, end - 1));
  if (part.pieces.empty()) return part;
  const std::uint32_t from = part.pieces.front().first_crossing;
  const std::uint32_t to = part.pieces.back().first_crossing + part.pieces.back().crossing_count;
  part.crossings.assign(at(curve.crossings, from), at(curve.crossings, to));
  for (Piece& piece : part.pieces) piece.first_crossing -= from;
  return part;
}

ProjectedCurve resampled(const ProjectedCurve& curve, const Surface& surface, std::size_t count,
                         const ProgressCallback& progress) {
  const TriangleMesh& mesh = surface.mesh();
  const std::span<const Vec3> vertex_normals = surface.vertex_normals();
  if (count < 2 || count > kMostResampledPoints || curve.points.empty())
    throw Error(ErrorKind::invalid_input, "a curve of " + std::to_string(curve.points.size()) +
                                              " points cannot be resampled to " +
                                              std::to_string(count) + "; it takes 2 to " +
                                              std::to_string(kMostResampledPoints));
  const RefinedCurve refined = refine(curve, surface);
  std::vector<double> lengths;  // at each point
  for (const std::size_t node : refined.point_nodes) lengths.push_back(refined.nodes[node].length);
  const double step = refined.nodes.back().length / static_cast<double>(count - 1);

  CurveBuilder builder(surface);
  builder.reserve(count);
  std::size_t before = 0;  // the last point at or before the sample
  const std::vector<SurfacePoint> samples = resample(curve, surface, count);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i % 64 == 0) report(progress, "resample", double(i) / double(count));
    const double s = i + 1 == count ? lengths.back() : step * static_cast<double>(i);
    const std::size_t last = before;
    while (before + 1 < lengths.size() && lengths[before + 1] <= s) ++before;
    for (std::size_t k = last; i > 0 && k < before; ++k)
      if (curve.pieces[k].kind == PieceKind::gap) builder.break_here();
    const CurvePoint& a = curve.points[before];
    const CurvePoint& b = curve.points[std::min(before + 1, curve.points.size() - 1)];
    const double span = lengths[std::min(before + 1, lengths.size() - 1)] - lengths[before];
    const double t = span > 0.0 ? std::clamp((s - lengths[before]) / span, 0.0, 1.0) : 0.0;
    builder.append({samples[i], mesh.position(samples[i]),
                    interpolated_normal(mesh, vertex_normals, samples[i]), a.frame,
                    a.time_s + t * (b.time_s - a.time_s),
                    a.pen_distance + t * (b.pen_distance - a.pen_distance)});
  }
  ProjectedCurve result = builder.curve();
  result.closed = curve.closed;
  return result;
}

}  // namespace mimicry
