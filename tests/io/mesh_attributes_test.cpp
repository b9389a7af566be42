#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/io/meshes.h>
#include <mimicry/mesh/connect.h>

#include "io/gltf_builder.h"
#include "io/mesh_fixtures.h"

namespace mimicry {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Texcoord = std::array<float, 2>;
using Color = std::array<float, 4>;

struct Carried {
  TriangleMesh mesh;
  std::vector<std::string> notes;

  const MeshAttributes& attributes() const {
    static const MeshAttributes none;
    return mesh.attributes() ? *mesh.attributes() : none;
  }
};

Carried read_carried(const std::string& bytes, MeshFormat format) {
  Carried out;
  MeshReadOptions options;
  options.note = [&](const std::string& note) { out.notes.push_back(note); };
  out.mesh = read_mesh(bytes, format, "name", options);
  return out;
}

template <std::size_t N>
std::vector<std::array<float, N>> at_corners(const CornerValues<N>& values, Index faces) {
  std::vector<std::array<float, N>> out;
  for (Index f = 0; f < faces; ++f)
    for (int k = 0; k < 3; ++k) {
      const auto* value = values.at_corner(f, k);
      std::array<float, N> none;
      none.fill(-1.0f);
      out.push_back(value ? *value : none);
    }
  return out;
}

std::vector<std::string> of_faces(const FaceLabels& labels) {
  std::vector<std::string> out;
  for (const Index n : labels.of_face) out.push_back(n == kNone ? "-" : labels.names[at(n)]);
  return out;
}

// The same for those who look at corners and faces, however values are numbered.
void expect_same_attributes(const TriangleMesh& got, const TriangleMesh& wanted,
                            float tolerance = 0.0f) {
  ASSERT_EQ(got.face_count(), wanted.face_count());
  ASSERT_TRUE(got.attributes() && wanted.attributes());
  const MeshAttributes &g = *got.attributes(), &w = *wanted.attributes();
  const auto uv = at_corners(g.texcoords, got.face_count());
  const auto wanted_uv = at_corners(w.texcoords, got.face_count());
  for (std::size_t c = 0; c < uv.size(); ++c)
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(uv[c][k], wanted_uv[c][k], tolerance) << c;
  EXPECT_EQ(at_corners(g.colors, got.face_count()), at_corners(w.colors, got.face_count()));
  EXPECT_EQ(of_faces(g.groups), of_faces(w.groups));
  EXPECT_EQ(of_faces(g.materials), of_faces(w.materials));
  EXPECT_EQ(of_faces(g.objects), of_faces(w.objects));
}

/// A tetrahedron with a seam in its texture coordinates, colours by vertex (bytes: as bytes hold
/// them) and names.
TriangleMesh painted(bool bytes) {
  TriangleMesh mesh = tetrahedron();
  MeshAttributes a;
  a.texcoords.values = {{0.1f, 0.25f}, {0.75f, 0.3f}, {1.0f, 1.0f}, {-2.5f, 1e-3f}, {0.5f, 0.125f}};
  a.texcoords.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 4, 0, 3};
  const auto byte = [](int x) { return static_cast<float>(linear_from_srgb(x / 255.0)); };
  // No two are alike, nor are the parts of one: what is exchanged is noticed.
  if (bytes)
    for (const int x : {51, 102, 204, 255})
      a.colors.values.push_back({byte(x), byte(x - 50), byte(x - 51), 1.0f});
  else
    for (const float x : {0.1f, 0.2f, 0.9f, 1.0f})
      a.colors.values.push_back({x, 0.5f * x, 1.0f - 0.75f * x, 1.0f});
  for (const Face& face : mesh.faces())
    a.colors.corners.insert(a.colors.corners.end(), face.begin(), face.end());
  a.groups = {{"lower side", "upper"}, {0, 1, 1, kNone}};
  a.materials = {{"red", "blue"}, {0, 0, 1, 0}};
  a.objects = {{"thing"}, {0, 0, 0, 0}};
  mesh.set_attributes(std::make_shared<MeshAttributes>(std::move(a)));
  return mesh;
}

