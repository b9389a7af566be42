#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/validation.h>
#include <mimicry/segment/segment.h>

#include "curve/support.h"

namespace mimicry {
namespace {

using std::numbers::pi;
using test::Drawn;

std::vector<Vec3> circle(double z, int count = 200) {
  const double r = std::sqrt(1.0 - z * z);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(r * std::cos(kTau * i / count), r * std::sin(kTau * i / count), z);
  points.push_back(points.front());
  return points;
}

// On the torus, from angles around the axis and around the tube.
Vec3 on_torus(double around, double tube) {
  const double r = kTorusMajorRadius + kTorusMinorRadius * std::cos(tube);
  return {r * std::cos(around), r * std::sin(around), kTorusMinorRadius * std::sin(tube)};
}
ProjectedCurve meridian(const Drawn& torus, double around) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 100; ++i) points.push_back(on_torus(around, kTau * (i % 100) / 100));
  return torus.curve_near(points, true);
}
ProjectedCurve longitude(const Drawn& torus, double tube) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 200; ++i) points.push_back(on_torus(kTau * (i % 200) / 200, tube));
  return torus.curve_near(points, true);
}

// What holds whatever was cut.
void expect_sound(const Drawn& target, const Segmentation& cut) {
  const MeshReport before = validate(target.mesh), after = validate(cut.surface.mesh());
  EXPECT_EQ(after.is_manifold(), before.is_manifold());
  EXPECT_EQ(after.is_closed(), before.is_closed());
  EXPECT_EQ(after.euler, before.euler);
  EXPECT_EQ(after.components.size(), before.components.size());
  EXPECT_EQ(after.boundary.loops, before.boundary.loops);
  EXPECT_NEAR(after.area / before.area, 1.0, 1e-12);
  ASSERT_EQ(cut.parents.size(), at(cut.surface.mesh().face_count()));
  ASSERT_EQ(cut.first_child.size(), at(target.mesh.face_count()) + 1);
  for (Index f = 0; f < target.mesh.face_count(); ++f) {
    double bary_area = 0.0, area = 0.0;
    const Vec3 normal = target.mesh.area_vector(f).normalized();
    for (Index c = cut.first_child[at(f)]; c < cut.first_child[at(f) + 1]; ++c) {
      ASSERT_EQ(cut.parents[at(c)], f);
      const auto& b = cut.barycentrics[at(c)];
      const Vec3 u = b[1] - b[0], v = b[2] - b[0];
      const double twice = u[1] * v[2] - u[2] * v[1];
      ASSERT_GT(twice, 0.0);
      bary_area += twice;
      const double piece = cut.surface.mesh().area_vector(c).dot(normal);
      ASSERT_GE(piece, 0.0);
      area += piece;
    }
    ASSERT_NEAR(bary_area, 1.0, 1e-14);
    ASSERT_NEAR(area / target.mesh.area_vector(f).norm(), 1.0, 1e-12);
  }
  double share = 0.0;
  for (const SurfacePart& part : cut.parts) share += part.area_share;
  EXPECT_NEAR(share, 1.0, 1e-12);
}

void expect_same(const Segmentation& a, const Segmentation& b) {
  const auto x = a.surface.mesh().positions(), y = b.surface.mesh().positions();
  const auto f = a.surface.mesh().faces(), g = b.surface.mesh().faces();
  EXPECT_TRUE(std::equal(x.begin(), x.end(), y.begin(), y.end()));
  EXPECT_TRUE(std::equal(f.begin(), f.end(), g.begin(), g.end()));
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.parents, b.parents);
  EXPECT_EQ(a.seam_edges, b.seam_edges);
}

