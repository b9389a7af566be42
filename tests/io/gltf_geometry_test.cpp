#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/gltf_builder.h"

namespace mimicry {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

const std::vector<float> kCorner = {0, 0, 0, 1, 0, 0, 0, 1, 0};

/// Column-major, a translation.
std::vector<float> moved(float x, float y, float z) {
  return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
}

TEST(GltfSparse, ValuesReplaceThoseOfTheView) {
  GltfBuilder gltf;
  const int positions = gltf.positions(kCorner);
  const int indices = gltf.view(std::vector<std::uint8_t>{2, 0});
  const int values = gltf.view(std::vector<float>{0, 5, 0, 0, 0, 7});
  gltf.root["accessors"][positions]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
      {"values", {{"bufferView", values}}}};
  gltf.mesh(positions);
  gltf.node({{"mesh", 0}});
  // Not in ascending order, as they should be.
  EXPECT_THAT(gltf.read().positions(), ElementsAre(Vec3(0, 0, 7), Vec3(1, 0, 0), Vec3(0, 5, 0)));
  gltf.root["accessors"][positions]["count"] = 2;
  EXPECT_THAT(said([&] { gltf.read(); }),
              HasSubstr("a sparse value for element 2, but there are 2"));
}

TEST(GltfSparse, WithoutAViewTheOthersAreZero) {
  GltfBuilder gltf;
  const int indices = gltf.view(std::vector<std::uint16_t>{1, 2});
  const int values = gltf.view(std::vector<float>{3, 0, 0, 0, 3, 0});
  const int positions = gltf.accessor(std::nullopt, "VEC3", 5126, 4);
  gltf.root["accessors"][positions]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
      {"values", {{"bufferView", values}}}};
  gltf.mesh(positions, gltf.indices({0, 1, 2, 3, 1, 2}));
  gltf.node({{"mesh", 0}});
  const TriangleMesh mesh = gltf.read();
  EXPECT_THAT(mesh.positions(),
              ElementsAre(Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(0, 0, 0)));
  EXPECT_THAT(mesh.faces(), ElementsAre(Face{0, 1, 2}, Face{3, 1, 2}));
}

TEST(GltfPositions, OfWholeNumbersThatAreNotNormalizedAreThoseNumbers) {
  GltfBuilder gltf;
  // Padded to four bytes a vertex, as KHR_mesh_quantization asks.
  const int view = gltf.view(std::vector<std::int8_t>{-128, 0, 0, 9, 127, 0, 0, 9, 0, 127, 0, 9});
  gltf.root["bufferViews"][view]["byteStride"] = 4;
  gltf.root["extensionsRequired"] = {"KHR_mesh_quantization"};
  gltf.mesh(gltf.accessor(view, "VEC3", 5120, 3));
  gltf.node({{"mesh", 0}, {"scale", {0.5, 0.5, 0.5}}});
  EXPECT_THAT(gltf.read().positions(),
              ElementsAre(Vec3(-64, 0, 0), Vec3(63.5, 0, 0), Vec3(0, 63.5, 0)));
}

