// Files as other programs write them: what they say beside the triangles, and the ways in which
// they differ from what their format's description says.

#include <cstring>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>
#include <mimicry/io/strokes.h>
#include <mimicry/io/study.h>

#include "io/csv.h"
#include "io/mesh_fixtures.h"

namespace mimicry {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Outcome {
  TriangleMesh mesh;
  std::vector<std::string> notes;
  std::string error;
};

Outcome read(const std::string& bytes, MeshFormat format) {
  Outcome outcome;
  MeshReadOptions options;
  options.note = [&](const std::string& sentence) { outcome.notes.push_back(sentence); };
  try {
    outcome.mesh = read_mesh(bytes, format, "name", options);
  } catch (const Error& error) {
    outcome.error = error.what();
  }
  return outcome;
}

const std::string kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kTriangleStl =
    "solid name\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    "endloop\nendfacet\nendsolid\n";
const std::string kTriangleOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kTrianglePly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

struct Text {
  MeshFormat format;
  std::string text;
};

std::vector<Text> triangles() {
  return {{MeshFormat::obj, kTriangleObj},
          {MeshFormat::stl, kTriangleStl},
          {MeshFormat::off, kTriangleOff},
          {MeshFormat::ply, kTrianglePly}};
}

void expect_triangle(const Outcome& outcome) {
  EXPECT_EQ(outcome.error, "");
  EXPECT_THAT(outcome.mesh.positions(), ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)));
  EXPECT_THAT(outcome.mesh.faces(), ElementsAre(Face{0, 1, 2}));
}

std::string with_line_ends(const std::string& text, const std::function<std::string(int)>& end) {
  std::string out;
  int line = 0;
  for (const char c : text) out += c == '\n' ? end(line++) : std::string(1, c);
  return out;
}

TEST(TextEncoding, Utf8MarkIsPassedOverInEveryMeshFormat) {
  for (const Text& file : triangles())
    expect_triangle(read("\xEF\xBB\xBF" + file.text, file.format));
}

TEST(TextEncoding, Utf16AndUtf32AreNamedWithTheRemedy) {
  for (const Text& file : triangles()) {
    for (const std::size_t width : {2u, 4u})
      for (const bool big : {false, true})
        for (const bool mark : {false, true}) {
          std::string bytes;
          const auto put = [&](unsigned code) {
            std::string character(width, '\0');
            for (std::size_t k = 0; k < 2; ++k)
              character[big ? width - 1 - k : k] = static_cast<char>(code >> (8 * k) & 0xff);
            bytes += character;
          };
          if (mark) put(0xFEFF);
          for (const char c : file.text) put(static_cast<unsigned char>(c));
          const std::string error = read(bytes, file.format).error;
          EXPECT_THAT(error, HasSubstr(width == 2 ? "name: is text in UTF-16" : "UTF-32"));
          EXPECT_THAT(error, HasSubstr("save it as UTF-8"));
        }
  }
  EXPECT_THAT(read(std::string("\xFF\xFE{\0}\0", 6), MeshFormat::gltf).error, HasSubstr("UTF-16"));
}

TEST(TextEncoding, TablesAndJsonAreTheSame) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(read_points_csv(mark + "x,y,z\r1,2,3\r", "p.csv").points.at(0), Vec3(1, 2, 3));
  EXPECT_TRUE(read_targets(mark + "{\"shapes\":[]}", "t.json").shapes.empty());
  for (const auto& read_wide : std::vector<std::function<void(const std::string&)>>{
           [](const std::string& text) { read_csv(text, "name"); },
           [](const std::string& text) { read_targets(text, "name"); }}) {
    try {
      read_wide(std::string("\xFF\xFEx\0,\0y\0\n\0", 10));
      FAIL();
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("name: is text in UTF-16"));
    }
  }
}

TEST(LineEnds, OfEveryKindAndMixedAreRead) {
  for (const Text& file : triangles()) {
    expect_triangle(read(with_line_ends(file.text, [](int) { return "\r"; }), file.format));
    expect_triangle(read(with_line_ends(file.text, [](int) { return "\r\n"; }), file.format));
    const char* kinds[] = {"\n", "\r\n", "\r"};
    expect_triangle(
        read(with_line_ends(file.text, [&](int line) { return kinds[line % 3]; }), file.format));
  }
}