TEST(Segment, ACircleCutsOffItsCap) {
  const Drawn sphere{make_shape("sphere", {.resolution = 38})};
  const std::vector<ProjectedCurve> curves{sphere.curve_near(circle(0.5), true)};
  const Segmentation cut = segment(sphere.surface, curves);
  expect_sound(sphere, cut);
  ASSERT_EQ(cut.parts.size(), 2u);
  EXPECT_TRUE(cut.separated);
  EXPECT_NEAR(std::min(cut.parts[0].area_share, cut.parts[1].area_share), 0.25, 5e-4);
  for (const SurfacePart& part : cut.parts) {
    EXPECT_EQ(part.euler, 1);
    EXPECT_EQ(part.boundary_loops, 1);
  }
  ASSERT_EQ(cut.seams.size(), 1u);
  EXPECT_TRUE(cut.seams[0].closed);
  EXPECT_NEAR(length(cut.seams[0]) / length(curves[0]), 1.0, 1e-3);
}

TEST(Segment, TwoCirclesCutOutABand) {
  const Drawn sphere{make_shape("sphere", {.resolution = 38})};
  const std::vector<ProjectedCurve> curves{sphere.curve_near(circle(0.41), true),
                                           sphere.curve_near(circle(-0.33), true)};
  const Segmentation cut = segment(sphere.surface, curves);
  expect_sound(sphere, cut);
  ASSERT_EQ(cut.parts.size(), 3u);
  std::multiset<Index> eulers;
  for (const SurfacePart& part : cut.parts) {
    eulers.insert(part.euler);
    if (part.euler == 0) {
      EXPECT_NEAR(part.area_share, 0.37, 1e-3);
    }
  }
  EXPECT_EQ(eulers, (std::multiset<Index>{0, 1, 1}));
}

TEST(Segment, AFigureEightMakesThreeParts) {
  const Drawn sphere{make_shape("sphere", {.resolution = 38})};
  std::vector<Vec3> eight;
  for (int i = 0; i <= 100; ++i) {
    const double a = kTau * ((i % 100) + 0.5) / 100;
    eight.push_back(
        Vec3(0.6 * std::sin(a) + 0.013, 0.3 * std::sin(2 * a) + 0.01, 1.0).normalized());
  }
  const Segmentation cut = segment(sphere.surface, std::vector{sphere.curve_near(eight, true)});
  expect_sound(sphere, cut);
  EXPECT_EQ(cut.parts.size(), 3u);
  EXPECT_EQ(cut.crossings, 1u);
}

TEST(Segment, AroundAHandleNothingIsSeparated) {
  const Drawn torus{make_torus(60, 24)};
  const Segmentation one = segment(torus.surface, std::vector{meridian(torus, 0.3)});
  expect_sound(torus, one);
  ASSERT_EQ(one.parts.size(), 1u);
  EXPECT_FALSE(one.separated);
  EXPECT_EQ(one.parts[0].euler, 0);
  EXPECT_EQ(one.parts[0].boundary_loops, 2);
  EXPECT_FALSE(one.notes.empty());

  const Segmentation two =
      segment(torus.surface, std::vector{meridian(torus, 0.3), meridian(torus, 1.7)});
  expect_sound(torus, two);
  ASSERT_EQ(two.parts.size(), 2u);
  const auto [low, high] = std::minmax(two.parts[0].area_share, two.parts[1].area_share);
  EXPECT_NEAR(low, 0.2228, 1e-3);
  EXPECT_NEAR(high, 0.7772, 1e-3);

  const Segmentation disc =
      segment(torus.surface, std::vector{meridian(torus, 0.3), longitude(torus, 0.7)});
  expect_sound(torus, disc);
  ASSERT_EQ(disc.parts.size(), 1u);
  EXPECT_EQ(disc.parts[0].euler, 1);
  EXPECT_EQ(disc.parts[0].boundary_loops, 1);
}

TEST(Segment, ASlitIsOnePartWithABoundary) {
  const Drawn sphere{make_shape("sphere", {.resolution = 20})};
  const std::vector<Vec3> arc{{0.3, 0.1, 0.9}, {-0.2, 0.3, 0.9}, {-0.5, 0.2, 0.7}};
  const Segmentation cut = segment(sphere.surface, std::vector{sphere.curve_near(arc)});
  expect_sound(sphere, cut);
  ASSERT_EQ(cut.parts.size(), 1u);
  EXPECT_EQ(cut.parts[0].euler, 1);
  EXPECT_EQ(cut.parts[0].boundary_loops, 1);
  EXPECT_FALSE(cut.separated);
  EXPECT_TRUE(validate(part_mesh(cut, 0)).is_closed());
  const MeshReport open = validate(part_mesh(cut, 0, true));
  EXPECT_EQ(open.boundary.loops, 1);
  EXPECT_EQ(open.euler, 1);
  EXPECT_TRUE(open.is_manifold());
}

