#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/mesh/connect.h>
#include <mimicry/mesh/shapes.h>

#include "bake/quality.h"
#include "messy/messy_meshes.h"
#include "support/sanitized.h"

namespace mimicry {
namespace {

double volume(const Embedding& e, const std::array<Index, 4>& t) {
  const Vec3& a = e.positions[at(t[0])];
  return (e.positions[at(t[1])] - a)
             .cross(e.positions[at(t[2])] - a)
             .dot(e.positions[at(t[3])] - a) /
         6.0;
}

// What every bake promises.
void expect_sound(const TriangleMesh& given, const Embedding& e) {
  const TriangleMesh mesh = connect(given).mesh;
  ASSERT_EQ(e.mesh_vertex_count, mesh.vertex_count());
  ASSERT_EQ(e.values.size(), e.positions.size() * at(e.dimension));
  for (Index v = 0; v < mesh.vertex_count(); ++v) ASSERT_EQ(e.positions[at(v)], mesh.position(v));
  ASSERT_FALSE(e.tets.empty());
  for (const auto& t : e.tets) {
    for (const Index v : t) ASSERT_TRUE(v >= 0 && v < e.vertex_count());
    ASSERT_GT(volume(e, t), 0.0);
  }
  for (const double x : e.values) ASSERT_TRUE(std::isfinite(x));
  EXPECT_GT(e.quality.samples, 0);
  EXPECT_TRUE(std::isfinite(e.quality.stress));
}

// Values of the embedding at p, by exhaustive search for its tetrahedra: several where these
// overlap; empty outside.
std::vector<std::vector<double>> values_at(const Embedding& e, const Vec3& p) {
  std::vector<std::vector<double>> values;
  double deepest = -1e-9;
  for (std::size_t i = 0; i < e.tets.size(); ++i) {
    const auto& t = e.tets[i];
    Eigen::Matrix3d m;
    for (int k = 0; k < 3; ++k) m.col(k) = e.positions[at(t[at(k + 1)])] - e.positions[at(t[0])];
    const Vec3 b = m.inverse() * (p - e.positions[at(t[0])]);
    const Eigen::Vector4d bary(1.0 - b.sum(), b[0], b[1], b[2]);
    if (!(bary.minCoeff() >= deepest)) continue;
    const bool overlaps = i >= e.tets.size() - at(e.overlapping_tets);
    if (!overlaps) deepest = bary.minCoeff();
    std::vector<double> value(at(e.dimension), 0.0);
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t c = 0; c < value.size(); ++c)
        value[c] += bary[static_cast<Eigen::Index>(k)] * e.values[at(t[k]) * value.size() + c];
    values.push_back(value);
  }
  return values;
}

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

TEST(Bake, FacesOfTheMeshStandInTheShell) {
  // On a face the embedding must be the linear interpolation of the corners' values.
  const std::vector<NamedMesh> shapes = {{"box", make_box(3, 4, 5, {0.5, 0.6, 0.7})},
                                         {"torus", make_torus(14, 8)},
                                         {"trefoil", make_trefoil(4)},
                                         {"noisy cube", make_noisy_cube(4, 0.2, false, 2)}};
  for (const auto& [name, mesh] : shapes) {
    SCOPED_TRACE(name);
    const Embedding e = bake(mesh, {.samples = 60});
    expect_sound(mesh, e);
    EXPECT_FALSE(e.quality.is_lattice);
    EXPECT_EQ(e.quality.missing_edges, 0);
    EXPECT_EQ(e.quality.pierced_faces, 0);
    for (Index f = 0; f < mesh.face_count(); f += 17)
      for (const Vec3& bary : {Vec3(0.3, 0.5, 0.2), Vec3(0.9, 0.06, 0.04)}) {
        std::vector<double> expected(at(e.dimension), 0.0);
        for (std::size_t c = 0; c < expected.size(); ++c)
          for (std::size_t k = 0; k < 3; ++k)
            expected[c] += bary[static_cast<Eigen::Index>(k)] *
                           e.values[at(mesh.face(f)[k]) * expected.size() + c];
        double off = kInfinity;
        for (const auto& value : values_at(e, mesh.position(SurfacePoint{f, bary}))) {
          double largest = 0.0;
          for (std::size_t c = 0; c < expected.size(); ++c)
            largest = std::max(largest, std::abs(value[c] - expected[c]));
          off = std::min(off, largest);
        }
        EXPECT_LT(off, 1e-9 * e.diagonal) << "face " << f;
      }
  }
}

TEST(Bake, ShellCoversTheOffset) {
  const TriangleMesh mesh = make_torus(14, 8);
  const Embedding e = bake(mesh, {.samples = 40});
  const double reach = 0.99 * e.diagonal / 20.0;
  for (Index f = 0; f < mesh.face_count(); f += 13) {
    const Vec3 n = mesh.area_vector(f).normalized();
    const Vec3 c = mesh.position(SurfacePoint{f, {0.2, 0.3, 0.5}});
    for (const double side : {-1.0, -0.4, 0.1, 0.7, 1.0})
      EXPECT_FALSE(values_at(e, c + side * reach * n).empty()) << f << " " << side;
  }
}

TEST(Bake, PartsFarAlongTheSurfaceAreSeparate) {
  // The two sides of a plate: in its middle, at a quarter of its thickness from one, the values are
  // those of that side, moved on by the distance.
  const double half = 0.02;
  const TriangleMesh mesh = make_box(16, 12, 1, Vec3(1.0, 0.75, half));
  const Embedding e = bake(mesh, {.samples = 300});
  expect_sound(mesh, e);
  EXPECT_GT(e.overlapping_tets, 0);
  const auto distance = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t c = 0; c < a.size(); ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
    return std::sqrt(sum);
  };
  for (const double x : {-0.4, 0.05, 0.3}) {
    const auto front = values_at(e, Vec3(x, 0.1, half)), back = values_at(e, Vec3(x, 0.1, -half));
    const auto inside = values_at(e, Vec3(x, 0.1, 0.5 * half));
    ASSERT_GE(inside.size(), 2u);
    // Both are at the surface's points too; which is the side's own is told by what it is next to.
    double near_front = kInfinity, near_back = kInfinity;
    for (const auto& value : inside) {
      for (const auto& f : front) near_front = std::min(near_front, distance(value, f));
      for (const auto& b : back) near_back = std::min(near_back, distance(value, b));
    }
    EXPECT_LT(near_front, 2.0 * half);
    EXPECT_LT(near_back, 4.0 * half);
  }
  // A cube has no such parts.
  EXPECT_EQ(bake(make_box(6, 6, 6, Vec3::Constant(0.8)), {.samples = 60}).overlapping_tets, 0);
}

