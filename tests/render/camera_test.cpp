#include "render/camera.h"

#include <cmath>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>

#include "render/scenes.h"

namespace mimicry::render {
namespace {

Scene ball_with_loop(const TriangleMesh& mesh, const Vec3& axis) {
  Scene scene;
  scene.surfaces.push_back({});
  scene.surfaces[0].mesh = &mesh;
  const Vec3 a = axis.unitOrthogonal();
  const Vec3 b = axis.cross(a);
  Tube tube;
  tube.radius = 0.02;
  for (int i = 0; i <= 40; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 40;
    tube.points.push_back((axis + 0.4 * (std::cos(t) * a + std::sin(t) * b)).normalized());
  }
  scene.tubes.push_back(tube);
  return scene;
}

TEST(Camera, AutomaticCameraFacesTheCurve) {
  const TriangleMesh mesh = ball(16);
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, -1), Vec3(0.6, 0.3, -0.7)}) {
    const Vec3 unit = axis.normalized();
    const Camera camera = choose_camera(ball_with_loop(mesh, unit));
    // Within 45 degrees: the loop's rim, 22 degrees around its axis, is seen from there as a whole.
    EXPECT_GT(camera.forward.dot(-unit), std::cos(std::numbers::pi / 4.0)) << axis.transpose();
  }
}

TEST(Camera, CurveOnTopOrBelowIsSeenFromAboveOrBelow) {
  const TriangleMesh mesh = ball(16);
  EXPECT_LT(choose_camera(ball_with_loop(mesh, Vec3::UnitY())).forward.y(), -0.5);
  EXPECT_GT(choose_camera(ball_with_loop(mesh, -Vec3::UnitY())).forward.y(), 0.1);
}

TEST(Camera, TubeWithoutWeightDoesNotCount) {
  const TriangleMesh mesh = ball(16);
  Scene scene = ball_with_loop(mesh, Vec3::UnitX());
  Scene both = scene;
  both.tubes.push_back(ball_with_loop(mesh, -Vec3::UnitX()).tubes[0]);
  both.tubes.back().camera_weight = 0.0;
  EXPECT_EQ(choose_camera(scene).forward, choose_camera(both).forward);
}

TEST(Camera, AnglesThatAreGivenAreKept) {
  const TriangleMesh mesh = ball(8);
  const Scene scene = ball_with_loop(mesh, Vec3::UnitX());
  const double tolerance = 1e-12;  // a few roundings of unit vectors
  EXPECT_LT((choose_camera(scene, from(0, 0)).forward - Vec3(0, 0, -1)).norm(), tolerance);
  EXPECT_LT((choose_camera(scene, from(90, 0)).forward - Vec3(-1, 0, 0)).norm(), tolerance);
  EXPECT_LT((choose_camera(scene, from(0, 90)).forward - Vec3(0, -1, 0)).norm(), tolerance);
  EXPECT_LT((choose_camera(scene, from(0, 90)).up - Vec3(0, 0, -1)).norm(), tolerance);
  CameraOptions half;
  half.elevation_deg = 10.0;
  const Camera camera = choose_camera(scene, half);
  EXPECT_NEAR(camera.forward.y(), -std::sin(std::numbers::pi / 18.0), tolerance);
  EXPECT_LT(camera.forward.x(), -0.7);
}

TEST(Camera, EverythingFitsTheFrameAndTouchesIt) {
  const TriangleMesh mesh = ball(16, 2.0, Vec3(5, 1, -3));
  Scene scene;
  scene.surfaces.push_back({});
  scene.surfaces[0].mesh = &mesh;
  Tube tube;
  tube.radius = 0.01;
  tube.points = {Vec3(5, 1, -3), Vec3(9, 2, 1)};
  scene.tubes.push_back(tube);
  for (const double aspect : {0.5, 1.0, 2.0}) {
    for (const double azimuth : {0.0, 70.0, 200.0}) {
      const Camera camera = choose_camera(scene, from(azimuth, 25.0, aspect));
      const int height = 1000;
      const int width = static_cast<int>(height * aspect);
      Eigen::AlignedBox2d box;
      for (const Vec3& p : mesh.positions()) box.extend(camera.project(p, width, height));
      for (const Vec3& p : tube.points) box.extend(camera.project(p, width, height));
      // 5 % of border on each side; the tube's radius, 0.1 %, is left out here.
      EXPECT_GT(box.min().x(), 0.05 * width - 1e-6);
      EXPECT_LT(box.max().x(), 0.95 * width + 1e-6);
      EXPECT_GT(box.min().y(), 0.05 * height - 1e-6);
      EXPECT_LT(box.max().y(), 0.95 * height + 1e-6);
      const double slack_x = (0.9 * width - box.sizes().x()) / width;
      const double slack_y = (0.9 * height - box.sizes().y()) / height;
      EXPECT_LT(std::min(slack_x, slack_y), 0.01);
    }
  }
}

TEST(Camera, ZoomEnlargesAroundTheMiddle) {
  const TriangleMesh mesh = ball(8);
  Scene scene;
  scene.surfaces.push_back({});
  scene.surfaces[0].mesh = &mesh;
  CameraOptions options = from(30, 20);
  const Vec2 once = choose_camera(scene, options).project(Vec3(0.5, 0.2, 0.1), 100, 100);
  options.zoom = 2.0;
  const Vec2 twice = choose_camera(scene, options).project(Vec3(0.5, 0.2, 0.1), 100, 100);
  EXPECT_LT((twice - Vec2(50, 50) - 2.0 * (once - Vec2(50, 50))).norm(), 1e-9);
}

TEST(Camera, DirectionThroughAProjectedPointLeadsToIt) {
  const TriangleMesh mesh = ball(8);
  Scene scene;
  scene.up = Vec3::UnitZ();
  scene.surfaces.push_back({});
  scene.surfaces[0].mesh = &mesh;
  const Camera camera = choose_camera(scene, from(123, 20));
  EXPECT_GT(camera.up.z(), 0.9);
  const Vec3 p(0.3, -0.4, 0.6);
  const Vec2 pixel = camera.project(p, 320, 200);
  const Vec3 direction = camera.direction(pixel.x(), pixel.y(), 320, 200);
  EXPECT_LT(direction.normalized().cross((p - camera.eye).normalized()).norm(), 1e-12);
}

TEST(Camera, RefusesOptionsOutOfRange) {
  const TriangleMesh mesh = ball(4);
  Scene scene;
  EXPECT_THROW(choose_camera(scene), Error);
  scene.surfaces.push_back({});
  EXPECT_THROW(choose_camera(scene), Error);
  scene.surfaces[0].mesh = &mesh;
  EXPECT_NO_THROW(choose_camera(scene));
  EXPECT_THROW(choose_camera(scene, from(0, 91)), Error);
  EXPECT_THROW(choose_camera(scene, from(std::nan(""), 0)), Error);
  CameraOptions options;
  options.zoom = 0.0;
  EXPECT_THROW(choose_camera(scene, options), Error);
  options = {};
  options.field_of_view_deg = 0.0;
  EXPECT_THROW(choose_camera(scene, options), Error);
}

}  // namespace
}  // namespace mimicry::render
