#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_obj_loader.h>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>

namespace mimicry {
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
  EXPECT_THAT(error("f 1 x 3\n"), HasSubstr("line 4: 'x' is not a face's corner"));
  EXPECT_THAT(error("f 1 2\n"), HasSubstr("holds no triangle or polygon (3 vertices)"));
  EXPECT_THAT(error("v 1 2\n"), HasSubstr("line 4: a vertex with 2 coordinates"));
  EXPECT_THAT(error("v 1 2 1,5\n"), HasSubstr("line 4: '1,5' is not a number"));
  EXPECT_THAT(error("v 1 \\\n 2 \\\n x\n"), HasSubstr("line 4: 'x' is not a number"));
  EXPECT_THAT(error(""), HasSubstr("name: holds no triangle or polygon (3 vertices)"));
}

// tinyobjloader is the independent reader; it keeps no polygons here, as the study's shapes have
// none.
TEST(ObjReader, ReadsTheStudysShapesAsTinyobjloaderDoes) {
  for (const char* name : {"bunny", "cube", "fertility", "hand", "torus"}) {
    std::ifstream file(std::string(MIMICRY_STUDY_DATA "/") + name + ".obj", std::ios::binary);
    if (!file) GTEST_SKIP() << "no study data in " MIMICRY_STUDY_DATA;
    SCOPED_TRACE(name);
    std::stringstream stream;
    stream << file.rdbuf();
    const TriangleMesh mesh = read_mesh(stream.str(), MeshFormat::obj, name);
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    ASSERT_TRUE(
        tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, nullptr));
    ASSERT_EQ(attributes.vertices.size(), 3 * static_cast<std::size_t>(mesh.vertex_count()));
    // tinyobjloader's own number parser is not exact to the last bits.
    const double tolerance = 1e-14 * diagonal(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      ASSERT_LT((mesh.position(v) -
                 Eigen::Map<const Vec3>(&attributes.vertices[3 * static_cast<std::size_t>(v)]))
                    .norm(),
                tolerance)
          << v;
    std::vector<Face> faces;
    for (const tinyobj::shape_t& shape : shapes)
      for (std::size_t k = 0; k < shape.mesh.indices.size(); k += 3)
        faces.push_back({shape.mesh.indices[k].vertex_index, shape.mesh.indices[k + 1].vertex_index,
                         shape.mesh.indices[k + 2].vertex_index});
    EXPECT_TRUE(std::equal(faces.begin(), faces.end(), mesh.faces().begin(), mesh.faces().end()));
  }
}

const std::string kPlyHead =
    "comment made by hand\nobj_info nothing\nelement vertex 4\nproperty uchar red\n"
    "property float x\nproperty list uchar short extra\nproperty double y\nproperty short z\n"
    "element edge 1\nproperty int v\nelement face 2\nproperty uchar flag\n"
    "property list uchar uint vertex_index\nend_header\n";

void expect_ply_sample(const TriangleMesh& mesh) {
  EXPECT_THAT(mesh.positions(),
              ElementsAre(Vec3(0, 0, 0), Vec3(1.5, 0, 0), Vec3(1.5, 1e-300, -3), Vec3(0, 1, 2)));
  EXPECT_THAT(mesh.faces(), ElementsAre(Face{0, 1, 2}, Face{0, 1, 2}, Face{0, 2, 3}));
  EXPECT_EQ(mesh.polygon(2), 1);
}

TEST(PlyReader, PassesOverWhatIsNoPositionOrCorner) {
  expect_ply_sample(read_mesh("ply\nformat ascii 1.0\n" + kPlyHead +
                                  "255 0 0 0 0\n0 1.5 1 7 0 0\n0 1.5 2 7 8 1e-300 -3\n0 0 0 1 2\n"
                                  "5\n0 3 0 1 2\n0 4 0 1 2 3",
                              MeshFormat::ply, "name"));
}

TEST(PlyReader, ReadsEitherByteOrder) {
  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\n" + kPlyHead;
    const auto put = [&](auto value) {
      char raw[sizeof(value)];
      std::memcpy(raw, &value, sizeof(value));  // on a little-endian machine
      if (big) std::reverse(std::begin(raw), std::end(raw));
      bytes.append(raw, sizeof(value));
    };
    using Byte = std::uint8_t;
    const auto vertex = [&](float x, std::vector<std::int16_t> extra, double y, std::int16_t z) {
      put(Byte{9});
      put(x);
      put(static_cast<Byte>(extra.size()));
      for (const std::int16_t e : extra) put(e);
      put(y);
      put(z);
    };
    vertex(0.f, {}, 0.0, 0);
    vertex(1.5f, {7}, 0.0, 0);
    vertex(1.5f, {7, 8}, 1e-300, -3);
    vertex(0.f, {}, 1.0, 2);
    put(std::int32_t{5});
    for (const std::uint32_t corners : {3u, 4u}) {
      put(Byte{1});
      put(static_cast<Byte>(corners));
      for (std::uint32_t k = 0; k < corners; ++k) put(k);
    }
    expect_ply_sample(read_mesh(bytes, MeshFormat::ply, "name"));
    bytes.pop_back();
    EXPECT_THAT(error_of(bytes, MeshFormat::ply), HasSubstr("name: byte "));
  }
}

