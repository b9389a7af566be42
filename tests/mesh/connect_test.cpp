#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>
#include <mimicry/mesh/connect.h>
#include <mimicry/mesh/shapes.h>

namespace mimicry {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Every corner a vertex of its own, as in an STL file.
TriangleMesh soup_of(const TriangleMesh& mesh) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto v = static_cast<Index>(positions.size());
    for (int k = 0; k < 3; ++k) positions.push_back(mesh.corner(f, k));
    faces.push_back({v, v + 1, v + 2});
  }
  return {std::move(positions), std::move(faces)};
}

TriangleMesh box(const Vec3& low, const Vec3& high) {
  std::vector<Vec3> positions;
  for (int i = 0; i < 8; ++i)
    positions.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                           i & 4 ? high.z() : low.z());
  return {std::move(positions),
          {{0, 2, 1},
           {1, 2, 3},
           {4, 5, 6},
           {5, 7, 6},
           {0, 1, 4},
           {1, 5, 4},
           {2, 6, 3},
           {3, 6, 7},
           {0, 4, 2},
           {2, 4, 6},
           {1, 3, 5},
           {3, 7, 5}}};
}

TriangleMesh together(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Vec3> positions(a.positions().begin(), a.positions().end());
  positions.insert(positions.end(), b.positions().begin(), b.positions().end());
  std::vector<Face> faces(a.faces().begin(), a.faces().end());
  for (Face f : b.faces()) {
    for (Index& v : f) v += a.vertex_count();
    faces.push_back(f);
  }
  return {std::move(positions), std::move(faces)};
}

TriangleMesh with_faces(const TriangleMesh& mesh, std::vector<Face> faces) {
  return {{mesh.positions().begin(), mesh.positions().end()}, std::move(faces)};
}

std::vector<Face> faces_of(const TriangleMesh& mesh) {
  return {mesh.faces().begin(), mesh.faces().end()};
}

Face other_side(const Face& f) {
  return {f[0], f[2], f[1]};
}

std::size_t parts(const TriangleMesh& mesh) {
  return validate(mesh).components.size();
}

// Whatever came in: what every technique relies on, and the maps.
void expect_surface(const TriangleMesh& from, const Connected& made) {
  ASSERT_EQ(made.mesh.face_count(), from.face_count());
  EXPECT_TRUE(made.half_edges.is_manifold());
  for (Index f = 0; f < from.face_count(); ++f) {
    EXPECT_EQ(made.mesh.polygon(f), from.polygon(f));
    if (repeats_corner(made.mesh.face(f))) continue;
    for (int k = 0; k < 3; ++k) {
      const Index own = source_vertex(made.mesh, f, k);
      EXPECT_EQ(made.mesh.corner(f, k), from.position(own)) << "face " << f << " corner " << k;
      EXPECT_TRUE(std::count(from.face(f).begin(), from.face(f).end(), own) > 0);
    }
    SurfacePoint p{f, Vec3(0.5, 0.3, 0.2)};
    // The same three terms, perhaps in another order.
    EXPECT_LT((made.mesh.position(p) - from.position(source_point(made.mesh, p))).norm(), 1e-14);
    for (int k = 0; k < 3; ++k)
      for (const double t : {0.0, 0.25, 1.0}) {
        const Crossing c{3 * f + k, t};
        EXPECT_LT((position(made.mesh, c) - position(from, source_crossing(made.mesh, c))).norm(),
                  1e-12);
      }
  }
  // Again it changes nothing.
  const Connected again = connect(made.mesh);
  EXPECT_EQ(again.mesh.vertex_count(), made.mesh.vertex_count());
  EXPECT_EQ(faces_of(again.mesh), faces_of(made.mesh));
  EXPECT_TRUE(made.mesh.is_connected());
}

TEST(Connect, ASoundMeshComesBackAsItIs) {
  for (const TriangleMesh& mesh : {make_torus(12, 8, 1.0, 0.4), make_grid(4)}) {
    const Connected made = connect(mesh);
    EXPECT_EQ(made.mesh.source(), nullptr);
    EXPECT_EQ(faces_of(made.mesh), faces_of(mesh));
    EXPECT_TRUE(made.report.sentences().empty());
    expect_surface(mesh, made);
  }
}

