#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/validation.h>

namespace mimicry {
namespace {

struct Expected {
  std::string name;
  Index euler;
  Index components;
  bool closed;
};

class BuiltinShape : public testing::TestWithParam<Expected> {};

TEST_P(BuiltinShape, HasItsTopologyAndFacesOutward) {
  const Expected& expected = GetParam();
  const ShapeInfo* info = find_shape(expected.name);
  ASSERT_NE(info, nullptr);
  for (const int resolution : {info->least_resolution, 3, 4, info->default_resolution}) {
    SCOPED_TRACE(resolution);
    if (resolution < info->least_resolution) continue;
    const TriangleMesh mesh = make_shape(expected.name, {.resolution = resolution});
    const MeshReport report = validate(mesh);
    EXPECT_EQ(report.euler, expected.euler);
    EXPECT_EQ(report.components.size(), static_cast<std::size_t>(expected.components));
    EXPECT_EQ(report.is_closed(), expected.closed);
    EXPECT_EQ(report.is_manifold(), HalfEdges(mesh).is_manifold());
    EXPECT_EQ(report.degenerate_faces.count, 0);
    EXPECT_EQ(report.duplicate_faces.count, 0);
    EXPECT_EQ(report.isolated_vertices.count, 0);
    EXPECT_EQ(report.invalid_vertices.count, 0);
    if (expected.closed) {
      EXPECT_GT(report.volume.value(), 0);
      EXPECT_EQ(report.genus, (2 * expected.components - expected.euler) / 2);
    }
    EXPECT_LT(report.box.center().norm(), 0.5);
    // At the display scale an object of 0.3 to 0.6 m.
    if (resolution == info->default_resolution) {
      EXPECT_GE(report.box.sizes().maxCoeff() * info->metres_per_unit, 0.3);
      EXPECT_LE(report.box.sizes().maxCoeff() * info->metres_per_unit, 0.6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BuiltinShape,
    testing::Values(Expected{"sphere", 2, 1, true}, Expected{"torus", 0, 1, true},
                    Expected{"cube", 2, 1, true}, Expected{"rounded-cube", 2, 1, true},
                    Expected{"cylinder", 2, 1, true}, Expected{"trefoil", 0, 1, true},
                    Expected{"plate", 2, 1, true}, Expected{"hand", 2, 1, true},
                    Expected{"double-torus", -2, 1, true}, Expected{"noisy-cube", 2, 1, true},
                    Expected{"moebius", 0, 1, false}, Expected{"grid", 1, 1, false},
                    Expected{"two-spheres", 4, 2, true}),
    [](const auto& shape) {
      std::string name = shape.param.name;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

TEST(Shapes, EveryRegisteredShapeIsCovered) {
  EXPECT_EQ(builtin_shapes().size(), 13u);
}

TEST(Shapes, CountsFollowTheFormulas) {
  EXPECT_EQ(make_shape("torus", {.resolution = kLargeTorusResolution}).face_count(), 86400);
  EXPECT_EQ(make_shape("torus", {.resolution = 24}).face_count(), 3456);
  EXPECT_EQ(make_shape("cube", {.resolution = 16}).vertex_count(), 1538);
  EXPECT_EQ(make_shape("cube", {.resolution = 16}).face_count(), 3072);
  EXPECT_EQ(make_shape("sphere", {.resolution = 7}).face_count(), 20 * 49);
  EXPECT_EQ(make_shape("sphere", {.resolution = 7}).vertex_count(), 10 * 49 + 2);
  EXPECT_EQ(make_shape("trefoil", {.resolution = 10}).face_count(), 2000);
}

TEST(Shapes, VolumesApproachTheIdealOnes) {
  // Inscribed facets lose a fraction of the order of (segment angle)^2.
  const double pi = std::numbers::pi;
  const auto volume = [](std::string_view name, int n) {
    return validate(make_shape(name, {.resolution = n})).volume.value();
  };
  EXPECT_NEAR(volume("sphere", 32) / (4 * pi / 3), 1, 2e-3);
  EXPECT_NEAR(volume("torus", 60) /
                  (2 * pi * pi * kTorusMajorRadius * kTorusMinorRadius * kTorusMinorRadius),
              1, 3e-3);
  EXPECT_NEAR(
      volume("cylinder", 16) / (2 * pi * kCylinderRadius * kCylinderRadius * kCylinderHalfHeight),
      1, 1e-3);
  EXPECT_NEAR(volume("cube", 5), 8 * std::pow(kCubeHalfSize, 3), 1e-12);
  EXPECT_NEAR(volume("plate", 5), 8 * kPlateHalfWidth * kPlateHalfHeight * kPlateHalfThickness,
              1e-12);
}

TEST(Shapes, NoThinTriangles) {
  // Smallest angle over the default meshes of the smooth shapes.
  for (const auto& [name, least_degrees] : {std::pair{"sphere", 45.0},
                                            {"torus", 25.0},
                                            {"cylinder", 30.0},
                                            {"trefoil", 15.0},
                                            {"hand", 8.0},
                                            {"double-torus", 15.0},
                                            {"rounded-cube", 15.0},
                                            {"cube", 44.9}}) {
    const TriangleMesh mesh = make_shape(name);
    double smallest = 180;
    for (Index f = 0; f < mesh.face_count(); ++f)
      for (int k = 0; k < 3; ++k) {
        const Vec3 a = mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k);
        const Vec3 b = mesh.corner(f, (k + 2) % 3) - mesh.corner(f, k);
        smallest =
            std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
      }
    EXPECT_GT(smallest, least_degrees) << name;
  }
}

TEST(Shapes, FacesStayWithinTheFacetingError) {
  Random random(7);
  for (const char* name : {"sphere", "torus", "cube", "cylinder", "plate", "rounded-cube"})
    for (const int n : {4, 12}) {
      SCOPED_TRACE(name);
      const TriangleMesh mesh = make_shape(name, {.resolution = n});
      const double bound = faceting_error(name, n).value();
      double largest = 0;
      for (Index f = 0; f < mesh.face_count(); ++f)
        for (int i = 0; i < 4; ++i) {
          double u = random.uniform(), v = random.uniform();
          if (u + v > 1) u = 1 - u, v = 1 - v;
          const Vec3 x = mesh.position({f, Vec3(1 - u - v, u, v)});
          largest = std::max(largest, (analytic_closest_point(name, x).value() - x).norm());
        }
      for (const Vec3& p : mesh.positions())
        EXPECT_NEAR((analytic_closest_point(name, p).value() - p).norm(), 0, 1e-14);
      // The bound holds and is no more than 5 times too large.
      EXPECT_LE(largest, bound + 1e-14);
      EXPECT_GE(largest, bound / 5);
    }
}

TEST(Shapes, AnalyticClosestPointIsClosestAmongSurfaceSamples) {
  Random random(11);
  for (const char* name : {"sphere", "torus", "cube", "cylinder", "plate", "rounded-cube"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = make_shape(name, {.resolution = 12});
    for (int i = 0; i < 100; ++i) {
      const Vec3 x(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
      const Vec3 c = analytic_closest_point(name, x).value();
      // The answer lies on the surface, and no vertex (all lie on it) is closer.
      EXPECT_NEAR((analytic_closest_point(name, c).value() - c).norm(), 0, 1e-12);
      double closest = kInfinity;
      for (const Vec3& p : mesh.positions()) closest = std::min(closest, (p - x).norm());
      EXPECT_LE((c - x).norm(), closest + 1e-12);
    }
  }
}

TEST(Shapes, NoiseStaysWithinItsFractionAndFollowsTheSeed) {
  const TriangleMesh cube = make_shape("cube");
  for (const bool two_sided : {false, true}) {
    const TriangleMesh noisy =
        make_shape("noisy-cube", {.seed = 5, .noise = 0.2, .two_sided = two_sided});
    double least = kInfinity, most = -kInfinity;
    for (Index v = 0; v < cube.vertex_count(); ++v) {
      const Vec3 d = noisy.position(v) - cube.position(v);
      const double outward = d.dot(cube.position(v)) > 0 ? d.norm() : -d.norm();
      least = std::min(least, outward / (2 * kCubeHalfSize));
      most = std::max(most, outward / (2 * kCubeHalfSize));
    }
    // 1,538 samples reach within 1 % of the range's ends.
    EXPECT_LE(most, 0.2 + 1e-12);
    EXPECT_GT(most, 0.197);
    EXPECT_GE(least, (two_sided ? -0.2 : 0.0) - 1e-12);
    EXPECT_LT(least, two_sided ? -0.196 : 0.002);
  }
  const auto first = make_noisy_cube(8, 0.1, false, 1);
  const auto again = make_noisy_cube(8, 0.1, false, 1);
  const auto other = make_noisy_cube(8, 0.1, false, 2);
  EXPECT_TRUE(
      std::equal(first.positions().begin(), first.positions().end(), again.positions().begin()));
  EXPECT_FALSE(
      std::equal(first.positions().begin(), first.positions().end(), other.positions().begin()));
}

TEST(Shapes, UnknownNamesAndResolutionsOutOfRangeAreRefused) {
  const auto message = [](std::string_view name, const ShapeOptions& options) -> std::string {
    try {
      make_shape(name, options);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::invalid_input);
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(message("teapot", {}), testing::HasSubstr("sphere, torus, cube"));
  EXPECT_THAT(message("torus", {.resolution = 2}), testing::HasSubstr("within 3 to"));
  EXPECT_THAT(message("hand", {.resolution = 7}), testing::HasSubstr("within 1 to 6"));
  EXPECT_THAT(message("hand", {.resolution = -1}), testing::HasSubstr("within 1 to 6"));
  EXPECT_THAT(message("noisy-cube", {.noise = 1.5}), testing::HasSubstr("noise"));
  EXPECT_THAT(message("noisy-cube", {.noise = std::nan("")}), testing::HasSubstr("noise"));
}

TEST(Random, MomentsAndRepeatability) {
  Random random(42), same(42), other_stream(42, 1);
  double sum = 0, squares = 0, normal_sum = 0, normal_squares = 0;
  constexpr int kCount = 20000;
  int equal = 0;
  for (int i = 0; i < kCount; ++i) {
    const double u = random.uniform();
    EXPECT_EQ(u, same.uniform());
    equal += u == other_stream.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    squares += u * u;
  }
  for (int i = 0; i < kCount; ++i) {
    const double z = random.normal();
    normal_sum += z;
    normal_squares += z * z;
  }
  EXPECT_EQ(equal, 0);
  // Five standard errors: uniform mean 0.29 / sqrt(n), normal mean 1 / sqrt(n), variance sqrt(2/n).
  EXPECT_NEAR(sum / kCount, 0.5, 0.0103);
  EXPECT_NEAR(squares / kCount, 1.0 / 3, 0.0106);
  EXPECT_NEAR(normal_sum / kCount, 0, 0.036);
  EXPECT_NEAR(normal_squares / kCount, 1, 0.05);
  // PCG32's published first outputs for seed 42, sequence 54.
  Random reference(42, 54);
  EXPECT_EQ(reference.bits(), 0xa15c02b7u);
  EXPECT_EQ(reference.bits(), 0x7b47f409u);
}

}  // namespace
}  // namespace mimicry
