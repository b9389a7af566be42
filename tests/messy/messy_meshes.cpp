#include "messy/messy_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <mimicry/base/random.h>
#include <mimicry/mesh/shapes.h>

namespace mimicry::messy {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

class Builder {
 public:
  Index vertex(const Vec3& p) {
    positions_.push_back(p);
    return static_cast<Index>(positions_.size()) - 1;
  }
  void face(Index a, Index b, Index c) { faces_.push_back({a, b, c}); }
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Index first = vertex(a);
    vertex(b);
    vertex(c);
    face(first, first + 1, first + 2);
  }
  void quad(Index a, Index b, Index c, Index d) {
    face(a, b, c);
    face(a, c, d);
  }
  void append(const TriangleMesh& mesh, double scale, const Vec3& by) {
    const auto first = static_cast<Index>(positions_.size());
    for (const Vec3& p : mesh.positions()) positions_.emplace_back(scale * p + by);
    for (const Face& f : mesh.faces()) face(first + f[0], first + f[1], first + f[2]);
  }
  // rows by columns of points, joined by quads.
  template <class Point>
  void sheet(int rows, int columns, Point&& point) {
    const auto first = static_cast<Index>(positions_.size());
    for (int i = 0; i <= rows; ++i)
      for (int j = 0; j <= columns; ++j) vertex(point(i, j));
    const int width = columns + 1;
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const Index a = first + i * width + j;
        quad(a, a + width, a + width + 1, a + 1);
      }
  }
  Index faces() const { return static_cast<Index>(faces_.size()); }
  TriangleMesh done() { return TriangleMesh(std::move(positions_), std::move(faces_)); }

 private:
  std::vector<Vec3> positions_;
  std::vector<Face> faces_;
};

Vec3 in_cube(Random& random) {
  const double x = random.uniform(), y = random.uniform();
  return Vec3(x, y, random.uniform()) - Vec3::Constant(0.5);
}

Vec3 direction(Random& random) {
  const double x = random.normal(), y = random.normal();
  const Vec3 d(x, y, random.normal());
  return d.norm() > 0.0 ? Vec3(d.normalized()) : Vec3(1.0, 0.0, 0.0);
}

int square_side(Index faces) {
  return std::max(1, static_cast<int>(std::sqrt(0.5 * faces)));
}

TriangleMesh large_soup(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  while (b.faces() < faces) {
    const Vec3 p = in_cube(random), q = in_cube(random);
    b.triangle(p, q, in_cube(random));
  }
  return b.done();
}

TriangleMesh small_soup(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  while (b.faces() < faces) {
    const Vec3 centre = in_cube(random);
    const Vec3 p = centre + 0.05 * in_cube(random), q = centre + 0.05 * in_cube(random);
    b.triangle(p, q, centre + 0.05 * in_cube(random));
  }
  return b.done();
}

// Few vertices, any three of them a face.
TriangleMesh random_faces(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  const auto vertices = static_cast<std::uint32_t>(std::max<Index>(4, faces / 2));
  for (std::uint32_t v = 0; v < vertices; ++v) b.vertex(in_cube(random));
  while (b.faces() < faces) {
    const auto p = static_cast<Index>(random.below(vertices));
    const auto q = static_cast<Index>(random.below(vertices));
    b.face(p, q, static_cast<Index>(random.below(vertices)));
  }
  return b.done();
}

TriangleMesh overlapping_tetrahedra(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  do {
    const Vec3 centre = in_cube(random);
    const double size = random.uniform(0.05, 0.5);
    std::array<Index, 4> v;
    for (Index& x : v) x = b.vertex(centre + size * in_cube(random));
    b.face(v[0], v[1], v[2]);
    b.face(v[0], v[2], v[3]);
    b.face(v[0], v[3], v[1]);
    b.face(v[1], v[3], v[2]);
  } while (b.faces() < faces);
  return b.done();
}

TriangleMesh overlapping_boxes(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  do {
    const Vec3 half = 0.3 * (in_cube(random) + Vec3::Constant(0.6));
    b.append(make_box(1, 1, 1, half), 1.0, in_cube(random));
  } while (b.faces() < faces);
  return b.done();
}

