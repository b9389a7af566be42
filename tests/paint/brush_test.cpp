#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/paint/brush.h>

#include "messy/messy_meshes.h"
#include "paint/support.h"
#include "support/allocations.h"

namespace mimicry {
namespace {

using test::shape_surface;

constexpr Rgb8 kWhite = {255, 255, 255};

// The integral over the surface of what an open stroke covers, and that of 1 over what is weighed:
// each texel counts for the part of its face that it shows.
double covered_area(const PaintAtlas& atlas, const PaintLayers& layers) {
  const TriangleMesh& mesh = atlas.surface().mesh();
  double sum = 0.0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    double covered = 0.0, weights = 0.0;
    const TexelFrame frame = atlas.frame(f);
    atlas.for_each_run(f, [&](const TexelRun& run) {
      for (int x = run.begin; x < run.end; ++x) {
        const Vec3 b = frame.bary(x, run.y);
        if (b.minCoeff() < -1e-9) continue;
        // Texels on edges and corners stand for half and for less.
        const auto on = (b.array() < 1e-9).count();
        const double weight = on == 0 ? 1.0 : on == 1 ? 0.5 : 1.0 / 6.0;
        covered += weight * double(layers.coverage(x, run.y));
        weights += weight;
      }
    });
    if (weights > 0.0) sum += 0.5 * mesh.area_vector(f).norm() * covered / weights;
  }
  return sum;
}

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (Index f = 0; f < mesh.face_count(); ++f) sum += 0.5 * mesh.area_vector(f).norm();
  return sum;
}

Brush brush_of(double radius) {
  Brush brush;
  brush.radius = radius;
  return brush;
}

// A point of a grid in the plane z = 0.
SurfacePoint at_place(const Surface& surface, double x, double y) {
  const TriangleMesh& mesh = surface.mesh();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vec3 a = mesh.corner(f, 0), b = mesh.corner(f, 1) - a, c = mesh.corner(f, 2) - a;
    const double d = b.x() * c.y() - b.y() * c.x(), px = x - a.x(), py = y - a.y();
    const double s = (px * c.y() - py * c.x()) / d, t = (b.x() * py - b.y() * px) / d;
    if (s >= -1e-12 && t >= -1e-12 && s + t <= 1.0 + 1e-12) return {f, Vec3(1.0 - s - t, s, t)};
  }
  ADD_FAILURE() << "no face at " << x << ", " << y;
  return {};
}

// Goes straight on the surface to the next point.
void line(StrokePainter& painter, const Surface& surface, const SurfacePoint& from,
          const SurfacePoint& to, double pressure = 1.0) {
  LocalPathFinder finder(surface);
  std::vector<Crossing> crossings;
  ASSERT_NE(finder.find(from, to, crossings).label, PathLabel::disconnected);
  painter.line_to(crossings, to, pressure);
}

TEST(Brush, ADabOnASphereCoversItsCap) {
  const Surface surface = shape_surface("sphere", 32);
  const PaintAtlas atlas = PaintAtlas::cells(surface, 1024);
  Brush brush = brush_of(0.3);
  brush.hardness = 1.0;
  for (const Index face : {0, 4321, 12000}) {
    PaintLayers layers(1024, kWhite);
    StrokePainter painter(atlas);
    painter.begin(layers, 0, brush);
    painter.move_to({face, Vec3(0.2, 0.5, 0.3)});
    const double share = covered_area(atlas, layers) / area(surface.mesh());
    EXPECT_NEAR(share, 0.5 * (1.0 - std::cos(0.3)), 0.005 * 0.022332) << "face " << face;
  }
}

TEST(Brush, HardnessSaysWhatADabCoversInTheMean) {
  const Surface surface(make_grid(37));
  const PaintAtlas atlas = PaintAtlas::cells(surface, 1024);
  const double means[3] = {0.3, 0.575, 1.0};
  for (int i = 0; i < 3; ++i) {
    Brush brush = brush_of(0.25);
    brush.hardness = 0.5 * i;
    PaintLayers layers(1024, kWhite);
    StrokePainter painter(atlas);
    painter.begin(layers, 0, brush);
    painter.move_to(at_place(surface, 0.123, -0.071));
    const double mean = covered_area(atlas, layers) / (std::numbers::pi * 0.25 * 0.25);
    EXPECT_NEAR(mean, means[i], 0.01 * means[i]) << "hardness " << brush.hardness;
  }
}