TEST(LineEnds, AreCountedAlike) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const auto bad = [&](const std::string& text) {
      return with_line_ends(text, [&](int) { return end; });
    };
    EXPECT_THAT(read(bad("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), MeshFormat::obj).error,
                HasSubstr("line 4:"));
    EXPECT_THAT(
        read(bad("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 O\n "), MeshFormat::stl).error,
        HasSubstr("line 4:"));
  }
}

TEST(LineEnds, BinaryPlyBehindAHeaderInAnyLineEnds) {
  const TriangleMesh mesh = tetrahedron();
  const std::string bytes = write_mesh(mesh, MeshFormat::ply);
  const std::size_t body = bytes.find("end_header\n") + 11;
  for (const char* end : {"\r", "\r\n"}) {
    std::string file =
        with_line_ends(bytes.substr(0, body), [&](int) { return end; }) + bytes.substr(body);
    // The body may begin with a line feed.
    file[file.size() - (bytes.size() - body)] = '\n';
    const Outcome outcome = read(file, MeshFormat::ply);
    EXPECT_EQ(outcome.error, "");
    EXPECT_EQ(outcome.mesh.face_count(), mesh.face_count());
    EXPECT_EQ(outcome.mesh.position(1), mesh.position(1));
  }
}

TEST(ObjDialects, WhatIsPassedOverNeedNotParse) {
  expect_triangle(
      read("v 0 0 0 -nan(ind) 1.#QNAN x\nv 1 0 0 # 1\nv 0 1 0 0.5\nvn -nan(ind) -nan(ind) x\n"
           "vt 1.#QNAN 0\nvt\nf 1/x/1 2//-nan 3/1/1/1\n",
           MeshFormat::obj));
}

TEST(ObjDialects, TextBehindAFaceIsPassedOverAndNoted) {
  const Outcome outcome =
      read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 material=red 7\n", MeshFormat::obj);
  expect_triangle(outcome);
  EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("first: line 4")));
}

TEST(ObjDialects, VertexThatCannotBeReadIsRefusedWhereAFaceUsesIt) {
  const Outcome outcome =
      read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 3.1+e2 0 0\nv 1 2\nf 1 2 3\n", MeshFormat::obj);
  EXPECT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.mesh.vertex_count(), 5);
  EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("2 vertices without readable coordinates")));
  EXPECT_THAT(read("v 0 0 0\nv 1 0 0\nv 0 1,5 0\nf 1 2 3\n", MeshFormat::obj).error,
              HasSubstr("line 3: '1,5' is not a number"));
}

TEST(ObjDialects, BackslashInANameOrACommentJoinsNoLines) {
  expect_triangle(
      read("# C:\\models\\\nv 0 0 0\nmtllib C:\\models\\\nv 1 0 0\nv 0 \\ \n 1 0\nf 1 \\\n\\\n2 3",
           MeshFormat::obj));
}

TEST(ObjDialects, FacesMayStandBeforeTheirVertices) {
  const Outcome outcome = read(
      "f 1 2 3 4 5 6\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\n", MeshFormat::obj);
  EXPECT_EQ(outcome.mesh.face_count(), 4);
  EXPECT_DOUBLE_EQ(total_area(outcome.mesh), 3.0);
}

TEST(PlyDialects, WhatIsPassedOverNeedNotParse) {
  expect_triangle(
      read("ply\nformat ascii 1.0\nwritten_by somebody\nelement vertex 3\nproperty float nx\n"
           "property float x\nproperty float y\nproperty float z\nproperty list uchar float more\n"
           "element face 1\nproperty list uchar int vertex_index\n"
           "property list uchar float texcoord\nend_header\n"
           "-nan(ind) 0 0 0 0\n1.#QNAN 1 0 0 1 x\n? 0 1 0 2 a b\n3 0 1 2 2 -nan(ind) -\n",
           MeshFormat::ply));
}

