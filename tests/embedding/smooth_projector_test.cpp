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
#include <mimicry/mesh/shapes.h>

#include "bench/normal_slide.h"
#include "embedding/baked.h"
#include "embedding/projection.h"
#include "support/allocations.h"
#include "support/sanitized.h"

namespace mimicry {
namespace {

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
      const ShellPoint place = projection_of(shape->projector).locate(y);
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
      if (test::kSanitized && resolution > 6) continue;  // the larger take minutes
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

// A motion straight off the surface leaves its point where it is: on thin parts values lean along
// the surface by a third of the way, as the least-squares mesh alone has them.
TEST(SmoothProjector, PointsOffTheSurfaceDoNotSlideAlongIt) {
  for (const std::string_view name : {"trefoil", "hand"}) {
    if (test::kSanitized && name == "hand") continue;  // its bake takes a minute
    const Baked shape(std::string(name), make_shape(name, {.resolution = name == "hand" ? 2 : 10}));
    const std::vector<double> slides = bench::normal_slides(shape.projector, 0.005, 1000, 5);
    EXPECT_LT(slides[500], 0.1) << name << " seed 5";
    EXPECT_LT(slides[900], 0.5) << name << " seed 5";
    EXPECT_LT(slides[999], 1e9) << name << " seed 5: not smooth everywhere";
  }
}

TEST(SmoothProjector, RefusesWhatIsNotItsMesh) {
  const Baked& shape = sphere();
  const auto refused = [](Embedding e, const Target& target, const std::string& what) {
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
  refused(shape.projector.embedding(), Target(shape.target.mesh().with_positions(moved)),
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
  e = shape.projector.embedding();
  e.face_order[3] = e.face_order[4];
  refused(e, shape.target, "order of the faces");
}

TEST(SmoothProjector, AnyOrderOfTetrahedraAndFacesGivesTheSamePoints) {
  for (const auto& shape : shapes()) {
    Embedding shuffled = shape->projector.embedding();
    Random random(8);
    const std::size_t own =
        shuffled.tets.size() - static_cast<std::size_t>(shuffled.overlapping_tets);
    for (std::size_t i = own; i-- > 1;)
      std::swap(shuffled.tets[i], shuffled.tets[random.below(static_cast<std::uint32_t>(i + 1))]);
    shuffled.face_order.clear();
    const SmoothProjector other(shuffled, shape->target);
    Embedding sorted = shuffled;
    sort_for_search(sorted);
    EXPECT_EQ(sorted.face_order, shape->projector.embedding().face_order);
    // Those that overlap are still the last.
    const auto last = static_cast<std::ptrdiff_t>(own);
    EXPECT_TRUE(std::is_permutation(sorted.tets.begin() + last, sorted.tets.end(),
                                    shuffled.tets.begin() + last));
    for (int i = 0; i < 100; ++i) {
      const Vec3 y = shape->query(random);
      const auto a = shape->projector.project(y), b = other.project(y);
      EXPECT_EQ(a->label, b->label);
      // The rounding of another tetrahedron on a common face.
      EXPECT_LT((a->position - b->position).norm(), 1e-9) << shape->name;
    }
  }
}

TEST(SmoothProjector, QueriesAllocateNothing) {
  Random random(5);
  for (const auto& shape : shapes()) {
    std::vector<Vec3> queries;
    for (int i = 0; i < 40; ++i) queries.push_back(shape->query(random, 0.2));
    ScpHint hint;
    const long before = test::allocation_count();
    int found = 0;
    for (const Vec3& y : queries) found += shape->projector.project(y, {true}, &hint).has_value();
    EXPECT_EQ(test::allocation_count(), before);
    EXPECT_EQ(found, 40) << shape->name;
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
}  // namespace mimicry