TEST(Bake, IsNearlyIsometricOnASheet) {
  // A flat sheet fits into R^8 without stress: the embedding is a rigid motion of it, up to the
  // error of the distances and of the least-squares mesh at the free edge.
  const TriangleMesh mesh = make_grid(8);
  const Embedding e = bake(mesh, {.samples = 81});
  expect_sound(mesh, e);
  EXPECT_LT(e.quality.stress, 1e-3);
  for (Index v = 1; v < mesh.vertex_count(); v += 5) {
    double d2 = 0.0;
    for (std::size_t c = 0; c < 8; ++c) d2 += std::pow(e.values[at(v) * 8 + c] - e.values[c], 2);
    const double d = (mesh.position(v) - mesh.position(0)).norm();
    EXPECT_NEAR(std::sqrt(d2), d, 2e-3 * d);
  }
}

TEST(Bake, SameBitsOnAnyNumberOfThreads) {
  const TriangleMesh mesh = make_sphere(5);
  const Embedding one = bake(mesh, {.samples = 100}, 1);
  const Embedding two = bake(mesh, {.samples = 100}, 2);
  EXPECT_TRUE(one.positions == two.positions);
  EXPECT_EQ(one.tets, two.tets);
  EXPECT_EQ(one.values, two.values);
}

TEST(Bake, ScaleAndPlaceDoNotMatter) {
  const TriangleMesh mesh = make_box(2, 3, 2, {0.4, 0.6, 0.3});
  const Embedding plain = bake(mesh, {.samples = 20});
  // Powers of two, so that nothing is rounded differently.
  for (const double scale : {0x1p-20, 0x1p20}) {
    std::vector<Vec3> scaled;
    for (const Vec3& p : mesh.positions()) scaled.push_back(scale * p);
    const TriangleMesh other = mesh.with_positions(scaled);
    const Embedding e = bake(other, {.samples = 20});
    EXPECT_EQ(e.tets, plain.tets);
    ASSERT_EQ(e.values.size(), plain.values.size());
    for (std::size_t k = 0; k < e.values.size(); ++k)
      ASSERT_EQ(e.values[k], scale * plain.values[k]);
  }
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Vec3> p(a.positions().begin(), a.positions().end());
  std::vector<Face> f(a.faces().begin(), a.faces().end());
  p.insert(p.end(), b.positions().begin(), b.positions().end());
  for (Face face : b.faces()) {
    for (Index& v : face) v += a.vertex_count();
    f.push_back(face);
  }
  return TriangleMesh(p, f);
}

