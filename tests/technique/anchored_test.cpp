#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/technique/technique.h>

#include "any_memory.h"
#include "spatial/pseudonormal.h"
#include "support/baked.h"
#include "technique/planar_section.h"

namespace mimicry {
namespace {

const test::BakedTarget& sphere() {
  static const test::BakedTarget baked(make_sphere(7));
  return baked;
}

AnyStep step(std::string_view name, const Canvas& canvas, const AnyMemory& memory, const Vec3& pen,
             const Quat& turned = Quat::Identity()) {
  Frame frame;
  frame.time_s = memory.time_s + 1.0 / 90;
  frame.controller = {pen, turned};
  return any_step(find_technique(name), canvas, memory, frame);
}

// Pen at p, last point at q (on the surface), and the motion before.
AnyMemory anchor(const Target& target, const Vec3& p, const Vec3& q,
                 const Vec3& motion = Vec3::Zero()) {
  const auto closest = target.closest_point(q);
  AnyMemory memory;
  memory.anchored = true;
  memory.pen = p;
  memory.surface = closest->surface;
  memory.position = closest->position;
  memory.points = 5;
  memory.motion = motion;
  return memory;
}

constexpr std::array<std::string_view, 7> kAnchored = {
    "anchored-closest",      "mimicry",          "mimicry-planar",
    "mimicry-offset",        "mimicry-parallel", "anchored-ray-plane",
    "anchored-ray-transport"};

TEST(Anchored, AllStartWithTheSpray) {
  for (const std::string_view name : kAnchored) {
    const Quat away(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitY()));
    const AnyStep waiting = step(name, sphere().canvas(), {}, Vec3(0.1, 0.2, 2.0), away);
    EXPECT_EQ(waiting.answer, Answer::miss) << name;
    EXPECT_FALSE(waiting.memory.anchored);
    const AnyStep first = step(name, sphere().canvas(), waiting.memory, Vec3(0.1, 0.2, 2.0));
    EXPECT_EQ(first.answer, Answer::ray) << name;
    EXPECT_EQ(first.position,
              sphere().target.first_hit(Vec3(0.1, 0.2, 2.0), -Vec3::UnitZ())->position);
    EXPECT_EQ(first.memory.points, 1);
  }
}

TEST(SmoothClosest, TechniquesSolveTheirEquations) {
  Random random(1);
  const test::BakedTarget& s = sphere();
  const auto normal_vector = [&] {
    return Vec3(random.normal(), random.normal(), random.normal());
  };
  for (int i = 0; i < 100; ++i) {
    const Vec3 q0 = normal_vector().normalized(), p0 = q0 + 0.2 * normal_vector();
    const Vec3 motion = 0.01 * normal_vector(), p = p0 + motion;
    const AnyMemory memory = anchor(s.target, p0, q0);
    const Vec3 r = memory.position + motion;
    const auto scp = [&](const Vec3& y) { return s.projector.project(y)->position; };
    const auto gradient = [&](const Vec3& y) -> Vec3 {
      return (y - s.target.closest_point(y)->position).normalized();
    };
    EXPECT_EQ(step("snap-smooth", s.canvas(), memory, p).position, scp(p));
    // p - p_0 is the motion to rounding.
    EXPECT_LT((step("mimicry", s.canvas(), memory, p).position - scp(r)).norm(), 1e-12);
    const Vec3 g = gradient(p), h = gradient(r);
    EXPECT_LT((step("mimicry-offset", s.canvas(), memory, p).position - scp(r - motion.dot(g) * g))
                  .norm(),
              1e-12);
    EXPECT_LT(
        (step("mimicry-parallel", s.canvas(), memory, p).position - scp(r - motion.dot(h) * h))
            .norm(),
        1e-9);
  }
}

TEST(SmoothClosest, AnswersNameTheirLabel) {
  const test::BakedTarget& s = sphere();
  const AnyMemory memory = anchor(s.target, Vec3(0, 0, 2), Vec3(0, 0, 1));
  EXPECT_EQ(step("mimicry", s.canvas(), memory, Vec3(0, 0.01, 2)).answer, Answer::smooth);
  const AnyStep far = step("mimicry", s.canvas(), memory, Vec3(0, 3, 2));
  EXPECT_EQ(far.answer, Answer::outside_shell);
  EXPECT_EQ(far.position, s.target.closest_point(memory.position + Vec3(0, 3, 0))->position);
}

TEST(SmoothClosest, MotionAcrossTheSurfaceIsDropped) {
  // Straight up from a point of a plane: offset and parallel stay where they are.
  const test::BakedTarget grid(make_grid(12));
  const AnyMemory memory = anchor(grid.target, Vec3(0.2, 0.1, 0.3), Vec3(-0.1, 0.05, 0.0));
  for (const std::string_view name : {"mimicry-offset", "mimicry-parallel"}) {
    const AnyStep up = step(name, grid.canvas(), memory, Vec3(0.2, 0.1, 0.35));
    EXPECT_LT((up.position - memory.position).norm(), 1e-9) << name;
    const AnyStep across = step(name, grid.canvas(), memory, Vec3(0.23, 0.12, 0.35));
    // The embedding of a flat sheet is flat to the quality of its scaling.
    EXPECT_LT((across.position - memory.position - Vec3(0.03, 0.02, 0.0)).norm(), 1e-4) << name;
  }
}

// All segments of the section, whatever their component.
double distance_to_whole_section(const TriangleMesh& mesh, const Vec3& origin, const Vec3& normal,
                                 const Vec3& r) {
  double best = (origin - r).norm();  // at a corner of the grid there may be nothing else
  for (Index f = 0; f < mesh.face_count(); ++f) {
    std::vector<Vec3> ends;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = mesh.corner(f, k), &b = mesh.corner(f, (k + 1) % 3);
      const double sa = normal.dot(a - origin), sb = normal.dot(b - origin);
      if ((sa < 0.0) != (sb < 0.0)) ends.push_back(a + sa / (sa - sb) * (b - a));
    }
    if (ends.size() != 2) continue;
    const Vec3 way = ends[1] - ends[0];
    const double length2 = way.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp((r - ends[0]).dot(way) / length2, 0.0, 1.0) : 0.0;
    best = std::min(best, (ends[0] + t * way - r).norm());
  }
  return best;
}

