#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <mimicry/base/random.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/surface.h>

#include "mesh/quads.h"

namespace mimicry {
namespace {

// rows x columns quads on a surface that closes in both directions.
template <class Position>
TriangleMesh closed_sheet(int rows, int columns, Position position) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  const auto vertex = [columns, rows](int i, int j) {
    return static_cast<Index>((i % rows) * columns + j % columns);
  };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      positions.push_back(position(kTau * i / rows, kTau * j / columns));
      const Index a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1);
      faces.push_back({a, b, c});
      faces.push_back({a, c, vertex(i, j + 1)});
    }
  return {std::move(positions), std::move(faces)};
}

// The quads of a box's surface on the lattice 0..n.
QuadMesh box_quads(const LatticePoint& n, const Vec3& half_size) {
  LatticeIndex index;
  QuadMesh box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {0, 1})
      for (int j = 0; j < n[v]; ++j)
        for (int i = 0; i < n[u]; ++i) {
          const auto at = [&](int du, int dv) {
            LatticePoint p{};
            p[axis] = side * n[axis];
            p[u] = i + du;
            p[v] = j + dv;
            return index(p);
          };
          if (side == 1)
            box.quads.push_back({at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
          else
            box.quads.push_back({at(0, 0), at(0, 1), at(1, 1), at(1, 0)});
        }
  }
  for (const LatticePoint& p : index.points()) {
    Vec3 x;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      // Symmetric in p and n - p to the last bit.
      x[k] = half_size[k] * (2 * p[i] - n[i]) / n[i];
    }
    box.positions.push_back(x);
  }
  return box;
}

}  // namespace

TriangleMesh make_sphere(int n, double radius) {
  const double g = std::numbers::phi;
  const std::array<Vec3, 12> corners = {Vec3(-1, g, 0),  Vec3(1, g, 0),   Vec3(-1, -g, 0),
                                        Vec3(1, -g, 0),  Vec3(0, -1, g),  Vec3(0, 1, g),
                                        Vec3(0, -1, -g), Vec3(0, 1, -g),  Vec3(g, 0, -1),
                                        Vec3(g, 0, 1),   Vec3(-g, 0, -1), Vec3(-g, 0, 1)};
  constexpr std::array<Face, 20> kFaces = {
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  // A lattice point of a face is the integer weights of its corners; on a shared edge both faces
  // name it alike: (corner, weight) pairs sorted by corner, zero weights left out.
  using Key = std::array<int, 6>;
  std::map<Key, Index> numbers;
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (const Face& face : kFaces) {
    const auto vertex = [&](int i, int j) {
      std::array<std::pair<int, int>, 3> parts = {
          {{face[0], n - i - j}, {face[1], i}, {face[2], j}}};
      for (auto& part : parts)
        if (part.second == 0) part.first = 12;
      std::sort(parts.begin(), parts.end());
      Key key;
      Vec3 x = Vec3::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        key[2 * k] = parts[k].first;
        key[2 * k + 1] = parts[k].second;
        if (parts[k].second > 0)
          x += parts[k].second * corners[static_cast<std::size_t>(parts[k].first)];
      }
      const auto [it, is_new] = numbers.try_emplace(key, static_cast<Index>(positions.size()));
      if (is_new) positions.push_back(radius * x.normalized());
      return it->second;
    };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i) {
        faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
        if (i + j + 1 < n)
          faces.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
  }
  return {std::move(positions), std::move(faces)};
}

TriangleMesh make_torus(int around, int across, double major_radius, double minor_radius) {
  return closed_sheet(around, across, [=](double u, double v) {
    const double ring = major_radius + minor_radius * std::cos(v);
    return Vec3(ring * std::cos(u), ring * std::sin(u), minor_radius * std::sin(v));
  });
}

Vec3 trefoil_point(double along, double around) {
  constexpr double kScale = 0.3;
  constexpr double kTubeRadius = 0.5;
  const double t = along;
  const Vec3 centre(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t),
                    -std::sin(3 * t));
  const Vec3 d1(std::cos(t) + 4 * std::cos(2 * t), -std::sin(t) + 4 * std::sin(2 * t),
                -3 * std::cos(3 * t));
  const Vec3 d2(-std::sin(t) - 8 * std::sin(2 * t), -std::cos(t) + 8 * std::cos(2 * t),
                9 * std::sin(3 * t));
  // The knot has no point without curvature, so its Frenet frame closes.
  const Vec3 binormal = d1.cross(d2).normalized();
  const Vec3 normal = binormal.cross(d1).normalized();
  return kScale *
         (centre + kTubeRadius * (std::cos(around) * normal - std::sin(around) * binormal));
}

TriangleMesh make_trefoil(int n) {
  return closed_sheet(10 * n, n, trefoil_point);
}

TriangleMesh make_box(int nx, int ny, int nz, const Vec3& half_size) {
  return triangulate(box_quads({nx, ny, nz}, half_size));
}