TriangleMesh moved(const TriangleMesh& mesh, const Vec3& by) {
  std::vector<Vec3> p(mesh.positions().begin(), mesh.positions().end());
  for (Vec3& x : p) x += by;
  return mesh.with_positions(p);
}

std::vector<NamedMesh> bad_meshes() {
  std::vector<NamedMesh> out;
  const TriangleMesh grid = make_grid(5);
  out.push_back({"one triangle", TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 1, 2}})});
  out.push_back({"open sheet", grid});
  out.push_back({"two components", make_two_spheres(2)});
  out.push_back({"thin plate", make_box(5, 5, 1, {1.0, 1.0, 1e-4})});
  out.push_back({"doubled sheet", joined(grid, grid)});
  {
    // The other diagonal on the second sheet.
    std::vector<Vec3> p(grid.positions().begin(), grid.positions().end());
    for (Vec3& x : p) x = Vec3(-x.x(), x.y(), x.z());
    out.push_back({"doubled sheet, other diagonals", joined(grid, grid.with_positions(p))});
  }
  out.push_back(
      {"crossing boxes", joined(make_box(3, 3, 3, {0.5, 0.5, 0.5}),
                                moved(make_box(3, 3, 3, {0.5, 0.5, 0.5}), {0.31, 0.17, 0.23}))});
  out.push_back({"noisy cube", make_noisy_cube(5, 0.2, false, 3)});
  out.push_back({"noisy cube, two-sided", make_noisy_cube(5, 0.2, true, 4)});
  out.push_back({"Moebius strip", make_moebius_strip(10)});
  out.push_back(
      {"needles",
       TriangleMesh(
           {{0, 0, 0}, {1, 0, 0}, {1, 1e-6, 0}, {0, 1e-6, 1e-7}, {0.5, 1, 0}, {0.5, -1, 0.2}},
           {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {1, 0, 5}})});
  out.push_back({"coarse box", make_box(1, 1, 1, {1.0, 0.5, 0.3})});
  {
    // A lonely vertex, a face without area, a face named twice.
    std::vector<Vec3> p(grid.positions().begin(), grid.positions().end());
    std::vector<Face> f(grid.faces().begin(), grid.faces().end());
    p.emplace_back(0.3, 0.2, 1.5);
    f.push_back({0, 1, 2});
    f.push_back(f.front());
    f.push_back({3, 3, 4});
    out.push_back({"odds and ends", TriangleMesh(p, f)});
  }
  {
    // Three sheets on one edge.
    out.push_back({"non-manifold edge",
                   TriangleMesh({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0.2, 0}, {0, 1, 0.4}},
                                {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}})});
  }
  return out;
}

TEST(Bake, NeverFailsOnBadMeshes) {
  for (const NamedMesh& bad : bad_meshes()) {
    SCOPED_TRACE(bad.name);
    Embedding e;
    ASSERT_NO_THROW(e = bake(bad.mesh, {.samples = 50, .offset = 0.2}));
    expect_sound(bad.mesh, e);
  }
}

TEST(Bake, MessyMeshesStayWithinTheirSize) {
  // Sizes and counts, which time and memory go with; bench/bake_budget_bench measures these.
  // Every third kind (ninth, with sanitizers), in a thick shell, keeps this quick; the fuzz target
  // goes on from there.
  constexpr std::size_t kEvery = test::kSanitized ? 9 : 3;
  for (std::size_t k = 0; k < messy::families().size(); k += kEvery) {
    const messy::Family& family = messy::families()[k];
    SCOPED_TRACE(family.name);
    const TriangleMesh mesh = family.make(40, 5);
    Embedding e;
    ASSERT_NO_THROW(e = bake(mesh, {.samples = 12, .offset = 0.5}, 2));
    expect_sound(mesh, e);
    EXPECT_LT(e.vertex_count(), 80000 + 5 * mesh.face_count());
    EXPECT_LT(static_cast<double>(e.vertex_count()) * e.quality.ls_mesh_iterations,
              20e6 + 800.0 * mesh.face_count());
  }
}

TEST(Bake, AMeshThatCrossesItselfEverywhereGetsTheLatticeAtOnce) {
  const TriangleMesh soup = messy::families()[0].make(400, 6);
  const Embedding e = bake(soup, {.samples = 30, .offset = 0.15});
  expect_sound(soup, e);
  EXPECT_TRUE(e.quality.is_lattice);
  EXPECT_EQ(e.quality.shell_rounds, 0);
  EXPECT_EQ(e.quality.missing_edges + e.quality.pierced_faces, 0);
  EXPECT_GT(e.quality.crossing_faces, 100);
}

