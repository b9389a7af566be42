#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/mimicry.h>

#include "handles.h"
#include "support/allocations.h"

namespace {

using namespace mimicry::test;
using testing::HasSubstr;

using Geodesics = std::unique_ptr<mimicry_geodesics, Destroy<mimicry_geodesics_destroy>>;
using Paths = std::unique_ptr<mimicry_path_finder, Destroy<mimicry_path_finder_destroy>>;
using ExponentialMap =
    std::unique_ptr<mimicry_exponential_map, Destroy<mimicry_exponential_map_destroy>>;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

mimicry_surface_point surface_point(const Target& target, double x, double y, double z) {
  const double query[] = {x, y, z};
  mimicry_surface_point point;
  EXPECT_EQ(mimicry_target_closest_point(target.get(), query, kInfinite, -1, &point), MIMICRY_OK);
  EXPECT_GE(point.face, 0);
  return point;
}

double distance(const double* a, const double* b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(CApiMeshes, CarryWhatTheirFileTells) {
  const std::string obj =
      "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nvt 0 0.5\nvt 1 0\ng cup\nusemtl red\n"
      "f 1/1 2/2 3/2\ng\nf 1 3 2\n";
  mimicry_mesh* made = nullptr;
  ASSERT_EQ(mimicry_mesh_read(obj.data(), obj.size(), "a.obj", &made), MIMICRY_OK);
  mimicry_mesh* mirrored = nullptr;  // faces turn, and their corners' values with them
  ASSERT_EQ(mimicry_mesh_in("unity", made, &mirrored), MIMICRY_OK);
  const std::vector<int32_t> corners = {0, 1, 1, -1, -1, -1};
  for (const mimicry_mesh* mesh : {made, mirrored}) {
    const mimicry_corner_values uv = mimicry_mesh_texcoords(mesh);
    ASSERT_EQ(uv.count, 2u);
    EXPECT_EQ(std::vector<int32_t>(uv.corners, uv.corners + 6), corners);
    EXPECT_EQ(uv.values[1], 0.5f);
    const mimicry_corner_values colors = mimicry_mesh_colors(mesh);
    ASSERT_EQ(colors.count, 3u);
    EXPECT_EQ(std::vector<int32_t>(colors.corners, colors.corners + 6),
              std::vector<int32_t>(mimicry_mesh_faces(mesh), mimicry_mesh_faces(mesh) + 6));
    EXPECT_EQ(colors.values[4 * 2 + 2], 1.0f);
    ASSERT_EQ(mimicry_mesh_label_count(mesh, MIMICRY_GROUPS), 1u);
    EXPECT_STREQ(mimicry_mesh_label_name(mesh, MIMICRY_GROUPS, 0), "cup");
    EXPECT_EQ(mimicry_mesh_label_name(mesh, MIMICRY_GROUPS, 1), nullptr);
    EXPECT_EQ(mimicry_mesh_face_labels(mesh, MIMICRY_GROUPS)[1], -1);
    EXPECT_EQ(mimicry_mesh_face_labels(mesh, MIMICRY_MATERIALS)[1], 0);
    EXPECT_EQ(mimicry_mesh_face_labels(mesh, MIMICRY_OBJECTS), nullptr);
  }
  mimicry_mesh_destroy(mirrored);
  mimicry_mesh_destroy(made);
  EXPECT_EQ(mimicry_mesh_texcoords(nullptr).corners, nullptr);
  EXPECT_EQ(mimicry_mesh_label_count(nullptr, MIMICRY_OBJECTS), 0u);
}

TEST(CApiQueries, ManyPointsEqualOneByOne) {
  const Target target = target_of("hand");
  std::vector<double> points, directions;
  for (int i = 0; i < 60; ++i)
    for (const double x : {std::sin(i), std::cos(1.3 * i), std::sin(2.1 * i)}) {
      points.push_back(x);
      directions.push_back(-x);
    }
  points[3] = kNaN;
  std::vector<mimicry_surface_point> closest(60), hits(60);
  ASSERT_EQ(mimicry_target_closest_points(target.get(), points.data(), 60, 0.9, closest.data()),
            MIMICRY_OK);
  ASSERT_EQ(
      mimicry_target_first_hits(target.get(), points.data(), directions.data(), 60, hits.data()),
      MIMICRY_OK);
  int found = 0, hit = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    mimicry_surface_point one;
    ASSERT_EQ(mimicry_target_closest_point(target.get(), &points[3 * i], 0.9, -1, &one),
              MIMICRY_OK);
    EXPECT_EQ(std::memcmp(&one, &closest[i], sizeof one), 0) << i;
    found += one.face >= 0;
    ASSERT_EQ(mimicry_target_first_hit(target.get(), &points[3 * i], &directions[3 * i], &one),
              MIMICRY_OK);
    EXPECT_EQ(std::memcmp(&one, &hits[i], sizeof one), 0) << i;
    hit += one.face >= 0;
  }
  EXPECT_GT(found, 10);
  EXPECT_LT(found, 60);
  EXPECT_GT(hit, 10);
  EXPECT_EQ(closest[1].face, -1) << "a point that is none has no closest one";

  EXPECT_EQ(mimicry_target_closest_points(target.get(), nullptr, 0, 0.9, nullptr), MIMICRY_OK);
  expect_invalid(mimicry_target_closest_points(nullptr, points.data(), 1, 1, closest.data()),
                 "target is NULL");
  expect_invalid(mimicry_target_closest_points(target.get(), nullptr, 1, 1, closest.data()),
                 "points is NULL");
  expect_invalid(mimicry_target_closest_points(target.get(), points.data(), 1, 1, nullptr),
                 "out is NULL");
  expect_invalid(
      mimicry_target_closest_points(target.get(), points.data(), 1, kNaN, closest.data()),
      "upper_bound");
  expect_invalid(
      mimicry_target_closest_points(target.get(), points.data(), 1, -1.0, closest.data()),
      "upper_bound");
  expect_invalid(mimicry_target_first_hits(target.get(), points.data(), nullptr, 1, hits.data()),
                 "directions is NULL");
}

TEST(CApiQueries, SmoothPointsNeedABake) {
  const auto mesh = make<Mesh>(mimicry_mesh_shape, "sphere", 6);
  const auto target = make<Target>(mimicry_target_make, mesh.get(), nullptr);
  const double points[] = {0, 0, 1.05, 0, 5, 0, kNaN, 0, 0};
  mimicry_surface_point out[3];
  mimicry_answer answers[3];
  expect_invalid(mimicry_target_smooth_closest_points(target.get(), points, 3, 0, out, answers),
                 "bake");

  mimicry_bake_options options = mimicry_default_bake_options();
  options.samples = 100;
  const auto baked = make<Bytes>(mimicry_bake, mesh.get(), &options, nullptr, nullptr);
  const auto smooth =
      make<Target>(mimicry_target_with_embedding, target.get(), mimicry_bytes_data(baked.get()),
                   mimicry_bytes_size(baked.get()), "sphere.mimicry");
  ASSERT_EQ(mimicry_target_smooth_closest_points(smooth.get(), points, 3, 0, out, answers),
            MIMICRY_OK);
  EXPECT_EQ(answers[0], MIMICRY_SMOOTH);
  EXPECT_NEAR(out[0].position[2], 1.0, 0.05);
  EXPECT_NEAR(out[0].distance, distance(out[0].position, points), 1e-15);
  EXPECT_EQ(answers[1], MIMICRY_OUTSIDE_SHELL);
  mimicry_surface_point closest;
  ASSERT_EQ(mimicry_target_closest_point(target.get(), points + 3, kInfinite, -1, &closest),
            MIMICRY_OK);
  EXPECT_EQ(out[1].face, closest.face);
  EXPECT_EQ(answers[2], MIMICRY_NO_POINT);
  EXPECT_EQ(out[2].face, -1);
  EXPECT_EQ(mimicry_target_smooth_closest_points(smooth.get(), points, 3, 1, out, nullptr),
            MIMICRY_OK);
  expect_invalid(mimicry_target_smooth_closest_points(smooth.get(), nullptr, 3, 0, out, nullptr),
                 "points is NULL");

  // A bake is of one shape: neither handle of the target moves now.
  expect_invalid(mimicry_target_update_positions(const_cast<mimicry_target*>(target.get()),
                                                 mimicry_mesh_positions(mesh.get()),
                                                 mimicry_mesh_vertex_count(mesh.get())),
                 "bake");
}

TEST(CApiGeodesics, DistancesAndPathsOnASphere) {
  const Target target = target_of("sphere", 16);
  const mimicry_surface_point poles[] = {surface_point(target, 0, 0, 2),
                                         surface_point(target, 2, 0, 0)};
  const auto geodesics = make<Geodesics>(mimicry_geodesics_create, target.get(), poles,
                                         std::size_t{2}, kInfinite, nullptr, nullptr);
  EXPECT_EQ(mimicry_geodesics_are_exact(geodesics.get()), 1);
  const mimicry_surface_point wanted[] = {surface_point(target, 0, 2, 0),
                                          surface_point(target, -2, 0, 0)};
  double distances[2];
  ASSERT_EQ(mimicry_geodesics_distances(geodesics.get(), wanted, 2, distances), MIMICRY_OK);
  // A quarter and half of the circle, less what the mesh's chords cut off.
  EXPECT_NEAR(distances[0], std::numbers::pi / 2, 0.01);
  EXPECT_NEAR(distances[1], std::numbers::pi / 2, 0.01);

  double length = 0.0;
  int32_t source = -1;
  ASSERT_EQ(mimicry_geodesics_find_path(geodesics.get(), &wanted[1], &length, &source), MIMICRY_OK);
  EXPECT_EQ(source, 0) << "the other pole is on the far side";
  EXPECT_NEAR(length, distances[1], 1e-9);
  const std::size_t count = mimicry_geodesics_path_count(geodesics.get());
  const mimicry_path_point* path = mimicry_geodesics_path(geodesics.get());
  ASSERT_GT(count, 10u);
  EXPECT_EQ(path[0].half_edge, -1);
  EXPECT_EQ(path[count - 1].half_edge, -1);
  EXPECT_LT(distance(path[0].position, poles[0].position), 1e-12);
  EXPECT_LT(distance(path[count - 1].position, wanted[1].position), 1e-12);
  double walked = 0.0;
  for (std::size_t i = 1; i < count; ++i) {
    walked += distance(path[i].position, path[i - 1].position);
    if (i + 1 < count) {
      EXPECT_GE(path[i].half_edge, 0);
    }
  }
  EXPECT_NEAR(walked, length, 1e-9);

  const auto vertices = mimicry_target_surface_vertex_count(target.get());
  std::vector<double> all(vertices);
  ASSERT_EQ(mimicry_geodesics_vertex_distances(geodesics.get(), all.data(), all.size()),
            MIMICRY_OK);
  for (const double d : all) EXPECT_LE(d, 0.75 * std::numbers::pi);
}

TEST(CApiGeodesics, RadiusCancellingAndBadInput) {
  const Target target = target_of("torus", 64);
  const mimicry_surface_point from = surface_point(target, 2, 0, 0),
                              to = surface_point(target, -2, 0, 0);
  const auto some = make<Geodesics>(mimicry_geodesics_create, target.get(), &from, std::size_t{1},
                                    0.3, nullptr, nullptr);
  double far = 0.0;
  ASSERT_EQ(mimicry_geodesics_distances(some.get(), &to, 1, &far), MIMICRY_OK);
  EXPECT_EQ(far, kInfinite);
  int32_t source = 5;
  ASSERT_EQ(mimicry_geodesics_find_path(some.get(), &to, &far, &source), MIMICRY_OK);
  EXPECT_EQ(far, kInfinite);
  EXPECT_EQ(source, -1);
  EXPECT_EQ(mimicry_geodesics_path_count(some.get()), 0u);

  mimicry_geodesics* none = nullptr;
  int calls = 0;
  const auto stop = [](void* user, const char*, double fraction) -> int32_t {
    EXPECT_GE(fraction, 0.0);
    EXPECT_LE(fraction, 1.0);
    return ++*static_cast<int*>(user) < 3;
  };
  EXPECT_EQ(mimicry_geodesics_create(target.get(), &from, 1, kInfinite, stop, &calls, &none),
            MIMICRY_CANCELLED);
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(none, nullptr);

  const auto create = [&](const mimicry_surface_point* p, std::size_t count, double radius) {
    return mimicry_geodesics_create(target.get(), p, count, radius, nullptr, nullptr, &none);
  };
  expect_invalid(create(&from, 0, 1.0), "no sources");
  expect_invalid(create(nullptr, 1, 1.0), "source is NULL");
  expect_invalid(create(&from, 1, 0.0), "radius");
  expect_invalid(create(&from, 1, kNaN), "radius");
  mimicry_surface_point odd = from;
  odd.face = 1'000'000;
  expect_invalid(create(&odd, 1, 1.0), "source 0");
  odd = from;
  odd.barycentric[1] = kNaN;
  expect_invalid(create(&odd, 1, 1.0), "source 0");
  odd.barycentric[1] = 7.0;
  expect_invalid(mimicry_geodesics_distances(some.get(), &odd, 1, &far), "point 0");
  expect_invalid(mimicry_geodesics_distances(some.get(), &from, 1, nullptr), "distances is NULL");
  expect_invalid(mimicry_geodesics_vertex_distances(some.get(), &far, 1), "room for 1");
  expect_invalid(mimicry_geodesics_find_path(some.get(), nullptr, &far, nullptr), "to is NULL");
}

TEST(CApiPaths, NearbyPathsAndStraightWalks) {
  const Target target = target_of("grid", 16);
  const auto paths = make<Paths>(mimicry_path_finder_create, target.get());
  const mimicry_surface_point a = surface_point(target, -0.5, -0.3, 0),
                              b = surface_point(target, 0.4, 0.1, 0);
  double length = 0.0;
  int32_t shortest = 0;
  ASSERT_EQ(mimicry_path_finder_find(paths.get(), &a, &b, &length, &shortest), MIMICRY_OK);
  EXPECT_EQ(shortest, 1);
  EXPECT_NEAR(length, std::hypot(0.9, 0.4), 1e-12);
  const std::size_t count = mimicry_path_finder_path_count(paths.get());
  ASSERT_GT(count, 5u);
  EXPECT_LT(distance(mimicry_path_finder_path(paths.get())[count - 1].position, b.position), 1e-12);
  const long before = mimicry::test::allocation_count();
  ASSERT_EQ(mimicry_path_finder_find(paths.get(), &b, &a, &length, nullptr), MIMICRY_OK);
  EXPECT_EQ(mimicry::test::allocation_count(), before);

  const double direction[] = {3, 0, 5};  // its part along the surface counts
  mimicry_surface_point end;
  double walked = 0.0;
  ASSERT_EQ(mimicry_path_finder_trace(paths.get(), &a, direction, 0.6, &end, &walked), MIMICRY_OK);
  EXPECT_NEAR(walked, 0.6, 1e-12);
  EXPECT_NEAR(end.position[0], 0.1, 1e-12);
  EXPECT_NEAR(end.position[1], -0.3, 1e-12);
  ASSERT_EQ(mimicry_path_finder_trace(paths.get(), &a, direction, 50.0, &end, &walked), MIMICRY_OK);
  EXPECT_NEAR(walked, 1.5, 1e-9) << "the boundary";

  const double none[] = {kNaN, 0, 0};
  expect_invalid(mimicry_path_finder_trace(paths.get(), &a, none, 1.0, &end, nullptr), "direction");
  expect_invalid(mimicry_path_finder_trace(paths.get(), &a, direction, -1.0, &end, nullptr),
                 "length");
  expect_invalid(mimicry_path_finder_trace(paths.get(), nullptr, direction, 1.0, &end, nullptr),
                 "from is NULL");
  expect_invalid(mimicry_path_finder_find(paths.get(), &a, nullptr, &length, nullptr),
                 "to is NULL");
  expect_invalid(mimicry_path_finder_find(paths.get(), &a, &b, nullptr, nullptr), "length is NULL");
  expect_invalid(mimicry_path_finder_find(nullptr, &a, &b, &length, nullptr), "finder is NULL");

  const Target two = target_of("two-spheres", 4);
  const auto across = make<Paths>(mimicry_path_finder_create, two.get());
  const mimicry_surface_point left = surface_point(two, -2, 0, 0),
                              right = surface_point(two, 2, 0, 0);
  ASSERT_EQ(mimicry_path_finder_find(across.get(), &left, &right, &length, nullptr), MIMICRY_OK);
  EXPECT_EQ(length, kInfinite);
  EXPECT_EQ(mimicry_path_finder_path_count(across.get()), 0u);
}

TEST(CApiExponentialMap, IsThePlaneOnAPlane) {
  const auto mesh = make<Mesh>(mimicry_mesh_shape, "grid", 16);
  const auto target = make<Target>(mimicry_target_make, mesh.get(), nullptr);
  const auto map = make<ExponentialMap>(mimicry_exponential_map_create, target.get());
  const mimicry_surface_point centre = surface_point(target, 0.1, 0.05, 0);
  const double x_hint[] = {1, 0, 0};
  mimicry_tangent_plane plane;
  ASSERT_EQ(mimicry_exponential_map_compute(map.get(), &centre, 0.5, x_hint, &plane), MIMICRY_OK);
  EXPECT_NEAR(plane.x_axis[0], 1.0, 1e-12);
  EXPECT_NEAR(plane.normal[2], 1.0, 1e-12);
  const std::size_t count = mimicry_exponential_map_count(map.get());
  ASSERT_GT(count, 20u);
  const int32_t* vertices = mimicry_exponential_map_vertices(map.get());
  const double* coordinates = mimicry_exponential_map_coordinates(map.get());
  const double* positions = mimicry_mesh_positions(mesh.get());
  for (std::size_t i = 0; i < count; ++i) {
    const double* x = positions + 3 * vertices[i];
    EXPECT_NEAR(coordinates[2 * i], x[0] - centre.position[0], 1e-9);
    EXPECT_NEAR(coordinates[2 * i + 1], x[1] - centre.position[1], 1e-9);
  }
  expect_invalid(mimicry_exponential_map_compute(map.get(), &centre, 0.0, nullptr, nullptr),
                 "radius");
  expect_invalid(mimicry_exponential_map_compute(map.get(), &centre, kNaN, nullptr, nullptr),
                 "radius");
  const double bad[] = {kNaN, 0, 0};
  expect_invalid(mimicry_exponential_map_compute(map.get(), &centre, 1.0, bad, nullptr), "x_hint");
  expect_invalid(mimicry_exponential_map_compute(map.get(), nullptr, 1.0, nullptr, nullptr),
                 "centre is NULL");
  EXPECT_EQ(mimicry_exponential_map_count(nullptr), 0u);
}

// A mesh with a seam: its vertices are not the surface's.
TEST(CApiDeforming, SessionsDrawOnWhatHasMoved) {
  const double square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0};
  const int32_t faces[] = {0, 1, 2, 3, 4, 5};
  const auto mesh =
      make<Mesh>(mimicry_mesh_create, square, std::size_t{6}, faces, std::size_t{2}, "square");
  auto target = make<Target>(mimicry_target_make, mesh.get(), nullptr);
  ASSERT_EQ(mimicry_target_surface_vertex_count(target.get()), 4u);
  const auto session = make<Session>(mimicry_session_create, target.get(), "snap");
  const mimicry_similarity here{{0, 0, 0, 1}, {0, 0, 0}, 1};
  mimicry_frame frame = wave(1)[0];
  for (int k = 0; k < 3; ++k) frame.controller_position[k] = 0.4;
  const auto draw = [&] {
    return make<Curve>(mimicry_session_project, session.get(), &here, &frame, std::size_t{1});
  };
  const auto flat = draw();
  const mimicry_surface_point centre = surface_point(target, 0.5, 0.4, 0);
  const auto geodesics = make<Geodesics>(mimicry_geodesics_create, target.get(), &centre,
                                         std::size_t{1}, kInfinite, nullptr, nullptr);

