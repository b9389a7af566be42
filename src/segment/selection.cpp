#include <string>
#include <utility>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/segment/segment.h>

namespace mimicry {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorKind::invalid_input, "selection: " + what);
}

Index vertex_of_point(const TriangleMesh& mesh, const CurvePoint& point) {
  int k = 0;
  point.surface.bary.maxCoeff(&k);
  return mesh.face(point.surface.face)[at(k)];
}

Index part_beside(const Segmentation& cut, bool left) {
  const HalfEdges& edges = cut.surface.half_edges();
  for (const ProjectedCurve& seam : cut.seams) {
    if (seam.points.size() < 2) continue;
    Index from = vertex_of_point(cut.surface.mesh(), seam.points[0]);
    Index to = vertex_of_point(cut.surface.mesh(), seam.points[1]);
    if (!left) std::swap(from, to);  // the half-edge runs with its face to its left
    const Index first = edges.outgoing(from);
    for (Index h = first; h >= 0;) {
      if (edges.head(h) == to) return cut.labels[at(HalfEdges::face(h))];
      h = edges.ccw(h);
      if (h == first) break;
    }
    refuse(std::string("nothing lies to the ") + (left ? "left" : "right") +
           " of the curve, which begins along a boundary; choose the other side, or a face");
  }
  refuse("no curve cuts the surface; choose a face, or draw a longer curve");
}

}  // namespace

Index left_part(const Segmentation& cut) {
  return part_beside(cut, true);
}

Index right_part(const Segmentation& cut) {
  return part_beside(cut, false);
}

Index smallest_part(const Segmentation& cut) {
  Index best = 0;
  for (Index label = 1; at(label) < cut.parts.size(); ++label)
    if (cut.parts[at(label)].area < cut.parts[at(best)].area) best = label;
  return best;
}

Index part_of_face(const Segmentation& cut, Index target_face) {
  const auto faces = static_cast<Index>(cut.first_child.size()) - 1;
  if (target_face < 0 || target_face >= faces)
    refuse("there is no face " + std::to_string(target_face) + "; the mesh has faces 0 to " +
           std::to_string(faces - 1));
  std::vector<double> areas(cut.parts.size(), 0.0);
  Index best = kNone;
  for (Index c = cut.first_child[at(target_face)]; c < cut.first_child[at(target_face) + 1]; ++c) {
    const auto& b = cut.barycentrics[at(c)];
    const Vec3 u = b[1] - b[0], v = b[2] - b[0];
    const Index label = cut.labels[at(c)];
    areas[at(label)] += u[1] * v[2] - u[2] * v[1];
    if (best == kNone || areas[at(label)] > areas[at(best)]) best = label;
  }
  if (best == kNone)
    refuse("face " + std::to_string(target_face) +
           " was left out of the surface: it is collapsed, or lies on another; choose another one");
  return best;
}

}  // namespace mimicry