TEST(PlanarSection, IsTheClosestPointOfTheSection) {
  Random random(2);
  const auto normal_vector = [&] {
    return Vec3(random.normal(), random.normal(), random.normal());
  };
  for (const TriangleMesh& mesh : {make_sphere(7), make_grid(9)}) {
    const Surface surface = Surface::as_given(mesh);
    for (int i = 0; i < 200; ++i) {
      SurfacePoint q{
          static_cast<Index>(random.below(static_cast<std::uint32_t>(mesh.face_count()))),
          Vec3(random.uniform(), random.uniform(), random.uniform())};
      q.bary /= q.bary.sum();
      if (i % 4 == 0) q.bary = Vec3::Unit(i % 3);
      const Vec3 normal = normal_vector().normalized();
      const Vec3 r = mesh.position(q) + 0.3 * normal_vector();
      const SurfacePoint x = closest_on_section(surface, q, normal, r);
      // On convex surfaces a section is one component. q is drawn inward by 1e-9, and a section
      // moves by that over the sine between plane and face.
      EXPECT_NEAR(normal.dot(mesh.position(x) - mesh.position(q)), 0.0, 1e-8);
      EXPECT_NEAR((mesh.position(x) - r).norm(),
                  distance_to_whole_section(mesh, mesh.position(q), normal, r), 1e-6);
    }
  }
}

// By the definition: cuts every face, and keeps what hangs together with q's face over edges that
// the plane cuts.
double distance_to_component(const TriangleMesh& mesh, const HalfEdges& edges,
                             const SurfacePoint& q, const Vec3& normal, const Vec3& r) {
  const Vec3 origin = mesh.position(q);
  std::vector<bool> is_part(static_cast<std::size_t>(mesh.face_count()), false);
  std::vector<Index> stack = {q.face};
  is_part[static_cast<std::size_t>(q.face)] = true;
  double best = (origin - r).norm();
  while (!stack.empty()) {
    const Index f = stack.back();
    stack.pop_back();
    std::vector<Vec3> ends;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Vec3 &a = mesh.position(edges.tail(h)), &b = mesh.position(edges.head(h));
      const double sa = normal.dot(a - origin), sb = normal.dot(b - origin);
      if ((sa < 0.0) == (sb < 0.0)) continue;
      ends.push_back(a + sa / (sa - sb) * (b - a));
      if (!edges.has_twin(h)) continue;
      const Index next = HalfEdges::face(edges.twin(h));
      if (is_part[static_cast<std::size_t>(next)]) continue;
      is_part[static_cast<std::size_t>(next)] = true;
      stack.push_back(next);
    }
    if (ends.size() != 2) continue;
    const Vec3 way = ends[1] - ends[0];
    const double length2 = way.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp((r - ends[0]).dot(way) / length2, 0.0, 1.0) : 0.0;
    best = std::min(best, (ends[0] + t * way - r).norm());
  }
  return best;
}

