#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/embedding/spline.h>
#include <mimicry/mesh/shapes.h>

#include "support/allocations.h"

namespace mimicry::embedding {
namespace {

struct Baked {
  std::string name;
  spatial::Target target;
  SmoothProjector projector;

  Baked(std::string n, const TriangleMesh& mesh)
      : name(std::move(n)), target(mesh), projector(baked(mesh), target) {}
  static Embedding baked(const TriangleMesh& mesh) {
    BakeOptions options;
    options.samples = 150;
    return bake::bake(mesh, options);
  }

  SurfacePoint random_point(Random& random) const {
    const auto count = static_cast<std::uint32_t>(target.mesh().face_count());
    SurfacePoint p{static_cast<Index>(random.below(count)), Vec3::Zero()};
    const double r = std::sqrt(random.uniform()), s = random.uniform();
    p.bary = Vec3(1.0 - r, r * (1.0 - s), r * s);
    return p;
  }
  // Within the shell but for a few.
  Vec3 query(Random& random, double reach = 0.055) const {
    const Vec3 away(random.normal(), random.normal(), random.normal());
    return target.position(random_point(random)) +
           random.uniform(0.0, reach) * target.diagonal() * away.normalized();
  }
};

// Baked once; every test reads them only.
const std::vector<std::unique_ptr<Baked>>& shapes() {
  static const auto all = [] {
    std::vector<std::unique_ptr<Baked>> list;
    list.push_back(std::make_unique<Baked>("sphere", make_sphere(7)));
    list.push_back(std::make_unique<Baked>("torus", make_torus(30, 14)));
    list.push_back(std::make_unique<Baked>("cube", make_box(7, 7, 7, Vec3::Constant(0.8))));
    list.push_back(std::make_unique<Baked>("grid", make_grid(14)));
    list.push_back(std::make_unique<Baked>("two-spheres", make_two_spheres(5)));
    return list;
  }();
  return all;
}
const Baked& sphere() {
  return *shapes()[0];
}

TEST(SmoothProjector, PointsOfTheMeshProjectToThemselves) {
  Random random(1);
  for (const auto& shape : shapes()) {
    double worst = 0.0;
    for (int i = 0; i < 600; ++i) {
      SurfacePoint p = shape->random_point(random);
      if (i % 3 == 1) p.bary = Vec3::Unit(i % 9 / 3);
      if (i % 3 == 2) {
        p.bary[i % 9 / 3] = 0.0;
        p.bary /= p.bary.sum();
      }
      const Vec3 y = shape->target.position(p);
      const auto q = shape->projector.project(y);
      ASSERT_TRUE(q);
      EXPECT_EQ(q->label, ScpLabel::smooth);
      worst = std::max(worst, (q->position - y).norm());
    }
    EXPECT_LT(worst, 1e-9 * shape->target.diagonal()) << shape->name;
  }
}

TEST(SmoothProjector, FastEqualsExhaustiveWhateverTheHint) {
  Random random(2);
  for (const auto& shape : shapes()) {
    ScpHint warm;
    for (int i = 0; i < 150; ++i) {
      const Vec3 y = shape->query(random);
      const ScpOptions options{i % 2 == 0};
      const auto truth = shape->projector.project_exhaustively(y, options);
      const auto cold = shape->projector.project(y, options);
      const auto fast = shape->projector.project(y, options, &warm);
      for (const auto& q : {cold, fast}) {
        ASSERT_EQ(q->label, truth->label) << shape->name;
        ASSERT_EQ(q->surface.face, truth->surface.face) << shape->name;
        ASSERT_EQ(q->surface.bary, truth->surface.bary) << shape->name;
        ASSERT_EQ(q->position, truth->position) << shape->name;
      }
    }
  }
}

TEST(SmoothProjector, LocatesInTheTetrahedronThatContains) {
  Random random(3);
  for (const auto& shape : shapes()) {
    const Embedding& e = shape->projector.embedding();
    int outside = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec3 y = shape->query(random);
      const ShellPoint place = shape->projector.locate(y);
      if (place.tet == kNone) {
        // Everything within the offset is covered.
        const auto closest = shape->target.closest_point(y);
        EXPECT_GT(closest->distance, 0.99 * e.options.offset * shape->target.diagonal());
        ++outside;
        continue;
      }
      EXPECT_GE(place.bary.minCoeff(), 0.0);
      EXPECT_NEAR(place.bary.sum(), 1.0, 1e-14);
      Vec3 back = Vec3::Zero();
      double size = 0.0;
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3& corner =
            e.positions[static_cast<std::size_t>(e.tets[static_cast<std::size_t>(place.tet)][k])];
        back += place.bary[static_cast<Eigen::Index>(k)] * corner;
        size = std::max(size, (corner - y).norm());
      }
      // In a flat one y is drawn to the nearest other by at most its thickness.
      EXPECT_LT((back - y).norm(), 6e-3 * size) << shape->name;
    }
    EXPECT_LT(outside, 60) << shape->name;
  }
}