TEST(Segment, PartsTogetherHaveTheTargetsAreaAndVolume) {
  const Drawn sphere{make_shape("sphere", {.resolution = 20})};
  const Segmentation cut = segment(
      sphere.surface,
      std::vector{sphere.curve_near(circle(0.41), true), sphere.curve_near(circle(-0.33), true)});
  double area = 0.0;
  for (Index label = 0; at(label) < cut.parts.size(); ++label) {
    const MeshReport report = validate(part_mesh(cut, label));
    EXPECT_TRUE(report.is_manifold());
    EXPECT_EQ(report.euler, cut.parts[at(label)].euler);
    EXPECT_EQ(report.boundary.loops, cut.parts[at(label)].boundary_loops);
    EXPECT_NEAR(report.area, cut.parts[at(label)].area, 1e-12);
    area += report.area;
  }
  EXPECT_NEAR(area, validate(sphere.mesh).area, 1e-11);
  EXPECT_NEAR(signed_volume(part_mesh(cut, kNone)), *validate(sphere.mesh).volume, 1e-12);
}

TEST(Segment, AlongMeshEdgesNothingIsAdded) {
  const Drawn sphere{make_shape("sphere", {.resolution = 12})};
  // A closed way from vertex to vertex around a vertex's ring.
  const Index v = 40;
  std::vector<Vec3> ring;
  const Index first = sphere.edges.outgoing(v);
  for (Index h = first;;) {
    ring.push_back(sphere.mesh.position(sphere.edges.head(h)));
    h = sphere.edges.ccw(h);
    if (h == first) break;
  }
  ring.push_back(ring.front());
  const Segmentation cut = segment(sphere.surface, std::vector{sphere.curve_near(ring, true)});
  expect_sound(sphere, cut);
  EXPECT_EQ(cut.surface.mesh().vertex_count(), sphere.mesh.vertex_count());
  EXPECT_EQ(cut.surface.mesh().face_count(), sphere.mesh.face_count());
  EXPECT_EQ(cut.parts.size(), 2u);
  // Beside the edges by less than the snapping distance: the same.
  Random random(3);
  for (Vec3& x : ring) x += 1e-7 * Vec3(random.normal(), random.normal(), random.normal());
  ring.back() = ring.front();
  const Segmentation near_by = segment(sphere.surface, std::vector{sphere.curve_near(ring, true)});
  EXPECT_EQ(near_by.surface.mesh().face_count(), sphere.mesh.face_count());
  EXPECT_EQ(near_by.labels, cut.labels);
}

TEST(Segment, EqualCurvesInAnyOrderGiveTheSameBits) {
  const Drawn torus{make_torus(30, 12)};
  std::vector<ProjectedCurve> curves{meridian(torus, 0.3), meridian(torus, 1.7),
                                     longitude(torus, 0.7), longitude(torus, 2.1)};
  const Segmentation once = segment(torus.surface, curves);
  expect_sound(torus, once);
  EXPECT_EQ(once.parts.size(), 4u);
  std::reverse(curves.begin(), curves.end());
  expect_same(once, segment(torus.surface, curves));
  curves.push_back(curves[1]);
  curves.push_back(curves[3]);
  expect_same(once, segment(torus.surface, curves));
}

