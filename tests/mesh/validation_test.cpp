#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/validation.h>

namespace mimicry {
namespace {

TriangleMesh without_faces(const TriangleMesh& mesh, std::vector<Index> removed) {
  std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
  std::vector<Face> faces;
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (std::find(removed.begin(), removed.end(), f) == removed.end())
      faces.push_back(mesh.face(f));
  return {positions, faces};
}

TEST(Validate, EmptyMesh) {
  const MeshReport report = validate(TriangleMesh());
  EXPECT_EQ(report.vertices, 0);
  EXPECT_EQ(report.edges, 0);
  EXPECT_TRUE(report.box.isEmpty());
  EXPECT_TRUE(report.components.empty());
  EXPECT_TRUE(report.is_manifold());
  EXPECT_FALSE(report.is_closed());
  EXPECT_FALSE(report.genus.has_value());
  EXPECT_FALSE(report.volume.has_value());
}

TEST(Validate, OneTriangle) {
  const MeshReport report = validate({{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0)}, {{0, 1, 2}}});
  EXPECT_EQ(report.boundary.loops, 1);
  EXPECT_EQ(report.boundary.edges.count, 3);
  EXPECT_EQ(report.boundary.edges.first_tail, 0);
  EXPECT_EQ(report.boundary.edges.first_head, 1);
  EXPECT_EQ(report.euler, 1);
  EXPECT_EQ(report.genus, 0);
  EXPECT_DOUBLE_EQ(report.area, 6);
  EXPECT_DOUBLE_EQ(report.shortest_edge, 3);
  EXPECT_DOUBLE_EQ(report.mean_edge, 4);
  EXPECT_DOUBLE_EQ(report.longest_edge, 5);
  EXPECT_DOUBLE_EQ(report.diagonal, 5);
  EXPECT_TRUE(report.is_manifold());
  EXPECT_FALSE(report.is_closed());
}

TEST(Validate, BookWithThreePagesHasOneNonManifoldEdge) {
  const TriangleMesh book(
      {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0)},
      {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  const MeshReport report = validate(book);
  EXPECT_EQ(report.nonmanifold_edges.count, 1);
  EXPECT_EQ(report.nonmanifold_edges.first_tail, 0);
  EXPECT_EQ(report.nonmanifold_edges.first_head, 1);
  EXPECT_EQ(report.inconsistent_edges.count, 0);
  EXPECT_EQ(report.nonmanifold_vertices.count, 0);
  EXPECT_EQ(report.boundary.edges.count, 6);
  EXPECT_FALSE(report.genus.has_value());
}

TEST(Validate, FlippedFaceIsInconsistentAndNotNonManifold) {
  const TriangleMesh cube = make_box(2, 2, 2, Vec3::Ones());
  std::vector<Vec3> positions(cube.positions().begin(), cube.positions().end());
  std::vector<Face> faces(cube.faces().begin(), cube.faces().end());
  std::swap(faces[5][0], faces[5][1]);
  const MeshReport report = validate({positions, faces});
  EXPECT_EQ(report.inconsistent_edges.count, 3);
  EXPECT_EQ(report.nonmanifold_edges.count, 0);
  EXPECT_EQ(report.nonmanifold_vertices.count, 0);
  EXPECT_EQ(report.boundary.edges.count, 0);
  EXPECT_FALSE(report.is_manifold());
  EXPECT_FALSE(report.volume.has_value());
  EXPECT_TRUE(report.components[0].orientable);
  EXPECT_TRUE(report.components[0].closed);
  EXPECT_EQ(report.genus, 0);
}

TEST(Validate, MoebiusStripIsNotOrientable) {
  const MeshReport report = validate(make_moebius_strip(32));
  EXPECT_EQ(report.inconsistent_edges.count, 4);  // the seam: 32 / 8 quads across
  EXPECT_EQ(report.nonmanifold_vertices.count, 0);
  EXPECT_EQ(report.boundary.loops, 1);
  EXPECT_EQ(report.boundary.edges.count, 64);
  ASSERT_EQ(report.components.size(), 1u);
  EXPECT_TRUE(report.components[0].manifold);
  EXPECT_FALSE(report.components[0].orientable);
  EXPECT_FALSE(report.genus.has_value());
}

TEST(Validate, TrianglesThatTouchInATipHaveANonManifoldVertex) {
  const MeshReport report =
      validate({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(-1, 0, 0), Vec3(-1, -1, 0)},
                {{1, 2, 0}, {0, 3, 4}}});
  EXPECT_EQ(report.nonmanifold_vertices.count, 1);
  EXPECT_EQ(report.nonmanifold_vertices.first, 0);
  EXPECT_EQ(report.components.size(), 1u);
  EXPECT_EQ(report.boundary.loops, 2);
  EXPECT_EQ(report.euler, 1);
}

TEST(Validate, HolesAreCountedAsLoops) {
  const TriangleMesh sphere = make_sphere(6);
  // Two faces far apart, and two neighbours that open one hole of four edges.
  const TriangleMesh holed = without_faces(sphere, {0, 1, 400});
  const MeshReport report = validate(holed);
  EXPECT_EQ(report.boundary.loops, 2);
  EXPECT_EQ(report.boundary.edges.count, 7);
  EXPECT_EQ(report.euler, 0);
  EXPECT_EQ(report.genus, 0);
  EXPECT_TRUE(report.is_manifold());
  EXPECT_FALSE(report.volume.has_value());
}

TEST(Validate, DegenerateFacesByTheirHeight) {
  // Needle just above and just below 1e-10 of its longest edge; a point; a face with one vertex
  // twice.
  const auto needle = [](double height) {
    return TriangleMesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, height, 0)}, {{0, 1, 2}});
  };
  EXPECT_EQ(validate(needle(2e-10)).degenerate_faces.count, 0);
  EXPECT_EQ(validate(needle(0.5e-10)).degenerate_faces.count, 1);
  const TriangleMesh mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(2, 0, 0)},
                          {{0, 1, 2}, {0, 1, 3}, {1, 1, 2}, {2, 2, 2}});
  const MeshReport report = validate(mesh);
  EXPECT_EQ(report.degenerate_faces.count, 3);
  EXPECT_EQ(report.degenerate_faces.first, 1);
  EXPECT_EQ(report.repeated_corners.count, 2);
  EXPECT_EQ(report.repeated_corners.first, 2);
  EXPECT_DOUBLE_EQ(report.area, 0.5);
}