TEST(SmoothProjector, AnswersAreLabelled) {
  Random random(4);
  for (const auto& shape : shapes()) {
    const double diagonal = shape->target.diagonal();
    for (int i = 0; i < 60; ++i) {
      const Vec3 y = shape->query(random, i % 2 == 0 ? 0.05 : 0.5);
      const auto q = shape->projector.project(y, {true});
      ASSERT_TRUE(q);
      const auto closest = shape->target.closest_point(y);
      if (q->label == ScpLabel::smooth) {
        EXPECT_LE((y - q->position).norm(), closest->distance + diagonal / 20.0);
      } else {
        EXPECT_EQ(q->position, closest->position);
      }
    }
    const Vec3 far = Vec3(1e9, -2e8, 3e7) * diagonal;
    EXPECT_EQ(shape->projector.project(far)->label, ScpLabel::outside_shell);
  }
}

TEST(SmoothProjector, WhatIsNotFiniteHasNoAnswer) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(sphere().projector.project(Vec3(nan, 0, 0)));
  EXPECT_FALSE(sphere().projector.project(Vec3(0, kInfinity, 0)));
  EXPECT_FALSE(sphere().projector.project(Vec3(0, 0, 1e200)));
  EXPECT_FALSE(sphere().projector.project_exhaustively(Vec3(nan, 0, 0)));
}

TEST(SmoothProjector, TheSphereIsSmootherThanItsFacets) {
  // On a circle outside the sphere snap jumps over corners' fans: steps of 0 beside steps over
  // whole facets. The ideal ratio |dq| / |dp| is 1 / 1.08 everywhere.
  const Baked& shape = sphere();
  double smooth_worst = 0.0, snap_worst = 0.0;
  Vec3 p0 = Vec3::Zero(), smooth0 = Vec3::Zero(), snap0 = Vec3::Zero();
  constexpr int kSteps = 3000;
  for (int i = 0; i <= kSteps; ++i) {
    const double a = 2.0 * 3.141592653589793 * i / kSteps;
    const Vec3 p = 1.08 * Vec3(std::cos(a), 0.6 * std::sin(a), 0.8 * std::sin(a));
    const auto q = shape.projector.project(p);
    ASSERT_EQ(q->label, ScpLabel::smooth);
    const auto s = shape.target.closest_point(p);
    if (i > 0) {
      const double step = (p - p0).norm() / 1.08;
      smooth_worst = std::max(smooth_worst, std::abs((q->position - smooth0).norm() / step - 1.0));
      snap_worst = std::max(snap_worst, std::abs((s->position - snap0).norm() / step - 1.0));
    }
    p0 = p;
    smooth0 = q->position;
    snap0 = s->position;
  }
  EXPECT_GT(snap_worst, 0.9);
  EXPECT_LT(smooth_worst, 0.5 * snap_worst);
}

// A projected path beside the ideal one: how far each step's length is off the ideal one's, and the
// turning of the whole way.
class PathLine {
 public:
  explicit PathLine(const Vec3& start) : q_(start) {}
  void add(const Vec3& to, double ideal_length) {
    const Vec3 step = to - q_;
    off_.push_back(std::abs(step.norm() / ideal_length - 1.0));
    q_ = to;
    if (step.norm() < 1e-12) return;
    if (!way_.isZero(0.0)) turning_ += std::atan2(way_.cross(step).norm(), way_.dot(step));
    way_ = step;
  }
  double quantile(double part) {
    std::sort(off_.begin(), off_.end());
    return off_[static_cast<std::size_t>(part * static_cast<double>(off_.size() - 1))];
  }
  double turning() const { return turning_; }

 private:
  std::vector<double> off_;
  double turning_ = 0.0;
  Vec3 q_, way_ = Vec3::Zero();
};

