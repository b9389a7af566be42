#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/io/mesh_reader.h>

namespace mimicry::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string error_of(std::string_view bytes, MeshFormat format) {
  try {
    read_mesh(bytes, format, "name");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ObjReader, PolygonsBecomeFansInFileOrderAndTheirNumberIsKept) {
  const TriangleMesh mesh = read_mesh(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 .5 0\n"
      "f 1 2 3\nf 1 2 3 4 5\nf 3 2 1\nf 4 3 2 1\n",
      MeshFormat::obj, "name");
  EXPECT_THAT(mesh.faces(), ElementsAre(Face{0, 1, 2}, Face{0, 1, 2}, Face{0, 2, 3}, Face{0, 3, 4},
                                        Face{2, 1, 0}, Face{3, 2, 1}, Face{3, 1, 0}));
  std::vector<Index> polygons;
  for (Index f = 0; f < mesh.face_count(); ++f) polygons.push_back(mesh.polygon(f));
  EXPECT_THAT(polygons, ElementsAre(0, 1, 1, 1, 2, 3, 3));
}

TEST(ObjReader, ReadsEveryFormOfItsStatements) {
  const TriangleMesh mesh = read_mesh(
      "# comment\r\nmtllib a.mtl\r\no thing\r\n"
      "v 0 0 0 1.0 0.5 0.25\r\n\tv  1 \\\r\n 0 0 # the second\r\nv 0 1 0 1\r\n"
      "vt 0 0\r\nvn 0 0 1\r\ng part\r\nusemtl red\r\ns off\r\n"
      "f 1/1/1 2//1 3/1\r\nf -3 -2 \\\r\n-1\r\nl 1 2\r\nf 1/ 4// 3\r\n"
      "v 5 5 5",
      MeshFormat::obj, "name");
  ASSERT_EQ(mesh.vertex_count(), 4);
  EXPECT_EQ(mesh.position(1), Vec3(1, 0, 0));
  EXPECT_EQ(mesh.position(3), Vec3(5, 5, 5));
  EXPECT_THAT(mesh.faces(), ElementsAre(Face{0, 1, 2}, Face{0, 1, 2}, Face{0, 3, 2}));
}

TEST(ObjReader, ErrorsTellTheLine) {
  const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto error = [&](const std::string& tail) {
    return error_of(head + tail, MeshFormat::obj);
  };
  EXPECT_THAT(error("f 1 2 4\n"), HasSubstr("name: line 4: the face refers to vertex 4"));
  EXPECT_THAT(error("f 1 2 0\n"), HasSubstr("line 4: the face refers to vertex 0"));
  EXPECT_THAT(error("f 1 2 -4\n"), HasSubstr("line 4: the face refers to vertex -4"));
  EXPECT_THAT(error("f 1 2 99999999999\n"), HasSubstr("refers to vertex 99999999999"));
  EXPECT_THAT(error("\nf 1 2 3x\n"), HasSubstr("line 5: '3x' is not a face's corner"));
  EXPECT_THAT(error("f 1 2 3/x\n"), HasSubstr("'3/x' is not a face's corner"));
  EXPECT_THAT(error("f 1 2\n"), HasSubstr("line 4: a face with 2 corners"));
  EXPECT_THAT(error("v 1 2\n"), HasSubstr("line 4: a vertex with 2 coordinates"));
  EXPECT_THAT(error("v 1 2 1,5\n"), HasSubstr("line 4: '1,5' is not a number"));
  EXPECT_THAT(error("v 1 \\\n 2 \\\n x\n"), HasSubstr("line 4: 'x' is not a number"));
  EXPECT_THAT(error(""), HasSubstr("name: holds no triangle or polygon (3 vertices)"));
}

TEST(MeshReader, EmptyFileIsRefusedInEveryFormat) {
  for (const MeshFormat format : {MeshFormat::obj, MeshFormat::ply, MeshFormat::stl,
                                  MeshFormat::off, MeshFormat::glb, MeshFormat::gltf})
    EXPECT_THAT(error_of("", format), HasSubstr("name: the file is empty"));
}

TEST(MeshReader, FormatIsToldByTheEnding) {
  EXPECT_EQ(mesh_format_of("a.b/c.OBJ"), MeshFormat::obj);
  EXPECT_EQ(mesh_format_of("x.gltf"), MeshFormat::gltf);
  EXPECT_THROW(mesh_format_of("x.blend"), Error);
  EXPECT_THROW(mesh_format_of("obj"), Error);
}

TEST(MeshReader, LimitsAreHeld) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3 4\n";
  EXPECT_NO_THROW(read_mesh(obj, MeshFormat::obj, "name", {4, 2}));
  EXPECT_THROW(read_mesh(obj, MeshFormat::obj, "name", {3, 2}), Error);
  EXPECT_THROW(read_mesh(obj, MeshFormat::obj, "name", {4, 1}), Error);
}

TEST(MeshReader, NanAndInfinityAreReadForTheValidationToReport) {
  const TriangleMesh mesh =
      read_mesh("v nan 0 0\nv 0 inf 0\nv 0 0 -1e999\nf 1 2 3\n", MeshFormat::obj, "name");
  EXPECT_TRUE(std::isnan(mesh.position(0)[0]));
  EXPECT_EQ(mesh.position(1)[1], kInfinity);
  EXPECT_EQ(mesh.position(2)[2], -kInfinity);
}

}  // namespace
}  // namespace mimicry::io