TriangleMesh make_rounded_cube(int n, double half_size, double radius) {
  QuadMesh box = box_quads({n, n, n}, Vec3::Constant(half_size));
  const Vec3 inner = Vec3::Constant(half_size - radius);
  for (Vec3& p : box.positions) {
    const Vec3 core = p.cwiseMax(-inner).cwiseMin(inner);
    p = core + radius * (p - core).normalized();
  }
  return triangulate(std::move(box));
}

TriangleMesh make_cylinder(int n, double radius, double half_height) {
  // Caps: a centre and n rings of 6 k points, so that no triangle is thin.
  const int around = 6 * n;
  const int rows = std::max(1, static_cast<int>(std::lround(2 * half_height * n / radius)));
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  const auto ring_point = [&](double angle, double r, double y) {
    positions.emplace_back(r * std::sin(angle), y, r * std::cos(angle));
  };
  const auto side = [around](int row, int i) {
    return static_cast<Index>(row * around + i % around);
  };
  for (int row = 0; row <= rows; ++row)
    for (int i = 0; i < around; ++i)
      ring_point(kTau * i / around, radius, half_height * (2 * row - rows) / rows);
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < around; ++i) {
      faces.push_back({side(row, i), side(row, i + 1), side(row + 1, i + 1)});
      faces.push_back({side(row, i), side(row + 1, i + 1), side(row + 1, i)});
    }
  for (const bool top : {false, true}) {
    const auto centre = static_cast<Index>(positions.size());
    positions.emplace_back(0, top ? half_height : -half_height, 0);
    for (int k = 1; k < n; ++k)
      for (int i = 0; i < 6 * k; ++i)
        ring_point(kTau * i / (6 * k), radius * k / n, top ? half_height : -half_height);
    const auto vertex = [&](int k, int i) {
      if (k == 0) return centre;
      if (k == n) return side(top ? rows : 0, i);
      return centre + 1 + static_cast<Index>(3 * k * (k - 1) + i % (6 * k));
    };
    const auto add = [&](Index a, Index b, Index c) {
      faces.push_back(top ? Face{a, b, c} : Face{a, c, b});
    };
    for (int k = 1; k <= n; ++k)
      for (int sector = 0; sector < 6; ++sector)
        for (int i = 0; i < k; ++i) {
          const int outer = sector * k + i, inner = sector * (k - 1) + i;
          add(vertex(k, outer), vertex(k, outer + 1), vertex(k - 1, inner));
          if (i + 1 < k) add(vertex(k - 1, inner), vertex(k, outer + 1), vertex(k - 1, inner + 1));
        }
  }
  return {std::move(positions), std::move(faces)};
}

TriangleMesh make_noisy_cube(int n, double fraction, bool two_sided, std::uint64_t seed) {
  TriangleMesh cube = make_box(n, n, n, Vec3::Constant(kCubeHalfSize));
  const std::vector<Vec3> normals = angle_weighted_normals(cube);
  std::vector<Vec3> positions(cube.positions().begin(), cube.positions().end());
  Random random(seed);
  for (std::size_t v = 0; v < positions.size(); ++v)
    positions[v] +=
        2 * kCubeHalfSize * random.uniform(two_sided ? -fraction : 0.0, fraction) * normals[v];
  return cube.with_positions(std::move(positions));
}

Vec3 moebius_point(double along, double w) {
  const double ring = 0.7 + w * std::cos(along / 2);
  return {ring * std::cos(along), ring * std::sin(along), w * std::sin(along / 2)};
}

TriangleMesh make_moebius_strip(int n) {
  const int across = std::max(1, n / 8);
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  const auto vertex = [n, across](int i, int j) {
    if (i == n) return static_cast<Index>(across - j);
    return static_cast<Index>(i * (across + 1) + j);
  };
  for (int i = 0; i < n; ++i) {
    const double u = kTau * i / n;
    for (int j = 0; j <= across; ++j)
      positions.push_back(moebius_point(u, 0.3 * (2.0 * j / across - 1)));
    for (int j = 0; j < across; ++j) {
      faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return {std::move(positions), std::move(faces)};
}

TriangleMesh make_grid(int n) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  const auto vertex = [n](int i, int j) { return static_cast<Index>(j * (n + 1) + i); };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) positions.emplace_back((2.0 * i - n) / n, (2.0 * j - n) / n, 0.0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return {std::move(positions), std::move(faces)};
}

TriangleMesh make_two_spheres(int n) {
  const TriangleMesh sphere = make_sphere(n, 0.45);
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (const double x : {-0.55, 0.55}) {
    const auto first = static_cast<Index>(positions.size());
    for (const Vec3& p : sphere.positions()) positions.push_back(p + Vec3(x, 0, 0));
    for (const Face& f : sphere.faces())
      faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  }
  return {std::move(positions), std::move(faces)};
}

}  // namespace mimicry
