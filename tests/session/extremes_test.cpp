#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>

#include "support/strokes.h"

namespace mimicry {
namespace {

struct Extreme {
  double scale;
  Vec3 offset;
};

// A model in other units or far from its origin, shown at the same size in the same place, takes
// the same curve to the same relative accuracy.
TEST(Extremes, UnitsAndOriginOfTheModelDoNotMatter) {
  const TriangleMesh mesh = make_sphere(12);
  const Stroke stroke = test::waving_stroke(200);
  const Target reference(mesh);
  for (const auto& info : techniques()) {
    if (info.needs_bake) continue;  // baked_test.cpp
    const ProjectedCurve expected = project({reference}, info, stroke).curve;
    for (const Extreme& e : {Extreme{1e-6, Vec3::Zero()}, Extreme{1e6, Vec3::Zero()},
                             Extreme{1.0, Vec3(1e4, -1e4, 1e4)}}) {
      std::vector<Vec3> moved;
      for (const Vec3& x : mesh.positions()) moved.push_back(e.scale * x + e.offset);
      const Target target(mesh.with_positions(moved));
      Stroke placed = stroke;
      placed.model_to_world = {Quat::Identity(), -e.offset / e.scale, 1.0 / e.scale};
      const ProjectedCurve curve = project({target}, info, placed).curve;
      ASSERT_EQ(curve.points.size(), expected.points.size()) << info.name << e.scale;
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const Vec3 shown = placed.model_to_world.point(curve.points[i].position);
        // At 1e4 units from the origin a double resolves 2e-12, and 200 anchored steps add up.
        ASSERT_LT((shown - expected.points[i].position).norm(), 1e-9) << info.name << " " << i;
      }
    }
  }
}

TEST(Extremes, StrokeTenMetresAwayWorks) {
  const Target target(make_sphere(12));
  Stroke stroke = test::waving_stroke(100);
  stroke.model_to_world.translation = Vec3(0, 0, -10);
  for (const auto& info : techniques()) {
    if (info.needs_bake) continue;  // baked_test.cpp
    const ProjectedCurve curve = project({target}, info, stroke).curve;
    for (const auto& p : curve.points) EXPECT_TRUE(p.position.allFinite()) << info.name;
    // Lines of sight and the head's axis miss a target that far aside; what looks for it finds it.
    if (info.name == "snap" || info.name == "anchored-closest") {
      EXPECT_EQ(curve.points.size(), 100u) << info.name;
    }
  }
}

TEST(Extremes, DuplicateFramesAddPointsWithoutLength) {
  const Target target(make_sphere(12));
  const Stroke stroke = test::waving_stroke(60);
  Stroke doubled = stroke;
  doubled.frames.clear();
  for (const auto& frame : stroke.frames) doubled.frames.insert(doubled.frames.end(), 2, frame);
  for (const auto& info : techniques()) {
    if (info.needs_bake) continue;  // baked_test.cpp
    const ProjectedCurve once = project({target}, info, stroke).curve;
    const ProjectedCurve twice = project({target}, info, doubled).curve;
    // Without any motion yet a ray across it is undefined: the first frame's double misses.
    const std::size_t missed = info.name == "anchored-ray-plane" ? 1 : 0;
    ASSERT_EQ(twice.points.size() + missed, 2 * once.points.size()) << info.name;
    EXPECT_NEAR(length(twice), length(once), 1e-9) << info.name;
  }
}

TEST(Extremes, FrameRatesFrom20To1000HzGiveTheSameShape) {
  const Target target(make_sphere(24));
  for (const auto& info : techniques()) {
    if (info.needs_bake) continue;  // baked_test.cpp
    const ProjectedCurve slow = project({target}, info, test::waving_stroke(41, 20.0)).curve;
    const ProjectedCurve fast = project({target}, info, test::waving_stroke(2001, 1000.0)).curve;
    ASSERT_FALSE(slow.points.empty()) << info.name;
    // The same two seconds; an anchored closest point loses the sagitta of each step, which 20 Hz
    // makes some per cent of the length.
    EXPECT_NEAR(length(slow), length(fast), 0.06 * length(fast)) << info.name;
  }
}

TEST(Extremes, SmallAndOddTargets) {
  const TriangleMesh one({Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)}, {{0, 1, 2}});
  struct Placed {
    TriangleMesh mesh;
    Vec3 at;  // so that the stroke passes over it
  };
  for (const auto& [mesh, at] : {Placed{one, Vec3::Zero()}, Placed{make_grid(4), Vec3::Zero()},
                                 Placed{make_two_spheres(4), Vec3(-0.4, -0.3, 0)},
                                 Placed{make_moebius_strip(16), Vec3(-0.9, 0, 0)}}) {
    const Target target(mesh);
    Stroke stroke = test::waving_stroke(100);
    stroke.model_to_world.translation = at;
    for (const auto& info : techniques()) {
      if (info.needs_bake) continue;  // baked_test.cpp
      const ProjectedCurve curve = project({target}, info, stroke).curve;
      ASSERT_FALSE(curve.points.empty()) << info.name << ", " << mesh.face_count() << " faces";
      for (const auto& p : curve.points) ASSERT_TRUE(p.position.allFinite()) << info.name;
    }
  }
  EXPECT_THROW(Target(TriangleMesh{}), Error);
  const TriangleMesh flat({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}, {{0, 1, 2}});
  EXPECT_THROW(Target{flat}, Error);
}

}  // namespace
}  // namespace mimicry
