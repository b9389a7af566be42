#include "io/curve_tubes.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

std::vector<std::vector<double>> polyline_radii(const CurveRecord& record,
                                                const TriangleMesh& mesh) {
  const ProjectedCurve& curve = record.curve;
  if (record.radii.size() != curve.points.size())
    throw Error(ErrorKind::invalid_input, "curve of stroke '" + record.stroke +
                                              "': " + std::to_string(record.radii.size()) +
                                              " radii for " + std::to_string(curve.points.size()) +
                                              " points; give one for each");
  std::vector<std::vector<double>> parts;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (i == 0 || curve.pieces[i - 1].kind == PieceKind::gap) {
      parts.emplace_back();
    } else {
      // Linear in arc length between the piece's two points.
      Vec3 at = curve.points[i - 1].position;
      double way = 0.0;
      const double length = curve.pieces[i - 1].length;
      for (const Crossing& c : curve.piece_crossings(i - 1)) {
        const Vec3 next = position(mesh, c);
        way += (next - at).norm();
        at = next;
        const double t = length > 0.0 ? std::min(1.0, way / length) : 1.0;
        parts.back().push_back((1.0 - t) * record.radii[i - 1] + t * record.radii[i]);
      }
    }
    parts.back().push_back(record.radii[i]);
  }
  return parts;
}

std::vector<Vec3> normals_for_lifts(const CurveSet& set, const TriangleMesh& mesh) {
  const bool any = std::any_of(set.curves.begin(), set.curves.end(),
                               [](const CurveRecord& record) { return record.lift != 0.0; });
  return any ? angle_weighted_normals(mesh) : std::vector<Vec3>{};
}

namespace {

// As `polylines`, each vertex raised.
std::vector<std::vector<Vec3>> raised_polylines(const CurveRecord& record, const TriangleMesh& mesh,
                                                std::span<const Vec3> normals) {
  const ProjectedCurve& curve = record.curve;
  std::vector<std::vector<Vec3>> parts;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (i == 0 || curve.pieces[i - 1].kind == PieceKind::gap)
      parts.emplace_back();
    else
      for (const Crossing& c : curve.piece_crossings(i - 1))
        parts.back().push_back(position(mesh, c) +
                               record.lift * interpolated_normal(mesh, normals, surface_point(c)));
    parts.back().push_back(curve.points[i].position + record.lift * curve.points[i].normal);
  }
  return parts;
}

}  // namespace

TubeMesh curve_tubes(const CurveRecord& record, const TriangleMesh& mesh, double radius,
                     std::span<const Vec3> normals) {
  const bool is_raised = record.lift != 0.0 && !normals.empty();
  const auto lines =
      is_raised ? raised_polylines(record, mesh, normals) : polylines(record.curve, mesh);
  std::vector<std::vector<double>> radii;
  if (!record.radii.empty()) radii = polyline_radii(record, mesh);
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  TubeMesh all;
  for (std::size_t part = 0; part < lines.size(); ++part) {
    TubeOptions options{.radius = radius};
    if (!radii.empty()) options.radii = radii[part];
    options.closed = record.curve.closed && lines.size() == 1;
    const TubeMesh tube = tube_mesh(lines[part], options);
    if (positions.size() + tube.normals.size() > std::numeric_limits<Index>::max() / 6)
      throw Error(ErrorKind::unsupported,
                  "curve of stroke '" + record.stroke + "': too long for tubes; write lines");
    const auto first = static_cast<Index>(positions.size());
    positions.insert(positions.end(), tube.mesh.positions().begin(), tube.mesh.positions().end());
    all.normals.insert(all.normals.end(), tube.normals.begin(), tube.normals.end());
    for (const Face& f : tube.mesh.faces())
      faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  }
  all.mesh = TriangleMesh(std::move(positions), std::move(faces));
  return all;
}

}  // namespace mimicry