TEST(PlanarSection, IsTheClosestPointOfItsComponentOnBentSurfaces) {
  Random random(5);
  for (const TriangleMesh& mesh : {make_torus(24, 12), make_hand(1), make_trefoil(6),
                                   make_noisy_cube(6, 0.2, true, 3), make_moebius_strip(24)}) {
    const Surface surface = Surface::as_given(mesh);
    const HalfEdges& edges = surface.half_edges();
    for (int i = 0; i < 200; ++i) {
      SurfacePoint q{
          static_cast<Index>(random.below(static_cast<std::uint32_t>(mesh.face_count()))),
          Vec3(random.uniform(), random.uniform(), random.uniform())};
      q.bary /= q.bary.sum();
      const Vec3 normal = Vec3(random.normal(), random.normal(), random.normal()).normalized();
      const Vec3 r =
          mesh.position(q) + 0.2 * Vec3(random.normal(), random.normal(), random.normal());
      const SurfacePoint x = closest_on_section(surface, q, normal, r);
      EXPECT_NEAR((mesh.position(x) - r).norm(), distance_to_component(mesh, edges, q, normal, r),
                  1e-6)
          << "trial " << i;
    }
  }
}

TEST(PlanarSection, StaysOnItsComponent) {
  const TriangleMesh mesh = make_two_spheres(6);
  const SurfacePoint q = Target(mesh).closest_point(Vec3(-0.55, 0.45, 0.0))->surface;
  const SurfacePoint x =
      closest_on_section(Surface::as_given(mesh), q, Vec3::UnitZ(), Vec3(0.4, 0.1, 0.0));
  EXPECT_LT(mesh.position(x)[0], -0.1 + 1e-9);
  EXPECT_GT(mesh.position(x)[0], -0.12) << "the first sphere's point nearest to the second";
}

TEST(MimicryPlanar, FollowsThePlaneOfTheLastTwoMotions) {
  const test::BakedTarget& s = sphere();
  const Vec3 before(0.02, 0.01, 0.0), motion(0.01, 0.02, 0.005);
  const AnyMemory memory = anchor(s.target, Vec3(0.1, 0.1, 1.3), Vec3(0.1, 0.1, 1.0), before);
  const AnyStep a = step("mimicry-planar", s.canvas(), memory, memory.pen + motion);
  EXPECT_EQ(a.answer, Answer::section);
  const Vec3 normal = motion.cross(before).normalized();
  EXPECT_NEAR(normal.dot(a.position - memory.position), 0.0, 1e-9);
  EXPECT_LT((a.memory.motion - motion).norm(), 1e-15);
  // The same motion again spans no plane: the last one is kept.
  const AnyStep b = step("mimicry-planar", s.canvas(), a.memory, a.memory.pen + motion);
  EXPECT_EQ(b.answer, Answer::section);
  EXPECT_NEAR(normal.dot(b.position - memory.position), 0.0, 1e-9);
  // No motion at all.
  const AnyStep c = step("mimicry-planar", s.canvas(), b.memory, b.memory.pen);
  EXPECT_LT((c.position - b.position).norm(), 1e-12);
  EXPECT_EQ(c.memory.motion, b.memory.motion);
  // Before there was any plane: the closest point.
  const AnyMemory straight = anchor(s.target, Vec3(0.1, 0.1, 1.3), Vec3(0.1, 0.1, 1.0), motion);
  EXPECT_EQ(step("mimicry-planar", s.canvas(), straight, straight.pen + motion).answer,
            Answer::closest);
}

