// Where the bytes of a glTF are: chunks of a GLB, files beside it, data URIs; and what may be
// missing of it.

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include "io/gltf_builder.h"

namespace mimicry {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::json;

/// Files beside the mesh, what was asked of them and what the reader told.
struct Beside {
  std::map<std::string, std::string> files;
  std::vector<std::string> asked;
  std::vector<std::string> notes;

  TriangleMesh read(const std::string& bytes, MeshFormat format = MeshFormat::gltf) {
    MeshReadOptions options;
    options.companion = [&](const std::string& name) -> std::optional<std::string> {
      asked.push_back(name);
      const auto file = files.find(name);
      if (file == files.end()) return std::nullopt;
      return file->second;
    };
    options.note = [&](const std::string& sentence) { notes.push_back(sentence); };
    return read_mesh(bytes, format, "name", options);
  }
};

void expect_cube(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.vertex_count(), 8);
  EXPECT_EQ(mesh.face_count(), 12);
  EXPECT_DOUBLE_EQ(area_of(mesh), 24.0);
}

TEST(GltfFiles, ABufferBesideTheMeshIsAskedForByItsDecodedName) {
  const GltfBuilder cube = cube_gltf();
  for (const auto& [uri, name] :
       std::map<std::string, std::string>{{"cube.bin", "cube.bin"},
                                          {"./a/../cube%20one.bin", "cube one.bin"},
                                          {"parts/w%C3%BCrfel.bin", "parts/w\xc3\xbcrfel.bin"},
                                          {"W\xc3\xbcrfel 1.bin", "W\xc3\xbcrfel 1.bin"},
                                          {"50%.bin", "50%.bin"}}) {
    Beside beside;
    beside.files[name] = cube.data;
    expect_cube(beside.read(cube.json(uri.c_str())));
    EXPECT_THAT(beside.asked, ElementsAre(name));
    EXPECT_THAT(beside.notes, IsEmpty());
  }
  Beside undecoded;  // by an exporter that does not encode
  undecoded.files["a%20b.bin"] = cube.data;
  expect_cube(undecoded.read(cube.json("a%20b.bin")));
}

TEST(GltfFiles, NothingOutsideOfTheFolderIsAskedFor) {
  const GltfBuilder cube = cube_gltf();
  for (const char* uri :
       {"../cube.bin", "a/../../cube.bin", "%2e%2e/cube.bin", "..%2Fcube.bin", "/etc/passwd",
        "%2Fetc/passwd", "file:///etc/passwd", "http://example.org/cube.bin", "C:/cube.bin",
        "C:\\cube.bin", "..\\cube.bin", "a%5Ccube.bin", "cube.bin%00.txt", ".", "", "a/.."}) {
    Beside beside;
    EXPECT_THAT(said([&] { beside.read(cube.json(uri)); }), HasSubstr("name: buffer 0: names '"))
        << uri;
    EXPECT_THAT(beside.asked, IsEmpty()) << uri;
  }
}

TEST(GltfFiles, AMissingFileIsNamed) {
  const std::string json = cube_gltf().json("cube%20one.bin");
  try {
    read_mesh(json, MeshFormat::gltf, "name");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_THAT(error.what(), HasSubstr("name: buffer 0: lies in the file 'cube one.bin', which is "
                                        "not there; give it together with this one"));
  }
  Beside cut;
  cut.files["cube one.bin"] = cube_gltf().data.substr(0, 100);
  EXPECT_THAT(
      said([&] { cut.read(json); }),
      HasSubstr("accessor 1: 36 elements reach beyond bufferView 1; the file is cut short"));
}

