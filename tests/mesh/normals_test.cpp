#include <cmath>

#include <gtest/gtest.h>

#include <mimicry/mesh/surface.h>

namespace mimicry {
namespace {

// A corner of a cube with one of its three sides cut in two: plain averaging would lean toward the
// cut side.
TriangleMesh cube_corner(double scale, const Vec3& origin) {
  std::vector<Vec3> p = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 0)};
  for (Vec3& x : p) x = origin + scale * x;
  return {p, {{0, 1, 4}, {0, 4, 2}, {0, 2, 3}, {0, 3, 1}}};
}

TEST(Normals, AngleWeightsMakeTheCutOfAFaceIrrelevant) {
  const auto normals = angle_weighted_normals(cube_corner(1.0, Vec3::Zero()));
  EXPECT_LT((normals[0] - Vec3::Ones() / std::sqrt(3.0)).norm(), 1e-15);
}

TEST(Normals, ScaleFromTinyToHugeGivesTheSameNormals) {
  for (const double scale : {1e-160, 1e-6, 1e6, 1e160}) {
    const auto normals = angle_weighted_normals(cube_corner(scale, Vec3::Zero()));
    EXPECT_LT((normals[0] - Vec3::Ones() / std::sqrt(3.0)).norm(), 1e-14) << scale;
  }
}

TEST(Normals, FaceWithoutAreaHasNoNormalAndNoInfluence) {
  const TriangleMesh mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(0, 1, 0)},
                          {{0, 1, 2}, {0, 1, 3}});
  EXPECT_EQ(face_normal(mesh, 0), Vec3::Zero());
  EXPECT_EQ(angle_weighted_normals(mesh)[0], Vec3(0, 0, 1));
}

TEST(Normals, InterpolatedNormalFallsBackToTheFaceWhereVertexNormalsCancel) {
  const TriangleMesh mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}});
  const std::vector<Vec3> normals = {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1)};
  const Vec3 n = interpolated_normal(mesh, normals, {0, Vec3(0.5, 0.5, 0.0)});
  EXPECT_EQ(n, Vec3(0, 0, 1));
}

}  // namespace
}  // namespace mimicry