TEST(Connect, TriangleSoupBecomesTheSurface) {
  const TriangleMesh torus = make_torus(12, 8, 1.0, 0.4), soup = soup_of(torus);
  const Connected made = connect(soup);
  expect_surface(soup, made);
  EXPECT_EQ(made.mesh.vertex_count(), torus.vertex_count());
  EXPECT_EQ(made.report.joined_edges.count, 3 * torus.face_count() / 2);
  EXPECT_EQ(made.report.joined_vertices.count, soup.vertex_count() - torus.vertex_count());
  EXPECT_EQ(made.report.joined_vertices.first, 3);
  const MeshReport report = validate(made.mesh);
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.genus, 1);

  const Connected apart = connect(soup, {.join = false});
  EXPECT_EQ(apart.mesh.vertex_count(), soup.vertex_count());
  EXPECT_EQ(apart.report.seam_edges.count, 3 * torus.face_count() / 2);
}

TEST(Connect, MinusZeroIsZero) {
  const TriangleMesh mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-0.0, 0, -0.0),
                           Vec3(1, -0.0, 0), Vec3(0, -1, 0)},
                          {{0, 1, 2}, {4, 3, 5}});
  const Connected made = connect(mesh);
  expect_surface(mesh, made);
  EXPECT_EQ(made.mesh.vertex_count(), 4);
}

TEST(Connect, BoxesThatTouchStayBoxes) {
  const TriangleMesh one = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  // On a side, on an edge, in a corner, on half a side.
  for (const Vec3& at : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(-1, 0, 0)}) {
    const TriangleMesh two = together(one, box(at, at + Vec3(1, 1, 1)));
    for (const TriangleMesh& mesh : {two, soup_of(two)}) {
      const Connected made = connect(mesh);
      expect_surface(mesh, made);
      const MeshReport report = validate(made.mesh);
      EXPECT_EQ(report.components.size(), 2u) << at.transpose();
      EXPECT_TRUE(report.is_closed()) << at.transpose();
      EXPECT_NEAR(report.volume.value_or(0.0), 2.0, 1e-12);
      EXPECT_EQ(made.report.doubled_faces.count, 0);
    }
  }
  // The same through shared vertices, as an STL reader makes it: eight boxes around a point.
  TriangleMesh all = one;
  for (int i = 1; i < 8; ++i) {
    const Vec3 at(i & 1, (i >> 1) & 1, i >> 2);
    all = together(all, box(at, at + Vec3(1, 1, 1)));
  }
  const Connected made = connect(soup_of(all));
  EXPECT_EQ(parts(made.mesh), 8u);
  EXPECT_TRUE(validate(made.mesh).is_closed());
}

TEST(Connect, ASeamThatClosesAnEdgeNeverGivesItAThirdFace) {
  // Two sheets and a fin of their own vertices at one edge.
  const std::vector<Vec3> edge = {Vec3(0, 0, 0), Vec3(0, 0, 1)};
  const TriangleMesh mesh({edge[0], edge[1], Vec3(1, 0, 0), edge[0], edge[1], Vec3(-1, 0, 0),
                           edge[0], edge[1], Vec3(0.2, 1, 0)},
                          {{0, 1, 2}, {4, 3, 5}, {7, 6, 8}});
  const Connected made = connect(mesh);
  expect_surface(mesh, made);
  // The flat continuation is the neighbour.
  EXPECT_EQ(made.half_edges.twin(0), 3);
  EXPECT_EQ(made.half_edges.twin(6), kNone);
  EXPECT_EQ(parts(made.mesh), 2u);
}

TEST(Connect, AFinOnASheetIsOpened) {
  const TriangleMesh grid = make_grid(2);
  std::vector<Vec3> positions(grid.positions().begin(), grid.positions().end());
  // An edge inside the sheet.
  const HalfEdges edges(grid);
  Index middle = 0;
  while (!edges.has_twin(middle)) ++middle;
  for (const double side : {1.0, -1.0}) {
    auto faces = faces_of(grid);
    auto points = positions;
    points.push_back(grid.position(edges.tail(middle)) + Vec3(0, 0, side));
    faces.push_back(
        {edges.tail(middle), edges.head(middle), static_cast<Index>(points.size() - 1)});
    const TriangleMesh mesh(points, faces);
    const Connected made = connect(mesh);
    expect_surface(mesh, made);
    EXPECT_EQ(made.half_edges.twin(middle), edges.twin(middle));
    EXPECT_EQ(made.report.split_edges.count, 1);
    EXPECT_EQ(parts(made.mesh), 2u);
  }
}