TEST(GltfMorph, DefaultWeightsMoveVerticesThoseOfTheNodeBeforeThoseOfTheMesh) {
  GltfBuilder gltf;
  Json& primitive = gltf.mesh(gltf.positions(kCorner));
  const int up = gltf.positions({0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int side = gltf.positions({4, 0, 0, 0, 0, 0, 0, 0, 0});
  primitive["targets"] = {{{"POSITION", up}}, {{"NORMAL", up}}, {{"POSITION", side}}};
  gltf.node({{"mesh", 0}});
  EXPECT_EQ(gltf.read().position(0), Vec3(0, 0, 0));
  gltf.root["meshes"][0]["weights"] = {0.5, 1, 0.25};
  EXPECT_THAT(gltf.read().positions(),
              ElementsAre(Vec3(1, 0, 0.5), Vec3(1, 0, 0.5), Vec3(0, 1, 0.5)));
  gltf.root["nodes"][0]["weights"] = {0, 0, 1};
  EXPECT_THAT(gltf.read().positions(), ElementsAre(Vec3(4, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)));
}

/// Two joints: weights of each vertex, and what is in the skin beside the joints.
GltfBuilder skinned_triangle(const std::vector<float>& weights) {
  GltfBuilder gltf;
  Json& primitive = gltf.mesh(gltf.positions(kCorner));
  primitive["attributes"]["JOINTS_0"] =
      gltf.accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4", 4);
  primitive["attributes"]["WEIGHTS_0"] = gltf.accessor(weights, "VEC4", 4);
  std::vector<float> inverse = moved(0, 0, 0);
  const std::vector<float> second = moved(-10, 0, 0);
  inverse.insert(inverse.end(), second.begin(), second.end());
  gltf.root["skins"] = {
      {{"joints", {1, 2}}, {"inverseBindMatrices", gltf.accessor(inverse, "MAT4", 16)}}};
  gltf.node({{"mesh", 0}, {"skin", 0}, {"scale", {9, 9, 9}}, {"translation", {5, 5, 5}}});
  gltf.node({{"children", {2}}, {"translation", {0, 0, 100}}});
  gltf.root["nodes"].push_back({{"translation", {10, 2, 0}}});
  return gltf;
}

TEST(GltfSkin, VerticesAreMeansOverTheirJointsWhateverTheirNode) {
  // Joint 1 is moved by (0, 2, 100) from where it was bound, joint 0 by (0, 0, 100).
  const GltfBuilder gltf = skinned_triangle({1, 0, 0, 0, 0, 1, 0, 0, 0.25f, 0.75f, 0, 0});
  EXPECT_THAT(gltf.read().positions(),
              ElementsAre(Vec3(0, 0, 100), Vec3(1, 2, 100), Vec3(0, 2.5, 100)));
}

TEST(GltfSkin, WeightsNeedNotSumToOne) {
  const GltfBuilder gltf = skinned_triangle({2, 0, 0, 0, 0, 0, 0, 0, 0.5f, 1.5f, 0, 0});
  EXPECT_THAT(gltf.read().positions(),
              ElementsAre(Vec3(0, 0, 100), Vec3(1, 0, 100), Vec3(0, 2.5, 100)));
}

TEST(GltfSkin, WithoutInverseBindMatricesTheJointsNodesCount) {
  GltfBuilder gltf = skinned_triangle({1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
  gltf.root["skins"][0].erase("inverseBindMatrices");
  EXPECT_EQ(gltf.read().position(2), Vec3(10, 3, 100));
}

TEST(GltfSkin, ErrorsTellThePlace) {
  GltfBuilder gltf = skinned_triangle({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
  gltf.root["skins"][0]["joints"] = {1};
  EXPECT_THAT(said([&] { gltf.read(); }),
              HasSubstr("mesh 0 primitive 0: vertex 0 refers to joint 1, but the skin has 1"));
  gltf.root["skins"][0]["joints"] = {1, 2, 7};
  EXPECT_THAT(said([&] { gltf.read(); }), HasSubstr("skin 0: refers to node 7"));
  gltf.root["skins"][0]["joints"] = {1, 2, 2};
  EXPECT_THAT(said([&] { gltf.read(); }), HasSubstr("skin 0: has 3 joints and 2 inverse bind"));
}

TEST(GltfSkin, MirroringJointsKeepTheOutsideOutside) {
  GltfBuilder gltf = skinned_triangle({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  gltf.root["nodes"][1]["scale"] = {-1, 1, 1};
  EXPECT_GT(gltf.read().area_vector(0).z(), 0.0);
}

TEST(GltfInstances, EachIsACopyBelowTheNode) {
  GltfBuilder gltf;
  gltf.mesh(gltf.positions(kCorner));
  const int places = gltf.positions({0, 0, 0, 10, 0, 0, 0, 0, 10});
  // A quarter turn about z for the last, quantized.
  const int turns =
      gltf.accessor(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 90, 90}, "VEC4", 4);
  gltf.root["accessors"][turns]["normalized"] = true;
  const int scales = gltf.positions({1, 1, 1, 2, 2, 2, -1, 1, 1});
  gltf.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  gltf.node(
      {{"mesh", 0}, {"translation", {100, 0, 0}}})["extensions"]["EXT_mesh_gpu_instancing"] = {
      {"attributes",
       {{"TRANSLATION", places}, {"ROTATION", turns}, {"SCALE", scales}, {"_ID", 0}}}};
  const TriangleMesh mesh = gltf.read();
  ASSERT_EQ(mesh.vertex_count(), 9);
  const Vec3 wanted[] = {Vec3(100, 0, 0),  Vec3(101, 0, 0),   Vec3(100, 1, 0),
                         Vec3(110, 0, 0),  Vec3(112, 0, 0),   Vec3(110, 2, 0),
                         Vec3(100, 0, 10), Vec3(100, -1, 10), Vec3(99, 0, 10)};
  // A few roundings of numbers of 100.
  for (Index v = 0; v < 9; ++v) EXPECT_LT((mesh.position(v) - wanted[v]).norm(), 1e-13) << v;
  for (Index f = 0; f < 3; ++f) EXPECT_GT(mesh.area_vector(f).z(), 0.0) << f;
  gltf.root["accessors"][turns]["count"] = 2;
  EXPECT_THAT(said([&] { gltf.read(); }), HasSubstr("node 0: its instances' attributes differ"));
}

TEST(GltfPrimitives, ThatNameTheSameVerticesShareThem) {
  GltfBuilder gltf;
  const int positions = gltf.positions(kCubePositions);
  Json& primitive = gltf.mesh(positions, gltf.indices({0, 2, 1, 0, 3, 2}));
  Json other = primitive;
  other["indices"] = gltf.indices({4, 5, 6, 4, 6, 7});
  other["material"] = 0;
  Json apart = other;
  apart["attributes"]["POSITION"] = gltf.positions(kCorner);
  apart.erase("indices");
  gltf.root["meshes"][0]["primitives"].push_back(apart);
  gltf.root["meshes"][0]["primitives"].push_back(other);
  gltf.node({{"mesh", 0}});
  gltf.node({{"mesh", 0}});
  const TriangleMesh mesh = gltf.read();
  EXPECT_EQ(mesh.vertex_count(), 22);
  EXPECT_THAT(mesh.faces(), ElementsAre(Face{0, 2, 1}, Face{0, 3, 2}, Face{8, 9, 10}, Face{4, 5, 6},
                                        Face{4, 6, 7}, Face{11, 13, 12}, Face{11, 14, 13},
                                        Face{19, 20, 21}, Face{15, 16, 17}, Face{15, 17, 18}));
}

TEST(GltfPrimitives, SeamsStayAsTheFileHasThem) {
  GltfBuilder gltf;
  gltf.mesh(gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  gltf.node({{"mesh", 0}});
  EXPECT_EQ(gltf.read().vertex_count(), 6);
}

TEST(GltfLimits, AreHeldBeforeAnythingIsMade) {
  // 1,000 nodes of a mesh of 1,000 primitives of 12 triangles in 60 kB.
  GltfBuilder gltf = cube_gltf();
  Json& primitives = gltf.root["meshes"][0]["primitives"];
  const Json primitive = primitives[0];
  for (int p = 1; p < 1000; ++p) primitives.push_back(primitive);
  for (int n = 1; n < 1000; ++n) gltf.node({{"mesh", 0}});
  EXPECT_THAT(said([&] { gltf.read(); }),
              HasSubstr("unfolds to 12000000 triangles, more than the 10000000 that a file of"));
  EXPECT_THAT(said([&] { gltf.read(); }), testing::EndsWith("with fewer instances"));
  MeshReadOptions options;
  options.raises_unfolded = "--more";
  EXPECT_THAT(said([&] { gltf.read(options); }), HasSubstr("or raise the limit (--more)"));
  options.max_unfolded = 12'000'000;
  options.max_faces = 11'000'000;
  EXPECT_THAT(said([&] { gltf.read(options); }), HasSubstr("more than the 11000000 that are read"));
  options.max_faces = 12'000'000;
  EXPECT_EQ(gltf.read(options).face_count(), 12'000'000);
}

TEST(GltfLimits, HoldForEverythingThatAFewBytesCanAskFor) {
  MeshReadOptions options;
  options.max_unfolded = 100'000;
  {
    GltfBuilder gltf;  // vertices that are nowhere
    gltf.mesh(gltf.accessor(std::nullopt, "VEC3", 5126, std::size_t{1} << 60));
    gltf.node({{"mesh", 0}});
    EXPECT_THAT(said([&] { gltf.read(options); }), HasSubstr("triangles, more than"));
  }
  {
    GltfBuilder gltf;  // instances that are nowhere
    gltf.mesh(gltf.positions(kCorner));
    gltf.node({{"mesh", 0}})["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
        gltf.accessor(std::nullopt, "VEC3", 5126, 1'000'000);
    EXPECT_THAT(said([&] { gltf.read(options); }), HasSubstr("1000000 triangles, more than"));
    gltf.root["accessors"][0]["count"] = 0;  // of nothing
    EXPECT_THAT(said([&] { gltf.read(options); }), HasSubstr("2000000 readings of vertices"));
  }
  {
    GltfBuilder gltf;  // one vertex moved again and again
    Json& primitive = gltf.mesh(gltf.accessor(std::nullopt, "VEC3", 5126, 30'000));
    for (int t = 0; t < 5; ++t) primitive["targets"].push_back({{"POSITION", 0}});
    gltf.root["meshes"][0]["weights"] = {1, 1, 1, 1, 1};
    gltf.node({{"mesh", 0}});
    EXPECT_THAT(said([&] { gltf.read(options); }), HasSubstr("180002 readings of vertices"));
  }
}

TEST(GltfCases, InstancingBombIsRefused) {
  const std::string bytes = case_file("31-instancing-bomb/amp_mid.gltf");
  if (bytes.empty()) GTEST_SKIP() << "the cases are not there";
  const std::string what = said([&] { read_mesh(bytes, MeshFormat::gltf, "amp_mid.gltf"); });
  EXPECT_THAT(what,
              HasSubstr("amp_mid.gltf: unfolds to 196000000 triangles, more than the 10000000"));
}

TEST(GltfCases, SkinnedCubeIsWhereItsJointsAre) {
  const std::string bytes = case_file("09-gltf-skinned/skinned.glb");
  if (bytes.empty()) GTEST_SKIP() << "the cases are not there";
  const TriangleMesh mesh = read_mesh(bytes, MeshFormat::glb, "skinned.glb");
  EXPECT_DOUBLE_EQ(area_of(mesh), 24.0);
  for (const Vec3& p : mesh.positions()) EXPECT_EQ(p.cwiseAbs(), Vec3(1, 1, 1));
}

}  // namespace
}  // namespace mimicry
