#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/io/meshes.h>

#include "io/mesh_fixtures.h"
#include "io/number.h"
#include "support/sanitized.h"

namespace mimicry {
namespace {

using testing::HasSubstr;
using Polygon = std::vector<Eigen::Vector2d>;

std::string obj_of(const std::vector<Vec3>& corners, bool face_first = false) {
  std::string vertices, face = "f";
  for (std::size_t k = 0; k < corners.size(); ++k) {
    vertices += "v";
    for (const double x : corners[k]) vertices += " " + format_double(x);
    vertices += "\n";
    face += " " + std::to_string(k + 1);
  }
  return face_first ? face + "\n" + vertices : vertices + face + "\n";
}

std::vector<Vec3> flat(const Polygon& polygon) {
  std::vector<Vec3> corners;
  for (const auto& p : polygon) corners.emplace_back(p.x(), p.y(), 0.0);
  return corners;
}

double area_of(const Polygon& polygon) {
  double area = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

struct Cut {
  TriangleMesh mesh;
  std::vector<std::string> notes;
};

Cut cut_of(const std::string& obj) {
  Cut cut;
  MeshReadOptions options;
  options.note = [&](const std::string& sentence) { cut.notes.push_back(sentence); };
  cut.mesh = read_mesh(obj, MeshFormat::obj, "name", options);
  return cut;
}

/// n - 2 triangles whose inner edges are used once each way and whose border is the polygon. With
/// the polygon's area as the sum of theirs, none overlaps another.
void expect_triangulation(const TriangleMesh& mesh, std::size_t corners) {
  ASSERT_EQ(static_cast<std::size_t>(mesh.face_count()), corners - 2);
  std::map<std::pair<Index, Index>, int> edges;
  for (const Face& face : mesh.faces())
    for (std::size_t k = 0; k < 3; ++k) ++edges[{face[k], face[(k + 1) % 3]}];
  std::size_t border = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1) << edge.first << "-" << edge.second;
    if (edges.contains({edge.second, edge.first})) continue;
    ++border;
    EXPECT_EQ((edge.first + 1) % static_cast<Index>(corners), edge.second);
  }
  EXPECT_EQ(border, corners);
}

bool crosses(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
             const Eigen::Vector2d& d) {
  const auto side = [](const auto& p, const auto& q, const auto& r) {
    return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x()) > 0.0;
  };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

/// A polygon through random points that does not cross itself: crossings are undone one by one,
/// each of which makes it shorter.
Polygon simple_polygon(std::mt19937_64& random, std::size_t corners) {
  std::uniform_real_distribution<double> place(0.0, 1.0);
  Polygon p(corners);
  for (auto& q : p) q = {place(random), place(random)};
  for (bool any = true; any;) {
    any = false;
    for (std::size_t i = 0; i + 2 < corners; ++i)
      for (std::size_t j = i + 2; j < corners; ++j) {
        if (i == 0 && j + 1 == corners) continue;
        if (!crosses(p[i], p[i + 1], p[j], p[(j + 1) % corners])) continue;
        std::reverse(p.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                     p.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        any = true;
      }
  }
  return p;
}

TEST(Polygon, ConvexOnesKeepTheFan) {
  for (const int n : {4, 5, 7, 30, 1000}) {
    std::vector<Vec3> corners;
    for (int k = 0; k < n; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / n;
      corners.emplace_back(3.0 * std::cos(angle), std::sin(angle), 0.2 + std::cos(angle));
    }
    const Cut cut = cut_of(obj_of(corners));
    ASSERT_EQ(cut.mesh.face_count(), n - 2);
    for (Index f = 0; f < cut.mesh.face_count(); ++f)
      EXPECT_EQ(cut.mesh.face(f), (Face{0, f + 1, f + 2}));
    EXPECT_TRUE(cut.notes.empty());
  }
}

TEST(Polygon, RandomOnesAreCutWithoutOverlapOrGap) {
  const unsigned seed = 20;
  std::mt19937_64 random(seed);
  int concave = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round));
    const Polygon polygon = simple_polygon(random, 4 + static_cast<std::size_t>(round) % 40);
    // Anywhere in space, in either order of vertices and face.
    std::normal_distribution<double> normal;
    const Quat turned =
        Quat(normal(random), normal(random), normal(random), normal(random)).normalized();
    std::vector<Vec3> corners = flat(polygon);
    for (Vec3& x : corners) x = turned * x + Vec3(1, -2, 3);
    const Cut cut = cut_of(obj_of(corners, round % 2 == 0));
    expect_triangulation(cut.mesh, polygon.size());
    const double area = std::abs(area_of(polygon));
    EXPECT_NEAR(total_area(cut.mesh), area, 1e-12);  // rounding of coordinates up to 4
    EXPECT_TRUE(cut.notes.empty()) << cut.notes[0];
    for (Index f = 0; f < cut.mesh.face_count(); ++f)
      concave += cut.mesh.face(f) != Face{0, f + 1, f + 2};
  }
  EXPECT_GT(concave, 1000);
}

