#include <memory>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/segment/segment.h>

#include "segment/parts.h"

namespace mimicry {
namespace {

// Values that the faces use, numbered anew in the order of their first use.
template <std::size_t N>
CornerValues<N> chosen_values(const CornerValues<N>& old, const std::vector<Index>& faces) {
  CornerValues<N> chosen;
  if (old.empty()) return chosen;
  std::vector<Index> number(old.values.size(), kNone);
  for (const Index f : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index value = old.corners[3 * at(f) + k];
      if (value != kNone && number[at(value)] == kNone) {
        number[at(value)] = static_cast<Index>(chosen.values.size());
        chosen.values.push_back(old.values[at(value)]);
      }
      chosen.corners.push_back(value == kNone ? kNone : number[at(value)]);
    }
  return chosen;
}

FaceLabels chosen_labels(const FaceLabels& old, const std::vector<Index>& faces) {
  FaceLabels chosen;
  if (old.empty()) return chosen;
  chosen.names = old.names;
  for (const Index f : faces) chosen.of_face.push_back(old.of_face[at(f)]);
  return chosen;
}

}  // namespace

TriangleMesh part_mesh(const Segmentation& cut, Index label, bool cut_open) {
  if (label != kNone && (label < 0 || at(label) >= cut.parts.size()))
    throw Error(ErrorKind::invalid_input, "part " + std::to_string(label) +
                                              ": there are parts 0 to " +
                                              std::to_string(cut.parts.size() - 1));
  const TriangleMesh& mesh = cut.surface.mesh();
  const HalfEdges& edges = cut.surface.half_edges();
  std::vector<bool> blocked(at(edges.count()), false);
  for (Index h = 0; h < edges.count(); ++h) {
    if (!cut.seam_edges[at(h)] || !edges.has_twin(h)) continue;
    const Index other = HalfEdges::face(edges.twin(h));
    blocked[at(h)] =
        cut_open || (label != kNone && cut.labels[at(HalfEdges::face(h))] != cut.labels[at(other)]);
  }
  const std::vector<Index> fans = fan_numbers(edges, blocked);
  std::vector<Index> number(fans.size(), kNone);
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  std::vector<Index> kept, polygons;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (label != kNone && cut.labels[at(f)] != label) continue;
    Face face{};
    for (std::size_t k = 0; k < 3; ++k) {
      Index& v = number[at(fans[3 * at(f) + k])];
      if (v == kNone) {
        v = static_cast<Index>(positions.size());
        positions.push_back(mesh.corner(f, static_cast<int>(k)));
      }
      face[k] = v;
    }
    faces.push_back(face);
    kept.push_back(f);
    if (mesh.has_polygons()) polygons.push_back(mesh.polygon(f));
  }
  TriangleMesh part(std::move(positions), std::move(faces), std::move(polygons));
  if (const auto& old = mesh.attributes()) {
    auto chosen = std::make_shared<MeshAttributes>();
    chosen->texcoords = chosen_values(old->texcoords, kept);
    chosen->colors = chosen_values(old->colors, kept);
    chosen->groups = chosen_labels(old->groups, kept);
    chosen->materials = chosen_labels(old->materials, kept);
    chosen->objects = chosen_labels(old->objects, kept);
    part.set_attributes(std::move(chosen));
  }
  part.mark_connected();  // what is cut apart stays so
  return part;
}

double signed_volume(const TriangleMesh& mesh) {
  if (mesh.face_count() == 0) return 0.0;
  const Vec3& origin = mesh.corner(0, 0);  // near it: far from the world's nothing would be left
  double six = 0.0;
  for (Index f = 0; f < mesh.face_count(); ++f)
    six += (mesh.corner(f, 0) - origin)
               .dot((mesh.corner(f, 1) - origin).cross(mesh.corner(f, 2) - origin));
  return six / 6.0;
}

}  // namespace mimicry
