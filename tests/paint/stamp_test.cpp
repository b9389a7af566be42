#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/paint/brush.h>

#include "paint/support.h"

namespace mimicry {
namespace {

using test::shape_surface;

StampImage image_of(int width, int height, const std::function<Rgba8(int, int)>& pixel) {
  std::vector<Rgba8> texels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) texels.push_back(pixel(x, y));
  return StampImage(width, height, texels);
}

StampImage solid(int width, int height) {
  return image_of(width, height, [](int, int) { return Rgba8{200, 30, 10, 255}; });
}

// A straight line on the surface in `steps` frames.
void draw(StrokePainter& painter, const Surface& surface, const SurfacePoint& from,
          const Vec3& direction, double length, int steps) {
  painter.move_to(from);
  SurfacePoint last = from;
  Vec3 way = direction;
  for (int i = 0; i < steps; ++i) {
    std::vector<Crossing> crossings;
    const Trace trace = trace_straightest(surface, last, way, length / steps, &crossings);
    ASSERT_EQ(trace.stop, TraceStop::complete);
    painter.line_to(crossings, trace.end);
    last = trace.end;
    way = trace.direction;
  }
}

TEST(StampImage, HalvedLevelsKeepTheMean) {
  const StampImage image = image_of(64, 16, [](int x, int y) {
    return Rgba8{255, 255, 255, static_cast<std::uint8_t>((x + y) % 2 == 0 ? 255 : 0)};
  });
  EXPECT_NEAR(double(image.sample(0.5, 0.5, 64.0)[3]), 0.5, 0.01);
  EXPECT_NEAR(double(image.sample(0.5, 0.5, 64.0)[0]), 0.5, 0.01);
  EXPECT_EQ(image.sample(-0.2, 0.5, 1.0)[3], 0.0f);
  EXPECT_EQ(image.sample(0.5, 1.2, 1.0)[3], 0.0f);
  // Between the last and the first column of an image that repeats.
  EXPECT_NEAR(double(image.sample(3.0, 0.5 / 16.0, 1.0, true)[3]), 0.5, 0.01);
}

TEST(StampImage, WrongSizesAreRefused) {
  const std::vector<Rgba8> texels(6);
  EXPECT_NO_THROW(StampImage(3, 2, texels));
  EXPECT_THROW(StampImage(2, 2, texels), Error);
  EXPECT_THROW(StampImage(0, 2, {}), Error);
  EXPECT_THROW(StampImage(20000, 1, std::vector<Rgba8>(20000)), Error);
}

// A rectangle's centre, extents and angle in the unrolled cylinder, by its moments.
TEST(Stamp, OnACylinderItHasItsSizeAndFollowsTheCurve) {
  const Surface surface = shape_surface("cylinder", 16);
  const PaintAtlas atlas = PaintAtlas::cells(surface, 1024);
  const TriangleMesh& mesh = surface.mesh();
  SurfacePoint start;
  for (Index f = 0; f < mesh.face_count() && start.face == kNone; ++f) {
    const SurfacePoint p{f, Vec3(0.3, 0.3, 0.4)};
    const Vec3 x = mesh.position(p);
    if (std::abs(x.y()) < 0.1 && x.x() > 0.55 && std::abs(x.z()) < 0.05) start = p;
  }
  ASSERT_NE(start.face, kNone);
  const StampImage image = solid(64, 32);
  for (const bool follow : {true, false}) {
    Stamp stamp;
    stamp.size = 0.4;
    stamp.rotation_rad = 0.3;
    stamp.follow = follow;
    stamp.spacing = 10.0;  // one
    PaintLayers layers(1024, {255, 255, 255});
    StrokePainter painter(atlas);
    painter.begin(layers, 0, stamp, image);
    // Around the cylinder and up: seen from outside to the right where z falls.
    draw(painter, surface, start, Vec3(0.0, std::sin(0.4), -std::cos(0.4)), 0.5, 5);
    painter.end();
    double weight = 0.0;
    Vec2 sum = Vec2::Zero();
    Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const TexelFrame frame = atlas.frame(f);
      const double area = mesh.area_vector(f).norm();
      const double texels = std::pow(1.0 / frame.along_x.cwiseAbs().maxCoeff(), 2);
      atlas.for_each_run(f, [&](const TexelRun& run) {
        for (int x = run.begin; x < run.end; ++x) {
          const Vec3 b = frame.bary(x, run.y);
          if (b.minCoeff() < -1e-9) continue;
          const auto on = (b.array() < 1e-9).count();
          const double w = area / texels *
                           (on == 0   ? 1.0
                            : on == 1 ? 0.5
                                      : 1.0 / 6.0) *
                           layers.layer_texel(0, x, run.y)[3] / 255.0;
          if (w == 0.0) continue;
          const Vec3 p = mesh.position(SurfacePoint{f, b});
          const Vec2 flat(-kCylinderRadius * std::atan2(p.z(), p.x()), p.y());
          weight += w;
          sum += w * flat;
          squares += w * flat * flat.transpose();
        }
      });
    }
    const Vec2 mean = sum / weight;
    const Eigen::Matrix2d spread = squares / weight - mean * mean.transpose();
    // Of a rectangle a^2 / 12 along its sides.
    const double half_trace = 0.5 * spread.trace();
    const double root = std::sqrt(half_trace * half_trace - spread.determinant());
    EXPECT_NEAR(std::sqrt(12.0 * (half_trace + root)), 0.4, 0.005 * 0.4);
    EXPECT_NEAR(std::sqrt(12.0 * (half_trace - root)), 0.2, 0.005 * 0.4);
    const double angle = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
    EXPECT_NEAR(angle, follow ? 0.7 : 0.3, 0.5 / 180.0 * std::numbers::pi) << follow;
  }
}