TEST(Polygon, CornersOnALineGiveNoFlatTriangles) {
  const Polygon outlines[] = {
      {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}},
      {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}},
      {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}, {0, 2}, {0, 1}}};
  for (Polygon polygon : outlines)
    for (std::size_t start = 0; start < polygon.size(); ++start) {
      std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
      const Cut cut = cut_of(obj_of(flat(polygon)));
      expect_triangulation(cut.mesh, polygon.size());
      EXPECT_DOUBLE_EQ(total_area(cut.mesh), area_of(polygon));
      for (Index f = 0; f < cut.mesh.face_count(); ++f) EXPECT_GT(cut.mesh.area_vector(f)[2], 0.1);
    }
}

// As modelling programs write a face with a hole: the outline runs to the hole and back again.
TEST(Polygon, HoleThatIsJoinedByADoubledEdgeStaysAHole) {
  for (const bool shared : {true, false})
    for (const int n : {3, 4, 12, 32}) {
      std::string obj, face = "f";
      for (int ring = 0; ring < 2; ++ring)
        for (int k = 0; k < n; ++k) {
          const double angle = 2.0 * std::numbers::pi * k / n;
          const double radius = ring == 0 ? 1.0 : 0.9;
          obj += "v 2 " + format_double(radius * std::cos(angle)) + " " +
                 format_double(radius * std::sin(angle)) + "\n";
        }
      // The doubled vertices once more, for files in which they are not shared.
      obj += "v 2 1 0\nv 2 0.9 0\n";
      for (int k = 0; k < n; ++k) face += " " + std::to_string(k + 1);
      face += shared ? " 1" : " " + std::to_string(2 * n + 1);
      face += " " + std::to_string(shared ? n + 1 : 2 * n + 2);
      for (int k = n; k > 0; --k) face += " " + std::to_string(n + (k % n == 0 ? n : k));
      // n + 1 ends the ring: it is in the list as the last corner of the inner one.
      const std::string last = " " + std::to_string(n + 1);
      ASSERT_TRUE(face.ends_with(last));
      const Cut cut = cut_of(obj + face + "\n");
      EXPECT_EQ(cut.mesh.face_count(), 2 * n);
      const double ring = 0.5 * n * std::sin(2.0 * std::numbers::pi / n) * (1.0 - 0.81);
      EXPECT_NEAR(total_area(cut.mesh), ring, 1e-12) << n << (shared ? " shared" : "");
      EXPECT_TRUE(cut.notes.empty()) << n << (shared ? " shared: " : ": ") << cut.notes[0];
    }
}

