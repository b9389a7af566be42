#include <mimicry/curve/curve_builder.h>
#include <mimicry/geodesic/plane_section.h>

namespace mimicry::curve {

CurveBuilder::CurveBuilder(const TriangleMesh& mesh, const HalfEdges& half_edges)
    : mesh_(&mesh), half_edges_(&half_edges) {}

void CurveBuilder::clear() {
  curve_.points.clear();
  curve_.pieces.clear();
  curve_.crossings.clear();
  broken_ = false;
}

void CurveBuilder::reserve(std::size_t points) {
  curve_.points.reserve(points);
  curve_.pieces.reserve(points);
  curve_.crossings.reserve(4 * points);
}

void CurveBuilder::append(const CurvePoint& point) {
  if (!curve_.points.empty()) {
    if (broken_)
      curve_.pieces.push_back(
          {PieceKind::gap, 0.0, static_cast<std::uint32_t>(curve_.crossings.size()), 0});
    else
      curve_.pieces.push_back(join(curve_.points.back(), point));
  }
  curve_.points.push_back(point);
  broken_ = false;
}

Piece CurveBuilder::join(const CurvePoint& from, const CurvePoint& to) {
  Piece piece;
  piece.first_crossing = static_cast<std::uint32_t>(curve_.crossings.size());
  const geodesic::PlaneSection section = geodesic::trace_plane_section(
      *mesh_, *half_edges_, from.surface, to.surface, from.normal + to.normal, curve_.crossings);
  piece.kind = section.found ? PieceKind::section : PieceKind::chord;
  piece.length = section.found ? section.length : (to.position - from.position).norm();
  piece.crossing_count = static_cast<std::uint32_t>(curve_.crossings.size()) - piece.first_crossing;
  return piece;
}

}  // namespace mimicry::curve