TriangleMesh needles(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  while (b.faces() < faces) {
    const Vec3 p = in_cube(random), q = in_cube(random);
    b.triangle(p, q, p + 1e-6 * direction(random));
  }
  return b.done();
}

TriangleMesh squeezed_sphere(Index faces, std::uint64_t) {
  const TriangleMesh sphere = make_sphere(std::max(1, static_cast<int>(std::sqrt(faces / 20.0))));
  std::vector<Vec3> p(sphere.positions().begin(), sphere.positions().end());
  for (Vec3& x : p) x = Vec3(x.x(), 1e-3 * x.y(), 1e-6 * x.z());
  return sphere.with_positions(std::move(p));
}

// Sheets that lie on each other but for rounding, cut along either diagonal.
TriangleMesh coincident_sheets(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  const int n = square_side(faces / 4);
  for (int k = 0; k < 4; ++k)
    b.sheet(n, n, [&](int i, int j) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      return Vec3(k % 2 == 0 ? x : 1.0 - x, y, 1e-8 * random.uniform());
    });
  return b.done();
}

TriangleMesh stacked_sheets(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  constexpr int kSheets = 50;
  const int n = square_side(faces / kSheets);
  for (int k = 0; k < kSheets; ++k)
    b.sheet(n, n, [&](int i, int j) {
      return Vec3(static_cast<double>(i) / n, static_cast<double>(j) / n,
                  2e-3 * k + 5e-4 * random.uniform());
    });
  return b.done();
}

TriangleMesh roll(Index faces, std::uint64_t) {
  Builder b;
  constexpr double kTurns = 40.0;
  const int rows = std::max(4, faces / 8);
  b.sheet(rows, 4, [&](int i, int j) {
    const double t = static_cast<double>(i) / rows;
    const double r = 0.05 + 0.45 * t;
    return Vec3(r * std::cos(kTwoPi * kTurns * t), r * std::sin(kTwoPi * kTurns * t), 0.25 * j);
  });
  return b.done();
}

TriangleMesh many_components(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  const double size = 0.15 / std::cbrt(std::max(1.0, faces / 20.0));
  do b.append(make_sphere(1), size, in_cube(random));
  while (b.faces() < faces);
  return b.done();
}

TriangleMesh dust(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  while (b.faces() < faces) {
    const Vec3 p = in_cube(random);
    b.triangle(p, p + 1e-4 * direction(random), p + 1e-4 * direction(random));
  }
  return b.done();
}

TriangleMesh cone(Index faces, double height) {
  Builder b;
  const Index apex = b.vertex({0.0, 0.0, height});
  for (Index k = 0; k < faces; ++k) {
    const double angle = kTwoPi * k / std::max<Index>(faces, 1);
    b.vertex({std::cos(angle), std::sin(angle), 0.0});
  }
  for (Index k = 0; k < faces; ++k) b.face(apex, 1 + k, 1 + (k + 1) % faces);
  return b.done();
}

TriangleMesh flat_fan(Index faces, std::uint64_t) {
  return cone(std::max<Index>(faces, 3), 0.0);
}

TriangleMesh steep_cone(Index faces, std::uint64_t) {
  return cone(std::max<Index>(faces, 3), 3.0);
}

// Triangles in all directions around one vertex.
TriangleMesh bouquet(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  const Index centre = b.vertex(Vec3::Zero());
  while (b.faces() < faces) {
    const Vec3 d = direction(random);
    const Index p = b.vertex(0.5 * d);
    b.face(centre, p, b.vertex(0.5 * d + 0.1 * in_cube(random)));
  }
  return b.done();
}

// A sphere around a vertex, to which every other edge is joined as well.
TriangleMesh hub(Index faces, std::uint64_t) {
  const TriangleMesh sphere = make_sphere(std::max(1, static_cast<int>(std::sqrt(faces / 50.0))));
  Builder b;
  b.append(sphere, 0.5, Vec3::Zero());
  const Index centre = b.vertex(Vec3::Zero());
  for (const Face& f : sphere.faces()) {
    if (f[0] < f[1]) b.face(centre, f[0], f[1]);
    if (f[1] < f[2]) b.face(centre, f[1], f[2]);
    if (f[2] < f[0]) b.face(centre, f[2], f[0]);
  }
  return b.done();
}