TEST(PlyDialects, UnknownHeaderLinesAreNoted) {
  std::string text = kTrianglePly;
  text.insert(text.find("element"), "version 3\n\nwhatever\n");
  const Outcome outcome = read(text, MeshFormat::ply);
  expect_triangle(outcome);
  EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("2 lines of the header")));
  EXPECT_THAT(outcome.notes[0], HasSubstr("'version' in line 3"));
}

TEST(PlyDialects, TriangleStrips) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 2\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n"
      "12 0 1 2 3 -1 2 3 4 5 5 -1 0\n4 4 -1 0 -1\n";
  const Outcome outcome = read(text, MeshFormat::ply);
  EXPECT_EQ(outcome.error, "");
  EXPECT_THAT(outcome.mesh.faces(),
              ElementsAre(Face{0, 1, 2}, Face{2, 1, 3}, Face{2, 3, 4}, Face{4, 3, 5}));
  for (Index f = 0; f < outcome.mesh.face_count(); ++f)
    EXPECT_EQ(outcome.mesh.area_vector(f), Vec3(0, 0, 1)) << f;
}

TEST(PlyDialects, ElementsInAnyOrder) {
  const Outcome outcome = read(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
      "element vertex 4\nproperty float z\nproperty float y\nproperty float x\nend_header\n"
      "4 0 3 2 1\n0 -1 -1\n0 2 0\n0 -1 1\n0 0 0\n",
      MeshFormat::ply);
  EXPECT_EQ(outcome.mesh.face_count(), 2);
  EXPECT_DOUBLE_EQ(total_area(outcome.mesh), 2.0);
}

// A cube of 8 vertices and 12 faces in each of the ways.
std::string cube_off(const std::string& head, const std::string& between,
                     const std::string& after_vertex = "", const std::string& after_face = "") {
  std::string text = head;
  for (int v = 0; v < 8; ++v)
    text += std::to_string(v & 1) + between + std::to_string(v >> 1 & 1) + between +
            std::to_string(v >> 2) + after_vertex + "\n";
  for (const char* face : {"0 2 1", "1 2 3", "4 5 6", "5 7 6", "0 1 4", "1 5 4", "2 6 3", "3 6 7",
                           "0 4 2", "2 4 6", "1 3 5", "3 7 5"}) {
    std::string line = std::string("3 ") + face + after_face;
    for (char& c : line)
      if (c == ' ' && between == "\n") c = '\n';
    text += line + "\n";
  }
  return text;
}

void expect_cube(const std::string& text) {
  const Outcome outcome = read(text, MeshFormat::off);
  ASSERT_EQ(outcome.error, "") << text.substr(0, 60);
  EXPECT_EQ(outcome.mesh.vertex_count(), 8);
  EXPECT_EQ(outcome.mesh.face_count(), 12);
  EXPECT_DOUBLE_EQ(total_area(outcome.mesh), 6.0) << text.substr(0, 60);
  EXPECT_EQ(outcome.mesh.position(5), Vec3(1, 0, 1));
}

TEST(OffDialects, Headers) {
  for (const char* head :
       {"OFF\n8 12 18\n", "OFF8 12 18\n", "off\n8 12\n", "8 12 18\n", "  \tOFF 8 12 18 # or not\n",
        "Off 8 12\n", "OFF\n8\n12\n18\n", "8 12\n", "OFF # a cube\n#\n\n8 12 0 # counts\n"})
    for (const char* between : {" ", "\n", "\t"}) expect_cube(cube_off(head, between));
}