TEST(Validate, VerdictsDoNotDependOnScale) {
  for (const double scale : {1e-90, 1e-6, 1e6, 1e90}) {
    const TriangleMesh torus = make_torus(12, 8, 0.8 * scale, 0.3 * scale);
    const MeshReport report = validate(torus);
    EXPECT_EQ(report.degenerate_faces.count, 0) << scale;
    EXPECT_EQ(report.invalid_vertices.count, 0) << scale;
    EXPECT_EQ(report.genus, 1) << scale;
    EXPECT_GT(report.volume.value(), 0) << scale;
  }
}

TEST(Validate, VolumeKeepsItsDigitsFarFromTheOrigin) {
  const TriangleMesh near = make_sphere(8);
  std::vector<Vec3> positions(near.positions().begin(), near.positions().end());
  for (Vec3& p : positions) p += Vec3(1e4, -1e4, 1e4);
  // Coordinates keep 1e4 * 2^-53 = 1e-12 of absolute accuracy.
  EXPECT_NEAR(validate(near.with_positions(positions)).volume.value(),
              validate(near).volume.value(), 1e-10);
}

TEST(Validate, DuplicateFacesInAnyOrder) {
  const TriangleMesh mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)},
                          {{1, 3, 2}, {0, 1, 2}, {2, 0, 1}, {1, 0, 2}, {3, 2, 1}});
  const MeshReport report = validate(mesh);
  EXPECT_EQ(report.duplicate_faces.count, 3);
  EXPECT_EQ(report.duplicate_faces.first, 2);
  EXPECT_EQ(report.duplicate_faces.first_copy_of, 1);
  EXPECT_EQ(report.nonmanifold_edges.count, 3);   // 0-1, 1-2, 2-0; 1-2 has five faces
  EXPECT_EQ(report.inconsistent_edges.count, 2);  // 1-3 and 3-2
}

