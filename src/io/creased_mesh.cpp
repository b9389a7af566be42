#include "io/creased_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <mimicry/mesh/normals.h>

namespace mimicry::io {
namespace {

/// Sums of the same faces in another order differ by less.
constexpr double kSame = 1e-9;

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

struct Corner {
  Index face = 0;
  int k = 0;
};

// All corners, those of one place side by side.
std::vector<Corner> by_place(const TriangleMesh& mesh) {
  std::vector<Corner> corners;
  corners.reserve(mesh.faces().size() * 3);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) corners.push_back({f, k});
  const auto at = [&](const Corner& c) -> const Vec3& {
    return mesh.position(mesh.faces()[c.face][c.k]);
  };
  std::stable_sort(corners.begin(), corners.end(),
                   [&](const Corner& a, const Corner& b) { return before(at(a), at(b)); });
  return corners;
}

double angle_at(const TriangleMesh& mesh, const Corner& c) {
  const Face& f = mesh.faces()[c.face];
  const Vec3& here = mesh.position(f[c.k]);
  const Vec3 a = mesh.position(f[(c.k + 1) % 3]) - here, b = mesh.position(f[(c.k + 2) % 3]) - here;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

CreasedMesh creased_mesh(const TriangleMesh& mesh, double crease_rad) {
  const double least = std::cos(crease_rad);
  std::vector<Vec3> flat;
  for (Index f = 0; f < mesh.face_count(); ++f) flat.push_back(face_normal(mesh, f));
  const std::vector<Corner> corners = by_place(mesh);
  std::vector<Vec3> positions, normals;
  std::vector<Face> faces(mesh.faces().begin(), mesh.faces().end());
  for (std::size_t first = 0, end = 0; first < corners.size(); first = end) {
    const auto place = [&](std::size_t c) -> const Vec3& {
      return mesh.position(mesh.faces()[corners[c].face][corners[c].k]);
    };
    for (end = first + 1; end < corners.size() && !before(place(first), place(end));) ++end;
    const std::size_t made = positions.size();
    for (std::size_t c = first; c < end; ++c) {
      const Vec3& own = flat[corners[c].face];
      Vec3 sum = Vec3::Zero();
      for (std::size_t d = first; d < end; ++d)
        if (d == c || own.dot(flat[corners[d].face]) > least)
          sum += angle_at(mesh, corners[d]) * flat[corners[d].face];
      const Vec3 normal = sum.norm() > 0.0 ? sum.normalized().eval() : own;
      std::size_t v = made;
      while (v < positions.size() && (normals[v] - normal).squaredNorm() > kSame * kSame) ++v;
      if (v == positions.size()) {
        positions.push_back(place(c));
        normals.push_back(normal);
      }
      faces[corners[c].face][corners[c].k] = static_cast<Index>(v);
    }
  }
  return {TriangleMesh(std::move(positions), std::move(faces)), std::move(normals)};
}

}  // namespace mimicry::io