TEST(Connect, FansThatMeetInAPointAreSplit) {
  const TriangleMesh bow(
      {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(-1, 0, 0), Vec3(-1, -1, 0)},
      {{0, 1, 2}, {0, 3, 4}});
  const Connected made = connect(bow);
  expect_surface(bow, made);
  EXPECT_EQ(made.mesh.vertex_count(), 6);
  EXPECT_EQ(made.report.split_vertices.count, 1);
  EXPECT_EQ(made.report.split_vertices.first, 0);
  EXPECT_EQ(made.report.sentences().size(), 1u);
}

TEST(Connect, VerticesWithoutFacesAreLeftOut) {
  const TriangleMesh mesh(
      {Vec3(1e9, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(kNaN, 0, 0), Vec3(0, 1, 0)},
      {{1, 2, 4}});
  const Connected made = connect(mesh);
  expect_surface(mesh, made);
  EXPECT_EQ(made.mesh.vertex_count(), 3);
  EXPECT_EQ(made.report.unused_vertices.count, 2);
  EXPECT_FALSE(made.report.is_flawed());
  EXPECT_EQ(made.mesh.source()->vertex, (std::vector<Index>{1, 2, 4}));
  EXPECT_EQ(made.mesh.source()->surface_vertex, (std::vector<Index>{kNone, 0, 1, kNone, 2}));
  EXPECT_NEAR(diagonal(made.mesh), std::sqrt(2.0), 1e-12);
}

TEST(Connect, TurnedFacesAreTurnedBack) {
  const TriangleMesh ball = make_sphere(8);
  std::mt19937 random(3);
  for (const bool is_soup : {false, true}) {
    auto faces = faces_of(ball);
    for (Face& f : faces)
      if (random() % 2) f = other_side(f);
    const TriangleMesh mixed = with_faces(ball, faces);
    const TriangleMesh mesh = is_soup ? soup_of(mixed) : mixed;
    const Connected made = connect(mesh);
    expect_surface(mesh, made);
    const MeshReport report = validate(made.mesh);
    EXPECT_TRUE(report.is_closed());
    EXPECT_GT(report.volume.value_or(0.0), 4.0);  // outward, though half of them were not
    EXPECT_GT(made.report.turned_faces.count, 0);
  }
  // Wholly inside out is somebody's choice.
  auto faces = faces_of(ball);
  for (Face& f : faces) f = other_side(f);
  EXPECT_EQ(connect(with_faces(ball, faces)).report.turned_faces.count, 0);
  // An open part follows most of its faces.
  const TriangleMesh grid = make_grid(4);
  faces = faces_of(grid);
  faces[5] = other_side(faces[5]);
  const Connected made = connect(with_faces(grid, faces));
  EXPECT_EQ(made.report.turned_faces.count, 1);
  EXPECT_EQ(made.report.turned_faces.first, 5);
  EXPECT_EQ(faces_of(made.mesh), faces_of(grid));
}

TEST(Connect, DoublesAreLeftOut) {
  for (const TriangleMesh& mesh : {make_sphere(6), make_grid(3)}) {
    for (const bool own_vertices : {false, true})
      for (const bool both_sides : {false, true}) {
        auto twice = faces_of(mesh);
        const auto once = twice;
        const Index offset = own_vertices ? mesh.vertex_count() : 0;
        for (const Face& f : once) {
          const Face copy = {f[0] + offset, f[1] + offset, f[2] + offset};
          twice.push_back(both_sides ? other_side(copy) : copy);
        }
        std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
        if (own_vertices)
          positions.insert(positions.end(), mesh.positions().begin(), mesh.positions().end());
        const TriangleMesh doubled(positions, twice);
        const Connected made = connect(doubled);
        expect_surface(doubled, made);
        EXPECT_EQ(made.report.doubled_faces.count, mesh.face_count());
        EXPECT_EQ(made.report.doubled_faces.first, mesh.face_count());
        EXPECT_EQ(made.report.doubled_faces.first_copy_of, 0);
        EXPECT_EQ(made.mesh.vertex_count(), mesh.vertex_count());
        for (Index f = 0; f < mesh.face_count(); ++f) {
          EXPECT_EQ(made.mesh.face(f), mesh.face(f));
          EXPECT_TRUE(repeats_corner(made.mesh.face(mesh.face_count() + f)));
        }
      }
  }
  // One stray double, of either side.
  const TriangleMesh ball = make_sphere(6);
  for (const bool both_sides : {false, true}) {
    auto faces = faces_of(ball);
    faces.insert(faces.begin() + 9, both_sides ? other_side(faces[4]) : faces[4]);
    const TriangleMesh mesh = with_faces(ball, faces);
    const Connected made = connect(mesh);
    expect_surface(mesh, made);
    EXPECT_EQ(made.report.doubled_faces.count, 1);
    EXPECT_EQ(made.report.doubled_faces.first, 9);
    EXPECT_TRUE(validate(made.mesh).is_closed());
  }
}

TEST(Connect, AClosedPartOfWhichTheFileHasBothSidesIsTurnedOutward) {
  // Each face from inside first, and one of all of them not from both.
  for (const TriangleMesh& mesh : {make_sphere(6), make_torus(12, 8)})
    for (const bool own_vertices : {false, true})
      for (const bool all : {true, false}) {
        std::vector<Face> faces;
        for (Index f = 0; f < mesh.face_count(); ++f) {
          faces.push_back(other_side(mesh.face(f)));
          if (all || f != 3) faces.push_back(mesh.face(f));
        }
        const TriangleMesh doubled =
            own_vertices ? soup_of(with_faces(mesh, faces)) : with_faces(mesh, faces);
        const Connected made = connect(doubled);
        expect_surface(doubled, made);
        const MeshReport report = validate(made.mesh);
        EXPECT_TRUE(report.is_closed());
        EXPECT_EQ(report.volume.value_or(0.0) > 0.0, all);
        EXPECT_EQ(made.report.turned_faces.count, all ? mesh.face_count() : 0);
      }
  // What is not closed encloses nothing.
  const TriangleMesh grid = make_grid(3);
  std::vector<Face> faces;
  for (const Face& f : grid.faces()) {
    faces.push_back(other_side(f));
    faces.push_back(f);
  }
  const Connected made = connect(with_faces(grid, faces));
  EXPECT_EQ(made.report.turned_faces.count, 0);
  EXPECT_EQ(made.mesh.face(0), faces[0]);
}

TEST(Connect, DoubledPolygonsAreLeftOutHoweverTheyAreCut) {
  // A square from both sides; the fan of the reversed list has the other diagonal.
  const TriangleMesh quad({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)},
                          {{0, 1, 2}, {0, 2, 3}, {3, 2, 1}, {3, 1, 0}}, {0, 0, 1, 1});
  const Connected made = connect(quad);
  expect_surface(quad, made);
  EXPECT_EQ(made.report.doubled_faces.count, 2);
  EXPECT_NEAR(validate(made.mesh).area, 1.0, 1e-15);
}

