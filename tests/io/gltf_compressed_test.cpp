#include <gmock/gmock.h>
#include <gtest/gtest.h>

#ifdef MIMICRY_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef MIMICRY_MESHOPT
#include <meshoptimizer.h>
#endif

#include "io/gltf_builder.h"
#include "io/mesh_fixtures.h"

namespace mimicry {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

#if defined(MIMICRY_DRACO) || defined(MIMICRY_MESHOPT)

/// The same triangles at the same places, whatever their and their vertices' order.
void expect_same_surface(const TriangleMesh& got, const TriangleMesh& wanted, double tolerance) {
  ASSERT_EQ(got.face_count(), wanted.face_count());
  Vec3 sum(0, 0, 0), wanted_sum(0, 0, 0);
  for (Index f = 0; f < got.face_count(); ++f) {
    sum += got.area_vector(f);
    wanted_sum += wanted.area_vector(f);
    double nearest = kInfinity;  // of a face with these corners, in any turn
    for (Index g = 0; g < wanted.face_count() && nearest > tolerance; ++g)
      for (int turn = 0; turn < 3; ++turn) {
        double off = 0.0;
        for (int k = 0; k < 3; ++k)
          off = std::max(off, (got.corner(f, k) - wanted.corner(g, (k + turn) % 3)).norm());
        nearest = std::min(nearest, off);
      }
    EXPECT_LE(nearest, tolerance) << f;
  }
  EXPECT_LT((sum - wanted_sum).norm(), 1e-2);
}

#endif

GltfBuilder grid_gltf(const TriangleMesh& grid, int& positions, int& indices) {
  GltfBuilder out;
  positions =
      out.accessor(std::nullopt, "VEC3", 5126, static_cast<std::size_t>(grid.vertex_count()));
  indices =
      out.accessor(std::nullopt, "SCALAR", 5125, 3 * static_cast<std::size_t>(grid.face_count()));
  out.mesh(positions, indices);
  out.node({{"mesh", 0}});
  return out;
}

#ifdef MIMICRY_DRACO

std::string draco_bytes(const TriangleMesh& mesh, bool edgebreaker, int* points) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(mesh.face_count());
  const int attribute =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int texcoord =
      builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    std::array<draco::Vector3f, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh.corner(f, k);
      corners[static_cast<std::size_t>(k)] = draco::Vector3f(
          static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
    }
    builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(static_cast<std::uint32_t>(f)),
                                      corners[0].data(), corners[1].data(), corners[2].data());
    const std::array<draco::Vector2f, 3> uv = {draco::Vector2f(corners[0][0], corners[0][1]),
                                               draco::Vector2f(corners[1][0], corners[1][1]),
                                               draco::Vector2f(corners[2][0], corners[2][1])};
    builder.SetAttributeValuesForFace(texcoord, draco::FaceIndex(static_cast<std::uint32_t>(f)),
                                      uv[0].data(), uv[1].data(), uv[2].data());
  }
  const auto built = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING
                                        : draco::MESH_SEQUENTIAL_ENCODING);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*built, &buffer).ok());
  *points = static_cast<int>(encoder.num_encoded_points());
  return {buffer.data(), buffer.size()};
}

GltfBuilder draco_gltf(const TriangleMesh& grid, bool edgebreaker) {
  int positions, indices, points;
  GltfBuilder gltf = grid_gltf(grid, positions, indices);
  const std::string bytes = draco_bytes(grid, edgebreaker, &points);
  if (points == 0) points = grid.vertex_count();
  gltf.root["accessors"][positions]["count"] = points;
  gltf.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  gltf.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", gltf.view(bytes.data(), bytes.size())}, {"attributes", {{"POSITION", 0}}}};
  return gltf;
}

TEST(GltfDraco, CompressedTrianglesAreRead) {
  const TriangleMesh grid = rough_grid(12, 1, true);
  for (const bool edgebreaker : {true, false}) {
    const TriangleMesh got = draco_gltf(grid, edgebreaker).read();
    // 14 bits over 11 units: a step is 7e-4.
    expect_same_surface(got, grid, 1e-3);
    EXPECT_EQ(got.vertex_count(), grid.vertex_count());
  }
}

