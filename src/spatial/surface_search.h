#pragma once

#include <optional>

#include <mimicry/mesh/triangle_mesh.h>

#include "spatial/triangle.h"

namespace mimicry {

struct NearestTriangle {
  SurfacePoint surface;
  Vec3 position = Vec3::Zero();
  double distance2 = kInfinity;
};

struct TriangleOnRay {
  SurfacePoint surface;
  Vec3 position = Vec3::Zero();
  double t = kInfinity;
};

inline Vec3 position(const Triangle& t, const Vec3& bary) {
  return bary[0] * t.a + bary[1] * t.b + bary[2] * t.c;
}

/// Closest point and rays over triangles, on `Bvh<3, Triangle>` or on its twin
/// `BruteForce<3, Triangle>`: both give the same bits, because what is compared is computed by the
/// triangle alone and ties go to the lower face number.

/// Nearest point with squared distance of at most bound2; surface.face kNone where there is none.
/// hint: a face that is probably near, any or kNone; it saves time and never changes the answer.
template <class Hierarchy, class GetTriangle>
NearestTriangle nearest_triangle(const Hierarchy& hierarchy, const Vec3& y, double bound2,
                                 Index hint, GetTriangle&& triangle) {
  NearestTriangle best;
  const auto consider = [&](Index face, const Triangle& candidate, double bound) {
    const TrianglePoint p = closest_point(candidate, y);
    if (!(p.distance2 <= bound) || p.distance2 == kInfinity) return bound;
    if (p.distance2 < best.distance2 || (p.distance2 == best.distance2 && face < best.surface.face))
      best = {{face, p.bary}, position(candidate, p.bary), p.distance2};
    return p.distance2;
  };
  if (hint >= 0 && hint < hierarchy.size()) bound2 = consider(hint, triangle(hint), bound2);
  hierarchy.nearest(y, bound2, consider);
  return best;
}

/// First hit at t >= 0; surface.face kNone where there is none.
template <class Hierarchy>
TriangleOnRay first_on_ray(const Hierarchy& hierarchy, const Ray& ray) {
  TriangleOnRay best;
  hierarchy.along(ray.origin(), ray.direction(), kInfinity,
                  [&](Index face, const Triangle& candidate, double bound) {
                    const auto hit = ray.hit(candidate);
                    if (!hit || hit->t > bound) return bound;
                    if (hit->t < best.t || (hit->t == best.t && face < best.surface.face))
                      best = {{face, hit->bary}, position(candidate, hit->bary), hit->t};
                    return hit->t;
                  });
  return best;
}

/// visit(TriangleOnRay) for every triangle that the ray hits, in no order.
template <class Hierarchy, class Visit>
void each_on_ray(const Hierarchy& hierarchy, const Ray& ray, Visit&& visit) {
  hierarchy.along(
      ray.origin(), ray.direction(), kInfinity,
      [&](Index face, const Triangle& candidate, double bound) {
        if (const auto hit = ray.hit(candidate))
          visit(TriangleOnRay{{face, hit->bary}, position(candidate, hit->bary), hit->t});
        return bound;
      });
}

}  // namespace mimicry
