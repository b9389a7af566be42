#include "technique/normal_foot.h"

#include "technique/cubic_roots.h"

namespace mimicry {
namespace {

// Barycentrics this little below zero lie on the edge: its other triangle sees the same point.
constexpr double kOnEdge = 1e-10;
// Squared ratio of the height to the sides below which barycentrics mean nothing.
constexpr double kNoArea2 = 1e-24;

}  // namespace

// With p_k = a_k - r, in units of the reach, b is sought so that sum b_k (p_k + t n_k) = 0: the
// three points p_k + t n_k and the origin lie in one plane,
// det[p_1 - p_0 + t (n_1 - n_0), p_2 - p_0 + t (n_2 - n_0), p_0 + t n_0] = 0.
NormalFoot normal_foot(const NormalTriangle& triangle, const Vec3& r, double reach,
                       double tolerance) {
  const auto& n = triangle.normals;
  const double unit = 1.0 / reach;
  const std::array<Vec3, 3> p = {(triangle.corners[0] - r) * unit, (triangle.corners[1] - r) * unit,
                                 (triangle.corners[2] - r) * unit};
  const Vec3 e = p[1] - p[0], g = p[2] - p[0];
  const Vec3 de = n[1] - n[0], dg = n[2] - n[0];
  const Vec3 area = e.cross(g), dd = de.cross(dg);
  const Vec3 mixed = de.cross(g) + e.cross(dg);
  const CubicRoots roots = cubic_roots(area.dot(p[0]), area.dot(n[0]) + mixed.dot(p[0]),
                                       mixed.dot(n[0]) + dd.dot(p[0]), dd.dot(n[0]));
  NormalFoot best;
  for (int i = 0; i < roots.count; ++i) {
    const double t = roots.t[static_cast<std::size_t>(i)];
    const Vec3 a = p[0] + t * n[0], b = p[1] + t * n[1], c = p[2] + t * n[2];
    const Vec3 ab = b - a, ac = c - a;
    const Vec3 normal = ab.cross(ac);
    const double normal2 = normal.squaredNorm();
    if (!(normal2 > kNoArea2 * ab.squaredNorm() * ac.squaredNorm())) continue;
    Vec3 bary(0.0, normal.dot(c.cross(a)) / normal2, normal.dot(a.cross(b)) / normal2);
    bary[0] = 1.0 - bary[1] - bary[2];
    if ((bary[0] * a + bary[1] * b + bary[2] * c).norm() > tolerance * unit) continue;
    const bool inside = bary.minCoeff() >= -kOnEdge;
    if (best.inside && !inside) continue;
    if (inside) {
      bary = bary.cwiseMax(0.0);
      bary /= bary.sum();
    }
    const double distance = (bary[0] * p[0] + bary[1] * p[1] + bary[2] * p[2]).norm() * reach;
    if (!best.found || inside != best.inside || distance < best.distance)
      best = {true, inside, bary, distance};
  }
  return best;
}

}  // namespace mimicry