TEST(Polygon, OneThatCrossesItselfIsCutAndNoted) {
  const Polygon star = {{0, 3}, {2, -3}, {-3, 1}, {3, 1}, {-2, -3}};
  const Cut cut = cut_of(obj_of(flat(star)));
  EXPECT_EQ(cut.mesh.face_count(), 3);
  ASSERT_EQ(cut.notes.size(), 1u);
  EXPECT_THAT(cut.notes[0], HasSubstr("1 polygon crosses itself"));
  const Polygon twice = {{0, 0}, {1, 0}, {0, 1}, {-1, -1}, {2, -2}, {3, 3}, {-3, 3}, {-4, -4}};
  EXPECT_EQ(cut_of(obj_of(flat(twice))).mesh.face_count(), 6);
  const Polygon no_area = {{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  EXPECT_EQ(cut_of(obj_of(flat(no_area))).mesh.face_count(), 2);
}

TEST(Polygon, CornersThatAreNotFiniteChangeNothing) {
  EXPECT_EQ(cut_of("v 0 0 0\nv nan 0 0\nv 1 1 0\nv 0 1 inf\nf 1 2 3 4\n").mesh.face_count(), 2);
  EXPECT_EQ(cut_of("v 0 0 0\nv 1e300 0 0\nv 1e300 1e300 0\nv 1e200 1e250 0\nf 1 2 3 4\n")
                .mesh.face_count(),
            2);
}

// A search of every corner in every triangle would look at 10^10 of them.
TEST(Polygon, OnesOfAHundredThousandCornersAreCut) {
  constexpr int kCorners = 100'000;
  Polygon comb, spiral, rough;
  for (int k = 0; k < kCorners / 4; ++k) {
    comb.emplace_back(k, 0.0);
    comb.emplace_back(k + 0.3, 10.0);
    comb.emplace_back(k + 0.6, 10.0);
    comb.emplace_back(k + 0.9, 0.0);
  }
  comb.front().y() = comb.back().y() = -5.0;
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < kCorners / 2; ++k) {
      const int at = side == 0 ? k : kCorners / 2 - 1 - k;
      const double angle = 0.01 * at;
      const double radius = 1.0 + angle + 2.0 * side;
      spiral.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> reach(1.0, 2.0);
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kCorners;
    rough.push_back(reach(random) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  for (const Polygon* polygon : {&comb, &spiral, &rough}) {
    const Cut cut = cut_of(obj_of(flat(*polygon)));
    ASSERT_EQ(cut.mesh.face_count(), static_cast<Index>(polygon->size()) - 2);
    const double area = std::abs(area_of(*polygon));
    EXPECT_NEAR(total_area(cut.mesh) / area, 1.0, 1e-9);
    EXPECT_TRUE(cut.notes.empty()) << cut.notes[0];
  }
}

TEST(Polygon, OneThatTouchesItselfInOnePlaceAgainAndAgainIsCut) {
  // Its time goes with the square of this.
  constexpr int kPetals = test::kSanitized ? 6'000 : 33'000;
  std::string obj = "v 0 0 0\n", face = "f";
  for (int k = 0; k < 2 * kPetals; ++k) {
    const double angle = std::numbers::pi * k / kPetals;
    obj += "v " + format_double(std::cos(angle)) + " " + format_double(std::sin(angle)) + " 0\n";
    face += (k % 2 == 0 ? " 1 " : " ") + std::to_string(k + 2);
  }
  const Cut cut = cut_of(obj + face + "\n");
  EXPECT_EQ(cut.mesh.face_count(), 3 * kPetals - 2);
}

TEST(Polygon, CornersThatRepeatTheOneBeforeAreDroppedAndNoted) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  for (const char* face : {"f 1 2 3 4 1\n", "f 1 1 2 3 4\n", "f 1 2 2 2 3 4 4 1 1\n"}) {
    const Cut cut = cut_of(vertices + face);
    EXPECT_THAT(cut.mesh.faces(), testing::ElementsAre(Face{0, 1, 2}, Face{0, 2, 3})) << face;
    ASSERT_EQ(cut.notes.size(), 1u) << face;
    EXPECT_THAT(cut.notes[0], HasSubstr("repeats a corner"));
  }
}

TEST(Polygon, FacesOfFewerThanThreeCornersAreLeftOutAndCountStill) {
  const Cut cut = cut_of(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2\nf 1 2 3\nf 4\nf 1 2 2 1\nf 1 2 1 2\nf 1 1 2\n"
      "f 1 2 3 4\nf 1 2 1 1\nf 3 4 1\n");
  // A triangle keeps its place, whatever it names.
  EXPECT_THAT(cut.mesh.faces(), testing::ElementsAre(Face{0, 1, 2}, Face{0, 0, 1}, Face{0, 1, 2},
                                                     Face{0, 2, 3}, Face{2, 3, 0}));
  std::vector<Index> polygons;
  for (Index f = 0; f < cut.mesh.face_count(); ++f) polygons.push_back(cut.mesh.polygon(f));
  EXPECT_THAT(polygons, testing::ElementsAre(1, 5, 6, 6, 8));
  ASSERT_EQ(cut.notes.size(), 1u);
  EXPECT_THAT(cut.notes[0], HasSubstr("5 faces have fewer than three different corners"));
}

}  // namespace
}  // namespace mimicry