TEST(GltfDraco, CompressedTexcoordsAreKept) {
  GltfBuilder gltf = draco_gltf(rough_grid(12, 1, true), true);
  auto& primitive = gltf.root["meshes"][0]["primitives"][0];
  const int texcoords =
      gltf.accessor(std::nullopt, "VEC2", 5126, gltf.root["accessors"][0]["count"]);
  primitive["attributes"]["TEXCOORD_0"] = texcoords;
  auto& names = primitive["extensions"]["KHR_draco_mesh_compression"]["attributes"];
  names["TEXCOORD_0"] = 1;
  const TriangleMesh mesh = gltf.read();
  ASSERT_TRUE(mesh.attributes());
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto* uv = mesh.attributes()->texcoords.at_corner(f, k);
      ASSERT_NE(uv, nullptr);
      EXPECT_NEAR((*uv)[0], mesh.corner(f, k).x(), 1e-3);
      EXPECT_NEAR(1.0f - (*uv)[1], mesh.corner(f, k).y(), 1e-3);
    }
  names["TEXCOORD_0"] = 7;  // which there is not
  EXPECT_EQ(gltf.read().attributes(), nullptr);
  EXPECT_EQ(gltf.read().face_count(), mesh.face_count());
}

TEST(GltfDraco, DamagedFormsAreRefused) {
  const GltfBuilder gltf = draco_gltf(rough_grid(6, 1, true), true);
  EXPECT_EQ(said([&] { gltf.read(); }), "");
  for (std::size_t k = 0; k < gltf.data.size(); ++k)
    for (const int bit : {0, 3, 7}) {
      GltfBuilder damaged = gltf;
      damaged.data[k] = static_cast<char>(damaged.data[k] ^ 1 << bit);
      said([&] { damaged.read(); });  // an Error or a mesh
    }
  GltfBuilder cut = gltf;
  cut.root["bufferViews"][0]["byteLength"] = 20;
  EXPECT_THAT(said([&] { cut.read(); }),
              HasSubstr("mesh 0 primitive 0: cannot be decompressed (Draco)"));
  GltfBuilder other = gltf;
  other.root["accessors"][0]["count"] = 35;
  EXPECT_THAT(said([&] { other.read(); }), HasSubstr("holds 36 vertices and not the 35"));
  other = gltf;
  other.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]
            ["POSITION"] = 3;
  EXPECT_THAT(said([&] { other.read(); }), HasSubstr("has no attribute 3"));
}

TEST(GltfDraco, WhatItAnnouncesIsCountedBeforeItIsDecoded) {
  MeshReadOptions options;
  options.max_faces = 241;
  EXPECT_THAT(said([&] { draco_gltf(rough_grid(12, 1, true), true).read(options); }),
              HasSubstr("unfolds to 242 triangles"));
}

#else

TEST(GltfDraco, IsNamedWhereItIsMissing) {
  int positions, indices;
  GltfBuilder gltf = grid_gltf(rough_grid(3, 1, true), positions, indices);
  gltf.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  gltf.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  EXPECT_THAT(said([&] { gltf.read(); }), HasSubstr("libdraco-dev"));
}

#endif

#ifdef MIMICRY_MESHOPT

struct Meshopt {
  GltfBuilder gltf;
  void compress(int accessor, const std::string& bytes, std::size_t count, std::size_t stride,
                const char* mode, const char* filter, const char* name) {
    const int view = gltf.view(bytes.data(), bytes.size());
    Json& json = gltf.root["bufferViews"][view];
    json["extensions"][name] = json;
    json["extensions"][name].update(Json{{"count", count}, {"byteStride", stride}, {"mode", mode}});
    if (filter) json["extensions"][name]["filter"] = filter;
    json["buffer"] = 1;
    json["byteOffset"] = 0;
    json["byteLength"] = count * stride;
    gltf.root["accessors"][accessor]["bufferView"] = view;
  }
};

std::string encode_vertices(const void* values, std::size_t count, std::size_t stride) {
  std::string out(meshopt_encodeVertexBufferBound(count, stride), '\0');
  out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                        values, count, stride));
  return out;
}

