#include <cfenv>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>

#include "base/float_traps.h"
#include "render/scenes.h"

namespace mimicry::render {
namespace {

using testing::HasSubstr;

constexpr Color kRed{0.8, 0.1, 0.1};

Scene scene_of(const TriangleMesh& mesh) {
  Scene scene;
  scene.surfaces.push_back({});
  scene.surfaces[0].mesh = &mesh;
  return scene;
}

Tube tube(std::vector<Vec3> points, double radius, const Color& color = kRed) {
  Tube result;
  result.points = std::move(points);
  result.radius = radius;
  result.color = color;
  return result;
}

Image shot(const Scene& scene, const RenderOptions& options, double azimuth = 0.0,
           double elevation = 0.0) {
  const double aspect = static_cast<double>(options.width) / options.height;
  return render(scene, choose_camera(scene, from(azimuth, elevation, aspect)), options);
}

bool reddish(const Image& image, int x, int y) {
  return image.pixel(x, y)[0] > image.pixel(x, y)[1] + 60;
}

std::string refusal(const Scene& scene, const RenderOptions& options = small(8, 8)) {
  try {
    render(scene, Camera{}, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  return "accepted";
}

TEST(Renderer, SphereCoversItsSilhouetteAndNothingElse) {
  const TriangleMesh mesh = ball(48);
  const Scene scene = scene_of(mesh);
  const RenderOptions options = small(120, 100);
  const Camera camera = choose_camera(scene, from(25.0, 10.0, 1.2));
  const Image image = render(scene, camera, options);
  // Half the angle that a unit sphere fills, in pixels; the polygon is at most 0.2 % smaller.
  const double radius =
      std::tan(std::asin(1.0 / camera.eye.norm())) / camera.tan_half_height * 50.0;
  const Vec2 center = camera.project(Vec3::Zero(), 120, 100);
  int inside = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 120; ++x) {
      const double d = (Vec2(x + 0.5, y + 0.5) - center).norm();
      // 1.3: half the reach of the pixel filter along the diagonal, and the polygon.
      if (d < radius - 1.3) {
        EXPECT_FALSE(is_background(image, x, y, options)) << x << " " << y;
        ++inside;
      } else if (d > radius + 1.3) {
        EXPECT_TRUE(is_background(image, x, y, options)) << x << " " << y;
      }
    }
  }
  EXPECT_GT(inside, 5000);
}

TEST(Renderer, TubeInFrontShowsAndTubeBehindIsHidden) {
  const TriangleMesh mesh = ball(24);
  const RenderOptions options = [] {
    RenderOptions o = small(60, 60);
    o.ghost = 0.0;
    return o;
  }();
  Scene scene = scene_of(mesh);
  const Camera camera = choose_camera(scene, from(0.0, 0.0));
  const Image plain = render(scene, camera, options);

  scene.tubes = {tube({Vec3(-0.5, 0, 1.05), Vec3(0.5, 0, 1.05)}, 0.05)};
  const Image front = render(scene, camera, options);
  EXPECT_TRUE(reddish(front, 30, 30));
  EXPECT_FALSE(reddish(front, 30, 20));

  scene.tubes = {tube({Vec3(-0.3, 0, -1.05), Vec3(0.3, 0, -1.05)}, 0.05)};
  // The box grows a little with the tube, so rays start elsewhere in the last bit.
  const Image behind = render(scene, camera, options);
  for (int x = 0; x < 60; ++x) {
    EXPECT_NEAR(brightness(behind, x, 30), brightness(plain, x, 30), 4.0) << x;
  }
  RenderOptions ghosted = options;
  ghosted.ghost = 0.3;
  const Image ghost = render(scene, camera, ghosted);
  EXPECT_GT(ghost.pixel(30, 30)[0], ghost.pixel(30, 30)[1] + 15);
  EXPECT_FALSE(reddish(ghost, 30, 30));
}

TEST(Renderer, TubeIsAsWideAsItsRadiusSaysWithRoundCaps) {
  Scene scene;
  scene.tubes = {tube({Vec3(-1, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0)}, 0.2)};
  const RenderOptions options = small(140, 40);
  CameraOptions far = from(0.0, 0.0, 3.5);
  far.field_of_view_deg = 1.0;  // nearly parallel rays: silhouettes are true to size
  const Camera camera = choose_camera(scene, far);
  const Image image = render(scene, camera, options);
  const double per_unit = 20.0 / (camera.tan_half_height * camera.eye.z());
  const auto covered = [&](double x, double y) {
    const Vec2 p = camera.project(Vec3(x, y, 0), 140, 40);
    return !is_background(image, static_cast<int>(p.x()), static_cast<int>(p.y()), options);
  };
  const double pixel = 1.0 / per_unit;
  for (const double x : {-0.9, 0.0, 0.7}) {
    EXPECT_TRUE(covered(x, 0.2 - 1.5 * pixel));
    EXPECT_FALSE(covered(x, 0.2 + 2.0 * pixel));
  }
  EXPECT_TRUE(covered(1.2 - 1.5 * pixel, 0.0));
  EXPECT_FALSE(covered(1.2 + 2.0 * pixel, 0.0));
  EXPECT_FALSE(covered(1.19, 0.17));  // a square cap would reach here
}

TEST(Renderer, OfTubesThatCoincideTheFirstIsSeen) {
  Scene scene;
  const std::vector<Vec3> points = {Vec3(-1, 0, 0), Vec3(1, 0, 0)};
  scene.tubes = {tube(points, 0.2), tube(points, 0.2, {0.1, 0.1, 0.8})};
  const Image image = shot(scene, small(60, 20));
  for (int x = 10; x < 50; ++x) EXPECT_TRUE(reddish(image, x, 10)) << x;
}

TEST(Renderer, SamePixelsTwiceAndWithAnyNumberOfThreads) {
  const TriangleMesh mesh = ball(16);
  Scene scene = scene_of(mesh);
  scene.tubes = {tube({Vec3(-0.5, 0, 1), Vec3(0, 0.5, 1), Vec3(0.5, 0, 1)}, 0.05)};
  RenderOptions options = small(64, 150);  // more rows than one band
  options.ground = 0.4;
  options.threads = 1;
  const Image one = shot(scene, options, 20.0, 30.0);
  EXPECT_EQ(one.rgb, shot(scene, options, 20.0, 30.0).rgb);
  options.threads = 3;
  EXPECT_EQ(one.rgb, shot(scene, options, 20.0, 30.0).rgb);
}

TEST(Renderer, FlatFaceIsShadedEvenly) {
  const TriangleMesh mesh = plate(7);
  const Image image = shot(scene_of(mesh), small(60, 60));
  // Nothing occludes a plane: what remains is rounding to 8 bits.
  for (int y = 8; y < 52; ++y) {
    for (int x = 8; x < 52; ++x)
      EXPECT_NEAR(brightness(image, x, y), brightness(image, 30, 30), 1.0);
  }
}

TEST(Renderer, CoarseSphereDoesNotShadeItself) {
  // Faces of 22 degrees: occlusion rays that started on the flat faces would darken each near its
  // corners. The smooth sphere occludes nothing.
  const TriangleMesh mesh = ball(8);
  RenderOptions options = small(60, 60);
  options.ao_samples = 4;
  const Image lit = shot(scene_of(mesh), options);
  options.ao_samples = 0;
  const Image bare = shot(scene_of(mesh), options);
  for (int y = 15; y < 45; ++y) {
    for (int x = 15; x < 45; ++x) {
      EXPECT_NEAR(brightness(lit, x, y), brightness(bare, x, y), 3.0) << x << " " << y;
    }
  }
}

TEST(Renderer, InnerCornerIsDarkerThanOpenFace) {
  // Two plates that meet at a right angle along the y axis, open to the viewer.
  const TriangleMesh mesh({Vec3(0, -1, 0), Vec3(1, -1, 1), Vec3(1, 1, 1), Vec3(0, 1, 0),
                           Vec3(-1, -1, 1), Vec3(-1, 1, 1)},
                          {{0, 1, 2}, {0, 2, 3}, {4, 0, 3}, {4, 3, 5}});
  const Image image = shot(scene_of(mesh), small(80, 60));
  EXPECT_LT(brightness(image, 42, 30), brightness(image, 62, 30) - 15.0);
  EXPECT_LT(brightness(image, 38, 30), brightness(image, 18, 30) - 15.0);
}

TEST(Renderer, IsoLinesStandAtMultiplesOfTheSpacing) {
  const TriangleMesh mesh = plate(4);
  Scene scene = scene_of(mesh);
  for (const Vec3& p : mesh.positions()) scene.surfaces[0].iso_values.push_back(p.x());
  scene.surfaces[0].iso_spacing = 0.4;
  RenderOptions options = small(200, 200);
  const Camera camera = choose_camera(scene, from(0.0, 0.0));
  const Image image = render(scene, camera, options);
  const double open = brightness(image, 110, 100);
  for (int x = 15; x < 185; ++x) {
    double off = kInfinity;  // pixels to the nearest line
    for (const double value : {-0.8, -0.4, 0.0, 0.4, 0.8}) {
      off = std::min(off, std::abs(camera.project(Vec3(value, 0, 0), 200, 200).x() - (x + 0.5)));
    }
    if (off < 0.5) {
      EXPECT_LT(brightness(image, x, 100), open - 25.0) << x;
    } else if (off > 2.0) {
      EXPECT_NEAR(brightness(image, x, 100), open, 2.0) << x;
    }
  }
}

TEST(Renderer, GroundIsDarkUnderTheObjectOnly) {
  const TriangleMesh mesh = ball(16);
  RenderOptions options = small(120, 100);
  options.ground = 0.5;
  const Scene scene = scene_of(mesh);
  const Camera camera = choose_camera(scene, from(0.0, 25.0, 1.2));
  const Image image = render(scene, camera, options);
  const Vec2 near = camera.project(Vec3(0.75, -1.0, 0.25), 120, 100);
  const double open = brightness(image, 2, 98);
  EXPECT_LT(brightness(image, static_cast<int>(near.x()), static_cast<int>(near.y())), open - 5.0);
  EXPECT_TRUE(is_background(image, 2, 2, options));
}

TEST(Renderer, SizeAndPlaceOfTheSceneDoNotMatter) {
  const auto shot_at = [](double scale, const Vec3& center) {
    const TriangleMesh mesh = ball(16, scale, center);
    Scene scene = scene_of(mesh);
    scene.tubes = {
        tube({center + scale * Vec3(-0.5, 0, 1), center + scale * Vec3(0.5, 0, 1)}, 0.05 * scale)};
    return shot(scene, small(50, 50), 30.0, 20.0);
  };
  const Image usual = shot_at(1.0, Vec3::Zero());
  for (const auto& [scale, center] :
       {std::pair(1e-6, Vec3(0, 0, 0)), std::pair(1e6, Vec3(0, 0, 0)),
        std::pair(1.0, Vec3(1e4, -1e4, 1e4)), std::pair(1e-100, Vec3(0, 0, 0)),
        std::pair(1e100, Vec3(0, 0, 0))}) {
    const Image other = shot_at(scale, center);
    double difference = 0.0;
    for (std::size_t i = 0; i < usual.rgb.size(); ++i) {
      difference += std::abs(double(usual.rgb[i]) - double(other.rgb[i]));
    }
    // Rounding moves single rays across edges; the picture stays.
    EXPECT_LT(difference / static_cast<double>(usual.rgb.size()), 0.2) << scale;
  }
}

TEST(Renderer, OnePointIsABallAndRepeatedPointsAreOne) {
  Scene scene;
  scene.tubes = {tube({Vec3(3, 4, 5)}, 0.5)};
  const RenderOptions options = small(40, 40);
  const Image one = shot(scene, options);
  EXPECT_TRUE(reddish(one, 20, 20));
  EXPECT_TRUE(is_background(one, 4, 4, options));
  scene.tubes = {tube({Vec3(3, 4, 5), Vec3(3, 4, 5), Vec3(3, 4, 5)}, 0.5)};
  EXPECT_EQ(one.rgb, shot(scene, options).rgb);
}

TEST(Renderer, TubeThatTurnsBackOnItselfIsDrawn) {
  Scene scene;
  scene.tubes = {tube({Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(-1, 0, 0)}, 0.1)};
  EXPECT_TRUE(reddish(shot(scene, small(60, 20)), 30, 10));
}

TEST(Renderer, DegenerateFacesAreDrawnAroundNotRefused) {
  const TriangleMesh mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(2, 0, 0)},
                          {{0, 1, 2}, {0, 1, 3}, {1, 1, 1}});
  const RenderOptions options = small(40, 40);
  const Image image = shot(scene_of(mesh), options);
  EXPECT_FALSE(is_background(image, 8, 24, options));
}

