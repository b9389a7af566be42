// The techniques' quality on a fixed set of strokes, against the stored table. A change that makes
// one worse on purpose stores a new one: build/release/bin/quality --small
// tests/quality/quality.csv
#include <cstddef>

#include <gtest/gtest.h>

#include "files/file.h"
#include "quality_table.h"

namespace mimicry::bench {
namespace {

TEST(Quality, NoTechniqueIsWorseThanStored) {
  const auto stored = read_quality(read_file(MIMICRY_QUALITY_TABLE));
  Executor executor(2);
  const auto rows = quality_table(small_quality_shapes(), small_quality_plan(), executor);
  ASSERT_EQ(rows.size(), stored.size()) << "store a new table";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].key(), stored[i].key()) << "store a new table";
    EXPECT_EQ(worse(rows[i], stored[i]), "");
  }
}

TEST(Quality, WorseIsSeen) {
  QualityRow stored{"snap",   "usual",   "open", 90,          {5, 1},
                    {2, 0.1}, {300, 20}, {0, 0}, {0.9, 0.01}, {0, 0}};
  EXPECT_EQ(worse(stored, stored), "");
  QualityRow row = stored;
  row.d_ep_mm.mean = 6;  // within the spread
  row.length_ratio.mean = 0.99;
  EXPECT_EQ(worse(row, stored), "");
  row.d_ep_mm.mean = 6.2;
  EXPECT_NE(worse(row, stored).find("snap,usual,open,90: D_ep_mm is 6.2"), std::string::npos);
  row = stored;
  row.length_ratio.mean = 1.2;
  EXPECT_NE(worse(row, stored), "");
  const auto again = read_quality(write_quality({stored}));
  EXPECT_EQ(again.at(0).key(), stored.key());
  EXPECT_EQ(again.at(0).k_g.spread, 20);
}

}  // namespace
}  // namespace mimicry::bench