TEST(Segment, AttributesAreInterpolated) {
  TriangleMesh mesh = make_shape("sphere", {.resolution = 10});
  auto attributes = std::make_shared<MeshAttributes>();
  for (const Vec3& x : mesh.positions())
    attributes->texcoords.values.push_back(
        {static_cast<float>(x[0]), static_cast<float>(0.5 * x[1] - x[2])});
  for (const Face& f : mesh.faces())
    attributes->texcoords.corners.insert(attributes->texcoords.corners.end(), f.begin(), f.end());
  attributes->groups.names = {"even", "odd"};
  for (Index f = 0; f < mesh.face_count(); ++f) attributes->groups.of_face.push_back(f % 2);
  mesh.set_attributes(attributes);
  const Drawn sphere{mesh};
  const Segmentation cut =
      segment(sphere.surface, std::vector{sphere.curve_near(circle(0.5, 40), true),
                                          sphere.curve_near(circle(0.1, 40), true)});
  const auto& now = cut.surface.mesh().attributes();
  ASSERT_TRUE(now);
  ASSERT_GT(cut.surface.mesh().face_count(), mesh.face_count());
  std::set<std::pair<Index, Index>> of_vertex;
  for (Index f = 0; f < cut.surface.mesh().face_count(); ++f) {
    EXPECT_EQ(now->groups.of_face[at(f)], cut.parents[at(f)] % 2);
    for (int k = 0; k < 3; ++k) {
      const auto wanted =
          attributes->texcoords.interpolated(cut.parents[at(f)], cut.barycentrics[at(f)][at(k)]);
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR((*now->texcoords.at_corner(f, k))[i], wanted[i], 1e-7);
      of_vertex.emplace(cut.surface.mesh().face(f)[at(k)],
                        now->texcoords.corners[3 * at(f) + at(k)]);
    }
  }
  // No seam where there was none.
  EXPECT_EQ(of_vertex.size(), at(cut.surface.mesh().vertex_count()));
}

TEST(Segment, PointsMapBothWays) {
  const Drawn sphere{make_shape("sphere", {.resolution = 10})};
  const Segmentation cut =
      segment(sphere.surface, std::vector{sphere.curve_near(circle(0.5, 40), true)});
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 b(random.uniform(), random.uniform(), random.uniform());
    const SurfacePoint p{
        static_cast<Index>(random.below(static_cast<std::uint32_t>(sphere.mesh.face_count()))),
        b / b.sum()};
    const SurfacePoint q = cut_point(cut, p);
    EXPECT_LT((cut.surface.position(q) - sphere.mesh.position(p)).norm(), 1e-12);
    const SurfacePoint back = target_point(cut, q);
    EXPECT_EQ(back.face, p.face);
    EXPECT_LT((back.bary - p.bary).norm(), 1e-12);
  }
}

// Closed curves and arcs at random: the characteristics of the parts sum to that of the surface and
// the graph's nodes.
TEST(Segment, TheLawOfEulersCharacteristicHolds) {
  // Of two spheres curves have chords, which part them.
  const std::vector<std::pair<std::string, int>> shapes{
      {"sphere", 6}, {"torus", 8},        {"cube", 4}, {"noisy-cube", 6},  {"rounded-cube", 5},
      {"grid", 8},   {"double-torus", 1}, {"hand", 1}, {"two-spheres", 4}, {"trefoil", 4}};
  int arrangements = 0;
  for (const auto& [shape, resolution] : shapes) {
    const Drawn target{make_shape(shape, {.resolution = resolution})};
    const auto faces = static_cast<std::uint32_t>(target.mesh.face_count());
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      Random random(seed);
      std::vector<ProjectedCurve> curves;
      for (std::uint32_t c = 0; c < 1 + random.below(3); ++c) {
        std::vector<SurfacePoint> points;
        for (int i = 0; i < 5; ++i) {
          const Vec3 b(random.uniform(), random.uniform(), random.uniform());
          points.push_back({static_cast<Index>(random.below(faces)), b / b.sum()});
        }
        const bool closed = random.below(2) == 1;
        if (closed) points.push_back(points.front());
        curves.push_back(target.curve(points, closed));
      }
      const Segmentation cut = segment(target.surface, curves);
      SCOPED_TRACE(shape + ", seed " + std::to_string(seed));
      expect_sound(target, cut);
      // By the seams alone: each edge opened takes 1 away, each vertex of degree d adds d - 1, and
      // d on a boundary.
      const HalfEdges& edges = cut.surface.half_edges();
      std::vector<Index> degree(at(cut.surface.mesh().vertex_count()), 0);
      Index wanted = validate(target.mesh).euler;
      for (Index h = 0; h < edges.count(); ++h) {
        if (!cut.seam_edges[at(h)] || !edges.has_twin(h) || edges.edge(h) != h) continue;
        ++degree[at(edges.tail(h))];
        ++degree[at(edges.head(h))];
        --wanted;
      }
      for (Index v = 0; at(v) < degree.size(); ++v)
        if (degree[at(v)] > 0) wanted += degree[at(v)] - (edges.is_boundary_vertex(v) ? 0 : 1);
      Index sum = 0;
      for (const SurfacePart& part : cut.parts) sum += part.euler;
      EXPECT_EQ(sum, wanted);
      for (Index label = 0; at(label) < cut.parts.size(); ++label) {
        const MeshReport report = validate(part_mesh(cut, label, true));
        EXPECT_TRUE(report.is_manifold());
        EXPECT_EQ(report.euler, cut.parts[at(label)].euler);
        EXPECT_EQ(report.boundary.loops, cut.parts[at(label)].boundary_loops);
        EXPECT_EQ(report.components.size(), 1u);
      }
      ++arrangements;
    }
  }
  EXPECT_EQ(arrangements, 400);
}

