#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <mimicry/mesh/surface.h>

namespace mimicry {
namespace {

// Norms of very small and very large vectors neither vanish nor overflow.
Vec3 unit_or_zero(const Vec3& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0.0) || !std::isfinite(largest)) return Vec3::Zero();
  if (largest > 1e-100 && largest < 1e100) return v / v.norm();
  const Vec3 scaled = v / largest;
  return scaled / scaled.norm();
}

}  // namespace

Vec3 face_normal(const TriangleMesh& mesh, Index f) {
  const Vec3 a = mesh.corner(f, 1) - mesh.corner(f, 0);
  const Vec3 b = mesh.corner(f, 2) - mesh.corner(f, 0);
  const double largest = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  if (!(largest > 0.0) || !std::isfinite(largest)) return Vec3::Zero();
  return unit_or_zero((a / largest).cross(b / largest));
}

std::vector<Vec3> angle_weighted_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(static_cast<std::size_t>(mesh.vertex_count()));
  angle_weighted_normals(mesh, normals);
  return normals;
}

void angle_weighted_normals(const TriangleMesh& mesh, std::span<Vec3> normals) {
  assert(normals.size() == mesh.positions().size());
  std::fill(normals.begin(), normals.end(), Vec3::Zero());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    Vec3 a = mesh.corner(f, 1) - mesh.corner(f, 0);
    Vec3 b = mesh.corner(f, 2) - mesh.corner(f, 0);
    const double largest = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
    if (!(largest > 0.0) || !std::isfinite(largest)) continue;
    if (largest < 1e-30 || largest > 1e30) {
      a /= largest;
      b /= largest;
    }
    Vec3 n = a.cross(b);
    const double twice_area = n.norm();
    if (!(twice_area > 0.0)) continue;
    n /= twice_area;
    // All three angles have the same sine part; the third is what is left of a half turn.
    const double angle0 = std::atan2(twice_area, a.dot(b));
    const double angle1 = std::atan2(twice_area, a.dot(a - b));
    const double angle2 = std::max(0.0, std::numbers::pi - angle0 - angle1);
    const Face& face = mesh.face(f);
    normals[static_cast<std::size_t>(face[0])] += angle0 * n;
    normals[static_cast<std::size_t>(face[1])] += angle1 * n;
    normals[static_cast<std::size_t>(face[2])] += angle2 * n;
  }
  for (Vec3& n : normals) n = unit_or_zero(n);
}

Vec3 interpolated_normal(const TriangleMesh& mesh, std::span<const Vec3> vertex_normals,
                         const SurfacePoint& p) {
  const Face& f = mesh.face(p.face);
  Vec3 n = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    n += p.bary[static_cast<Eigen::Index>(k)] * vertex_normals[static_cast<std::size_t>(f[k])];
  // Normals that cancel leave rounding noise, not a direction.
  return n.squaredNorm() > 1e-12 ? unit_or_zero(n) : face_normal(mesh, p.face);
}

}  // namespace mimicry