// Where a grid's point lies.
Vec2 texel_at(const PaintAtlas& atlas, double x, double y) {
  const TriangleMesh& mesh = atlas.surface().mesh();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vec3 a = mesh.corner(f, 0), b = mesh.corner(f, 1) - a, c = mesh.corner(f, 2) - a;
    const double d = b.x() * c.y() - b.y() * c.x(), px = x - a.x(), py = y - a.y();
    const double s = (px * c.y() - py * c.x()) / d, t = (b.x() * py - b.y() * px) / d;
    if (s >= 0.0 && t >= 0.0 && s + t <= 1.0)
      return atlas.place(SurfacePoint{f, Vec3(1.0 - s - t, s, t)});
  }
  ADD_FAILURE() << x << ", " << y;
  return Vec2::Zero();
}

SurfacePoint point_at(const PaintAtlas& atlas, double x, double y) {
  const Vec2 t = texel_at(atlas, x, y);
  return atlas.point(static_cast<int>(std::lround(t.x())), static_cast<int>(std::lround(t.y())));
}

TEST(Ribbon, RunsAlongTheCurveWithoutGapsAtBends) {
  const Surface surface(make_grid(9));
  const PaintAtlas atlas = PaintAtlas::cells(surface, 1024);
  // Left of the curve green, right of it red; the last quarter along it opaque blue in both.
  const StampImage image = image_of(64, 32, [](int x, int y) {
    if (x >= 48) return Rgba8{0, 0, 255, 255};
    return y < 16 ? Rgba8{0, 255, 0, 255} : Rgba8{255, 0, 0, 255};
  });
  Ribbon ribbon;
  ribbon.width = 0.2;
  PaintLayers layers(1024, {255, 255, 255});
  StrokePainter painter(atlas);
  painter.begin(layers, 0, ribbon, image);
  LocalPathFinder finder(surface);
  const Vec2 corners[4] = {{-0.7, 0.05}, {0.2, 0.05}, {0.2, -0.6}, {0.6, -0.2}};
  SurfacePoint last = point_at(atlas, corners[0].x(), corners[0].y());
  painter.move_to(last);
  for (int i = 1; i < 4; ++i) {
    // Frames of unlike lengths.
    for (const double t : {0.03, 0.4, 1.0}) {
      const Vec2 x = corners[i - 1] + t * (corners[i] - corners[i - 1]);
      const SurfacePoint to = point_at(atlas, x.x(), x.y());
      std::vector<Crossing> crossings;
      finder.find(last, to, crossings);
      painter.line_to(crossings, to);
      last = to;
    }
  }
  painter.end();
  const auto texel = [&](double x, double y) {
    const Vec2 t = texel_at(atlas, x, y);
    return layers.layer_texel(0, static_cast<int>(std::lround(t.x())),
                              static_cast<int>(std::lround(t.y())));
  };
  EXPECT_EQ(texel(-0.6, 0.1), (Rgba8{0, 255, 0, 255}));   // u = 0.25, left
  EXPECT_EQ(texel(-0.6, 0.0), (Rgba8{255, 0, 0, 255}));   // right
  EXPECT_EQ(texel(-0.35, 0.1), (Rgba8{0, 0, 255, 255}));  // u = 0.875
  EXPECT_EQ(texel(-0.2, 0.1), (Rgba8{0, 255, 0, 255}));   // it repeats
  EXPECT_EQ(texel(-0.75, 0.05)[3], 0);                    // straight ends
  EXPECT_EQ(texel(-0.5, 0.17)[3], 0);                     // half a width from the curve
  int inside = 0;
  for (double x = -0.8; x < 0.8; x += 0.013)
    for (double y = -0.8; y < 0.8; y += 0.013) {
      double least = kInfinity;
      bool beyond = false;
      for (int i = 1; i < 4; ++i) {
        const Vec2 a = corners[i - 1], way = corners[i] - a;
        const double t = (Vec2(x, y) - a).dot(way) / way.squaredNorm();
        const double d = (Vec2(x, y) - a - std::clamp(t, 0.0, 1.0) * way).norm();
        if (d < least) beyond = (i == 1 && t < 0.01) || (i == 3 && t > 0.99);
        least = std::min(least, d);
      }
      if (least > 0.095 || beyond) continue;
      ASSERT_EQ(texel(x, y)[3], 255) << x << ", " << y;
      ++inside;
    }
  EXPECT_GT(inside, 1000);
}