TEST(PlyReader, ErrorsTellThePlace) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n";
  const auto error = [&](const std::string& tail) {
    return error_of(head + tail, MeshFormat::ply);
  };
  EXPECT_THAT(error("3 0 1 2"), "no error");
  EXPECT_THAT(error("3 0 1 3"), HasSubstr("line 13: face 0 refers to vertex 3"));
  EXPECT_THAT(error("3 0 1 -1"), HasSubstr("line 13: face 0 refers to vertex -1"));
  EXPECT_THAT(error("3 0 1 x"), HasSubstr("line 13: 'x' is not a whole number"));
  EXPECT_THAT(error("2 0 1"), HasSubstr("holds no triangle or polygon (3 vertices)"));
  EXPECT_THAT(
      error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n", MeshFormat::ply),
      HasSubstr("line 4: 'quad' is no PLY type"));
  EXPECT_THAT(error_of("solid", MeshFormat::ply), HasSubstr("line 1: a PLY file begins with"));
}

TEST(StlReader, CornersAtTheSamePositionBecomeOneVertexInOrderOfFirstAppearance) {
  const std::string text =
      "solid a name\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"
      "endloop\nendfacet\nFACET NORMAL 0 0 1\n OUTER LOOP\n VERTEX 1.0 1.0e0 0\n VERTEX 0 1 0\n"
      "VERTEX -0 0 0\nENDLOOP\nENDFACET\nendsolid a name\n";
  const TriangleMesh mesh = read_mesh(text, MeshFormat::stl, "name");
  EXPECT_THAT(mesh.positions(),
              ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)));
  EXPECT_THAT(mesh.faces(), ElementsAre(Face{0, 1, 2}, Face{2, 3, 0}));
}

TEST(StlReader, BinaryFileThatBeginsWithSolidIsTakenForBinary) {
  std::string bytes = "solid, but binary";
  bytes.resize(84 + 50, '\0');
  bytes[80] = 1;
  const float corners[] = {0, 0, 0, 2, 0, 0, 0, 2, 0};
  std::memcpy(&bytes[96], corners, sizeof(corners));
  EXPECT_EQ(read_mesh(bytes, MeshFormat::stl, "name").position(1), Vec3(2, 0, 0));
}

TEST(StlReader, ErrorsTellThePlace) {
  EXPECT_THAT(error_of("solid\nfacet normal 0 0 1\nouter\nlop\n", MeshFormat::stl),
              HasSubstr("line 4: 'lop' where 'loop' should stand"));
  EXPECT_THAT(error_of("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 O\n", MeshFormat::stl),
              HasSubstr("line 4: 'O' is not a number, for a corner"));
  EXPECT_THAT(error_of("solid\nfacet normal 0 0 1", MeshFormat::stl), HasSubstr("no triangle"));
  EXPECT_THAT(error_of("short", MeshFormat::stl), HasSubstr("byte 5: the file ends within"));
}

TEST(OffReader, ReadsItsVariants) {
  const char* files[] = {
      "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
      "# first a comment\nOFF 4 2 # on the same line\n\n0 0 0 # origin\n1 0 0\n1 1 0\n0 1 0\n"
      "3 0 1 2 255 0 0\n\n3 0 2 3 0.5 0.5 0.5 1",
      "CNOFF\r\n4 1 0\r\n0 0 0 0 0 1 255 0 0\r\n1 0 0 0 0 1 1 1 1\r\n1 1 0 0 0 1 1 1 1\r\n"
      "0 1 0 0 0 1 1 1 1\r\n4 0 1 2 3\r\n"};
  for (const char* file : files) {
    const TriangleMesh mesh = read_mesh(file, MeshFormat::off, "name");
    EXPECT_THAT(mesh.positions(),
                ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)));
    EXPECT_THAT(mesh.faces(), ElementsAre(Face{0, 1, 2}, Face{0, 2, 3}));
  }
}

TEST(OffReader, ErrorsTellThePlace) {
  const auto error = [](const std::string& text) { return error_of(text, MeshFormat::off); };
  EXPECT_THAT(error("OOF\n"), HasSubstr("line 1: 'OOF' where 'OFF' should stand"));
  EXPECT_THAT(error("OFF BINARY\n"), HasSubstr("binary OFF is not handled"));
  EXPECT_THAT(error("nOFF\n4\n3 1 0\n"), HasSubstr("vertices of 4 coordinates are not handled"));
  EXPECT_THAT(error("OFF\nx 1 0\n"), HasSubstr("line 2: 'x' where the number of vertices"));
  EXPECT_THAT(error("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n"),
              HasSubstr("line 4: '' is not a number"));
  EXPECT_THAT(error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
              HasSubstr("line 6: the face refers to vertex 3"));
  EXPECT_THAT(error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\nx 0 1 2\n"),
              HasSubstr("line 6: a face of 'x' corners"));
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
  const auto read_within = [&](std::size_t vertices, std::size_t faces) {
    MeshReadOptions options;
    options.max_vertices = vertices;
    options.max_faces = faces;
    read_mesh(obj, MeshFormat::obj, "name", options);
  };
  EXPECT_NO_THROW(read_within(4, 2));
  EXPECT_THROW(read_within(3, 2), Error);
  EXPECT_THROW(read_within(4, 1), Error);
}

TEST(MeshReader, NanAndInfinityAreReadForTheValidationToReport) {
  const TriangleMesh mesh =
      read_mesh("v nan 0 0\nv 0 inf 0\nv 0 0 -1e999\nf 1 2 3\n", MeshFormat::obj, "name");
  EXPECT_TRUE(std::isnan(mesh.position(0)[0]));
  EXPECT_EQ(mesh.position(1)[1], kInfinity);
  EXPECT_EQ(mesh.position(2)[2], -kInfinity);
}

}  // namespace
}  // namespace mimicry
