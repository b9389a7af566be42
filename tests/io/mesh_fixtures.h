#pragma once

#include <random>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// A closed tetrahedron.
inline TriangleMesh tetrahedron() {
  return {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// An open grid with coordinates that need every bit; in single precision where asked, so that
/// every format can hold them. Each vertex is a corner of a face, in order of number.
inline TriangleMesh rough_grid(int side, unsigned seed, bool single) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-1e-3, 1e-3);
  std::vector<Vec3> positions;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      Vec3 p(i + noise(random), j + noise(random), noise(random));
      if (single) p = p.cast<float>().cast<double>();
      positions.push_back(p);
    }
  std::vector<Face> faces;
  for (Index i = 0; i + 1 < side; ++i)
    for (Index j = 0; j + 1 < side; ++j) {
      const Index v = i * side + j;
      faces.push_back({v, v + side, v + 1});
      faces.push_back({v + 1, v + side, v + side + 1});
    }
  return {std::move(positions), std::move(faces)};
}

inline double total_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (Index f = 0; f < mesh.face_count(); ++f) area += 0.5 * mesh.area_vector(f).norm();
  return area;
}

}  // namespace mimicry