// On curved surfaces each piece has a map of its own; they differ where pieces join.
TEST(Ribbon, PiecesJoinWithoutCracksOnCurvedSurfaces) {
  for (const char* name : {"sphere", "torus"}) {
    const Surface surface = shape_surface(name, 24);
    const PaintAtlas atlas = PaintAtlas::cells(surface, 1024);
    const double width = 0.08 * diagonal(surface.mesh());
    const StampImage image = solid(64, 32);
    PaintLayers layers(1024, {255, 255, 255});
    StrokePainter painter(atlas);
    painter.begin(layers, 0, Ribbon{width}, image);
    SurfacePoint last{300, Vec3(0.3, 0.3, 0.4)};
    painter.move_to(last);
    std::vector<Vec3> points = {surface.position(last)};
    Vec3 way(0.2, 0.7, 0.6);
    for (int i = 0; i < 60; ++i) {
      std::vector<Crossing> crossings;
      const Trace trace = trace_straightest(surface, last, way, 0.15 * width, &crossings);
      ASSERT_EQ(trace.stop, TraceStop::complete);
      painter.line_to(crossings, trace.end);
      last = trace.end;
      points.push_back(surface.position(last));
      const Vec3 normal = face_normal(surface.mesh(), last.face);
      way = Eigen::AngleAxisd(i % 30 < 15 ? 0.1 : -0.1, normal) * trace.direction;
    }
    painter.end();
    int inside = 0, missing = 0;
    for (int y = 0; y < 1024; ++y)
      for (int x = 0; x < 1024; ++x) {
        const SurfacePoint p = atlas.point(x, y);
        if (p.face == kNone) continue;
        std::size_t nearest = 0;
        double least = kInfinity;
        for (std::size_t i = 0; i < points.size(); ++i) {
          const double d = (points[i] - surface.position(p)).norm();
          if (d < least) least = d, nearest = i;
        }
        if (least > 0.42 * width || nearest < 4 || nearest + 4 >= points.size()) continue;
        ++inside;
        missing += layers.layer_texel(0, x, y)[3] != 255;
      }
    EXPECT_GT(inside, 10000) << name;
    EXPECT_EQ(missing, 0) << name;
  }
}

TEST(Stamp, JitterIsTheSameForTheSameSeed) {
  const Surface surface = shape_surface("torus", 24);
  const PaintAtlas atlas = PaintAtlas::cells(surface, 512);
  const StampImage image = solid(16, 8);
  const auto drawn = [&](std::uint64_t seed) {
    Stamp stamp;
    stamp.size = 0.1;
    stamp.size_jitter = 0.5;
    stamp.rotation_jitter_rad = 1.0;
    stamp.seed = seed;
    PaintLayers layers(512, {255, 255, 255});
    StrokePainter painter(atlas);
    painter.begin(layers, 0, stamp, image);
    draw(painter, surface, {100, Vec3(0.3, 0.3, 0.4)}, Vec3(0.2, 0.4, 0.9), 1.0, 20);
    painter.end();
    return std::vector<Rgba8>(layers.pixels().begin(), layers.pixels().end());
  };
  const auto first = drawn(1);
  EXPECT_EQ(drawn(1), first);
  EXPECT_NE(drawn(2), first);
}

TEST(Stamp, ASinglePointGetsOneAndWrongNumbersAreRefused) {
  const Surface surface(make_grid(4));
  const PaintAtlas atlas = PaintAtlas::cells(surface, 256);
  const StampImage image = solid(4, 4);
  PaintLayers layers(256, {255, 255, 255});
  StrokePainter painter(atlas);
  Stamp stamp;
  EXPECT_THROW(painter.begin(layers, 0, stamp, image), Error);
  stamp.size = 0.3;
  stamp.spacing = 0.0;
  EXPECT_THROW(painter.begin(layers, 0, stamp, image), Error);
  EXPECT_THROW(painter.begin(layers, 0, Ribbon{}, image), Error);
  EXPECT_FALSE(layers.has_stroke());
  stamp.spacing = 1.0;
  painter.begin(layers, 0, stamp, image);
  painter.move_to({0, Vec3::Constant(1.0 / 3.0)});
  painter.end();
  EXPECT_TRUE(layers.can_undo());
}

}  // namespace
}  // namespace mimicry
