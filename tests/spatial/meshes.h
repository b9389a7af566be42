#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>
#include <mimicry/spatial/triangle.h>

// Meshes that searches find hard.
namespace mimicry::spatial::testing {

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

/// Closed torus of 2 m n faces, outside counter-clockwise.
inline TriangleMesh torus(int m, int n, double major = 1.0, double minor = 0.4) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = 2.0 * std::numbers::pi * i / m, v = 2.0 * std::numbers::pi * j / n;
      const double r = major + minor * std::cos(v);
      positions.emplace_back(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
      const auto at = [&](int a, int b) { return (a % m) * n + b % n; };
      faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return {positions, faces};
}

/// Closed cube [-1, 1]^3 with n by n squares a side: coplanar neighbours, axis-aligned boxes
/// without thickness.
inline TriangleMesh cube(int n) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  const auto vertex = [&](const Vec3& p) {
    for (std::size_t i = 0; i < positions.size(); ++i)
      if (positions[i] == p) return static_cast<Index>(i);
    positions.push_back(p);
    return static_cast<Index>(positions.size() - 1);
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int a, int b) {
            Vec3 p;
            p[axis] = side;
            p[(axis + 1) % 3] = (2.0 * a - n) / n;
            p[(axis + 2) % 3] = (2.0 * b - n) / n;
            return vertex(p);
          };
          Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          if (side < 0) std::swap(b, d);
          faces.push_back({a, b, c});
          faces.push_back({a, c, d});
        }
  return {positions, faces};
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

}  // namespace mimicry::spatial::testing