TEST(OffDialects, ColoursNormalsAndTextureCoordinates) {
  expect_cube(cube_off("OFF\n8 12 0\n", " ", "", " 255 0 0 255"));
  expect_cube(cube_off("OFF\n8 12 0\n", " ", " 0.1 0.2 0.3"));
  expect_cube(cube_off("COFF\n8 12 0\n", " ", " 255 0 0 255", " 1"));
  expect_cube(cube_off("coff 8 12 0\n", " ", " 255 0 0 255"));
  expect_cube(cube_off("NOFF\n8 12 0\n", " ", " 0 0 -nan(ind)"));
  expect_cube(cube_off("noff\n8 12 0\n", "\n", "\n0\n0\n1"));
  expect_cube(cube_off("STOFF\n8 12 0\n", "\n", " 0.5 0.5"));
  expect_cube(cube_off("STCNOFF\n8 12 0\n", "\n", " 0 0 1 1 1 1 1 0.5 0.5"));
  expect_cube(cube_off("nOFF\n3\n8 12 0\n", " "));
  // Words anywhere, but a face's colour on its line.
  std::string coloured = cube_off("OFF\n8 12 18\n", "\n");
  const std::size_t faces = coloured.find("3\n0\n2\n1\n");
  std::string lines = coloured.substr(faces);
  for (std::size_t at = 0, n = 0; (at = lines.find('\n', at)) != std::string::npos; ++n)
    if (n % 4 != 3)
      lines[at] = ' ';
    else
      lines.insert(at, " 0.5 0.5 0.5"), at += 13;
  expect_cube(coloured.substr(0, faces) + lines);
}

TEST(OffDialects, HomogeneousVerticesAreDivided) {
  const Outcome outcome =
      read("4OFF\n3 1 0\n0 0 0 2\n2 0 0 2\n0 -3 0 -3\n3 0 1 2\n", MeshFormat::off);
  expect_triangle(outcome);
}

TEST(OffDialects, OneLine) {
  std::string text = cube_off("OFF\n8 12 18\n", " ");
  for (char& c : text)
    if (c == '\n') c = ' ';
  expect_cube(text);
  const Outcome outcome = read(text, MeshFormat::off);
  EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("word by word")));
}

TEST(OffDialects, FacesOfOneOrTwoCornersAreLeftOut) {
  const Outcome outcome =
      read("OFF\n3 4 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n1 2\n3 0 1 2\n0\n", MeshFormat::off);
  expect_triangle(outcome);
  EXPECT_EQ(outcome.mesh.polygon(0), 2);
  EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("3 faces")));
}

// Word by word, the coordinates of all vertices behind it would be others'.
TEST(OffDialects, VertexThatLacksACoordinateIsNotMadeUpFor) {
  for (const char* counts : {"4 2 0", "4 2"})
    for (const char* faces : {"3 0 1 2\n3 0 2 3\n", "4 3 0 1 2\n4 0 1 2 3\n", "3 1 2 3\n3 2 3 0\n"})
      EXPECT_THAT(read(std::string("OFF\n") + counts + "\n0 0 0\n1 0\n1 1 0\n0 1 0\n" + faces,
                       MeshFormat::off)
                      .error,
                  HasSubstr("line 4: '' is not a number"))
          << counts << " " << faces;
}

std::string binary_stl(const std::string& head, std::uint32_t count, std::size_t triangles) {
  std::string bytes = head;
  bytes.resize(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t f = 0; f < triangles; ++f) {
    const auto z = static_cast<float>(f);
    const float numbers[] = {0, 0, 1, 0, 0, z, 1, 0, z, 0, 1, z};
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof(numbers)).append(2, '\0');
  }
  return bytes;
}

TEST(StlDialects, BinaryThatBeginsWithSolid) {
  for (const char* head : {"solid", "solid made by a program\n", "SOLID x facet normal"}) {
    const std::string bytes = binary_stl(head, 3, 3);
    EXPECT_EQ(read(bytes, MeshFormat::stl).mesh.face_count(), 3) << head;
    for (const std::string& more : {std::string("\n"), std::string(80, '\0')}) {
      const Outcome outcome = read(bytes + more, MeshFormat::stl);
      EXPECT_EQ(outcome.error, "");
      EXPECT_EQ(outcome.mesh.face_count(), 3) << head;
      EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("more follows")));
    }
  }
}

TEST(StlDialects, CountThatWasNeverWrittenIsTakenFromTheSize) {
  for (const char* head : {"", "solid"})
    for (const std::uint32_t count : {0u, 0xffffffffu, 7u}) {
      const Outcome outcome = read(binary_stl(head, count, 5), MeshFormat::stl);
      EXPECT_EQ(outcome.error, "") << count;
      EXPECT_EQ(outcome.mesh.face_count(), 5) << count;
      EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("but the file holds 5"))) << count;
    }
  EXPECT_THAT(read(binary_stl("", 0, 0), MeshFormat::stl).error, HasSubstr("no triangle"));
}

