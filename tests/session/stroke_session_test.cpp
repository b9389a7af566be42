#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>

#include "support/strokes.h"

namespace mimicry {
namespace {

bool same_bits(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

// The first points, pieces and crossings of `longer` are `shorter`, bit for bit.
bool starts_with(const ProjectedCurve& longer, const ProjectedCurve& shorter) {
  if (longer.points.size() < shorter.points.size() ||
      longer.crossings.size() < shorter.crossings.size())
    return false;
  for (std::size_t i = 0; i < shorter.points.size(); ++i) {
    const CurvePoint& a = longer.points[i];
    const CurvePoint& b = shorter.points[i];
    if (a.surface.face != b.surface.face || !same_bits(a.surface.bary, b.surface.bary) ||
        !same_bits(a.position, b.position) || a.frame != b.frame)
      return false;
  }
  for (std::size_t i = 0; i < shorter.crossings.size(); ++i)
    if (longer.crossings[i].half_edge != shorter.crossings[i].half_edge ||
        longer.crossings[i].t != shorter.crossings[i].t)
      return false;
  return true;
}

bool same(const ProjectedCurve& a, const ProjectedCurve& b) {
  return starts_with(a, b) && starts_with(b, a);
}

struct Sphere {
  Target target{make_sphere(12)};
  Canvas canvas{target};
};

TEST(StrokeSession, ReplayIsIdenticalBitForBit) {
  const Sphere sphere;
  const Stroke stroke = test::waving_stroke(300);
  for (const auto& info : techniques()) {
    if (info.needs_bake) continue;  // baked_test.cpp
    const ProjectedCurve once = project(sphere.canvas, info, stroke).curve;
    EXPECT_GT(once.points.size(), 100u) << info.name;
    EXPECT_TRUE(same(once, project(sphere.canvas, info, stroke).curve)) << info.name;
    // A session that has drawn something else before draws the same.
    StrokeSession session(sphere.canvas, info);
    session.begin({});
    for (const auto& frame : test::waving_stroke(50, 30.0).frames) session.add(frame);
    session.begin(stroke.model_to_world);
    for (const auto& frame : stroke.frames) session.add(frame);
    EXPECT_TRUE(same(once, session.curve())) << info.name;
  }
}

TEST(StrokeSession, WhatIsInkedNeverChanges) {
  const Sphere sphere;
  const Stroke stroke = test::waving_stroke(120);
  for (const auto& info : techniques()) {
    if (info.needs_bake) continue;  // baked_test.cpp
    StrokeSession session(sphere.canvas, info);
    session.begin(stroke.model_to_world);
    ProjectedCurve before;
    for (const auto& frame : stroke.frames) {
      session.add(frame);
      ASSERT_TRUE(starts_with(session.curve(), before)) << info.name;
      before = session.curve();
    }
  }
}

TEST(StrokeSession, PointsKnowTheirFrameTimeAndDistance) {
  const Sphere sphere;
  const Stroke stroke = test::waving_stroke(40);
  const ProjectedCurve curve = project(sphere.canvas, find_technique("snap"), stroke).curve;
  ASSERT_EQ(curve.points.size(), 40u);
  for (std::size_t i = 0; i < 40; ++i) {
    const CurvePoint& p = curve.points[i];
    EXPECT_EQ(p.frame, Index(i));
    EXPECT_EQ(p.time_s, stroke.frames[i].time_s);
    EXPECT_DOUBLE_EQ(p.pen_distance, (stroke.frames[i].controller.position - p.position).norm());
    EXPECT_NEAR(p.normal.norm(), 1.0, 1e-14);
    EXPECT_NEAR(p.surface.bary.sum(), 1.0, 1e-14);
    EXPECT_GE(p.surface.bary.minCoeff(), 0.0);
  }
}

TEST(StrokeSession, MissesConnectOrSplit) {
  const Sphere sphere;
  Stroke stroke = test::waving_stroke(30);
  for (std::size_t i = 10; i < 15; ++i)
    stroke.frames[i].controller.orientation = Quat(Eigen::AngleAxisd(3.1, Vec3::UnitY()));
  const auto& spray = find_technique("spraycan");
  const ProjectedCurve connected = project(sphere.canvas, spray, stroke).curve;
  EXPECT_EQ(connected.points.size(), 25u);
  for (const auto& piece : connected.pieces) EXPECT_NE(piece.kind, PieceKind::gap);
  SessionOptions options;
  options.misses = MissPolicy::split;
  const ProjectedCurve split = project(sphere.canvas, spray, stroke, options).curve;
  EXPECT_EQ(split.points.size(), 25u);
  for (std::size_t i = 0; i < split.pieces.size(); ++i)
    EXPECT_EQ(split.pieces[i].kind == PieceKind::gap, i == 9) << i;
  EXPECT_EQ(polylines(split, sphere.target.mesh()).size(), 2u);
}

TEST(StrokeSession, StillFramesArePassedOver) {
  const Sphere sphere;
  SessionOptions options;
  options.minimum_motion_m = 0.02;
  StrokeSession session(sphere.canvas, find_technique("snap"), options);
  session.begin({});
  Vec3 last = Vec3::Constant(1e9);
  for (const auto& frame : test::waving_stroke(90).frames) {
    const bool moved = (frame.controller.position - last).norm() >= 0.02;
    EXPECT_EQ(session.add(frame), moved ? FrameStatus::inked : FrameStatus::still);
    if (moved) last = frame.controller.position;
  }
  EXPECT_GT(session.counts()[FrameStatus::still], 10);
  EXPECT_GT(session.counts()[FrameStatus::inked], 10);
}

TEST(StrokeSession, UnusableFramesAreRejectedAndTheStrokeGoesOn) {
  const Sphere sphere;
  const Stroke stroke = test::waving_stroke(10);
  StrokeSession session(sphere.canvas, find_technique("anchored-closest"));
  EXPECT_EQ(session.add(stroke.frames[0]), FrameStatus::rejected) << "before begin";
  session.begin({});
  EXPECT_EQ(session.add(stroke.frames[0]), FrameStatus::inked);
  Frame lost = stroke.frames[1];
  lost.controller.position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(session.add(lost), FrameStatus::rejected);
  Frame earlier = stroke.frames[1];
  earlier.time_s = -1;
  EXPECT_EQ(session.add(earlier), FrameStatus::rejected);
  EXPECT_EQ(session.add(stroke.frames[2]), FrameStatus::inked);
  EXPECT_EQ(session.curve().points[1].frame, 3) << "rejected frames are counted";
  session.end();
  EXPECT_EQ(session.add(stroke.frames[3]), FrameStatus::rejected) << "after end";
}

TEST(StrokeSession, StrokesOfNoAndOneFrame) {
  const Sphere sphere;
  for (const auto& info : techniques()) {
    if (info.needs_bake) continue;  // baked_test.cpp
    EXPECT_TRUE(project(sphere.canvas, info, test::waving_stroke(0)).curve.points.empty());
    const ProjectedCurve one = project(sphere.canvas, info, test::waving_stroke(1)).curve;
    EXPECT_EQ(one.points.size(), 1u) << info.name;
    EXPECT_TRUE(one.pieces.empty());
  }
}

TEST(StrokeSession, RecordedStrokeThatIsNotUsableThrows) {
  const Sphere sphere;
  Stroke stroke = test::waving_stroke(5);
  stroke.frames[3].time_s = -1;
  EXPECT_THROW(project(sphere.canvas, find_technique("snap"), stroke).curve, Error);
}

// A hand in space dips its pen into the object from the first frame to the last.
TEST(StrokeSession, ADippedStrokeStaysOnTheSideThatItWentInto) {
  const Sphere sphere;
  Stroke stroke;
  for (int i = 0; i < 40; ++i) {
    Frame frame;
    frame.time_s = i / 90.0;
    frame.head.position = Vec3(0.0, 0.0, 3.0);
    frame.controller.position = Vec3(0.01 * (i - 20), 0.02 * std::sin(0.3 * i), 0.9);
    stroke.frames.push_back(frame);
  }
  int looked_at = 0;
  for (const auto& info : techniques()) {
    if (info.needs_bake) continue;
    SessionOptions dipped;
    const double on = 1.0;
    for (const OptionInfo& option : info.options)
      if (option.name == "dipped-pen") set_option(info, dipped.technique, option.name, {&on, 1});
    const ProjectedCurve curve = project(sphere.canvas, info, stroke, dipped).curve;
    ASSERT_GT(curve.points.size(), 20u) << info.name;
    for (const CurvePoint& point : curve.points) ASSERT_GT(point.position.z(), 0.5) << info.name;
    ++looked_at;
  }
  EXPECT_EQ(looked_at, 9);
  // The paper's rays go on to the far side.
  const auto far = project(sphere.canvas, find_technique("spraycan"), stroke).curve;
  for (const CurvePoint& point : far.points) EXPECT_LT(point.position.z(), -0.5);
}

}  // namespace
}  // namespace mimicry