TEST(GltfFiles, OnlyWhatTrianglesNeedHasToBeThere) {
  GltfBuilder cube = cube_gltf();
  cube.root["buffers"] = {{{"byteLength", cube.data.size()}, {"uri", "cube.bin"}},
                          {{"byteLength", 0}},
                          {{"byteLength", 100}, {"uri", "animation.bin"}},
                          {{"byteLength", 100}, {"uri", "../../elsewhere.bin"}},
                          Json::object()};
  cube.root["bufferViews"].push_back({{"buffer", 2}, {"byteLength", 100}});
  cube.root["bufferViews"].push_back({{"buffer", 7}, {"byteLength", 100}});
  cube.root["accessors"].push_back({{"bufferView", 2}, {"count", 25}, {"type", "SCALAR"}});
  cube.root["images"] = {{{"uri", "wood.png"}}, {{"bufferView", 3}}};
  cube.root["animations"] = {{{"samplers", {{{"input", 2}, {"output", 2}}}}}};
  cube.root["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 2}}}}}}});
  Beside beside;
  beside.files["cube.bin"] = cube.data;
  expect_cube(beside.read(cube.json()));
  EXPECT_THAT(beside.asked, ElementsAre("cube.bin"));
}

TEST(GltfFiles, OneFileOfSeveralBuffersIsReadOnce) {
  GltfBuilder cube = cube_gltf();
  cube.root["buffers"] = {{{"byteLength", 9}, {"uri", "cube.bin"}},
                          {{"byteLength", 9}, {"uri", "cube.bin"}}};
  cube.root["bufferViews"][1]["buffer"] = 1;
  Beside beside;
  beside.files["cube.bin"] = cube.data;
  expect_cube(beside.read(cube.json()));  // though the lengths are wrong
  EXPECT_THAT(beside.asked, ElementsAre("cube.bin"));
}

TEST(GltfFiles, WrongLengthsOfViewsAreToldAndMended) {
  GltfBuilder cube = cube_gltf();
  cube.root["bufferViews"][0]["byteLength"] = 95;
  Beside beside;
  expect_cube(beside.read(cube.glb(), MeshFormat::glb));
  EXPECT_THAT(beside.notes, ElementsAre(HasSubstr("accessor 0 reaches beyond bufferView 0")));
}

TEST(GltfFiles, DataUrisAreReadInTheirForms) {
  const auto read = [](const std::string& uri) {
    GltfBuilder gltf;
    gltf.root["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}};
    gltf.mesh(gltf.accessor(0, "VEC3", 5126, 3));
    gltf.node({{"mesh", 0}});
    return read_mesh(gltf.json(uri.c_str()), MeshFormat::gltf, "name").position(1);
  };
  const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  EXPECT_EQ(read("data:application/octet-stream;base64," + base64), Vec3(1, 0, 0));
  EXPECT_EQ(read("data:;base64," + base64), Vec3(1, 0, 0));
  EXPECT_EQ(read("DATA:application/gltf-buffer;BASE64," + base64), Vec3(1, 0, 0));
  EXPECT_EQ(read("data:;base64," + base64.substr(0, 20) + "\r\n " + base64.substr(20)),
            Vec3(1, 0, 0));
  std::string percent = "data:,";
  for (const int byte : {0, 0, 128, 63}) {
    char digits[4];
    std::snprintf(digits, sizeof digits, "%%%02x", static_cast<unsigned>(byte));
    percent += digits;
  }
  for (int k = 0; k < 32; ++k) percent += "%00";
  EXPECT_EQ(read(percent), Vec3(0, 0, 0));
  EXPECT_THAT(said([&] { read("data:;base64,AA*A"); }),
              HasSubstr("buffer 0: 'uri' is not of the form data:"));
  EXPECT_THAT(said([&] { read("data:nothing"); }), HasSubstr("'uri' is not of the form data:"));
}

TEST(GltfFiles, TextAndBinaryTellThemselves) {
  const GltfBuilder cube = cube_gltf();
  expect_cube(read_mesh(cube.glb(), MeshFormat::gltf, "name"));
  Beside beside;
  beside.files["cube.bin"] = cube.data;
  expect_cube(beside.read("\xef\xbb\xbf\n" + cube.json("cube.bin") + std::string(3, '\0'),
                          MeshFormat::glb));
  EXPECT_THAT(beside.notes, IsEmpty());
  expect_cube(beside.read(cube.json("cube.bin") + "more"));
  EXPECT_THAT(beside.notes, ElementsAre("4 bytes after the JSON were passed over"));
}

/// A GLB whose chunks say and hold what they should not.
struct Glb {
  std::string json = cube_gltf().json();
  std::string binary = cube_gltf().data;
  std::string json_padding, binary_padding, between, behind;
  std::ptrdiff_t json_off = 0, binary_off = 0, length_off = 0;  // of the lengths

  std::string bytes() const {
    const auto word = [](std::size_t size, std::ptrdiff_t off) {
      return GltfBuilder::word(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(size) + off));
    };
    const std::string text = json + json_padding;
    const std::string data = binary + binary_padding;
    const std::string chunks = word(text.size(), json_off) + "JSON" + text + between +
                               word(data.size(), binary_off) + std::string("BIN\0", 4) + data +
                               behind;
    return "glTF" + word(2, 0) + word(12 + chunks.size(), length_off) + chunks;
  }
};

TEST(GlbChunks, AreFoundWhereverTheLengthsSayTheyAre) {
  std::vector<std::pair<const char*, Glb>> kinds;
  const auto kind = [&](const char* name) -> Glb& {
    return kinds.emplace_back(name, Glb()).second;
  };
  Glb good;
  good.json_padding.assign((4 - good.json.size() % 4) % 4, ' ');
  good.json.replace(0, 1, "{\n  ");  // three bytes more
  kind("not padded");
  kind("padding that is not counted").between = "  ";
  kind("padding of zeros").json_padding.assign(5, '\0');
  kind("JSON's length too small").json_off = -17;
  kind("JSON's length too large").json_off = 5;
  kind("JSON's length beyond the file").json_off = 1 << 30;
  kind("binary length too small").binary_off = -100;
  kind("binary length too large").binary_off = 3;
  kind("binary length beyond all").binary_off = 0x7fffffff;
  kind("length too small").length_off = -50;
  kind("length too large").length_off = 1000;
  kind("length of nothing").length_off = -1'000'000;
  kind("trailing bytes").behind = "trailing bytes of no chunk";
  kind("a chunk of another kind").behind = GltfBuilder::word(4) + "NAMEabcd";
  kind("a chunk between").between = GltfBuilder::word(4) + "NAMEabcd";
  kinds.emplace_back("as it should be", good);
  for (const auto& [name, glb] : kinds) {
    SCOPED_TRACE(name);
    Beside beside;
    const std::string bytes = glb.bytes();
    EXPECT_EQ(said([&] { expect_cube(beside.read(bytes, MeshFormat::glb)); }), "");
  }
  Beside beside;
  good.length_off = 4;
  expect_cube(beside.read(good.bytes(), MeshFormat::glb));
  EXPECT_THAT(beside.notes, ElementsAre(HasSubstr("the header counts")));
}

TEST(GlbChunks, WhatIsCutShortIsRefused) {
  const std::string whole = cube_gltf().glb();
  for (std::size_t size = 0; size + 3 < whole.size(); ++size)
    EXPECT_NE(said([&] { read_mesh(whole.substr(0, size), MeshFormat::glb, "name"); }), "") << size;
  std::string old = whole;
  old[4] = 1;
  EXPECT_THAT(said([&] { read_mesh(old, MeshFormat::glb, "name"); }), HasSubstr("GLB version 1"));
}

TEST(GltfCases, AreReadAsOtherReadersReadThem) {
  const std::string separate = case_file("13-gltf-separate-bin/separate.gltf");
  if (separate.empty()) GTEST_SKIP() << "the cases are not there";
  Beside beside;
  beside.files["sep.bin"] = case_file("13-gltf-separate-bin/sep.bin");
  expect_cube(beside.read(separate));
  expect_cube(beside.read(case_file("12-glb-unaligned-chunk/unpadded.glb"), MeshFormat::glb));
}

/// tinygltf, the independent reader: how many vertices and corners the file has.
TEST(GltfFiles, AnIndependentReaderCountsTheSame) {
  const GltfBuilder cube = cube_gltf();
  tinygltf::Model model;
  std::string warning, error;
  const std::string glb = cube.glb();
  ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(
      &model, &error, &warning, reinterpret_cast<const unsigned char*>(glb.data()),
      static_cast<unsigned>(glb.size())))
      << error;
  ASSERT_EQ(model.meshes.size(), 1u);
  const tinygltf::Primitive& primitive = model.meshes[0].primitives.at(0);
  const TriangleMesh mesh = read_mesh(glb, MeshFormat::glb, "name");
  EXPECT_EQ(model.accessors[static_cast<std::size_t>(primitive.attributes.at("POSITION"))].count,
            static_cast<std::size_t>(mesh.vertex_count()));
  EXPECT_EQ(model.accessors[static_cast<std::size_t>(primitive.indices)].count,
            3 * static_cast<std::size_t>(mesh.face_count()));
}

}  // namespace
}  // namespace mimicry