TEST(SmoothProjector, IsSmootherThanSnapAtEveryResolution) {
  // Around the sphere and along the torus; smoothness_bench has the figures.
  constexpr int kSteps = 2000;
  for (const std::string_view name : {"sphere", "torus"})
    for (const int resolution : {6, 9, 13}) {
      const Baked shape(std::string(name), make_shape(name, {.resolution = resolution}));
      const auto path = [&](int i) -> Vec3 {
        const double a = 2.0 * 3.141592653589793 * i / kSteps;
        if (name == "sphere") return 1.1 * Vec3(std::cos(a), 0.6 * std::sin(a), 0.8 * std::sin(a));
        const double around = 0.7 + 0.5 * std::sin(3.0 * a), minor = kTorusMinorRadius + 0.1;
        const double ring = kTorusMajorRadius + minor * std::cos(around);
        return {ring * std::cos(a), ring * std::sin(a), minor * std::sin(around)};
      };
      const auto smooth_at = [&](int i) { return shape.projector.project(path(i))->position; };
      const auto snap_at = [&](int i) { return shape.target.closest_point(path(i))->position; };
      Vec3 ideal_before = *analytic_closest_point(name, path(0));
      PathLine smooth(smooth_at(0)), snap(snap_at(0)), ideal(ideal_before);
      for (int i = 1; i <= kSteps; ++i) {
        const Vec3 x = *analytic_closest_point(name, path(i));
        const double length = (x - ideal_before).norm();
        ideal.add(x, length);
        smooth.add(smooth_at(i), length);
        snap.add(snap_at(i), length);
        ideal_before = x;
      }
      for (const double part : {0.5, 0.9, 0.99, 1.0})
        EXPECT_LT(smooth.quantile(part), snap.quantile(part)) << name << resolution << " " << part;
      EXPECT_LT(smooth.turning(), snap.turning()) << name << resolution;
      EXPECT_GT(smooth.turning(), 0.99 * ideal.turning()) << name << resolution;
    }
}

TEST(SmoothProjector, RefusesWhatIsNotItsMesh) {
  const Baked& shape = sphere();
  const auto refused = [](Embedding e, const spatial::Target& target, const std::string& what) {
    try {
      const SmoothProjector projector(std::move(e), target);
      ADD_FAILURE() << what;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(what));
    }
  };
  refused(shape.projector.embedding(), shapes()[1]->target, "another mesh");
  std::vector<Vec3> moved(shape.target.mesh().positions().begin(),
                          shape.target.mesh().positions().end());
  moved[5][1] += 1e-12;
  refused(shape.projector.embedding(), spatial::Target(shape.target.mesh().with_positions(moved)),
          "another mesh");
  Embedding e = shape.projector.embedding();
  e.tets[7][2] = e.vertex_count();
  refused(e, shape.target, "tetrahedron 7");
  e = shape.projector.embedding();
  e.values.pop_back();
  refused(e, shape.target, "contradict");
  e = shape.projector.embedding();
  e.values[17] = kInfinity;
  refused(e, shape.target, "vertex 2");
}

TEST(SmoothProjector, QueriesAllocateNothing) {
  Random random(5);
  for (const auto& shape : shapes()) {
    std::vector<Vec3> queries;
    for (int i = 0; i < 40; ++i) queries.push_back(shape->query(random, 0.2));
    ScpHint hint;
    const long before = test::allocation_count();
    for (const Vec3& y : queries) shape->projector.project(y, {true}, &hint);
    EXPECT_EQ(test::allocation_count(), before);
  }
}

TEST(WeightedAverage, OfOnePointIsThePoint) {
  Random random(6);
  for (const auto& shape : shapes())
    for (int i = 0; i < 40; ++i) {
      const std::array<SurfacePoint, 3> points = {
          shape->random_point(random), shape->random_point(random), shape->random_point(random)};
      const std::array<double, 3> weights = {0.0, 1.0, 0.0};
      const SmoothPoint q = shape->projector.weighted_average(points, weights);
      EXPECT_LT((q.position - shape->target.position(points[1])).norm(),
                1e-9 * shape->target.diagonal());
    }
}

TEST(Spline, OnAPlaneIsThePlanesSpline) {
  const Baked& grid = *shapes()[3];
  std::vector<SurfacePoint> controls;
  for (const Vec2& p :
       {Vec2(-0.5, -0.4), Vec2(-0.2, 0.3), Vec2(0.1, -0.2), Vec2(0.5, 0.4), Vec2(0.6, -0.3)})
    controls.push_back(grid.target.closest_point(Vec3(p[0], p[1], 0.0))->surface);
  const auto at = [&](std::size_t i) { return grid.target.position(controls[i]); };
  // Where two spans meet: a sixth, four sixths, a sixth.
  const SmoothPoint joint = b_spline_point(grid.projector, controls, 1.0);
  // The scaling of the embedding's distances leaves a grid flat but for its quality.
  EXPECT_LT((joint.position - (at(1) + 4.0 * at(2) + at(3)) / 6.0).norm(), 0.02);
}

// Controls about a fifth of the shape apart.
std::vector<SurfacePoint> winding_controls(const spatial::Target& target) {
  std::vector<SurfacePoint> controls;
  for (int i = 0; i < 7; ++i) {
    const double a = 0.35 * i;
    controls.push_back(
        target.closest_point(Vec3(std::cos(a), std::sin(a), 0.2 * std::sin(2.0 * a)))->surface);
  }
  return controls;
}

