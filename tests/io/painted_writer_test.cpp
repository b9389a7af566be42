#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>

namespace mimicry {
namespace {

using testing::HasSubstr;

TriangleMesh with_texcoords() {
  TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 3}});
  auto attributes = std::make_shared<MeshAttributes>();
  attributes->texcoords.values = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  attributes->texcoords.corners = {0, 1, 2, 2, 1, 3};
  attributes->materials = {{"wood"}, {0, 0}};
  mesh.set_attributes(attributes);
  return mesh;
}

TEST(PaintedMesh, GlbCarriesTheImageAsItIs) {
  std::string told;
  MeshWriteOptions options;
  options.texture_png = "not a real picture!";
  options.note = [&](const std::string& sentence) { told += sentence; };
  const std::string bytes = write_mesh(with_texcoords(), MeshFormat::glb, options);
  EXPECT_THAT(bytes, HasSubstr("\"baseColorTexture\":{\"index\":0}"));
  EXPECT_THAT(bytes, HasSubstr("\"mimeType\":\"image/png\""));
  EXPECT_THAT(bytes, HasSubstr("\"byteLength\":19"));
  EXPECT_THAT(bytes, HasSubstr("not a real picture!"));
  EXPECT_THAT(bytes, HasSubstr("NORMAL"));
  EXPECT_EQ(bytes.size() % 4, 0u);
  EXPECT_THAT(told, HasSubstr("one material, with the texture"));
  // Other readers' view of it, and ours: the same faces and coordinates.
  const TriangleMesh back = read_mesh(bytes, MeshFormat::glb, "back");
  EXPECT_EQ(back.face_count(), 2);
  EXPECT_EQ(back.attributes()->texcoords.interpolated(1, {0, 0, 1}), (std::array<float, 2>{1, 1}));
}

TEST(PaintedMesh, ATextureNeedsCoordinates) {
  MeshWriteOptions options;
  options.texture_png = "x";
  const TriangleMesh bare({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  try {
    write_mesh(bare, MeshFormat::glb, options);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("needs texture coordinates"));
  }
}

TEST(PaintedMesh, ObjHasOneMaterialOfTheFileBesideIt) {
  MeshWriteOptions options;
  options.material_file = "a b.mtl";
  const std::string text = write_mesh(with_texcoords(), MeshFormat::obj, options);
  EXPECT_THAT(text, testing::StartsWith("mtllib a b.mtl\n"));
  EXPECT_THAT(text, HasSubstr("\nusemtl paint\nf 1/1"));
  EXPECT_THAT(text, testing::Not(HasSubstr("wood")));
  EXPECT_EQ(write_mtl("a b.png"), "newmtl paint\nKd 1 1 1\nmap_Kd a b.png\n");
}

}  // namespace
}  // namespace mimicry
