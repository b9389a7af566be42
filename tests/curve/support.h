#pragma once

#include <span>
#include <utility>
#include <vector>

#include <mimicry/mesh/surface.h>

#include "curve/curve_builder.h"

namespace mimicry::test {

inline const Vec3 kMiddle = Vec3::Constant(1.0 / 3.0);

/// A target to draw on.
struct Drawn {
  explicit Drawn(TriangleMesh m) : surface(Surface::as_given(std::move(m))) {}

  Surface surface;
  const TriangleMesh& mesh = surface.mesh();
  const HalfEdges& edges = surface.half_edges();
  std::span<const Vec3> normals = surface.vertex_normals();

  CurvePoint point(const SurfacePoint& p, Index frame = 0) const {
    return {p, mesh.position(p), interpolated_normal(mesh, normals, p), frame, 0.0, 0.0};
  }

  /// The surface point at x, by looking at all faces; near x where it is not on the surface.
  SurfacePoint locate(const Vec3& x) const {
    SurfacePoint best;
    double nearest = kInfinity;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const Vec3 n = mesh.area_vector(f);
      Vec3 bary;
      for (int k = 0; k < 3; ++k) {
        const Vec3& a = mesh.corner(f, (k + 1) % 3);
        const Vec3& b = mesh.corner(f, (k + 2) % 3);
        bary[k] = (b - a).cross(x - a).dot(n) / n.squaredNorm();
      }
      bary = bary.cwiseMax(0.0);
      const SurfacePoint p{f, bary / bary.sum()};
      const double distance = (mesh.position(p) - x).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      best = p;
    }
    return best;
  }

  /// Points joined by shortest paths; a closed curve's last point must be its first.
  ProjectedCurve curve(std::span<const SurfacePoint> points, bool closed = false) const {
    CurveBuilder builder(surface);
    for (const SurfacePoint& p : points)
      builder.append(point(p, static_cast<Index>(builder.curve().points.size())));
    ProjectedCurve curve = builder.curve();
    curve.closed = closed;
    return curve;
  }
  ProjectedCurve curve_near(std::span<const Vec3> positions, bool closed = false) const {
    std::vector<SurfacePoint> points;
    for (const Vec3& x : positions) points.push_back(locate(x));
    return curve(points, closed);
  }
};

}  // namespace mimicry::test