  std::vector<double> raised(square, square + 18);
  for (int v = 0; v < 6; ++v) raised[3 * v + 2] = 0.25;
  const long before = mimicry::test::allocation_count();
  ASSERT_EQ(mimicry_target_update_positions(target.get(), raised.data(), 6), MIMICRY_OK)
      << mimicry_last_error();
  EXPECT_EQ(mimicry::test::allocation_count(), before);
  const auto moved = draw();
  const auto followed = make<Curve>(mimicry_curve_follow, flat.get());
  mimicry_curve_point a, b, c;
  ASSERT_EQ(mimicry_curve_point_at(flat.get(), 0, &a), MIMICRY_OK);
  ASSERT_EQ(mimicry_curve_point_at(moved.get(), 0, &b), MIMICRY_OK);
  ASSERT_EQ(mimicry_curve_point_at(followed.get(), 0, &c), MIMICRY_OK);
  EXPECT_EQ(a.position[2], 0.0);
  EXPECT_DOUBLE_EQ(b.position[2], 0.25);
  EXPECT_DOUBLE_EQ(c.position[2], 0.25);
  EXPECT_FLOAT_EQ(mimicry_curve_ink(followed.get())[0].position[2], 0.25f);
  double d;
  expect_invalid(mimicry_geodesics_distances(geodesics.get(), &centre, 1, &d), "moved");

  // Tilted: the normals of the mesh's six vertices turn with it.
  for (int v = 0; v < 6; ++v) raised[3 * v + 2] = raised[3 * v];
  ASSERT_EQ(mimicry_target_update_positions(target.get(), raised.data(), 6), MIMICRY_OK);
  const double* normals = mimicry_target_vertex_normals(target.get());
  for (int v = 0; v < 6; ++v) EXPECT_NEAR(normals[3 * v], -std::sqrt(0.5), 1e-12) << v;

  expect_invalid(mimicry_target_update_positions(target.get(), raised.data(), 4),
                 "4 new positions");
  expect_invalid(mimicry_target_update_positions(target.get(), nullptr, 6), "positions is NULL");
  expect_invalid(mimicry_target_update_positions(nullptr, raised.data(), 6), "target is NULL");
  raised[4] = kNaN;
  EXPECT_EQ(mimicry_target_update_positions(target.get(), raised.data(), 6), MIMICRY_INVALID_INPUT);
  EXPECT_NEAR(mimicry_target_vertex_normals(target.get())[0], -std::sqrt(0.5), 1e-12);
}

}  // namespace