TEST(Brush, ABrushFarSmallerThanItsFaceIsRound) {
  const Surface surface(make_box(1, 1, 1, Vec3(1.0, 1.0, 1.0)));
  const PaintAtlas atlas = PaintAtlas::cells(surface, 2048);
  Brush brush = brush_of(0.02);
  brush.hardness = 1.0;
  PaintLayers layers(2048, kWhite);
  StrokePainter painter(atlas);
  painter.begin(layers, 0, brush);
  for (const Vec3& b : {Vec3(0.3, 0.3, 0.4), Vec3(0.9, 0.05, 0.05), Vec3(0.5, 0.4999, 0.0001)})
    painter.move_to({3, b});
  EXPECT_NEAR(covered_area(atlas, layers), 3.0 * std::numbers::pi * 0.02 * 0.02, 0.02 * 0.00377);
}

TEST(Brush, FlowIsCoveredInTheMiddleWhateverTheSpacing) {
  const Surface surface(make_grid(8));
  const PaintAtlas atlas = PaintAtlas::cells(surface, 512);
  for (const double spacing : {0.05, 0.1, 0.25}) {
    Brush brush = brush_of(0.1);
    brush.hardness = 1.0;
    brush.flow = 0.6;
    brush.spacing = spacing;
    PaintLayers layers(512, kWhite);
    StrokePainter painter(atlas);
    painter.begin(layers, 0, brush);
    const SurfacePoint from = at_place(surface, -0.7, 0.013), to = at_place(surface, 0.7, 0.013);
    painter.move_to(from);
    line(painter, surface, from, to);
    for (int i = 0; i < 50; ++i) {
      const Vec2 texel = atlas.place(at_place(surface, -0.4 + 0.0161 * i, 0.015));
      EXPECT_NEAR(double(layers.coverage(int(std::lround(texel.x())), int(std::lround(texel.y())))),
                  0.6, 0.01)
          << spacing;
    }
  }
}

TEST(Brush, AStrokeThatCrossesItselfIsNotDarkerAndTwoStrokesAre) {
  const Surface surface(make_grid(8));
  const PaintAtlas atlas = PaintAtlas::cells(surface, 512);
  Brush brush = brush_of(0.1);
  brush.opacity = 0.5;
  PaintLayers layers(512, kWhite);
  StrokePainter painter(atlas);
  const SurfacePoint a = at_place(surface, -0.5, -0.5), b = at_place(surface, 0.5, 0.5),
                     c = at_place(surface, -0.5, 0.5), d = at_place(surface, 0.5, -0.5);
  const auto most = [&] {
    int largest = 0;
    for (int y = 0; y < 512; ++y)
      for (int x = 0; x < 512; ++x)
        largest = std::max<int>(largest, layers.layer_texel(0, x, y)[3]);
    return largest;
  };
  for (const int expected : {128, 191}) {
    painter.begin(layers, 0, brush);
    painter.move_to(a);
    line(painter, surface, a, b);
    line(painter, surface, b, c);
    line(painter, surface, c, d);
    painter.end();
    EXPECT_NEAR(most(), expected, 1);
  }
}

// A wave on a torus, drawn at even speed and sampled at a rate.
std::vector<Rgba8> drawn_at(double hertz, const PaintAtlas& atlas, const Brush& brush) {
  const Surface& surface = atlas.surface();
  const SurfacePoint start{1234, Vec3(0.3, 0.3, 0.4)};
  PaintLayers layers(atlas.size(), kWhite);
  StrokePainter painter(atlas);
  painter.begin(layers, 0, brush);
  painter.move_to(start, 0.2);
  // A geodesic of 1.4 units in one second: its samples at any rate join to the same curve.
  const double length = 1.4;
  const auto steps = static_cast<int>(hertz);
  std::vector<Crossing> crossings;
  SurfacePoint last = start;
  Vec3 direction(0.3, 0.5, 0.8);
  for (int i = 0; i < steps; ++i) {
    crossings.clear();
    const Trace trace = trace_straightest(surface, last, direction, length / steps, &crossings);
    EXPECT_EQ(trace.stop, TraceStop::complete);
    painter.line_to(crossings, trace.end, 0.2 + 0.8 * (i + 1) / steps);
    last = trace.end;
    direction = trace.direction;
  }
  painter.end();
  return {layers.pixels().begin(), layers.pixels().end()};
}