TEST(Segment, ManyCrossingsInOneFaceAreBounded) {
  const Drawn face{TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})};
  Random random(9);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 120; ++i) {
    const Vec3 b(random.uniform(), random.uniform(), random.uniform());
    points.push_back({0, b / b.sum()});
  }
  const std::vector curves{face.curve(points)};
  const Segmentation cut = segment(face.surface, curves);
  expect_sound(face, cut);
  EXPECT_GT(cut.crossings, 1000u);
  SegmentOptions few;
  few.most_crossings = 100;
  EXPECT_THROW(segment(face.surface, curves, few), Error);
}

std::string refusal(const Surface& surface, const ProjectedCurve& curve) {
  try {
    segment(surface, std::vector{curve});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Segment, RefusesCurvesThatCannotBeCut) {
  const Drawn sphere{make_shape("sphere", {.resolution = 12})};
  const ProjectedCurve good = sphere.curve_near(circle(0.5, 40), true);
  EXPECT_EQ(refusal(sphere.surface, good), "");
  EXPECT_THAT(refusal(sphere.surface, {}), testing::HasSubstr("curve 0: it has no points"));
  EXPECT_THAT(refusal(sphere.surface, sphere.curve_near(std::vector<Vec3>{Vec3::UnitX()})),
              testing::HasSubstr("single point"));
  const Drawn other{make_shape("sphere", {.resolution = 11})};
  EXPECT_THAT(refusal(other.surface, good), testing::HasSubstr("another mesh"));
  ProjectedCurve bad = good;
  bad.points[3].surface.bary[1] = std::nan("");
  EXPECT_THAT(refusal(sphere.surface, bad), testing::HasSubstr("point 3"));
  bad = good;
  ASSERT_FALSE(bad.crossings.empty());
  bad.crossings[0].t = std::nan("");
  EXPECT_NE(refusal(sphere.surface, bad), "");
  SegmentOptions options;
  options.snap = 0.5;
  EXPECT_THROW(segment(sphere.surface, std::vector{good}, options), Error);

  const Drawn pillow{TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}})};
  EXPECT_THAT(refusal(pillow.surface, pillow.curve(std::vector<SurfacePoint>{
                                          {0, Vec3(0.2, 0.2, 0.6)}, {0, Vec3(0.5, 0.3, 0.2)}})),
              testing::HasSubstr("faces 0 and 1"));

  const Drawn fins{TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                                {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}})};
  ProjectedCurve through =
      fins.curve(std::vector<SurfacePoint>{{0, Vec3(0.3, 0.3, 0.4)}, {0, Vec3(0.5, 0.5, 0.0)}});
  EXPECT_THAT(refusal(fins.surface, through), testing::HasSubstr("vertices 0 and 1"));
}

}  // namespace
}  // namespace mimicry
