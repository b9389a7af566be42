#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/connect.h>

namespace mimicry {
namespace {

TriangleMesh with(TriangleMesh mesh, MeshAttributes attributes) {
  mesh.set_attributes(std::make_shared<MeshAttributes>(std::move(attributes)));
  return mesh;
}

/// Two faces of a square, each with its own vertices; the second runs against the first.
TriangleMesh square_with_a_turned_face() {
  MeshAttributes attributes;
  attributes.texcoords.values = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  attributes.texcoords.corners = {0, 1, 2, 0, 3, 2};
  attributes.colors.values = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
  attributes.colors.corners = {0, 1, 2, 0, 3, 2};
  attributes.groups = {{"a", "b"}, {0, 1}};
  return with(
      {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)},
       {{0, 1, 2}, {3, 4, 5}}},
      attributes);
}

TEST(MeshAttributes, FollowFacesThatConnectTurnsAndVerticesThatItJoins) {
  const TriangleMesh mesh = square_with_a_turned_face();
  const Connected surface = connect(mesh);
  EXPECT_EQ(surface.report.turned_faces.count, 1);
  EXPECT_EQ(surface.mesh.vertex_count(), 4);
  ASSERT_TRUE(surface.mesh.attributes());
  const MeshAttributes& a = *surface.mesh.attributes();
  EXPECT_EQ(a.groups, mesh.attributes()->groups);
  for (Index f = 0; f < 2; ++f)
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = surface.mesh.corner(f, k);
      EXPECT_EQ(*a.texcoords.at_corner(f, k),
                (std::array{static_cast<float>(p.x()), static_cast<float>(p.y())}));
      EXPECT_EQ((*a.colors.at_corner(f, k))[0], static_cast<float>(p.x()));
    }
}

TEST(MeshAttributes, DoNotChangeTheSurface) {
  const TriangleMesh mesh = square_with_a_turned_face();
  TriangleMesh bare = mesh;
  bare.set_attributes(nullptr);
  const Connected a = connect(mesh), b = connect(bare);
  EXPECT_EQ(a.mesh.vertex_count(), 4);
  EXPECT_THAT(a.mesh.faces(), testing::ElementsAreArray(b.mesh.faces()));
  EXPECT_THAT(a.mesh.positions(), testing::ElementsAreArray(b.mesh.positions()));
  EXPECT_EQ(b.mesh.attributes(), nullptr);
  EXPECT_GT(a.mesh.memory_bytes(), b.mesh.memory_bytes());
}

TEST(MeshAttributes, ThatDoNotFitAreRefused) {
  const TriangleMesh mesh = square_with_a_turned_face();
  const auto refuses = [&](auto change) {
    MeshAttributes attributes = *mesh.attributes();
    change(attributes);
    EXPECT_THROW(with(mesh, attributes), Error);
  };
  refuses([](MeshAttributes& a) { a.texcoords.corners.pop_back(); });
  refuses([](MeshAttributes& a) { a.texcoords.corners[5] = 4; });
  refuses([](MeshAttributes& a) { a.colors.corners[0] = -2; });
  refuses([](MeshAttributes& a) { a.groups.of_face.push_back(0); });
  refuses([](MeshAttributes& a) { a.objects.of_face = {0, kNone}; });
  TriangleMesh emptied = mesh;
  emptied.set_attributes(std::make_shared<MeshAttributes>());
  EXPECT_EQ(emptied.attributes(), nullptr);
}

TEST(MeshAttributes, AreLinearInAFace) {
  const TriangleMesh mesh = square_with_a_turned_face();
  const auto uv = mesh.attributes()->texcoords.interpolated(0, Vec3(0.25, 0.25, 0.5));
  EXPECT_FLOAT_EQ(uv[0], 0.75f);
  EXPECT_FLOAT_EQ(uv[1], 0.5f);
  EXPECT_TRUE(std::isnan(CornerValues<2>().interpolated(0, Vec3(1, 0, 0))[0]));
}

TEST(MeshAttributes, EncodingOfColorsGoesBothWays) {
  for (const double x : {-0.5, 0.0, 0.001, 0.0031308, 0.2, 0.5, 1.0, 4.0})
    EXPECT_NEAR(linear_from_srgb(srgb_from_linear(x)), x, 1e-7) << x;
  EXPECT_NEAR(srgb_from_linear(0.5), 0.735357, 1e-6);
}

}  // namespace
}  // namespace mimicry