TEST(MeshAttributesInFiles, ObjKeepsTexcoordsColorsAndNames) {
  const Carried outcome = read_carried(
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0.5\no cup\ng lower side\nusemtl red\n"
      "v 0 0 0 1 0 0.5\nv 1 0 0 0 1 0\nv 1 1 0 0 0 0\nv 0 1 0 1\n"
      "f 1/1 2/2 3/3\ng upper\nusemtl\nf -4/-4/1 3//1 4/-1\nf 1 2 4\n",
      MeshFormat::obj);
  EXPECT_THAT(outcome.notes, IsEmpty());
  const MeshAttributes& a = outcome.attributes();
  EXPECT_THAT(
      at_corners(a.texcoords, 3),
      ElementsAre(Texcoord{0, 0}, Texcoord{1, 0}, Texcoord{1, 1}, Texcoord{0, 0}, Texcoord{-1, -1},
                  Texcoord{0.5f, 0}, Texcoord{-1, -1}, Texcoord{-1, -1}, Texcoord{-1, -1}));
  const auto half = static_cast<float>(linear_from_srgb(0.5));
  EXPECT_NEAR(half, 0.2140, 1e-4);
  ASSERT_NE(a.colors.at_corner(0, 0), nullptr);
  EXPECT_EQ(*a.colors.at_corner(0, 0), (Color{1, 0, half, 1}));
  EXPECT_EQ(a.colors.at_corner(1, 2), nullptr);  // a weight
  EXPECT_THAT(of_faces(a.groups), ElementsAre("lower side", "upper", "upper"));
  EXPECT_THAT(of_faces(a.materials), ElementsAre("red", "-", "-"));
  EXPECT_THAT(of_faces(a.objects), ElementsAre("cup", "cup", "cup"));
}

TEST(MeshAttributesInFiles, MeshesWithoutAnyCarryNone) {
  EXPECT_EQ(read_carried("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1 2 3\n", MeshFormat::obj)
                .mesh.attributes(),
            nullptr);
  for (const MeshFormat format :
       {MeshFormat::obj, MeshFormat::ply, MeshFormat::off, MeshFormat::stl, MeshFormat::glb})
    EXPECT_EQ(read_carried(write_mesh(tetrahedron(), format), format).mesh.attributes(), nullptr);
}

TEST(MeshAttributesInFiles, ObjTexcoordsThatAreNotThereAreNoted) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\nvt x y\n";
  for (const char* face :
       {"f 1/1 2/9 3/1\n", "f 1/1 2/-3 3/1\n", "f 1/1 2/0 3/1\n", "f 1/1 2/x 3/1\n"}) {
    const Carried outcome = read_carried(vertices + face, MeshFormat::obj);
    EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("line 6"))) << face;
    EXPECT_EQ(outcome.attributes().texcoords.corners, (std::vector<Index>{0, kNone, 0})) << face;
  }
  // One that is no number is none.
  EXPECT_EQ(
      read_carried(vertices + "f 1/1 2/2 3/1\n", MeshFormat::obj).attributes().texcoords.corners,
      (std::vector<Index>{0, kNone, 0}));
}

// An L whose corner lies so that its fan does not cover it, with a corner that is repeated.
TEST(MeshAttributesInFiles, CornersOfPolygonsKeepTheirValues) {
  const Carried outcome = read_carried(
      "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\n"
      "vt 2 0\nvt 2 1\nvt 1 1\nvt 1 2\nvt 0 2\nvt 0 0\nvt 9 9\n"
      "f 1/1 2/2 2/7 3/3 4/4 5/5 6/6\n",
      MeshFormat::obj);
  ASSERT_EQ(outcome.mesh.face_count(), 4);
  EXPECT_DOUBLE_EQ(total_area(outcome.mesh), 3.0);
  for (Index f = 0; f < 4; ++f)
    for (int k = 0; k < 3; ++k) {
      const Texcoord* uv = outcome.attributes().texcoords.at_corner(f, k);
      ASSERT_NE(uv, nullptr);
      EXPECT_EQ((*uv)[0], outcome.mesh.corner(f, k).x());
      EXPECT_EQ((*uv)[1], outcome.mesh.corner(f, k).y());
    }
}

