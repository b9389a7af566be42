#include "mesh/visible_normals.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <mimicry/mesh/surface.h>

namespace mimicry {
namespace {

// What lies this little below the wanted dot product is rounding.
constexpr double kRounding = 1e-9;
constexpr std::size_t kMostDeciding = 24;

// The vectors that have decided so far; every other one is seen at least as well.
struct Core {
  std::array<Vec3, kMostDeciding> vectors;
  std::size_t count = 0;

  double smallest_dot(const Vec3& n, double enough) const {
    double smallest = 1.0;
    for (std::size_t i = 0; i < count && smallest > enough; ++i)
      smallest = std::min(smallest, n.dot(vectors[i]));
    return smallest;
  }
};

// At the optimum one, two or three vectors have the smallest dot product: the best direction is one
// of them, halfway between two, or at equal angles to three.
MostVisible best_of_candidates(const Core& core) {
  MostVisible best;
  const auto consider = [&](const Vec3& direction) {
    const double norm = direction.norm();
    if (!(norm > 1e-9)) return;
    const Vec3 n = direction / norm;
    const double dot = core.smallest_dot(n, best.smallest_dot);
    if (dot > best.smallest_dot) best = {n, dot};
  };
  for (std::size_t i = 0; i < core.count; ++i) {
    const Vec3& a = core.vectors[i];
    consider(a);
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3& b = core.vectors[j];
      consider(a + b);
      if (a.dot(b) < -1.0 + 1e-12) consider(a.unitOrthogonal());
      for (std::size_t k = 0; k < j; ++k) {
        const Vec3 axis = (b - a).cross(core.vectors[k] - a);
        consider(axis);
        consider(-axis);
      }
    }
  }
  return best;
}

// for_each(visit) calls visit(vector) for all vectors, in the same order each time. The vector that
// is seen worst joins those that decide until none is seen worse than they.
template <class ForEach>
MostVisible most_visible(const ForEach& for_each) {
  Core core;
  MostVisible best, candidate;
  while (true) {
    Vec3 worst = Vec3::Zero();
    double smallest = 2.0;
    for_each([&](const Vec3& f) {
      const double dot = candidate.direction.dot(f);
      if (dot < smallest) smallest = dot, worst = f;
    });
    if (smallest > 1.0 + kRounding) return {};
    if (core.count > 0 && smallest > best.smallest_dot) best = {candidate.direction, smallest};
    const bool settled = core.count > 0 && smallest >= candidate.smallest_dot - 1e-14;
    if (settled || core.count == kMostDeciding) return best;
    core.vectors[core.count++] = worst;
    candidate = best_of_candidates(core);
  }
}

template <class Visit>
void for_each_fan_normal(const TriangleMesh& mesh, const HalfEdges& half_edges, Index v,
                         Visit&& visit) {
  const Index start = half_edges.outgoing(v);
  for (Index h = start; h >= 0;) {
    const Vec3 f = face_normal(mesh, HalfEdges::face(h));
    if (!f.isZero(0.0)) visit(f);
    h = half_edges.ccw(h);
    if (h == start) break;
  }
}

void move_toward_visible(const TriangleMesh& mesh, const HalfEdges& half_edges, Index v,
                         Vec3& normal) {
  const auto fan = [&](auto&& visit) { for_each_fan_normal(mesh, half_edges, v, visit); };
  const MostVisible best = most_visible(fan);
  if (best.direction.isZero(0.0)) return;
  const Vec3 across = best.direction - normal.dot(best.direction) * normal;
  const double sine = across.norm();
  if (best.smallest_dot <= kVisibleDot || normal.isZero(0.0) || !(sine > 1e-12)) {
    normal = best.direction;
    return;
  }
  // On the arc n(angle) = cos normal + sin side, a face's dot product is R cos(angle - phase); the
  // arc's end sees all faces well enough, so that each is entered once and stays.
  const Vec3 side = across / sine;
  double angle = 0.0;
  fan([&](const Vec3& f) {
    const double a = normal.dot(f), b = side.dot(f);
    const double r = std::hypot(a, b);
    if (a >= kVisibleDot || r <= kVisibleDot) return;
    angle = std::max(angle, std::atan2(b, a) - std::acos(kVisibleDot / r));
  });
  angle = std::min(angle, std::atan2(sine, normal.dot(best.direction)));
  normal = (std::cos(angle) * normal + std::sin(angle) * side).normalized();
}

}  // namespace

MostVisible most_visible_direction(std::span<const Vec3> unit_vectors) {
  return most_visible([&](auto&& visit) {
    for (const Vec3& f : unit_vectors) visit(f);
  });
}

void make_visible(const TriangleMesh& mesh, const HalfEdges& half_edges, std::span<Vec3> normals) {
  assert(normals.size() == mesh.positions().size());
  constexpr double kLeast = kVisibleDot - kRounding;
  std::array<Index, 1024> moved;
  moved.fill(kNone);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    // Most faces pass without a root; sizes whose squares vanish or overflow go the long way.
    const Vec3 area = mesh.area_vector(f);
    const double least2 = kLeast * kLeast * area.squaredNorm();
    const bool plain = least2 > 1e-200 && least2 < 1e200;
    const Vec3 face = plain ? area : face_normal(mesh, f);
    const double bound2 = plain ? least2 : kLeast * kLeast * face.squaredNorm();
    // A vertex of several faces is moved once: then it passes, or is where it would be moved again,
    // which the last ones moved are remembered for: around some, thousands of faces do not pass.
    for (const Index v : mesh.face(f)) {
      Vec3& normal = normals[static_cast<std::size_t>(v)];
      const double dot = normal.dot(face);
      if (dot >= 0.0 && dot * dot >= bound2) continue;
      Index& last = moved[at(v) % moved.size()];
      if (last == v) continue;
      move_toward_visible(mesh, half_edges, v, normal);
      last = v;
    }
  }
}

}  // namespace mimicry
