#include "support/baked.h"

#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>

#include "support/allocations.h"
#include "support/strokes.h"

namespace mimicry {
namespace {

// The techniques that need a bake, in the same trials as the others.
template <class Visit>
void each_baked_technique(Visit&& visit) {
  int count = 0;
  for (const auto& info : techniques())
    if (info.needs_bake) {
      visit(info);
      ++count;
    }
  EXPECT_EQ(count, 4);
}

void expect_same(const ProjectedCurve& a, const ProjectedCurve& b, double tolerance) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i)
    ASSERT_LE((a.points[i].position - b.points[i].position).norm(), tolerance) << i;
}

TEST(BakedSession, ReplaysBitForBitAndAllocatesNothing) {
  const test::BakedTarget baked(make_sphere(8));
  const Stroke stroke = test::waving_stroke(200);
  each_baked_technique([&](const TechniqueInfo& info) {
    const ProjectedCurve once = project(baked.canvas(), info, stroke).curve;
    EXPECT_GT(once.points.size(), 100u) << info.name;
    StrokeSession session(baked.canvas(), info);
    session.begin({});
    for (const auto& frame : test::waving_stroke(50, 30.0).frames) session.add(frame);
    session.begin(stroke.model_to_world);
    const long before = test::allocation_count();
    for (const auto& frame : stroke.frames) session.add(frame);
    EXPECT_EQ(test::allocation_count(), before) << info.name;
    expect_same(once, session.curve(), 0.0);
  });
}

TEST(BakedSession, CountsHowEachPointWasFound) {
  const test::BakedTarget baked(make_sphere(8));
  StrokeSession session(baked.canvas(), find_technique("snap-smooth"));
  session.begin({});
  double time_s = 0.0;
  for (const double height : {1.05, 1.02, 3.0, 1.04, 4.0}) {
    Frame frame;
    frame.time_s = time_s += 0.01;
    frame.controller.position = Vec3(0.1, 0.2, 1.0).normalized() * height;
    session.add(frame);
  }
  EXPECT_EQ(session.answers()[Answer::smooth], 3);
  EXPECT_EQ(session.answers()[Answer::outside_shell], 2);
  session.begin({});
  EXPECT_EQ(session.answers()[Answer::smooth], 0);
}

TEST(BakedSession, UnitsAndOriginOfTheModelDoNotMatter) {
  const TriangleMesh mesh = make_sphere(6);
  const Stroke stroke = test::waving_stroke(100);
  const test::BakedTarget reference(mesh);
  struct Place {
    double scale;
    Vec3 offset;
  };
  for (const Place& p : {Place{0x1p-20, Vec3::Zero()}, Place{0x1p20, Vec3::Zero()},
                         Place{1.0, Vec3(1e4, -1e4, 1e4)}}) {
    // The same bake, moved along: that a bake is the same elsewhere is the bake's affair.
    std::vector<Vec3> moved;
    for (const Vec3& x : mesh.positions()) moved.push_back(p.scale * x + p.offset);
    const Target target(mesh.with_positions(moved));
    Embedding e = reference.projector.embedding();
    e.mesh_hash = content_hash(target.mesh());
    for (Vec3& x : e.positions) x = p.scale * x + p.offset;
    for (double& x : e.values) x *= p.scale;
    const SmoothProjector projector(e, target);
    Stroke placed = stroke;
    placed.model_to_world = {Quat::Identity(), -p.offset / p.scale, 1.0 / p.scale};
    each_baked_technique([&](const TechniqueInfo& info) {
      const ProjectedCurve expected = project(reference.canvas(), info, stroke).curve;
      ProjectedCurve curve = project({target, 1.0, projector}, info, placed).curve;
      for (auto& point : curve.points) point.position = placed.model_to_world.point(point.position);
      // At 1e4 units from the origin a double resolves 2e-12, and 100 anchored steps add up.
      expect_same(expected, curve, 1e-9);
    });
  }
}

TEST(BakedSession, OddTargets) {
  const TriangleMesh one({Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)}, {{0, 1, 2}});
  struct Placed {
    TriangleMesh mesh;
    Vec3 at;  // so that the stroke passes within the shell
  };
  for (const Placed& placed : {Placed{one, Vec3(0, 0, 1.1)}, Placed{make_grid(5), Vec3(0, 0, 1.1)},
                               Placed{make_two_spheres(4), Vec3(-0.4, -0.3, 0.7)}}) {
    const test::BakedTarget baked(placed.mesh);
    Stroke stroke = test::waving_stroke(100);
    stroke.model_to_world.translation = placed.at;
    each_baked_technique([&](const TechniqueInfo& info) {
      const ProjectedCurve curve = project(baked.canvas(), info, stroke).curve;
      ASSERT_FALSE(curve.points.empty())
          << info.name << ", " << placed.mesh.face_count() << " faces";
      for (const auto& p : curve.points) ASSERT_TRUE(p.position.allFinite()) << info.name;
    });
  }
}

}  // namespace
}  // namespace mimicry
