#include "curve/curve_builder.h"

namespace mimicry {

PieceKind kind_of(PathLabel label) {
  switch (label) {
    case PathLabel::same_face:
      return PieceKind::same_face;
    case PathLabel::shortest:
      return PieceKind::shortest;
    case PathLabel::locally_shortest:
      return PieceKind::locally_shortest;
    case PathLabel::disconnected:
      return PieceKind::chord;
  }
  return PieceKind::chord;
}

CurveBuilder::CurveBuilder(const Surface& surface) : paths_(surface) {}

void CurveBuilder::clear() {
  curve_.points.clear();
  curve_.pieces.clear();
  curve_.crossings.clear();
  curve_.closed = false;
  broken_ = false;
}

void CurveBuilder::reserve(std::size_t points) {
  curve_.points.reserve(points);
  curve_.pieces.reserve(points);
  curve_.crossings.reserve(16 * points);
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
  const LocalPath path = paths_.find(from.surface, to.surface, curve_.crossings);
  piece.kind = kind_of(path.label);
  piece.length =
      piece.kind == PieceKind::chord ? (to.position - from.position).norm() : path.length;
  piece.crossing_count = static_cast<std::uint32_t>(curve_.crossings.size()) - piece.first_crossing;
  return piece;
}

}  // namespace mimicry