TEST(Spline, IsSmoothOnTheSurface) {
  for (const Baked* shape : {shapes()[0].get(), shapes()[1].get()}) {
    const std::vector<SurfacePoint> controls = winding_controls(shape->target);
    double coarse = 0.0, fine = 0.0;  // largest angle between consecutive steps
    for (const Index points : {200, 800}) {
      const auto curve = b_spline_curve(shape->projector, controls, points);
      double& worst = points == 200 ? coarse : fine;
      for (std::size_t i = 2; i < curve.size(); ++i) {
        EXPECT_EQ(curve[i].label, ScpLabel::smooth);
        const Vec3 a = curve[i - 1].position - curve[i - 2].position;
        const Vec3 b = curve[i].position - curve[i - 1].position;
        worst = std::max(worst, std::atan2(a.cross(b).norm(), a.dot(b)));
      }
    }
    // What is left of the angle is the surface's own: edges between facets, bent by 10 degrees on
    // the sphere.
    EXPECT_LT(fine, 0.35) << shape->name;
    EXPECT_LT(fine, 1.2 * coarse) << shape->name;
  }
}

// Turns, within the surface, from one step of a curve to the one after the next.
struct Turns {
  double in_faces = 0.0;      // the largest where both are in one face
  double across_edges = 0.0;  // the largest where they are in two faces, laid out flat
};

Turns turns_of(const TriangleMesh& mesh, const std::vector<SmoothPoint>& curve) {
  Turns turns;
  for (std::size_t i = 3; i < curve.size(); ++i) {
    const Index f = curve[i - 2].surface.face, g = curve[i - 1].surface.face;
    if (curve[i - 3].surface.face != f || curve[i].surface.face != g) continue;
    const Vec3 a = curve[i - 2].position - curve[i - 3].position;
    const Vec3 b = curve[i].position - curve[i - 1].position;
    Vec3 edge = mesh.corner(f, 1) - mesh.corner(f, 0);
    if (f != g) {
      std::vector<Index> shared;
      for (const Index v : mesh.face(f))
        for (const Index w : mesh.face(g))
          if (v == w) shared.push_back(v);
      if (shared.size() != 2) continue;
      edge = mesh.position(shared[1]) - mesh.position(shared[0]);
    }
    edge.normalize();
    const Vec3 across_f = mesh.area_vector(f).normalized().cross(edge);
    const Vec3 across_g = mesh.area_vector(g).normalized().cross(edge);
    const Vec2 from(a.dot(edge), a.dot(across_f)), to(b.dot(edge), b.dot(across_g));
    double& worst = f == g ? turns.in_faces : turns.across_edges;
    worst = std::max(worst, std::abs(std::atan2(from[0] * to[1] - from[1] * to[0], from.dot(to))));
  }
  return turns;
}

TEST(Spline, TurnsSmoothlyWithinFacesAndLittleAcrossEdges) {
  for (const Baked* shape : {shapes()[0].get(), shapes()[1].get()}) {
    const std::vector<SurfacePoint> controls = winding_controls(shape->target);
    const auto turns = [&](Index points) {
      return turns_of(shape->target.mesh(), b_spline_curve(shape->projector, controls, points));
    };
    // Within faces, and there where spans meet, a corner would keep its angle.
    const Turns coarse = turns(800), fine = turns(6400);
    EXPECT_LT(fine.in_faces, 0.5 * coarse.in_faces) << shape->name;
    // Across edges some degrees are left, at finer resolutions of the mesh too
    // (docs/smoothness.md).
    EXPECT_LT(fine.across_edges, 0.1) << shape->name;
  }
}

TEST(SmoothProjector, OnTheMedialAxisThereIsALabelledAnswer) {
  // Between the sides of a thin box, in the middle of the torus's tube, where two spheres are
  // equally near.
  const Baked plate("plate", make_box(12, 9, 1, Vec3(1.0, 0.75, 0.02)));
  struct Case {
    const Baked* shape;
    Vec3 y;
  };
  for (const Case& c :
       {Case{&plate, Vec3(0.1, 0.2, 0.0)}, Case{&plate, Vec3::Zero()},
        Case{shapes()[1].get(), Vec3(0.8, 0.0, 0.0)}, Case{shapes()[1].get(), Vec3::Zero()},
        Case{&sphere(), Vec3::Zero()}, Case{shapes()[4].get(), Vec3::Zero()}}) {
    const auto q = c.shape->projector.project(c.y, {true});
    ASSERT_TRUE(q);
    EXPECT_EQ(q->position, c.shape->projector.project(c.y, {true})->position);
    // That is what "replaced" is for: nothing farther than this is left.
    EXPECT_LE((q->position - c.y).norm(),
              c.shape->target.closest_point(c.y)->distance + c.shape->target.diagonal() / 20.0);
  }
}

}  // namespace
}  // namespace mimicry::embedding