Meshopt meshopt_grid(const TriangleMesh& grid, bool sequence,
                     const char* name = "EXT_meshopt_compression") {
  int positions, indices;
  Meshopt out{grid_gltf(grid, positions, indices)};
  std::vector<float> values;
  for (const Vec3& p : grid.positions())
    for (const double x : p) values.push_back(static_cast<float>(x));
  std::vector<unsigned> corners;
  for (const Face& face : grid.faces())
    for (const Index v : face) corners.push_back(static_cast<unsigned>(v));
  const auto count = static_cast<std::size_t>(grid.vertex_count());
  std::string packed(sequence ? meshopt_encodeIndexSequenceBound(corners.size(), count)
                              : meshopt_encodeIndexBufferBound(corners.size(), count),
                     '\0');
  auto* to = reinterpret_cast<unsigned char*>(packed.data());
  packed.resize(sequence
                    ? meshopt_encodeIndexSequence(to, packed.size(), corners.data(), corners.size())
                    : meshopt_encodeIndexBuffer(to, packed.size(), corners.data(), corners.size()));
  out.compress(positions, encode_vertices(values.data(), count, 12), count, 12, "ATTRIBUTES",
               nullptr, name);
  out.compress(indices, packed, corners.size(), 4, sequence ? "INDICES" : "TRIANGLES", nullptr,
               name);
  out.gltf.root["extensionsRequired"] = {name};
  out.gltf.root["buffers"] = {
      {{"byteLength", out.gltf.data.size()}},
      {{"byteLength", 100'000}, {"extensions", {{name, {{"fallback", true}}}}}}};
  return out;
}

TEST(GltfMeshopt, CompressedViewsAreRead) {
  const TriangleMesh grid = rough_grid(12, 1, true);
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    for (const bool sequence : {false, true}) {
      const TriangleMesh got = meshopt_grid(grid, sequence, name).gltf.read();
      EXPECT_THAT(got.positions(), testing::ElementsAreArray(grid.positions()));
      expect_same_surface(got, grid, 0.0);
    }
}

TEST(GltfMeshopt, FiltersAreUndone) {
  Meshopt out;
  const std::vector<float> values = {0.f, 0.f, 0.f, 1.5f, 0.f, 0.f, 0.f, 2.f, 0.f};
  std::vector<unsigned> encoded(9);
  for (std::size_t k = 0; k < 9; ++k)  // 2^-4 times a whole number
    encoded[k] = static_cast<unsigned>(values[k] * 16.f) | 0xfcu << 24;
  const int positions = out.gltf.accessor(std::nullopt, "VEC3", 5126, 3);
  out.gltf.mesh(positions);
  out.gltf.node({{"mesh", 0}});
  out.compress(positions, encode_vertices(encoded.data(), 3, 12), 3, 12, "ATTRIBUTES",
               "EXPONENTIAL", "EXT_meshopt_compression");
  EXPECT_THAT(out.gltf.read().positions(),
              testing::ElementsAre(Vec3(0, 0, 0), Vec3(1.5, 0, 0), Vec3(0, 2, 0)));
}

TEST(GltfMeshopt, DamagedFormsAreRefused) {
  const Meshopt good = meshopt_grid(rough_grid(6, 1, true), false);
  EXPECT_EQ(said([&] { good.gltf.read(); }), "");
  for (std::size_t k = 0; k < good.gltf.data.size(); ++k)
    for (const int bit : {0, 3, 7}) {
      GltfBuilder damaged = good.gltf;
      damaged.data[k] = static_cast<char>(damaged.data[k] ^ 1 << bit);
      said([&] { damaged.read(); });
    }
  const auto broken = [&](const char* key, const Json& value) {
    GltfBuilder gltf = good.gltf;
    gltf.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
    return said([&] { gltf.read(); });
  };
  EXPECT_THAT(broken("count", 1'000'000'000), HasSubstr("promises 1000000000 elements of"));
  EXPECT_THAT(broken("byteStride", 3), HasSubstr("bufferView 0: 'byteStride' or 'count' is none"));
  EXPECT_THAT(broken("byteStride", 0), HasSubstr("'byteStride' or 'count' is none"));
  EXPECT_THAT(broken("mode", "OTHER"), HasSubstr("unknown mode 'OTHER'"));
  EXPECT_THAT(broken("filter", "OTHER"), HasSubstr("filtered by 'OTHER'"));
  EXPECT_THAT(broken("byteLength", 9), HasSubstr("bufferView 0"));
}

#else

TEST(GltfMeshopt, IsNamedWhereItIsMissing) {
  GltfBuilder gltf = cube_gltf();
  gltf.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = Json::object();
  gltf.root["bufferViews"][0]["buffer"] = 1;
  gltf.root["buffers"] = {{{"byteLength", 200}}, {{"byteLength", 200}}};
  EXPECT_THAT(said([&] { gltf.read(); }), HasSubstr("libmeshoptimizer-dev"));
}

#endif

}  // namespace
}  // namespace mimicry