TEST(MeshAttributesInFiles, SeamsSplitNoVertex) {
  const Carried outcome = read_carried(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvt 5 5\nvt 6 6\n"
      "f 1/1 2/2 3/2\nf 1/3 3/4 4/4\n",
      MeshFormat::obj);
  const Connected surface = connect(outcome.mesh);
  EXPECT_EQ(surface.mesh.vertex_count(), 4);
  EXPECT_EQ(surface.mesh.attributes(), outcome.mesh.attributes());  // shared
  EXPECT_TRUE(surface.half_edges.has_twin(2));
}

TEST(MeshAttributesInFiles, RoundTrips) {
  struct Form {
    MeshFormat format;
    bool text, bytes;
  };
  for (const Form form : {Form{MeshFormat::obj, false, false}, Form{MeshFormat::obj, false, true},
                          Form{MeshFormat::ply, true, false}, Form{MeshFormat::ply, false, false},
                          Form{MeshFormat::ply, true, true}, Form{MeshFormat::ply, false, true}}) {
    const TriangleMesh mesh = painted(form.bytes);
    const std::string bytes = write_mesh(mesh, form.format, {.text = form.text});
    const Carried back = read_carried(bytes, form.format);
    EXPECT_THAT(back.notes, IsEmpty());
    EXPECT_THAT(back.mesh.positions(), testing::ElementsAreArray(mesh.positions()));
    expect_same_attributes(back.mesh, mesh);
    if (form.format == MeshFormat::ply) {
      EXPECT_EQ(bytes.find("uchar red") != std::string::npos, form.bytes);
    }
  }
}

TEST(MeshAttributesInFiles, PlyColorsByCorner) {
  TriangleMesh mesh = painted(true);
  MeshAttributes a = *mesh.attributes();
  a.colors.values.push_back({0.25f, 0.5f, 0.0f, 0.5f});
  a.colors.corners[4] = 4;
  mesh.set_attributes(std::make_shared<MeshAttributes>(a));
  for (const bool text : {true, false})
    expect_same_attributes(
        read_carried(write_mesh(mesh, MeshFormat::ply, {.text = text}), MeshFormat::ply).mesh,
        mesh);
}

TEST(MeshAttributesInFiles, GlbKeepsFacesTexcoordsColorsMaterialsAndTheObject) {
  TriangleMesh mesh = painted(false);
  std::vector<std::string> notes;
  MeshWriteOptions options;
  options.note = [&](const std::string& note) { notes.push_back(note); };
  const Carried back = read_carried(write_mesh(mesh, MeshFormat::glb, options), MeshFormat::glb);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("no groups")));
  MeshAttributes a = *mesh.attributes();
  a.groups = {};
  mesh.set_attributes(std::make_shared<MeshAttributes>(a));
  expect_same_attributes(back.mesh, mesh, 6e-8f);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(back.mesh.corner(f, k), mesh.corner(f, k));
  // A vertex more for the seam, which is none of the surface.
  EXPECT_EQ(back.mesh.vertex_count(), 5);
  EXPECT_EQ(connect(back.mesh).mesh.vertex_count(), 4);
}