TriangleMesh spiky_ball(Index faces, std::uint64_t) {
  const TriangleMesh sphere = make_sphere(std::max(1, static_cast<int>(std::sqrt(faces / 20.0))));
  std::vector<Vec3> p(sphere.positions().begin(), sphere.positions().end());
  for (std::size_t v = 0; v < p.size(); ++v)
    if (v % 2 == 0) p[v] *= 0.1;
  return sphere.with_positions(std::move(p));
}

TriangleMesh spikes(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  const int n = square_side(faces);
  b.sheet(n, n, [&](int i, int j) {
    return Vec3(static_cast<double>(i) / n, static_cast<double>(j) / n,
                random.below(5) == 0 ? random.uniform() : 0.0);
  });
  return b.done();
}

TriangleMesh crumpled_sphere(Index faces, std::uint64_t seed) {
  Random random(seed);
  const TriangleMesh sphere = make_sphere(std::max(1, static_cast<int>(std::sqrt(faces / 20.0))));
  std::vector<Vec3> p(sphere.positions().begin(), sphere.positions().end());
  for (Vec3& x : p) x += 0.3 * in_cube(random);
  return sphere.with_positions(std::move(p));
}

// Cubes of a Menger sponge with all their sides: inner ones are doubled, edges have many faces.
TriangleMesh sponge(Index faces, std::uint64_t) {
  Builder b;
  const int level = faces < 300 ? 1 : faces < 5000 ? 2 : 3;
  const int n = level == 1 ? 3 : level == 2 ? 9 : 27;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z) {
        bool is_solid = true;
        for (int i = x, j = y, k = z, l = 0; l < level; ++l, i /= 3, j /= 3, k /= 3)
          is_solid = is_solid && (i % 3 == 1) + (j % 3 == 1) + (k % 3 == 1) < 2;
        if (!is_solid || b.faces() >= faces) continue;
        b.append(make_box(1, 1, 1, Vec3::Constant(0.5 / n)), 1.0, Vec3(x, y, z) / n);
      }
  return b.done();
}

TriangleMesh one_face(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  b.triangle({0, 0, 0}, {1, 0, 0}, {random.uniform(), std::pow(0.1, faces % 7), 0.0});
  return b.done();
}

// A polygon in a plane, cut into a fan from its first corner.
TriangleMesh flat_polygon(Index faces, std::uint64_t) {
  Builder b;
  const Index corners = faces + 2;
  for (Index k = 0; k < corners; ++k)
    b.vertex({std::cos(kTwoPi * k / corners), std::sin(kTwoPi * k / corners), 0.0});
  for (Index k = 0; k < faces; ++k) b.face(0, k + 1, k + 2);
  return b.done();
}

// Long teeth of a comb, cut into a fan as if the polygon were convex: faces lie on each other.
TriangleMesh flat_comb(Index faces, std::uint64_t) {
  Builder b;
  const Index corners = faces + 2;
  for (Index k = 0; k < corners; ++k)
    b.vertex({static_cast<double>(k) / corners, k % 2 == 0 ? 0.0 : 1.0, 0.0});
  for (Index k = 0; k < faces; ++k) b.face(0, k + 1, k + 2);
  return b.done();
}

TriangleMesh moebius(Index faces, std::uint64_t) {
  return make_moebius_strip(std::clamp(square_side(4 * faces), 3, 400));
}

// Long thin prisms that cross each other.
TriangleMesh hair(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  do {
    const Vec3 from = in_cube(random), to = in_cube(random);
    std::array<Index, 6> v;
    for (std::size_t k = 0; k < 6; ++k)
      v[k] = b.vertex((k < 3 ? from : to) + 2e-3 * Vec3(std::cos(kTwoPi * (k % 3) / 3.0),
                                                        std::sin(kTwoPi * (k % 3) / 3.0), 0.0));
    for (std::size_t k = 0; k < 3; ++k) b.quad(v[k], v[(k + 1) % 3], v[3 + (k + 1) % 3], v[3 + k]);
  } while (b.faces() < faces);
  return b.done();
}