TEST(StlDialects, LastTriangleThatIsCutShortIsNoted) {
  const std::string bytes = binary_stl("", 3, 3);
  for (std::size_t lacks = 1; lacks < 50; ++lacks) {
    const Outcome outcome = read(bytes.substr(0, bytes.size() - lacks), MeshFormat::stl);
    EXPECT_EQ(outcome.mesh.face_count(), lacks <= 2 ? 3 : 2) << lacks;
    EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("last triangle"))) << lacks;
  }
  EXPECT_THAT(read(bytes.substr(0, bytes.size() - 60), MeshFormat::stl).error,
              HasSubstr("the file ends after 1; it is cut short"));
  const std::string two = kTriangleStl.substr(0, kTriangleStl.find("endsolid")) +
                          kTriangleStl.substr(kTriangleStl.find("facet"));
  const std::size_t second = two.rfind("facet normal");
  for (std::size_t size = second; size < two.size() - 1; ++size) {
    const Outcome outcome = read(two.substr(0, size), MeshFormat::stl);
    EXPECT_EQ(outcome.error, "") << two.substr(0, size);
    EXPECT_GE(outcome.mesh.face_count(), 1);
    EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("the file ends"))) << two.substr(second, size);
  }
}

TEST(StlDialects, NormalsNeedNotParseAndSolidsMayBeEmpty) {
  std::string text = "solid empty\nendsolid empty\n" + kTriangleStl + "solid\nendsolid\n";
  text.replace(text.find("0 0 1"), 5, "-nan(ind) -nan(ind) -1.#IND");
  expect_triangle(read(text, MeshFormat::stl));
  text.replace(text.find("normal -nan(ind) -nan(ind) -1.#IND"), 34, "");
  expect_triangle(read(text, MeshFormat::stl));
}

// What other readers give for files that other people's programs wrote.
TEST(RecordedCases, AreReadAsOtherReadersDo) {
  struct Case {
    const char* path;
    Index vertices, faces;
    double area;  // < 0: not known
  };
  const Case cases[] = {{"07-concave-polygons/L.obj", 6, 4, 3.0},
                        {"07-concave-polygons/concave_arrow.off", 4, 2, 2.0},
                        {"07-concave-polygons/concave_arrow.ply", 4, 2, 2.0},
                        {"08-byte-order-mark/bom.obj", 8, 12, 24.0},
                        {"08-byte-order-mark/bom.off", 8, 12, 24.0},
                        {"08-byte-order-mark/bom.ply", 8, 12, 24.0},
                        {"08-byte-order-mark/bom.stl", 8, 12, 24.0},
                        {"08-byte-order-mark/silent.obj", 5, 2, 1.0},
                        {"16-off-dialects/broken_lines.off", 8, 12, 24.0},
                        {"16-off-dialects/glued.off", 8, 12, 24.0},
                        {"16-off-dialects/lower.off", 8, 12, 24.0},
                        {"16-off-dialects/no_keyword.off", 8, 12, 24.0},
                        {"16-off-dialects/one_line.off", 8, 12, 24.0},
                        {"21-repeated-corners/polygon_first_again.obj", 4, 2, 1.0},
                        {"21-repeated-corners/sphere_two_degenerate.obj", -1, 2210, -1.0}};
  for (const Case& c : cases) {
    std::ifstream file(std::string(MIMICRY_CASES "/") + c.path, std::ios::binary);
    if (!file) GTEST_SKIP() << "no cases in " MIMICRY_CASES;
    std::stringstream bytes;
    bytes << file.rdbuf();
    const Outcome outcome = read(bytes.str(), mesh_format_of(c.path));
    EXPECT_EQ(outcome.error, "") << c.path;
    if (c.vertices >= 0) {
      EXPECT_EQ(outcome.mesh.vertex_count(), c.vertices) << c.path;
    }
    EXPECT_EQ(outcome.mesh.face_count(), c.faces) << c.path;
    if (c.area >= 0.0) {
      EXPECT_NEAR(total_area(outcome.mesh), c.area, 1e-12) << c.path;
    }
  }
}

}  // namespace
}  // namespace mimicry
