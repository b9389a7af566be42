#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/io/embedding_file.h>

namespace mimicry {
namespace {

Embedding example() {
  Random random(1);
  Embedding e;
  e.dimension = 5;
  e.mesh_vertex_count = 7;
  e.faces = {{0, 1, 2}, {6, 5, 4}, {2, 3, 0}};
  e.face_order = {2, 0, 1};
  e.mesh_hash = 0xfedcba9876543210U;
  e.diagonal = 1.75;
  for (int v = 0; v < 11; ++v) e.positions.emplace_back(random.normal(), 1e-300, -0.0);
  for (Index t = 0; t < 6; ++t) e.tets.push_back({t, t + 1, t + 2, t + 3});
  for (int i = 0; i < 55; ++i) e.values.push_back(random.normal());
  e.options = {5, 123, 0.07};
  e.quality.is_lattice = true;
  e.quality.shell_rounds = 4;
  e.quality.missing_edges = 3;
  e.quality.samples = 77;
  e.quality.stress = 0.01;
  e.quality.distortion = {0.1, 0.2, 0.3, 0.4};
  e.quality.surface_first = true;
  e.quality.sliver_percent = 6.9;
  return e;
}

ErrorKind refusal(const std::string& bytes, const std::string& part) {
  try {
    read_embedding(bytes, "bunny.mimicry");
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::StartsWith("bunny.mimicry: "));
    EXPECT_THAT(error.what(), ::testing::HasSubstr(part));
    return error.kind();
  }
  ADD_FAILURE() << "read: " << part;
  return ErrorKind::io;
}

TEST(EmbeddingFile, KeepsEveryNumber) {
  const Embedding e = example();
  const std::string bytes = write_embedding(e);
  const Embedding back = read_embedding(bytes, "x");
  EXPECT_EQ(back.dimension, e.dimension);
  EXPECT_EQ(back.mesh_vertex_count, e.mesh_vertex_count);
  EXPECT_EQ(back.faces, e.faces);
  EXPECT_EQ(back.face_order, e.face_order);
  EXPECT_EQ(back.mesh_hash, e.mesh_hash);
  EXPECT_EQ(back.diagonal, e.diagonal);
  EXPECT_EQ(back.positions, e.positions);
  EXPECT_EQ(back.tets, e.tets);
  EXPECT_EQ(back.values, e.values);
  EXPECT_EQ(back.options.samples, 123);
  EXPECT_EQ(back.options.offset, 0.07);
  EXPECT_EQ(back.quality.is_lattice, true);
  EXPECT_EQ(back.quality.hit_a_cap, false);
  EXPECT_EQ(back.quality.missing_edges, 3);
  EXPECT_EQ(back.quality.samples, 77);
  EXPECT_EQ(back.quality.distortion, e.quality.distortion);
  EXPECT_EQ(back.quality.surface_first, true);
  EXPECT_EQ(back.quality.sliver_percent, 6.9);
  // Numbers that are not named above come back too: the same bytes again.
  EXPECT_EQ(write_embedding(back), bytes);
  EXPECT_EQ(write_embedding(read_embedding(write_embedding(Embedding()), "x")),
            write_embedding(Embedding()));
}

TEST(EmbeddingFile, SectionsAreAligned) {
  const std::string bytes = write_embedding(example());
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(static_cast<unsigned char>(bytes[32 + 24 * i + 8]) % 64, 0);
}

TEST(EmbeddingFile, NoFlippedBitPasses) {
  const std::string bytes = write_embedding(example());
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ 1 << bit);
      EXPECT_THROW(read_embedding(damaged, "x"), Error) << i << " " << bit;
    }
}

TEST(EmbeddingFile, CutOrForeignOrLaterFilesAreRefusedByName) {
  const std::string bytes = write_embedding(example());
  for (std::size_t size = 0; size < bytes.size(); size += 7)
    EXPECT_EQ(refusal(bytes.substr(0, size), ""), ErrorKind::invalid_input) << size;
  refusal(bytes + "x", "bytes");
  refusal("solid cube\nfacet normal 0 0 1", "does not begin");
  std::string later = bytes;
  later[8] = 3;
  EXPECT_EQ(refusal(later, "version 3"), ErrorKind::unsupported);
}

TEST(EmbeddingFile, ContradictionsAreRefused) {
  Embedding e = example();
  e.values.pop_back();
  refusal(write_embedding(e), "contradict");
  e = example();
  e.mesh_vertex_count = 12;
  refusal(write_embedding(e), "contradict");
  e = example();
  e.tets[4][1] = 11;
  refusal(write_embedding(e), "tetrahedron 4");
  e.tets[4][1] = -1;
  refusal(write_embedding(e), "vertex -1");
  e = example();
  e.faces[1][2] = 7;  // of the shell, not of the mesh
  refusal(write_embedding(e), "face 1");
}

}  // namespace
}  // namespace mimicry