// Pages around one edge.
TriangleMesh book(Index faces, std::uint64_t) {
  Builder b;
  b.vertex({0, 0, -0.5});
  b.vertex({0, 0, 0.5});
  for (Index k = 0; k < faces; ++k) {
    const double angle = kTwoPi * k / std::max<Index>(faces, 1);
    b.face(0, 1, b.vertex({std::cos(angle), std::sin(angle), 0.0}));
  }
  return b.done();
}

TriangleMesh nested_spheres(Index faces, std::uint64_t) {
  Builder b;
  constexpr int kSpheres = 20;
  const TriangleMesh sphere =
      make_sphere(std::max(1, static_cast<int>(std::sqrt(faces / (20.0 * kSpheres)))));
  for (int k = 0; k < kSpheres; ++k) b.append(sphere, 0.5 - 1e-3 * k, Vec3::Zero());
  return b.done();
}

TriangleMesh noisy_cube(Index faces, std::uint64_t seed) {
  return make_noisy_cube(std::max(1, static_cast<int>(std::sqrt(faces / 12.0))), 0.2, true, seed);
}

// Two meshes far from each other, or one of tiny faces and one of a large one: sizes that differ by
// much.
TriangleMesh fine_and_coarse(Index faces, std::uint64_t seed) {
  Random random(seed);
  Builder b;
  b.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const int n = square_side(faces);
  b.sheet(n, n, [&](int i, int j) {
    return Vec3(0.3 + 1e-3 * i / n, 0.3 + 1e-3 * j / n, 1e-4 * (random.uniform() - 0.5));
  });
  return b.done();
}

constexpr Family kFamilies[] = {
    {"large soup", large_soup},
    {"small soup", small_soup},
    {"random faces", random_faces},
    {"overlapping tetrahedra", overlapping_tetrahedra},
    {"overlapping boxes", overlapping_boxes},
    {"needles", needles},
    {"hair", hair},
    {"squeezed sphere", squeezed_sphere},
    {"coincident sheets", coincident_sheets},
    {"stacked sheets", stacked_sheets},
    {"nested spheres", nested_spheres},
    {"roll", roll},
    {"many components", many_components},
    {"dust", dust},
    {"flat fan", flat_fan},
    {"steep cone", steep_cone},
    {"bouquet", bouquet},
    {"hub", hub},
    {"book", book},
    {"spiky ball", spiky_ball},
    {"spikes", spikes},
    {"crumpled sphere", crumpled_sphere},
    {"noisy cube, two-sided", noisy_cube},
    {"fine and coarse", fine_and_coarse},
    {"sponge", sponge},
    {"one face", one_face},
    {"flat polygon", flat_polygon},
    {"flat comb", flat_comb},
    {"Moebius strip", moebius},
};

}  // namespace

std::span<const Family> families() {
  return kFamilies;
}

TriangleMesh of_bytes(std::span<const std::uint8_t> bytes) {
  std::size_t next = 0;
  const auto byte = [&]() -> std::uint8_t { return next < bytes.size() ? bytes[next++] : 0; };
  const int vertices = 3 + byte() % 10;
  const int faces = 1 + byte() % 24;
  // Steps of the grid, and small ones: slivers and nearly coincident vertices.
  const double small = std::pow(10.0, -static_cast<double>(byte() % 10));
  Builder b;
  for (int v = 0; v < vertices; ++v) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
      const std::uint8_t x = byte();
      p[k] = (x & 7) + small * (x >> 3 & 7);
    }
    b.vertex(p);
  }
  for (int f = 0; f < faces; ++f) {
    const auto corner = [&] { return static_cast<Index>(byte() % vertices); };
    const Index p = corner(), q = corner();
    b.face(p, q, corner());
  }
  return b.done();
}

}  // namespace mimicry::messy