TEST(MeshAttributesInFiles, OffColorsAndTexcoords) {
  TriangleMesh mesh = tetrahedron();
  MeshAttributes a;
  for (const float x : {0.0f, 0.2f, 0.9f, 1.0f}) {
    a.colors.values.push_back({x, 0.0f, 1.0f, 0.5f});
    a.texcoords.values.push_back({x, 0.5f});
  }
  for (const Face& face : mesh.faces()) {
    a.colors.corners.insert(a.colors.corners.end(), face.begin(), face.end());
    a.texcoords.corners.insert(a.texcoords.corners.end(), face.begin(), face.end());
  }
  mesh.set_attributes(std::make_shared<MeshAttributes>(a));
  const std::string text = write_mesh(mesh, MeshFormat::off);
  EXPECT_TRUE(text.starts_with("STCOFF\n"));
  expect_same_attributes(read_carried(text, MeshFormat::off).mesh, mesh);

  const std::string rest = "\n3 1 0\n0 0 0 0 255 51\n1 0 0 255 255 255\n0 1 0 0 0 0\n3 0 1 2\n";
  const Carried whole = read_carried("COFF" + rest, MeshFormat::off);
  ASSERT_TRUE(whole.mesh.attributes());
  EXPECT_EQ(*whole.attributes().colors.at_corner(0, 0),
            (Color{0, 1, static_cast<float>(linear_from_srgb(0.2)), 1}));
  EXPECT_EQ(read_carried("OFF" + rest, MeshFormat::off).mesh.attributes(), nullptr);
  EXPECT_EQ(read_carried("COFF\n3 1 0\n0 0 0 a b c\n1 0 0\n0 1 0 1 1\n3 0 1 2\n", MeshFormat::off)
                .mesh.attributes(),
            nullptr);
}

TEST(MeshAttributesInFiles, WritersSayWhatTheyLeaveOut) {
  const TriangleMesh mesh = painted(true);
  const auto notes = [&](MeshFormat format) {
    std::string all;
    MeshWriteOptions options;
    options.note = [&](const std::string& note) { all += note + "\n"; };
    (void)write_mesh(mesh, format, options);
    return all;
  };
  EXPECT_THAT(notes(MeshFormat::stl), HasSubstr("STL holds no attributes"));
  EXPECT_THAT(notes(MeshFormat::obj), HasSubstr(".mtl"));
  EXPECT_THAT(notes(MeshFormat::off), HasSubstr("texture coordinates are left out"));
  EXPECT_EQ(notes(MeshFormat::ply), "");
}

TEST(MeshAttributesInFiles, PlyTellsOfFacesOfWhichACornerHasNoValue) {
  TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 3}});
  MeshAttributes attributes;
  attributes.texcoords.values = {{0.0f, 0.0f}, {1.0f, 0.5f}};
  attributes.texcoords.corners = {0, 1, 1, 0, kNone, 1};
  mesh.set_attributes(std::make_shared<const MeshAttributes>(attributes));
  std::vector<std::string> notes;
  MeshWriteOptions options;
  options.note = [&](const std::string& note) { notes.push_back(note); };
  const Carried back = read_carried(write_mesh(mesh, MeshFormat::ply, options), MeshFormat::ply);
  EXPECT_THAT(notes,
              ElementsAre(HasSubstr("texture coordinates of whole faces; those of 1 faces")));
  const Texcoord none{-1.0f, -1.0f};
  EXPECT_THAT(at_corners(back.attributes().texcoords, 2),
              ElementsAre(Texcoord{0.0f, 0.0f}, Texcoord{1.0f, 0.5f}, Texcoord{1.0f, 0.5f}, none,
                          none, none));
}

TEST(MeshAttributesInFiles, ValuesThatAreNotFiniteAreNone) {
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1e400 0\nvt 0 1\nvt nan 1\nf 1/1 2/2 3/3\n";
  const Carried read = read_carried(obj, MeshFormat::obj);
  const Texcoord none{-1.0f, -1.0f};
  EXPECT_THAT(at_corners(read.attributes().texcoords, 1),
              ElementsAre(none, Texcoord{0.0f, 1.0f}, none));
}

const std::string kPlyVertices =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";

TEST(MeshAttributesInFiles, PlyLabelsWithoutNames) {
  const Carried outcome = read_carried(
      "ply\nformat ascii 1.0\n" + kPlyVertices +
          "element face 4\nproperty list uchar int vertex_indices\nproperty int label\n"
          "property float label2\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7 1\n3 0 1 2 7 1\n"
          "3 0 1 2 -1 1\n3 0 1 2 3 1\n",
      MeshFormat::ply);
  EXPECT_THAT(of_faces(outcome.attributes().groups), ElementsAre("7", "7", "-", "3"));
  EXPECT_THAT(write_mesh(outcome.mesh, MeshFormat::ply, {.text = true}),
              HasSubstr("3 0 1 2 7\n3 0 1 2 7\n3 0 1 2 -1\n3 0 1 2 3\n"));
}