TEST(Brush, TheFrameRateDoesNotShow) {
  const Surface surface = shape_surface("torus", 40);
  const PaintAtlas atlas = PaintAtlas::cells(surface, 1024);
  for (const BrushBlend blend : {BrushBlend::build, BrushBlend::max}) {
    Brush brush = brush_of(0.1);
    brush.hardness = 0.3;
    brush.flow = 0.7;
    brush.blend = blend;
    brush.pressure_size = 0.5;
    const std::vector<Rgba8> slow = drawn_at(30, atlas, brush);
    for (const double hertz : {90.0, 240.0}) {
      const std::vector<Rgba8> fast = drawn_at(hertz, atlas, brush);
      int largest = 0, painted = 0;
      for (std::size_t i = 0; i < slow.size(); ++i) {
        largest = std::max(largest, std::abs(int(slow[i][0]) - int(fast[i][0])));
        painted += slow[i][0] < 250;
      }
      EXPECT_GT(painted, 1000);
      EXPECT_LE(largest, 2) << hertz << (blend == BrushBlend::max ? " max" : " build");
    }
  }
}

TEST(Brush, TheOtherSideOfAPlateGetsNothing) {
  const Surface surface = shape_surface("plate", 0);
  const PaintAtlas atlas = PaintAtlas::cells(surface, 512);
  const TriangleMesh& mesh = surface.mesh();
  Index face = kNone;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vec3 x = mesh.position(SurfacePoint{f, Vec3::Constant(1.0 / 3.0)});
    if (std::abs(x.x()) < 0.1 && std::abs(x.y()) < 0.1 && x.z() > 0.0) face = f;
  }
  ASSERT_NE(face, kNone);
  PaintLayers layers(512, kWhite);
  StrokePainter painter(atlas);
  painter.begin(layers, 0, brush_of(0.3));  // the plate is 0.04 thick
  painter.move_to({face, Vec3::Constant(1.0 / 3.0)});
  int front = 0;
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) {
      if (!(layers.coverage(x, y) > 0.0f)) continue;
      ASSERT_GT(surface.position(atlas.point(x, y)).z(), 0.0);
      ++front;
    }
  EXPECT_GT(front, 500);
}

TEST(Brush, TheNextFingerGetsNothing) {
  const Surface surface = shape_surface("hand", 0);
  const PaintAtlas atlas = PaintAtlas::cells(surface, 512);
  const TriangleMesh& mesh = surface.mesh();
  const Vec3 tip = hand_finger_axis(1, 0.9);
  SurfacePoint start;
  double nearest = kInfinity;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const SurfacePoint p{f, Vec3::Constant(1.0 / 3.0)};
    const double d = (mesh.position(p) - tip).norm();
    if (d < nearest) nearest = d, start = p;
  }
  const auto distance_to = [&](int finger, const Vec3& x) {
    double least = kInfinity;
    for (double t = 0.4; t <= 1.0; t += 0.02)
      least = std::min(least, (hand_finger_axis(finger, t) - x).norm());
    return least;
  };
  // Long enough to reach the next fingertip through the air, and not along the surface.
  const double radius = 1.3 * (hand_finger_axis(2, 0.9) - tip).norm();
  PaintLayers layers(512, kWhite);
  StrokePainter painter(atlas);
  painter.begin(layers, 0, brush_of(radius));
  painter.move_to(start);
  int painted = 0;
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) {
      if (!(layers.coverage(x, y) > 0.0f)) continue;
      const Vec3 p = surface.position(atlas.point(x, y));
      ASSERT_LE(distance_to(1, p), distance_to(2, p));
      ++painted;
    }
  EXPECT_GT(painted, 300);
}

