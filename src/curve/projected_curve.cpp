#include <mimicry/curve/projected_curve.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

double length(const ProjectedCurve& curve) {
  double sum = 0.0;
  for (const Piece& piece : curve.pieces) sum += piece.length;
  return sum;
}

std::vector<std::vector<Vec3>> polylines(const ProjectedCurve& curve, const TriangleMesh& mesh) {
  std::vector<std::vector<Vec3>> parts;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (i == 0 || curve.pieces[i - 1].kind == PieceKind::gap)
      parts.emplace_back();
    else
      for (const Crossing& c : curve.piece_crossings(i - 1))
        parts.back().push_back(position(mesh, c));
    parts.back().push_back(curve.points[i].position);
  }
  return parts;
}

void follow(ProjectedCurve& curve, const TriangleMesh& mesh, std::span<const Vec3> vertex_normals) {
  for (CurvePoint& point : curve.points) {
    point.position = mesh.position(point.surface);
    point.normal = interpolated_normal(mesh, vertex_normals, point.surface);
  }
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    Piece& piece = curve.pieces[i];
    if (piece.kind == PieceKind::gap) continue;
    piece.length = 0.0;
    Vec3 at = curve.points[i].position;
    for (const Crossing& c : curve.piece_crossings(i)) {
      const Vec3 next = position(mesh, c);
      piece.length += (next - at).norm();
      at = next;
    }
    piece.length += (curve.points[i + 1].position - at).norm();
  }
}

}  // namespace mimicry