TEST(Connect, TwoSidedSheetsThatMeetAreDoubles) {
  // Pages on a spine, each from both sides; then a box with such a flag at an edge.
  std::vector<Vec3> positions = {Vec3(0, 0, 0), Vec3(0, 0, 1)};
  std::vector<Face> faces;
  for (const Vec3& out : {Vec3(1, 0, 0), Vec3(-0.5, 0.8, 0), Vec3(-0.5, -0.8, 0)}) {
    const auto v = static_cast<Index>(positions.size());
    positions.push_back(out);
    positions.push_back(out + Vec3(0, 0, 1));
    for (const Face& f : {Face{0, v, v + 1}, Face{0, v + 1, 1}}) {
      faces.push_back(f);
      faces.push_back(other_side(f));
    }
  }
  const TriangleMesh pages(positions, faces);
  for (const TriangleMesh& mesh : {pages, soup_of(pages)}) {
    const Connected made = connect(mesh);
    expect_surface(mesh, made);
    EXPECT_EQ(made.report.doubled_faces.count, 6);
    EXPECT_LE(parts(made.mesh), 3u);
  }
  const TriangleMesh cube = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  faces = faces_of(cube);
  positions.assign(cube.positions().begin(), cube.positions().end());
  positions.push_back(Vec3(2, 2, 0.5));
  faces.push_back({3, 7, 8});
  faces.push_back({3, 8, 7});
  const TriangleMesh flag(positions, faces);
  const Connected made = connect(flag);
  expect_surface(flag, made);
  EXPECT_EQ(made.report.doubled_faces.count, 1);
  const MeshReport report = validate(made.mesh);
  ASSERT_EQ(report.components.size(), 2u);
  EXPECT_TRUE(report.components[0].closed);
}