TEST(MeshAttributesInFiles, PlyVerticesOfOtherPrograms) {
  const Carried outcome = read_carried(
      "ply\nformat ascii 1.0\n" + kPlyVertices +
          "property uchar diffuse_red\nproperty uchar diffuse_green\n"
          "property uchar diffuse_blue\nproperty float texture_u\nproperty float texture_v\n"
          "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
          "0 0 0 255 0 0 0.5 0.25\n1 0 0 0 0 255 1 1\n0 1 0 ? 0 0 nan 0\n3 0 1 2\n",
      MeshFormat::ply);
  EXPECT_THAT(at_corners(outcome.attributes().texcoords, 1),
              ElementsAre(Texcoord{0.5f, 0.25f}, Texcoord{1, 1}, Texcoord{-1, -1}));
  EXPECT_THAT(at_corners(outcome.attributes().colors, 1),
              ElementsAre(Color{1, 0, 0, 1}, Color{0, 0, 1, 1}, Color{-1, -1, -1, -1}));
}

TEST(MeshAttributesInFiles, PlyColoursHaveEachTheScaleOfItsType) {
  const Carried outcome =
      read_carried("ply\nformat ascii 1.0\n" + kPlyVertices +
                       "property uchar red\nproperty float green\nproperty ushort blue\n"
                       "property float alpha\n"
                       "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                       "0 0 0 255 0 0 1\n1 0 0 0 1 0 0.5\n0 1 0 0 0 65535 0.25\n3 0 1 2\n",
                   MeshFormat::ply);
  EXPECT_THAT(at_corners(outcome.attributes().colors, 1),
              ElementsAre(Color{1, 0, 0, 1}, Color{0, 1, 0, 0.5f}, Color{0, 0, 1, 0.25f}));
}

TEST(MeshAttributesInFiles, PlyListsThatDoNotFitAreNoted) {
  const Carried outcome =
      read_carried("ply\nformat ascii 1.0\n" + kPlyVertices +
                       "element face 2\nproperty list uchar float texcoord\n"
                       "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
                       "4 0 0 1 1 3 0 1 2\n6 0 0 1 0 0 1 3 0 1 2\n",
                   MeshFormat::ply);
  EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("first: face 0")));
  EXPECT_EQ(outcome.attributes().texcoords.corners,
            (std::vector<Index>{kNone, kNone, kNone, 0, 1, 2}));
}