TEST(Renderer, UnusedVertexWithoutFiniteCoordinatesIsIgnored) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TriangleMesh mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(nan, nan, nan)},
                          {{0, 1, 2}});
  const RenderOptions options = small(40, 40);
  EXPECT_FALSE(is_background(shot(scene_of(mesh), options), 12, 26, options));
}

TEST(Renderer, RefusesWhatCannotBeDrawnAndSaysWhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(Scene{}), HasSubstr("nothing to draw"));
  const TriangleMesh empty;
  EXPECT_THAT(refusal(scene_of(empty)), HasSubstr("nothing to draw"));
  const TriangleMesh bad({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, nan, 0)}, {{0, 1, 2}});
  EXPECT_THAT(refusal(scene_of(bad)), HasSubstr("surface 0: vertex 2 of face 0 is not finite"));

  const TriangleMesh mesh = ball(4);
  Scene scene = scene_of(mesh);
  scene.tubes = {tube({Vec3(0, 0, 0), Vec3(nan, 0, 0)}, 0.1)};
  scene.tubes[0].label = "snap";
  EXPECT_THAT(refusal(scene), HasSubstr("tube 0 (snap): point 1 is not finite"));
  scene.tubes = {tube({Vec3(0, 0, 0), Vec3(1, 0, 0)}, 0.0)};
  EXPECT_THAT(refusal(scene), HasSubstr("radius"));
  scene.tubes.clear();
  scene.surfaces[0].iso_values = {1.0, 2.0};
  EXPECT_THAT(refusal(scene), HasSubstr("2 iso values"));
  scene.surfaces[0].iso_values.assign(static_cast<std::size_t>(mesh.vertex_count()), 1.0);
  EXPECT_THAT(refusal(scene), HasSubstr("spacing"));
  scene.surfaces[0].iso_values.clear();
  EXPECT_THAT(refusal(scene, small(0, 8)), HasSubstr("width"));
  EXPECT_THAT(refusal(scene, small(8, 100000)), HasSubstr("height"));
  RenderOptions options = small(8, 8);
  options.samples = 0;
  EXPECT_THAT(refusal(scene, options), HasSubstr("samples"));
  options = small(8, 8);
  options.ghost = nan;
  EXPECT_THAT(refusal(scene, options), HasSubstr("opacity"));
  const TriangleMesh point({Vec3(1, 1, 1)}, {{0, 0, 0}});
  EXPECT_THAT(refusal(scene_of(point)), HasSubstr("coincide"));
}

#if defined(__GLIBC__) && defined(__x86_64__)
TEST(Renderer, LeavesTheFloatingPointStateAsItWas) {
  const TriangleMesh mesh = ball(4);
  const int before = fegetexcept();
  shot(scene_of(mesh), small(16, 16));
  EXPECT_EQ(fegetexcept(), before);
  volatile double tiny = std::numeric_limits<double>::min();
  tiny = 0.5 * tiny;
  EXPECT_GT(tiny, 0.0) << "denormals are still flushed to zero";
}
#endif

}  // namespace
}  // namespace mimicry::render
