#include <gtest/gtest.h>

#include <mimicry/mesh/half_edges.h>

namespace mimicry {
namespace {

TriangleMesh tetrahedron() {
  return {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

TEST(HalfEdges, TwinsOfAClosedMeshRunTheOtherWay) {
  const HalfEdges edges(tetrahedron());
  EXPECT_TRUE(edges.is_manifold());
  for (Index h = 0; h < edges.count(); ++h) {
    ASSERT_TRUE(edges.has_twin(h));
    EXPECT_EQ(edges.twin(edges.twin(h)), h);
    EXPECT_EQ(edges.tail(h), edges.head(edges.twin(h)));
  }
}

TEST(HalfEdges, TurningAroundAVertexMeetsEveryFaceOnce) {
  const HalfEdges edges(tetrahedron());
  for (Index v = 0; v < 4; ++v) {
    int faces = 0;
    Index h = edges.outgoing(v);
    do {
      EXPECT_EQ(edges.tail(h), v);
      EXPECT_EQ(edges.cw(edges.ccw(h)), h);
      h = edges.ccw(h);
      ++faces;
    } while (h != edges.outgoing(v));
    EXPECT_EQ(faces, 3);
    EXPECT_FALSE(edges.is_boundary_vertex(v));
  }
}

TEST(HalfEdges, BoundaryVertexStartsItsFanAtTheBoundary) {
  // Three triangles in a fan around vertex 0.
  const TriangleMesh fan(
      {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(-1, 1, 0)},
      {{0, 2, 3}, {0, 1, 2}, {0, 3, 4}});
  const HalfEdges edges(fan);
  EXPECT_TRUE(edges.is_boundary_vertex(0));
  Index h = edges.outgoing(0);
  std::vector<Index> heads;
  for (; h >= 0; h = edges.ccw(h)) heads.push_back(edges.head(h));
  EXPECT_EQ(heads, (std::vector<Index>{1, 2, 3}));
  EXPECT_TRUE(edges.is_manifold());
}

TEST(HalfEdges, ThreeFacesAtAnEdgeAreNonManifold) {
  const TriangleMesh book(
      {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0)},
      {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  const HalfEdges edges(book);
  EXPECT_FALSE(edges.is_manifold());
  EXPECT_EQ(edges.twin(0), HalfEdges::kNonManifold);
  EXPECT_FALSE(edges.has_twin(0));
}

TEST(HalfEdges, SameDirectionOnBothSidesIsNonManifold) {
  const TriangleMesh flipped({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)},
                             {{0, 1, 2}, {0, 1, 3}});
  EXPECT_FALSE(HalfEdges(flipped).is_manifold());
}

TEST(HalfEdges, ConesThatTouchInATipAreNonManifoldThere) {
  const TriangleMesh bow(
      {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(-1, 0, 0), Vec3(-1, -1, 0)},
      {{0, 1, 2}, {0, 3, 4}});
  const HalfEdges edges(bow);
  EXPECT_TRUE(edges.is_nonmanifold_vertex(0));
  EXPECT_FALSE(edges.is_nonmanifold_vertex(1));
  EXPECT_FALSE(edges.is_manifold());
}

TEST(HalfEdges, IsolatedVertexHasNoHalfEdge) {
  const HalfEdges edges(
      TriangleMesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(5, 5, 5)}, {{0, 1, 2}}));
  EXPECT_EQ(edges.outgoing(3), kNone);
  EXPECT_TRUE(edges.is_boundary_vertex(3));
}

TEST(HalfEdges, FaceThatNamesAVertexTwiceHasNoNeighbours) {
  const HalfEdges edges(TriangleMesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                                     {{0, 1, 1}, {0, 1, 2}, {2, 2, 2}}));
  EXPECT_TRUE(edges.is_manifold());
  for (Index h = 0; h < edges.count(); ++h) EXPECT_EQ(edges.twin(h), kNone);
  EXPECT_EQ(HalfEdges::face(edges.outgoing(0)), 1);
  EXPECT_EQ(HalfEdges::face(edges.outgoing(2)), 1);
}

}  // namespace
}  // namespace mimicry
