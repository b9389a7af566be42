#include "geodesic/surface_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <mimicry/base/error.h>

#include "geodesic/tolerances.h"

namespace mimicry {

SurfaceFrames::SurfaceFrames(const TriangleMesh& mesh, const HalfEdges& half_edges) {
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
  const auto count = static_cast<std::size_t>(half_edges.count());
  for (std::size_t v = 0; v < vertices; ++v)
    // Squares of squares of lengths must neither overflow nor vanish.
    for (const double x : mesh.positions()[v])
      if (!std::isfinite(x) || std::abs(x) > 1e70)
        throw Error(ErrorKind::invalid_input, "mesh: vertex " + std::to_string(v) +
                                                  " is not finite or larger than 1e70; repair it");
  size = diagonal(mesh);

  frames.resize(count);
  corner_angles.resize(count);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    double longest = 0.0;
    int shortest = 0;
    for (int k = 0; k < 3; ++k) {
      EdgeFrame& frame = frames[static_cast<std::size_t>(3 * f + k)];
      frame.length = (mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k)).norm();
      longest = std::max(longest, frame.length);
      if (frame.length < frames[static_cast<std::size_t>(3 * f + shortest)].length) shortest = k;
    }
    // From the shortest edge: of two long sides that are nearly parallel the product is all
    // rounding.
    const Vec3& corner = mesh.corner(f, shortest);
    const double area = (mesh.corner(f, (shortest + 1) % 3) - corner)
                            .cross(mesh.corner(f, (shortest + 2) % 3) - corner)
                            .norm();
    for (int k = 0; k < 3; ++k) {
      EdgeFrame& frame = frames[static_cast<std::size_t>(3 * f + k)];
      const Vec3 along = mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k);
      const Vec3 to_apex = mesh.corner(f, (k + 2) % 3) - mesh.corner(f, k);
      const double least = std::max(kLeastHeight * longest, 1e-300);
      frame.apex_x = frame.length > 0.0 ? along.dot(to_apex) / frame.length : 0.0;
      frame.apex_y = std::max(frame.length > 0.0 ? area / frame.length : longest, least);
      corner_angles[static_cast<std::size_t>(3 * f + k)] =
          area == 0.0 && along.dot(to_apex) == 0.0 ? 0.0 : std::atan2(area, along.dot(to_apex));
    }
  }

  for (Index h = 0; h < half_edges.count(); ++h) {
    EdgeFrame& frame = frames[static_cast<std::size_t>(h)];
    if (half_edges.edge(h) == h) {
      frame.edge = static_cast<Index>(edge_half_edges.size());
      edge_half_edges.push_back(h);
    } else {
      const EdgeFrame& other = frames[static_cast<std::size_t>(half_edges.twin(h))];
      frame.edge = other.edge;
      frame.forward = false;
      frame.length = other.length;
    }
  }

  fan_begin.assign(vertices + 1, 0);
  for (Index h = 0; h < half_edges.count(); ++h)
    ++fan_begin[static_cast<std::size_t>(half_edges.tail(h)) + 1];
  for (std::size_t v = 0; v < vertices; ++v) fan_begin[v + 1] += fan_begin[v];
  fan.resize(count);
  {
    std::vector<Index> fill(fan_begin.begin(), fan_begin.end() - 1);
    for (Index h = 0; h < half_edges.count(); ++h)
      fan[static_cast<std::size_t>(fill[static_cast<std::size_t>(half_edges.tail(h))]++)] = h;
  }

  start_angles.assign(count, 0.0);
  total_angles.assign(vertices, 0.0);
  bends.assign(vertices, never);
  constexpr double kFlat = 1e-8;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const auto i = static_cast<std::size_t>(v);
    const Index first = half_edges.outgoing(v);
    if (first < 0) continue;
    if (half_edges.is_nonmanifold_vertex(v)) {
      bends[i] = anywhere;
      continue;
    }
    double angle = 0.0;
    Index h = first;
    do {
      start_angles[static_cast<std::size_t>(h)] = angle;
      angle += corner_angles[static_cast<std::size_t>(h)];
      h = half_edges.ccw(h);
    } while (h >= 0 && h != first);
    total_angles[i] = angle;
    const double straight =
        half_edges.is_boundary_vertex(v) ? std::numbers::pi : 2.0 * std::numbers::pi;
    bends[i] =
        angle > straight + (half_edges.is_boundary_vertex(v) ? -kFlat : kFlat) ? outside : never;
  }
  // Where an edge is too short to have a direction, the fans of its ends are one in truth.
  for (Index h = 0; h < half_edges.count(); ++h)
    if (frames[static_cast<std::size_t>(h)].length <= 1e-14 * size) {
      bends[static_cast<std::size_t>(half_edges.tail(h))] = anywhere;
      bends[static_cast<std::size_t>(half_edges.head(h))] = anywhere;
    }
}

}  // namespace mimicry
