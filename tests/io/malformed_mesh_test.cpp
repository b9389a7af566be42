#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>

#include "io/mesh_fixtures.h"

namespace mimicry {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Malformed {
  std::string name;
  MeshFormat format;
  std::string bytes;
  std::size_t shortest;  // a shorter file must be refused: it lacks what its beginning promises
};

std::vector<Malformed> samples() {
  std::vector<Malformed> out;
  const auto add = [&](const char* name, MeshFormat format, bool text, bool counted) {
    std::string bytes = write_mesh(tetrahedron(), format, {.text = text});
    // Of a text only the last line's end may be missed unnoticed.
    const std::size_t shortest = counted ? bytes.size() - (text ? 1 : 0) : 0;
    out.push_back({name, format, std::move(bytes), shortest});
  };
  add("obj", MeshFormat::obj, true, false);
  add("ply text", MeshFormat::ply, true, true);
  add("ply binary", MeshFormat::ply, false, true);
  add("stl text", MeshFormat::stl, true, false);
  add("stl binary", MeshFormat::stl, false, false);
  add("off", MeshFormat::off, true, true);
  add("glb", MeshFormat::glb, false, true);
  out.push_back({"gltf", MeshFormat::gltf,
                 R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
                 R"({"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"count":3,)"
                 R"("componentType":5126,"type":"VEC3"}],"bufferViews":[{"buffer":0,)"
                 R"("byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
                 R"("data:application/octet-stream;base64,)"
                 R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})",
                 0});
  out.back().shortest = out.back().bytes.size();
  return out;
}

/// What the reader says; "" where it takes the file.
std::string outcome(std::string_view bytes, MeshFormat format) {
  try {
    const TriangleMesh mesh = read_mesh(bytes, format, "the file");
    EXPECT_GT(mesh.face_count(), 0);
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), StartsWith("the file: "));
    return error.what();
  }
  return "";
}

TEST(MalformedMesh, SamplesAreWhole) {
  for (const Malformed& sample : samples()) EXPECT_EQ(outcome(sample.bytes, sample.format), "");
}

TEST(MalformedMesh, FileCutAtAnyByteIsRefusedOrASmallerMesh) {
  for (const Malformed& sample : samples()) {
    SCOPED_TRACE(sample.name);
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      // A copy of its own size lets the sanitizers see a read beyond the end.
      const std::vector<char> cut(sample.bytes.begin(),
                                  sample.bytes.begin() + static_cast<std::ptrdiff_t>(size));
      const std::string said = outcome({cut.data(), cut.size()}, sample.format);
      if (size < sample.shortest) {
        EXPECT_NE(said, "") << size;
      }
    }
  }
}

TEST(MalformedMesh, AnyByteChangedIsRefusedOrAnotherMesh) {
  for (const Malformed& sample : samples()) {
    SCOPED_TRACE(sample.name);
    std::string bytes = sample.bytes;
    for (char& byte : bytes) {
      const char kept = byte;
      for (const char other : std::string("\0\xff\x80\x7f"
                                          "9- \n\\\"",
                                          10) +
                                  static_cast<char>(kept ^ 1)) {
        byte = other;
        outcome(bytes, sample.format);
      }
      byte = kept;
    }
  }
}

TEST(MalformedMesh, OneFormatTakenForAnotherIsRefused) {
  for (const Malformed& sample : samples())
    for (const Malformed& other : samples()) {
      // GLB and glTF tell themselves by their first bytes.
      if (sample.format == other.format ||
          (sample.format >= MeshFormat::glb && other.format >= MeshFormat::glb))
        continue;
      EXPECT_NE(outcome(sample.bytes, other.format), "") << sample.name << " as " << other.name;
    }
}

// Readers that believed these headers would ask for hundreds of gigabytes.
TEST(MalformedMesh, CountsThatLieAllocateNothing) {
  const std::string properties =
      "property double x\nproperty double y\nproperty double z\nelement face 1\n"
      "property list uint int vertex_indices\nend_header\n";
  for (const char* encoding : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const char* count : {"4294967295", "9223372036854775807"})
      EXPECT_THAT(outcome(std::string("ply\nformat ") + encoding + " 1.0\nelement vertex " + count +
                              "\n" + properties + "0 0 0\n",
                          MeshFormat::ply),
                  HasSubstr("more than the file holds"));
  EXPECT_THAT(outcome("ply\nformat ascii 1.0\nelement vertex 1\n" + properties +
                          "0 0 0\n4294967295 0 0 0\n",
                      MeshFormat::ply),
              HasSubstr("line 11: a list of 4294967295 items, more than the file holds"));
  // Elements without properties take no bytes at all.
  for (const char* element : {"nothing", "vertex", "face"})
    EXPECT_NE(outcome(std::string("ply\nformat binary_little_endian 1.0\nelement ") + element +
                          " 9223372036854775807\nend_header\n",
                      MeshFormat::ply),
              "");
  EXPECT_THAT(outcome("OFF\n4294967295 4294967295 0\n0 0 0\n", MeshFormat::off),
              HasSubstr("line 2: the header promises 4294967295 vertices"));
  EXPECT_THAT(outcome("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4294967295 0 1 2\n", MeshFormat::off),
              HasSubstr("line 6: '' where corner 3 of 4294967295 should stand"));
  EXPECT_THAT(outcome(std::string(80, ' ') + "\xff\xff\xff\xff", MeshFormat::stl),
              HasSubstr("byte 84: the header promises 4294967295 triangles"));
}

TEST(MalformedMesh, JsonNumberBeyondDoublePrecisionIsRefused) {
  EXPECT_THAT(outcome(R"({"asset":{"version":"2.0"},"scene":1e999})", MeshFormat::gltf),
              HasSubstr("a number beyond double precision"));
}

TEST(MalformedMesh, DeeplyNestedJsonIsRefused) {
  EXPECT_NE(outcome(std::string(1'000'000, '['), MeshFormat::gltf), "");
  EXPECT_NE(outcome(std::string(100'000, '[') + std::string(100'000, ']'), MeshFormat::gltf), "");
}

}  // namespace
}  // namespace mimicry
