#include "lab/pairing.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>

#include "lab/measured_rows.h"
#include "lab/paper_agreement.h"

namespace mimicry::lab {
namespace {

// Two participants, three curves; p2 has one stroke of one method only, and one is noisy.
const std::string kToday =
    "participant,stroke,method,shape,curve,repetition,task,K_E,noisy\n"
    "p1,,spraycan,hand,0,0,tracing,5,0\np1,,mimicry,hand,0,0,tracing,3,0\n"
    "p1,,mimicry,hand,1,0,re-creating,4,0\np1,,spraycan,hand,1,0,re-creating,6,0\n"
    "p1,,spraycan,torus,0,0,tracing,50,0\np1,,mimicry,torus,0,0,tracing,30,0\n"
    "p2,,spraycan,hand,0,0,tracing,7,1\np2,,mimicry,hand,0,0,tracing,1,0\n"
    "p2,,spraycan,hand,2,0,tracing,7,0\n";
const std::string kFormer =
    "method,shape,curve,repeat,task,K_E,noisy,participant\n"
    "0,4,0,0,tracing,5,0,p1\n1,4,0,0,tracing,3,0,p1\n"
    "1,4,1,0,re-creating,4,0,p1\n0,4,1,0,re-creating,6,0,p1\n"
    "0,0,0,0,tracing,50,0,p1\n1,0,0,0,tracing,30,0,p1\n"
    "0,4,0,0,tracing,7,1,p2\n1,4,0,0,tracing,1,0,p2\n"
    "0,4,2,0,tracing,7,0,p2\n";

std::vector<PairedGroup> paired(const std::string& text, PairingOptions options) {
  return pair_rows(read_rows(text, "rows.csv"), options, "rows.csv");
}

TEST(Pairing, RowsOfOneTaskBelongTogetherInTablesOfEveryVersion) {
  for (const std::string& text : {kToday, kFormer})
    for (const char* rule : {"shape=torus", "shape=0"})
      for (const char* b : {"mimicry", "1"}) {
        PairingOptions options;
        options.method_a = "spraycan";
        options.method_b = b;
        options.without = {rule};
        const auto groups = paired(text, options);
        ASSERT_EQ(groups.size(), 3u);
        EXPECT_EQ(groups[0].name, "task re-creating");
        EXPECT_EQ(groups[1].name, "task tracing");
        const PairedGroup& all = groups[2];
        EXPECT_EQ(all.name, kAllRows);
        EXPECT_EQ(all.pairs, 2u);
        EXPECT_EQ(all.failed, 1u);
        EXPECT_EQ(all.unpaired, 1u);
        ASSERT_EQ(all.measures.size(), 1u);
        EXPECT_THAT(all.measures[0].a, testing::ElementsAre(5, 6));
        EXPECT_THAT(all.measures[0].b, testing::ElementsAre(3, 4));
        EXPECT_THAT(all.rows, testing::ElementsAre(testing::Pair(0, 1), testing::Pair(3, 2)));
      }
}

TEST(Pairing, RowsThatWereDrawnAgainBelongTogetherByTheirStroke) {
  PairingOptions options;
  options.method_a = "snap";
  options.method_b = "occlude";
  const auto groups = paired(
      "participant,stroke,method,K_E\ns,a,snap,1\ns,b,snap,2\ns,b,occlude,4\ns,a,occlude,3\n",
      options);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_THAT(groups[0].measures[0].b, testing::ElementsAre(3, 4));
}

TEST(Pairing, ErrorsNameWhatIsMissingOrDouble) {
  const auto message = [](const std::string& text, PairingOptions options) {
    try {
      paired(text, options);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  PairingOptions options;
  options.method_a = "spraycan";
  options.method_b = "snap";
  EXPECT_THAT(message(kToday, options), testing::HasSubstr("'snap', only of mimicry, spraycan"));
  options.method_b = "mimicry";
  options.by = "nope";
  EXPECT_THAT(message(kToday, options), testing::HasSubstr("no column 'nope'"));
  options.by = "task";
  options.without = {"shape"};
  EXPECT_THAT(message(kToday, options), testing::HasSubstr("COLUMN=VALUE"));
  options.without = {};
  EXPECT_THAT(message(kToday + "p1,,spraycan,hand,0,0,tracing,5,0\n", options),
              testing::HasSubstr("two rows of method spraycan"));
}

TEST(PaperAgreement, TheStudysMethodsHaveFiguresByNameAndByNumber) {
  for (const char* a : {"spraycan", "0"})
    for (const char* b : {"mimicry", "1"}) {
      const auto* figure = published_figure(a, b, "task tracing", "D_ep_mm");
      ASSERT_NE(figure, nullptr);
      EXPECT_EQ(figure->mimicry, 1.13);
      EXPECT_EQ(published_figure(a, b, std::string(kAllRows), "D_ep_mm"), nullptr);
    }
  EXPECT_EQ(published_figure("mimicry", "spraycan", "task tracing", "D_ep_mm"), nullptr);
  EXPECT_EQ(published_figure("snap", "mimicry", "task tracing", "D_ep_mm"), nullptr);
}

}  // namespace
}  // namespace mimicry::lab