TEST(Brush, MessyMeshesArePaintedTwiceWithTheSameBits) {
  int painted = 0;
  for (const messy::Family& family : messy::families()) {
    SCOPED_TRACE(family.name);
    const Surface surface(family.make(300, 5));
    const PaintAtlas atlas = PaintAtlas::cells(surface, 256);
    std::vector<Rgba8> pictures[2];
    for (auto& picture : pictures) {
      Random random(11);
      PaintLayers layers(256, kWhite);
      StrokePainter painter(atlas);
      for (const BrushBlend blend : {BrushBlend::build, BrushBlend::max}) {
        Brush brush = brush_of(0.05 + 0.1 * random.uniform());
        brush.blend = blend;
        painter.begin(layers, 0, brush);
        SurfacePoint last;
        for (int i = 0; i < 6; ++i) {
          const auto face = static_cast<Index>(
              random.below(static_cast<std::uint32_t>(surface.mesh().face_count())));
          if (repeats_corner(surface.mesh().face(face))) continue;
          const SurfacePoint p{face, i % 2 == 0 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.2, 0.3, 0.5)};
          std::vector<Crossing> crossings;
          LocalPathFinder finder(surface);
          if (last.face == kNone ||
              finder.find(last, p, crossings).label == PathLabel::disconnected)
            painter.move_to(p);
          else
            painter.line_to(crossings, p);
          last = p;
        }
        painter.end();
      }
      picture.assign(layers.pixels().begin(), layers.pixels().end());
    }
    EXPECT_EQ(pictures[0], pictures[1]);
    for (const Rgba8& pixel : pictures[0]) painted += pixel[0] < 128;
  }
  EXPECT_GT(painted, 1000);
}

TEST(Brush, SeamsOfADabDoNotShow) {
  const Surface surface = shape_surface("torus", 24);
  const PaintAtlas atlas = PaintAtlas::cells(surface, 1024);
  double texel = 0.0;
  for (Index f = 0; f < surface.mesh().face_count(); ++f)
    texel = std::max(texel, atlas.texel_length(f));
  Brush brush = brush_of(20.0 * texel);
  brush.hardness = 0.2;
  PaintLayers layers(1024, {0, 0, 0});
  brush.color = kWhite;
  StrokePainter painter(atlas);
  painter.begin(layers, 0, brush);
  painter.move_to({777, Vec3(0.1, 0.2, 0.7)});
  const auto sample = [&](const SurfacePoint& p) {
    return test::bilinear(atlas, atlas.place(p),
                          [&](int x, int y) { return double(layers.coverage(x, y)); });
  };
  const HalfEdges& edges = surface.half_edges();
  double sum = 0.0, largest = 0.0;
  int count = 0;
  for (Index h = 0; h < edges.count(); ++h) {
    if (edges.edge(h) != h || !edges.has_twin(h)) continue;
    for (int i = 0; i <= 10; ++i) {
      const double t = i / 10.0;
      const double a = sample(surface_point(Crossing{h, t}));
      const double b = sample(surface_point(Crossing{edges.twin(h), 1.0 - t}));
      if (a + b == 0.0 || a + b >= 2.0) continue;
      sum += std::abs(a - b);
      largest = std::max(largest, std::abs(a - b));
      ++count;
    }
  }
  ASSERT_GT(count, 100);
  EXPECT_LE(255.0 * sum / count, 1.0);
  EXPECT_LE(255.0 * largest, 6.0);
}

TEST(Brush, OneLargerThanTheObjectCoversItsComponent) {
  const Surface surface(make_two_spheres(6));
  const PaintAtlas atlas = PaintAtlas::cells(surface, 512);
  for (const double radius : {1e6, kInfinity}) {
    Brush brush = brush_of(radius);
    PaintLayers layers(512, kWhite);
    StrokePainter painter(atlas);
    painter.begin(layers, 0, brush);
    painter.move_to({0, Vec3::Constant(1.0 / 3.0)});
    EXPECT_NEAR(covered_area(atlas, layers), 0.5 * area(surface.mesh()),
                1e-6 * area(surface.mesh()))
        << radius;
  }
}

TEST(Brush, AFrameAllocatesNothingOnceItsMemoryIsThere) {
  const Surface surface = shape_surface("torus", 24);
  const PaintAtlas atlas = PaintAtlas::cells(surface, 512);
  PaintLayers layers(512, kWhite);
  StrokePainter painter(atlas);
  const Brush brush = brush_of(0.1);
  std::vector<Crossing> crossings;
  const SurfacePoint from{40, Vec3(0.2, 0.2, 0.6)};
  const SurfacePoint to =
      trace_straightest(surface, from, Vec3(0.2, 0.9, 0.1), 0.3, &crossings).end;
  for (int round = 0; round < 2; ++round) {
    painter.begin(layers, 0, brush);
    const long before = test::allocation_count();
    painter.move_to(from);
    painter.line_to(crossings, to);
    if (round == 1) {
      EXPECT_EQ(test::allocation_count(), before);
    }
    painter.end();
  }
}

