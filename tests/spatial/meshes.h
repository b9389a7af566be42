#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

#include "spatial/triangle.h"

// Meshes that searches find hard.
namespace mimicry::test {

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}
inline Vec3 uniform_vector(Random& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}
inline Vec3 unit_vector(Random& random) {
  while (true) {
    const Vec3 v = uniform_vector(random, 1.0);
    if (v.squaredNorm() < 1.0 && v.squaredNorm() > 1e-4) return v.normalized();
  }
}

inline Triangle triangle_of(const TriangleMesh& mesh, Index f) {
  return {mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)};
}

/// Triangles that share nothing, many of them needles, some without area, some the same.
inline TriangleMesh soup(Random& random, int count) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (int f = 0; f < count; ++f) {
    const Vec3 a = uniform_vector(random, 1.0);
    const Vec3 b = a + uniform_vector(random, 0.3);
    Vec3 c = a + uniform_vector(random, 0.3);
    if (f % 5 == 1) c = a + 0.7 * (b - a) + uniform_vector(random, 1e-9);
    if (f % 5 == 2) c = b;
    positions.insert(positions.end(), {a, b, c});
    const Index v = 3 * (f % 7 == 6 ? f - 1 : f);
    faces.push_back({v, v + 1, v + 2});
  }
  return {positions, faces};
}

inline TriangleMesh transformed(const TriangleMesh& mesh, double scale, const Vec3& offset) {
  std::vector<Vec3> positions;
  for (const Vec3& p : mesh.positions()) positions.push_back(scale * p + offset);
  return mesh.with_positions(std::move(positions));
}

/// Both, side by side.
inline TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Vec3> positions(a.positions().begin(), a.positions().end());
  std::vector<Face> faces(a.faces().begin(), a.faces().end());
  positions.insert(positions.end(), b.positions().begin(), b.positions().end());
  for (Face f : b.faces()) {
    for (Index& v : f) v += a.vertex_count();
    faces.push_back(f);
  }
  return {positions, faces};
}

}  // namespace mimicry::test
