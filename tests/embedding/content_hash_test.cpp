#include <vector>

#include <gtest/gtest.h>

#include <mimicry/embedding/embedding.h>

namespace mimicry {
namespace {

TEST(ContentHash, ChangesWithEveryBit) {
  const std::vector<Vec3> p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<Face> f = {{0, 1, 2}, {0, 2, 3}};
  const std::uint64_t hash = content_hash({p, f});
  EXPECT_EQ(hash, content_hash({p, f}));
  for (std::size_t v = 0; v < p.size(); ++v)
    for (int k = 0; k < 3; ++k) {
      std::vector<Vec3> q = p;
      q[v][k] += 0x1p-52;
      EXPECT_NE(content_hash({q, f}), hash);
    }
  EXPECT_NE(content_hash({p, {{0, 2, 1}, {0, 2, 3}}}), hash);
  EXPECT_NE(content_hash({p, {{0, 2, 3}, {0, 1, 2}}}), hash);
  EXPECT_NE(content_hash({p, {{0, 1, 2}}}), hash);
}

TEST(ContentHash, IsTheSameOnEveryMachine) {
  // A change of this number means that every embedding file must be baked again.
  EXPECT_EQ(content_hash({{{0, 0, 0}, {1, 0.5, 0}, {-0.25, 1, 2}}, {{0, 1, 2}}}),
            853384026490010769U);
}

}  // namespace
}  // namespace mimicry
