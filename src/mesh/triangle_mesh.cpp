#include <algorithm>
#include <cassert>
#include <limits>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/mesh/triangle_mesh.h>

#include "base/finite.h"

namespace mimicry {

TriangleMesh::TriangleMesh(std::vector<Vec3> positions, std::vector<Face> faces,
                           std::vector<Index> polygons)
    : positions_(std::move(positions)), faces_(std::move(faces)), polygons_(std::move(polygons)) {
  // Half-edges are numbered 3 f + k in an Index.
  constexpr std::size_t kMost = std::numeric_limits<Index>::max() / 3;
  if (faces_.size() > kMost || positions_.size() > kMost)
    throw Error(ErrorKind::unsupported, "mesh: more than " + std::to_string(kMost) +
                                            " vertices or faces; split or simplify it");
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (const Index v : faces_[f])
      if (v < 0 || v >= vertex_count())
        throw Error(ErrorKind::invalid_input,
                    "mesh: face " + std::to_string(f) + " refers to vertex " + std::to_string(v) +
                        ", but there are " + std::to_string(positions_.size()) + " vertices");
  if (!polygons_.empty() && polygons_.size() != faces_.size())
    throw Error(ErrorKind::invalid_input, "mesh: " + std::to_string(polygons_.size()) +
                                              " polygon numbers for " +
                                              std::to_string(faces_.size()) + " faces");
  // Kept for long: without the room that arrays grow by.
  positions_.shrink_to_fit();
  faces_.shrink_to_fit();
  polygons_.shrink_to_fit();
}

void TriangleMesh::set_attributes(std::shared_ptr<const MeshAttributes> attributes) {
  if (attributes && attributes->empty()) attributes.reset();
  if (attributes) attributes->require_fit(face_count());
  attributes_ = std::move(attributes);
}

TriangleMesh TriangleMesh::with_positions(std::vector<Vec3> positions) const {
  TriangleMesh other = *this;
  other.set_positions(positions);
  return other;
}

void TriangleMesh::set_positions(std::span<const Vec3> positions) {
  if (positions.size() != positions_.size())
    throw Error(ErrorKind::invalid_input, "mesh: " + std::to_string(positions.size()) +
                                              " new positions for " +
                                              std::to_string(positions_.size()) + " vertices");
  std::copy(positions.begin(), positions.end(), positions_.begin());
}

Eigen::AlignedBox3d bounding_box(const TriangleMesh& mesh) {
  std::vector<bool> used(at(mesh.vertex_count()), false);
  for (const Face& f : mesh.faces()) {
    const Vec3 &a = mesh.position(f[0]), &b = mesh.position(f[1]), &c = mesh.position(f[2]);
    if (a == b || b == c || c == a) continue;  // no part of any surface
    for (const Index v : f) used[at(v)] = true;
  }
  Eigen::AlignedBox3d box;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (used[at(v)] && is_finite(mesh.position(v))) box.extend(mesh.position(v));
  return box;
}

double diagonal(const TriangleMesh& mesh) {
  const Eigen::AlignedBox3d box = bounding_box(mesh);
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

}  // namespace mimicry