TEST(Connect, JoiningTearsNothingThatIsSoundByNumber) {
  // A thin ribbon: the front of two squares and a back of its own vertices with other diagonals.
  std::vector<Vec3> positions;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 2; ++j) positions.emplace_back(i, j, 0);
  std::vector<Face> faces;
  for (Index i = 0; i < 2; ++i) {
    const Index a = 2 * i, b = a + 1, c = a + 2, d = a + 3;
    faces.insert(faces.end(), {{a, c, b}, {b, c, d}});
    faces.insert(faces.end(), {{6 + a, 6 + b, 6 + d}, {6 + a, 6 + d, 6 + c}});
  }
  const TriangleMesh ribbon(positions, faces);
  ASSERT_EQ(parts(ribbon), 2u);
  const Connected made = connect(ribbon);
  expect_surface(ribbon, made);
  EXPECT_LE(parts(made.mesh), 2u);
  const HalfEdges own(ribbon);
  for (Index h = 0; h < own.count(); ++h)
    if (own.has_twin(h)) {
      EXPECT_EQ(made.half_edges.twin(h), own.twin(h)) << h;
    }
}

TEST(Connect, BodiesThatTouchAreTurnedEachByItself) {
  const TriangleMesh one = box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  for (const Vec3& at : {Vec3(1, 0, 0), Vec3(1, 1, 0)})
    for (int turned = 0; turned < 12; ++turned) {
      const TriangleMesh two = together(one, box(at, at + Vec3(1, 1, 1)));
      auto faces = faces_of(two);
      for (int k = 0; k <= turned; ++k)
        faces[static_cast<std::size_t>(k)] = other_side(two.face(k));
      const TriangleMesh mesh = with_faces(two, faces);
      const Connected made = connect(mesh);
      expect_surface(mesh, made);
      const MeshReport report = validate(made.mesh);
      EXPECT_EQ(report.components.size(), 2u) << turned;
      EXPECT_TRUE(report.is_closed()) << turned;
      // A body that is wholly inside out is somebody's choice.
      EXPECT_NEAR(report.volume.value_or(0.0), turned == 11 ? 0.0 : 2.0, 1e-12) << turned;
    }
}

TEST(Connect, CollapsedFacesAreLeftOutAndClosed) {
  // A face with two corners at one place, by number and by position, in a closed surface.
  const TriangleMesh ball = make_sphere(6);
  const Face f = ball.face(7);
  auto faces = faces_of(ball);
  faces.push_back({f[0], f[0], f[1]});
  std::vector<Vec3> positions(ball.positions().begin(), ball.positions().end());
  positions.push_back(ball.position(f[1]));
  faces.push_back({f[0], f[1], ball.vertex_count()});
  const TriangleMesh mesh(positions, faces);
  const Connected made = connect(mesh);
  expect_surface(mesh, made);
  EXPECT_EQ(made.report.repeated_corners.count, 2);
  EXPECT_EQ(made.report.repeated_corners.first, ball.face_count());
  EXPECT_TRUE(validate(made.mesh).is_closed());
}

TEST(Connect, AOneSidedStripIsOpened) {
  const TriangleMesh strip = make_moebius_strip(7);
  const Connected made = connect(strip);
  expect_surface(strip, made);
  EXPECT_EQ(made.report.one_sided_edges.count, 1);
  const MeshReport report = validate(made.mesh);
  EXPECT_EQ(report.components.size(), 1u);
  EXPECT_TRUE(report.components[0].orientable);
  // Turned at random it is opened once more, not shattered.
  std::mt19937 random(5);
  auto faces = faces_of(strip);
  for (Face& f : faces)
    if (random() % 2) f = other_side(f);
  const TriangleMesh mixed = with_faces(strip, faces);
  const Connected mended = connect(mixed);
  expect_surface(mixed, mended);
  EXPECT_EQ(parts(mended.mesh), 1u);
}

TEST(Connect, AnyMessBecomesASurface) {
  const unsigned seed = 20261;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int round = 0; round < 20000; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    // Few places, so that faces share edges, vertices and each other; some vertices twice.
    const int places = 4 + static_cast<int>(random() % 6);
    std::vector<Vec3> positions;
    for (int i = 0; i < places * 2; ++i) {
      const auto k = random() % static_cast<unsigned>(places);
      positions.emplace_back(k % 3, (k / 3) % 3, round % 2 ? 0.0 : static_cast<double>(k % 2));
    }
    std::vector<Face> faces;
    const auto any = [&] {
      return static_cast<Index>(random() % static_cast<unsigned>(positions.size()));
    };
    const int count = 1 + static_cast<int>(random() % 40);
    for (int i = 0; i < count; ++i) faces.push_back({any(), any(), any()});
    const TriangleMesh mesh(positions, faces);
    const Connected made = connect(mesh);
    if (made.mesh.source()) expect_surface(mesh, made);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace mimicry
