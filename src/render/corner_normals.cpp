#include "render/corner_normals.h"

#include <cmath>
#include <numbers>

#include <mimicry/mesh/surface.h>

namespace mimicry::render {
namespace {

double corner_angle(const TriangleMesh& mesh, Index f, int k) {
  const Vec3 a = (mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k)).stableNormalized();
  const Vec3 b = (mesh.corner(f, (k + 2) % 3) - mesh.corner(f, k)).stableNormalized();
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(const TriangleMesh& mesh,
                                                           double crease_deg) {
  const auto faces = static_cast<std::size_t>(mesh.face_count());
  // Corners 3 f + k sorted by vertex.
  std::vector<std::size_t> first(static_cast<std::size_t>(mesh.vertex_count()) + 1, 0);
  for (const Face& face : mesh.faces()) {
    for (const Index v : face) ++first[static_cast<std::size_t>(v) + 1];
  }
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<std::size_t> corners(3 * faces);
  std::vector<std::size_t> fill(first.begin(), first.end() - 1);
  std::vector<Vec3> normals(faces);
  std::vector<double> angles(3 * faces);
  for (std::size_t f = 0; f < faces; ++f) {
    normals[f] = face_normal(mesh, static_cast<Index>(f));
    for (std::size_t k = 0; k < 3; ++k) {
      corners[fill[static_cast<std::size_t>(mesh.faces()[f][k])]++] = 3 * f + k;
      angles[3 * f + k] = corner_angle(mesh, static_cast<Index>(f), static_cast<int>(k));
    }
  }

  // A hair wider than asked: faces at exactly the crease angle count as smooth on every machine.
  const double min_cosine = std::cos(crease_deg * std::numbers::pi / 180.0) - 1e-9;
  std::vector<std::array<Eigen::Vector3f, 3>> result(faces);
  for (std::size_t f = 0; f < faces; ++f) {
    const Vec3 own = normals[f].isZero() ? Vec3::UnitY() : normals[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(mesh.faces()[f][k]);
      Vec3 sum = Vec3::Zero();
      for (std::size_t c = first[v]; c < first[v + 1]; ++c) {
        const Vec3& other = normals[corners[c] / 3];
        if (own.dot(other) >= min_cosine) sum += angles[corners[c]] * other;
      }
      result[f][k] = (sum.norm() > 1e-6 ? sum.normalized() : own).cast<float>();
    }
  }
  return result;
}

}  // namespace mimicry::render