TEST(Validate, IsolatedAndInvalidVertices) {
  const double nan = std::nan("");
  const TriangleMesh mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(5, 5, 5),
                           Vec3(nan, 0, 0), Vec3(0, kInfinity, 0), Vec3(1e300, 0, 0)},
                          {{0, 1, 2}, {0, 2, 4}, {0, 4, 5}});
  // Box and findings of bad places are of what faces use.
  const MeshReport report = validate(mesh);
  EXPECT_EQ(report.isolated_vertices.count, 2);
  EXPECT_EQ(report.isolated_vertices.first, 3);
  EXPECT_EQ(report.invalid_vertices.count, 2);
  EXPECT_EQ(report.invalid_vertices.first, 4);
  EXPECT_EQ(report.degenerate_faces.count, 0);
  EXPECT_DOUBLE_EQ(report.area, 0.5);
  EXPECT_EQ(report.box.max(), Vec3(1, 1, 0));
}

TEST(Validate, ComponentsAndTheirGenus) {
  const TriangleMesh torus = make_torus(9, 7);
  const TriangleMesh sphere = make_sphere(3, 0.2);
  std::vector<Vec3> positions(torus.positions().begin(), torus.positions().end());
  std::vector<Face> faces(torus.faces().begin(), torus.faces().end());
  const Index first = torus.vertex_count();
  positions.insert(positions.end(), sphere.positions().begin(), sphere.positions().end());
  for (const Face& f : sphere.faces()) faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  const MeshReport report = validate({positions, faces});
  ASSERT_EQ(report.components.size(), 2u);
  EXPECT_EQ(report.components[0].genus, 1);
  EXPECT_EQ(report.components[0].vertices, 63);
  EXPECT_EQ(report.components[0].edges, 189);
  EXPECT_EQ(report.components[1].genus, 0);
  EXPECT_EQ(report.components[1].first_face, 126);
  EXPECT_EQ(report.components[1].faces, 180);
  EXPECT_EQ(report.genus, 1);
  EXPECT_EQ(report.euler, 2);
}

TEST(Validate, AnyConnectivityIsReportedAndAgreesWithHalfEdges) {
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    const std::uint32_t vertices = 3 + random.below(6);
    std::vector<Vec3> positions(vertices);
    for (Vec3& p : positions) p = Vec3(random.uniform(), random.uniform(), random.uniform());
    std::vector<Face> faces(random.below(8));
    for (Face& f : faces)
      for (Index& v : f) v = static_cast<Index>(random.below(vertices));
    const TriangleMesh mesh(positions, faces);
    const MeshReport report = validate(mesh);
    EXPECT_EQ(report.is_manifold(), HalfEdges(mesh).is_manifold());
    Index in_components = 0;
    for (const ComponentReport& part : report.components) in_components += part.faces;
    EXPECT_EQ(in_components + report.repeated_corners.count, report.faces);
  }
}

// Under floating-point traps, too: neither box nor report computes with what is not finite.
TEST(BoundingBox, PassesOverWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TriangleMesh mesh({Vec3(0, 0, 0), Vec3(1, 2, 0), Vec3(0, 1, -3), Vec3(kInfinity, 0, 0),
                           Vec3(9, -kInfinity, 9), Vec3(9, nan, 9), Vec3(50, 50, 50)},
                          {{0, 1, 2}, {0, 3, 4}, {1, 2, 5}});
  const Eigen::AlignedBox3d box = bounding_box(mesh);
  EXPECT_EQ(box.min(), Vec3(0, 0, -3));
  EXPECT_EQ(box.max(), Vec3(1, 2, 0));
  EXPECT_EQ(validate(mesh).invalid_vertices.count, 3);
}

}  // namespace
}  // namespace mimicry