TEST(Bake, AFlatPolygonThatLiesOnItselfIsSmall) {
  // An L, cut into a fan as if it were convex: two of its faces lie on each other. No tetrahedra
  // hold both.
  const TriangleMesh mesh({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
                          {{2, 3, 4}, {2, 4, 5}, {2, 5, 0}, {2, 0, 1}});
  const Embedding e = bake(mesh);
  expect_sound(mesh, e);
  EXPECT_LT(e.tets.size(), 60000u);
}

TEST(Bake, VerticesAtOnePlaceShareTheirValue) {
  // Two boxes that touch stay two: the nine vertices of each at their common side.
  const TriangleMesh box = make_box(2, 2, 2, {0.5, 0.5, 0.5});
  const TriangleMesh mesh = joined(box, moved(box, {1.0, 0.0, 0.0}));
  const Embedding e = bake(mesh, {.samples = 30});
  EXPECT_EQ(e.mesh_vertex_count, 2 * box.vertex_count());
  EXPECT_EQ(e.quality.joined_vertices, 9);
  int compared = 0;
  for (Index v = 0; v < box.vertex_count(); ++v)
    for (Index w = box.vertex_count(); w < mesh.vertex_count(); ++w) {
      if (mesh.position(v) != mesh.position(w)) continue;
      ++compared;
      for (std::size_t c = 0; c < 8; ++c)
        EXPECT_EQ(e.values[at(v) * 8 + c], e.values[at(w) * 8 + c]);
    }
  EXPECT_EQ(compared, 9);
}

TEST(Bake, RefusesWhatHasNoSurface) {
  EXPECT_THROW(bake(TriangleMesh()), Error);
  EXPECT_THROW(bake(TriangleMesh({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}})), Error);
  EXPECT_THROW(bake(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}, {{0, 1, 2}})), Error);
  const TriangleMesh mesh = make_grid(2);
  EXPECT_THROW(bake(mesh, {.dimension = 2}), Error);
  EXPECT_THROW(bake(mesh, {.dimension = 9}), Error);  // no projector takes it
  EXPECT_THROW(bake(mesh, {.samples = 9}), Error);
  EXPECT_THROW(bake(make_box(4, 4, 4, Vec3::Ones()), {.offset = 1e-3}), Error);  // too many cells
  EXPECT_THROW(bake(mesh, {.offset = 0.0}), Error);
}

TEST(Bake, StagesComeInOrderAndEachCanBeCancelled) {
  const TriangleMesh mesh = make_grid(3);
  std::vector<std::string> stages;
  bake(mesh, {}, 1, [&](const Progress& p) {
    EXPECT_GE(p.fraction, 0.0);
    EXPECT_LE(p.fraction, 1.0);
    if (stages.empty() || stages.back() != p.stage) stages.emplace_back(p.stage);
    return true;
  });
  EXPECT_EQ(stages,
            (std::vector<std::string>{"shell", "samples", "distances", "mds", "ls-mesh", "done"}));
  for (const std::string& stage : stages) {
    try {
      bake(mesh, {}, 2, [&](const Progress& p) { return p.stage != stage; });
      ADD_FAILURE() << stage;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::cancelled);
    }
  }
}

TEST(Bake, OtherDimensions) {
  const TriangleMesh mesh = make_sphere(2);
  for (const int dimension : {3, 7}) {
    const Embedding e = bake(mesh, {.dimension = dimension, .samples = 30});
    EXPECT_EQ(e.dimension, dimension);
    expect_sound(mesh, e);
  }
}

TEST(Quality, SliverPercentOfKnownTetrahedra) {
  Values x(5, 4);
  x << 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.3, 0.3, 0.001, 0;
  const std::vector<Tet> good = {{0, 1, 2, 3}};
  EXPECT_EQ(sliver_percent(good, x), 0.0);
  // A cap: its three angles at the base are small, the three others nearly flat.
  const std::vector<Tet> flat = {{0, 1, 2, 4}};
  EXPECT_EQ(sliver_percent(flat, x), 100.0);
  const std::vector<Tet> both = {{0, 1, 2, 3}, {0, 1, 2, 4}};
  EXPECT_EQ(sliver_percent(both, x), 50.0);
}

}  // namespace
}  // namespace mimicry