GltfBuilder textured_triangle() {
  GltfBuilder gltf;
  auto& primitive = gltf.mesh(gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  primitive["attributes"]["TEXCOORD_0"] =
      gltf.accessor(std::vector<float>{0, 0, 1, 0, 0.25f, 0.75f}, "VEC2", 2);
  primitive["attributes"]["COLOR_0"] =
      gltf.accessor(std::vector<float>{1, 0, 0, 0, 0.5f, 0, 0, 0, 0.25f}, "VEC3", 3);
  primitive["material"] = 1;
  gltf.root["materials"] = {{{"name", "first"}}, GltfBuilder::Json::object()};
  return gltf;
}

TEST(MeshAttributesInFiles, GltfNodesThatMirrorTurnTheCornersToo) {
  GltfBuilder gltf = textured_triangle();
  gltf.node({{"mesh", 0}, {"name", "left"}});
  gltf.node({{"mesh", 0}, {"name", "right"}, {"scale", {-1, 1, 1}}});
  const Carried outcome = read_carried(gltf.glb(), MeshFormat::glb);
  EXPECT_THAT(outcome.notes, IsEmpty());
  const MeshAttributes& a = outcome.attributes();
  // v runs up; both nodes share the values.
  EXPECT_THAT(at_corners(a.texcoords, 2),
              ElementsAre(Texcoord{0, 1}, Texcoord{1, 1}, Texcoord{0.25f, 0.25f}, Texcoord{0, 1},
                          Texcoord{0.25f, 0.25f}, Texcoord{1, 1}));
  EXPECT_EQ(a.texcoords.values.size(), 3u);
  EXPECT_EQ(*a.colors.at_corner(1, 1), (Color{0, 0, 0.25f, 1}));
  EXPECT_THAT(of_faces(a.materials), ElementsAre("material 1", "material 1"));
  EXPECT_THAT(of_faces(a.objects), ElementsAre("left", "right"));
}

TEST(MeshAttributesInFiles, GltfAttributesThatCannotBeReadAreNotedOnce) {
  const auto spoil = [](const std::function<void(GltfBuilder&)>& change) {
    GltfBuilder gltf = textured_triangle();
    gltf.node({{"mesh", 0}});
    gltf.node({{"mesh", 0}});
    change(gltf);
    return read_carried(gltf.glb(), MeshFormat::glb);
  };
  const auto expect_only_colors = [](const Carried& outcome, const char* note) {
    EXPECT_EQ(outcome.mesh.face_count(), 2);
    EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr(note)));
    EXPECT_TRUE(outcome.attributes().texcoords.empty());
    EXPECT_FALSE(outcome.attributes().colors.empty());
  };
  expect_only_colors(spoil([](GltfBuilder& g) { g.root["accessors"][1]["count"] = 2; }),
                     "TEXCOORD_0 is passed over: mesh 0 primitive 0 TEXCOORD_0: has 2 elements");
  expect_only_colors(spoil([](GltfBuilder& g) { g.root["accessors"][1]["count"] = 1000; }),
                     "TEXCOORD_0 is passed over: accessor 1");
  expect_only_colors(spoil([](GltfBuilder& g) { g.root["accessors"][1]["type"] = "VEC3"; }),
                     "not of type VEC2");
  expect_only_colors(spoil([](GltfBuilder& g) {
                       g.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = "x";
                     }),
                     "TEXCOORD_0 is passed over");
  expect_only_colors(spoil([](GltfBuilder& g) { g.root["accessors"][1]["componentType"] = 5125; }),
                     "whole numbers of 32 bits");
}

TEST(MeshAttributesInFiles, GltfMaterialsThatAreNotThereAreNotedOnce) {
  GltfBuilder gltf = textured_triangle();
  gltf.node({{"mesh", 0}});
  gltf.node({{"mesh", 0}});
  gltf.root["meshes"][0]["primitives"][0]["material"] = 77;
  const Carried outcome = read_carried(gltf.glb(), MeshFormat::glb);
  EXPECT_THAT(
      outcome.notes,
      ElementsAre(HasSubstr("mesh 0 primitive 0: material 77 is passed over: there are 2")));
  EXPECT_TRUE(outcome.attributes().materials.empty());
}

// Primitives share their positions, and vertices with them, whatever else differs.
TEST(MeshAttributesInFiles, GltfPrimitivesOfSharedPositionsHaveTheirOwnValues) {
  GltfBuilder gltf = textured_triangle();
  auto second = gltf.root["meshes"][0]["primitives"][0];
  second["attributes"]["TEXCOORD_0"] =
      gltf.accessor(std::vector<float>{0, 0, 0, 0, 0, 0}, "VEC2", 2);
  second["material"] = 0;
  gltf.root["meshes"][0]["primitives"].push_back(second);
  gltf.node({{"mesh", 0}});
  const Carried outcome = read_carried(gltf.glb(), MeshFormat::glb);
  EXPECT_EQ(outcome.mesh.vertex_count(), 3);
  EXPECT_THAT(of_faces(outcome.attributes().materials), ElementsAre("material 1", "first"));
  EXPECT_EQ(*outcome.attributes().texcoords.at_corner(0, 1), (Texcoord{1, 1}));
  EXPECT_EQ(*outcome.attributes().texcoords.at_corner(1, 1), (Texcoord{0, 1}));
  EXPECT_EQ(outcome.attributes().colors.values.size(), 3u);
}

}  // namespace
}  // namespace mimicry
