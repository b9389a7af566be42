#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <mimicry/embedding/smooth_projector.h>

#include "embedding/projection.h"

namespace mimicry::bench {

/// How much a curve of projected points may turn where it crosses the mesh's edges, radians: the
/// largest of 32 directions, both faces laid out flat, 99 % quantile over the middles of all edges.
struct EdgeTurns {
  double in_embedding, in_space;
};

// Near the surface a projected point x moves by dx in its face with T dx = T dy; T is the same on
// both sides of an edge.
inline EdgeTurns edge_turns(const SmoothProjector& projector) {
  const TriangleMesh& mesh = projector.target().mesh();
  const HalfEdges& edges = projector.target().half_edges();
  const PhongSurface& surface = projection_of(projector).surface();
  // Coordinates along the edge and to the left of it, of the edge and a side.
  const auto layout = [](const auto& edge, const auto& side, double sign) {
    const double along = side.dot(edge) / edge.norm();
    Eigen::Matrix2d m;
    m << edge.norm(), along, 0.0, sign * std::sqrt(side.squaredNorm() - along * along);
    return m;
  };
  std::vector<double> in_embedding, in_space;
  for (Index h = 0; h < edges.count(); ++h) {
    const Index t = edges.twin(h);
    if (t < h) continue;
    const auto in_embedding_at = [&](Index half_edge, Index step) -> Vec8 {
      return surface.position({half_edge / 3, Vec3::Unit((half_edge % 3 + step) % 3)});
    };
    const auto in_space_at = [&](Index half_edge, Index step) -> Vec3 {
      return mesh.corner(half_edge / 3, (half_edge % 3 + step) % 3);
    };
    SurfacePoint middle{h / 3, Vec3::Constant(0.5)};
    middle.bary[(h + 2) % 3] = 0.0;
    const Basis plane = surface.tangent_plane(middle);
    const Vec8 a8 = in_embedding_at(h, 0), edge8 = in_embedding_at(h, 1) - a8,
               l8 = in_embedding_at(h, 2) - a8, r8 = in_embedding_at(t, 2) - a8;
    const Vec3 a3 = in_space_at(h, 0), edge3 = in_space_at(h, 1) - a3, l3 = in_space_at(h, 2) - a3,
               r3 = in_space_at(t, 2) - a3;
    Eigen::Matrix2d from, to;
    from << plane * edge8, plane * l8;
    to << plane * edge8, plane * r8;
    const Eigen::Matrix2d across = to.inverse() * from;
    const auto largest = [](const Eigen::Matrix2d& map) {
      double worst = 0.0;
      for (int k = 0; k < 32; ++k) {
        const double angle = std::numbers::pi * k / 32.0;
        const Vec2 in(std::cos(angle), std::sin(angle)), out = map * in;
        worst = std::max(worst, std::abs(std::atan2(in[0] * out[1] - in[1] * out[0], in.dot(out))));
      }
      return worst;
    };
    in_embedding.push_back(
        largest(layout(edge8, r8, -1.0) * across * layout(edge8, l8, 1.0).inverse()));
    in_space.push_back(
        largest(layout(edge3, r3, -1.0) * across * layout(edge3, l3, 1.0).inverse()));
  }
  const auto quantile = [](std::vector<double> x) {
    std::sort(x.begin(), x.end());
    return x[x.size() * 99 / 100];
  };
  return {quantile(std::move(in_embedding)), quantile(std::move(in_space))};
}

}  // namespace mimicry::bench
