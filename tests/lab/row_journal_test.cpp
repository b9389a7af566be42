#include "lab/row_journal.h"

#include <string>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>

#include "files/file.h"
#include "support/folder.h"

namespace mimicry::lab {
namespace {

constexpr const char *kSettings = "{\"a\": 1}", *kHeading = "x,y\n";

std::string read(const test::TestFolder& folder, const std::string& name) {
  return read_file(folder.path(name));
}

TEST(RowJournal, ARunGoesOnWhereTheLastOneEnded) {
  const test::TestFolder folder;
  {
    RowJournal journal(folder.path("out"), kSettings, kHeading);
    EXPECT_EQ(journal.jobs(), 0u);
    journal.append("1,2\n", "{}\n", 1, 0);
    journal.append("3,4\n5,6\n", "{}\n{}\n", 2, 1);
  }
  // What the journal does not count was not finished.
  write_file_atomically(folder.path("out/rows.csv"), read(folder, "out/rows.csv") + "7,8\n9,");
  RowJournal journal(folder.path("out"), kSettings, kHeading);
  EXPECT_EQ(journal.jobs(), 2u);
  EXPECT_EQ(journal.rows(), 3u);
  EXPECT_EQ(journal.rejected(), 1u);
  journal.append("7,8\n", "{}\n", 1, 0);
  journal.record();
  EXPECT_EQ(read(folder, "out/rows.csv"), "x,y\n1,2\n3,4\n5,6\n7,8\n");
  EXPECT_EQ(read(folder, "out/rows.jsonl"), "{}\n{}\n{}\n{}\n");
  EXPECT_THROW(RowJournal(folder.path("out"), kSettings, kHeading), Error);  // it is locked
}

TEST(RowJournal, RowsOfAnotherRunAreRefusedAndKept) {
  const test::TestFolder folder;
  RowJournal(folder.path("out"), kSettings, kHeading).append("1,2\n", "{}\n", 1, 0);
  const std::string before = read(folder, "out/rows.csv");
  const auto message = [&](const char* settings, const char* heading) {
    try {
      RowJournal(folder.path("out"), settings, heading);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message("{\"a\": 2}", kHeading).find("other strokes"), std::string::npos);
  EXPECT_NE(message(kSettings, "x,z\n").find("other columns"), std::string::npos);
  EXPECT_EQ(read(folder, "out/rows.csv"), before);
}

}  // namespace
}  // namespace mimicry::lab