TEST(Brush, TheEraserTakesItsDabAway) {
  const Surface surface(make_grid(4));
  const PaintAtlas atlas = PaintAtlas::cells(surface, 256);
  PaintLayers layers(256, kWhite);
  StrokePainter painter(atlas);
  Brush brush = brush_of(0.3);
  brush.hardness = 1.0;
  const auto painted = [&] {
    std::size_t count = 0;
    for (const Rgba8& pixel : layers.pixels()) count += pixel[0] < 255;
    return count;
  };
  for (const bool erase : {false, true}) {
    brush.erase = erase;
    if (erase) brush.radius = 0.4;
    painter.begin(layers, 0, brush);
    painter.move_to(at_place(surface, 0.1, 0.2));
    painter.end();
    if (erase)
      EXPECT_EQ(painted(), 0u);
    else
      EXPECT_GT(painted(), 500u);
  }
}

TEST(Brush, PressureTakesFlowAway) {
  const Surface surface(make_grid(4));
  const PaintAtlas atlas = PaintAtlas::cells(surface, 256);
  PaintLayers layers(256, kWhite);
  StrokePainter painter(atlas);
  Brush brush = brush_of(0.3);
  brush.flow = 0.8;
  brush.pressure_flow = 0.5;
  brush.blend = BrushBlend::max;
  const SurfacePoint point = at_place(surface, 0.1, 0.2);
  const Vec2 texel = atlas.place(point);
  for (const double pressure : {0.0, 0.5, 1.0}) {
    painter.begin(layers, 0, brush);
    painter.move_to(point, pressure);
    EXPECT_NEAR(double(layers.coverage(int(std::lround(texel.x())), int(std::lround(texel.y())))),
                0.4 + 0.4 * pressure, 1e-6);
    painter.cancel();
  }
}

TEST(Brush, AStrokeThatIsCancelledOrRefusedLeavesNothing) {
  const Surface surface(make_grid(4));
  const PaintAtlas atlas = PaintAtlas::cells(surface, 256);
  PaintLayers layers(256, kWhite);
  StrokePainter painter(atlas);
  painter.cancel();
  painter.begin(layers, 0, brush_of(0.1));
  painter.move_to({0, Vec3::Constant(1.0 / 3.0)});
  painter.cancel();
  EXPECT_THROW(painter.move_to({0, Vec3::Constant(1.0 / 3.0)}), Error);
  ProjectedCurve curve;
  curve.points.resize(1);
  curve.points[0].surface = {0, Vec3::Constant(1.0 / 3.0)};
  const double wrong[1] = {2.0};
  EXPECT_THROW(paint_curve(painter, layers, 0, brush_of(0.1), curve, wrong), Error);
  EXPECT_FALSE(layers.has_stroke());
  EXPECT_FALSE(layers.can_undo());
  for (const Rgba8& pixel : layers.pixels()) ASSERT_EQ(pixel, (Rgba8{255, 255, 255, 255}));
  paint_curve(painter, layers, 0, brush_of(0.1), curve);
  EXPECT_TRUE(layers.can_undo());
}

TEST(Brush, WhatIsOutOfRangeIsRefused) {
  const Surface surface(make_grid(4));
  const PaintAtlas atlas = PaintAtlas::cells(surface, 256);
  PaintLayers layers(256, kWhite), larger(512, kWhite);
  StrokePainter painter(atlas);
  const auto refuses = [&](const Brush& brush, PaintLayers& on, const char* why) {
    try {
      painter.begin(on, 0, brush);
      ADD_FAILURE() << why;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(why));
    }
    EXPECT_FALSE(on.has_stroke());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses(brush_of(0.0), layers, "radius is not above 0");
  refuses(brush_of(nan), layers, "radius is not above 0");
  Brush brush = brush_of(0.1);
  brush.hardness = nan;
  refuses(brush, layers, "hardness is out of range; give 0 to 1");
  brush = brush_of(0.1);
  brush.spacing = 0.0;
  refuses(brush, layers, "spacing is out of range; give 0.01 to 1");
  refuses(brush_of(0.1), larger, "512 texels wide and the atlas 256");
  EXPECT_THROW(painter.move_to({0, Vec3::Constant(1.0 / 3.0)}), Error);
  painter.begin(layers, 0, brush_of(0.1));
  EXPECT_THROW(painter.move_to({1000, Vec3::Constant(1.0 / 3.0)}), Error);
  EXPECT_THROW(painter.move_to({0, Vec3::Constant(1.0 / 3.0)}, 1.5), Error);
}

}  // namespace
}  // namespace mimicry