TEST(MimicryPlanar, SpraysTheFirstTwoPoints) {
  const test::BakedTarget& s = sphere();
  AnyMemory memory;
  for (int i = 0; i < 3; ++i) {
    const AnyStep next =
        step("mimicry-planar", s.canvas(), memory, Vec3(0.01 * i, 0.02 * i * i, 2.0));
    EXPECT_EQ(next.answer, i < 2 ? Answer::ray : Answer::section) << i;
    memory = next.memory;
  }
}

TEST(AnchoredRayPlane, HitsAcrossTheMotion) {
  const test::BakedTarget& s = sphere();
  const Vec3 motion(0.01, 0.02, 0.005);
  const AnyMemory memory = anchor(s.target, Vec3(0.2, 0.1, 1.3), Vec3(0.1, 0.1, 1.0));
  const AnyStep a = step("anchored-ray-plane", s.canvas(), memory, memory.pen + motion);
  ASSERT_EQ(a.answer, Answer::ray);
  const Vec3 ray = a.position - (memory.position + motion);
  EXPECT_NEAR(ray.dot(motion), 0.0, 1e-15);
  EXPECT_NEAR(ray.dot(motion.cross(memory.pen - memory.position)), 0.0, 1e-15);
  EXPECT_LT(ray.norm(), 0.1) << "the nearer of both hits";
  // Along the lift there is no d: the last one, or a miss.
  const Vec3 lift = memory.pen - memory.position;
  EXPECT_EQ(step("anchored-ray-plane", s.canvas(), memory, memory.pen + 0.01 * lift).answer,
            Answer::miss);
  EXPECT_EQ(step("anchored-ray-plane", s.canvas(), memory, memory.pen).answer, Answer::miss);
  const AnyStep b = step("anchored-ray-plane", s.canvas(), a.memory, a.memory.pen);
  EXPECT_EQ(b.answer, Answer::ray);
  EXPECT_LT((b.position - a.position).norm(), 1e-9) << "the hand rests";
}

TEST(AnchoredRayTransport, TurnsTheRayWithTheMotion) {
  const test::BakedTarget& s = sphere();
  const AnyMemory straight =
      anchor(s.target, Vec3(0.2, 0.1, 1.3), Vec3(0.1, 0.1, 1.0), Vec3(0.01, 0.02, 0.0));
  const auto ray_after = [&](const Vec3& motion) -> Vec3 {
    const AnyStep a = step("anchored-ray-transport", s.canvas(), straight, straight.pen + motion);
    EXPECT_EQ(a.answer, Answer::ray);
    return (a.position - (straight.position + motion)).normalized();
  };
  const Vec3 last = (straight.position - straight.pen).normalized();
  const auto expect_parallel = [](const Vec3& a, const Vec3& b) {
    EXPECT_LT(a.cross(b).norm(), 1e-9);
  };
  expect_parallel(ray_after(Vec3(0.02, 0.04, 0.0)), last);
  // 0.3 radians about z.
  const Mat3 turn = Eigen::AngleAxisd(0.3, Vec3::UnitZ()).toRotationMatrix();
  expect_parallel(ray_after(turn * Vec3(0.01, 0.02, 0.0)), turn * last);
  expect_parallel(ray_after(Vec3(-0.01, -0.02, 0.0)), last);  // reversed
  const AnyStep rest = step("anchored-ray-transport", s.canvas(), straight, straight.pen);
  EXPECT_LT((rest.position - straight.position).norm(), 1e-9);
}

TEST(Anchored, FarAndStillHandsAreHarmless) {
  const test::BakedTarget& s = sphere();
  for (const TechniqueInfo& info : techniques()) {
    AnyMemory memory = anchor(s.target, Vec3(0, 0, 1.3), Vec3(0, 0, 1), Vec3(0.01, 0, 0));
    for (const Vec3& pen : {Vec3(0, 0, 1.3), Vec3(1e-200, 0, 1.3), Vec3(1e8, 0, 0),
                            Vec3(-1e40, 1e40, 0), Vec3(1e100, 0, 0), Vec3(0.1, 0.1, 1.2)}) {
      const AnyStep next = step(info.name, s.canvas(), memory, pen);
      EXPECT_TRUE(next.position.allFinite()) << info.name;
      memory = next.memory;
    }
  }
}

}  // namespace
}  // namespace mimicry
