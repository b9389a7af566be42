#include "lab/measured_rows.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>

#include "files/names.h"
#include "lab/columns.h"
#include "lab/study_rows.h"

namespace mimicry::lab {
namespace {

using testing::HasSubstr;

MeasuredRow full_row() {
  MeasuredRow row;
  row.participant = "p, the \"first\"";
  row.stroke = "1_4.json#3";
  row.recording = "1_4.json";
  row.method = "snap";
  row.shape = "hand";
  row.shape_number = 4;
  row.index = 3;
  row.curve = "7";
  row.repetition = true;
  row.task = "tracing";
  row.simulated = Simulation{"mimicry 0.1.0", 5, "mimicry"};
  row.measures.emplace();
  row.measures->d_ep_m = 0.00125;
  row.measures->filters.noisy = true;
  row.measures->gaps = 2;
  row.pieces = 3;
  row.frames = 90;
  row.missed = 4;
  return row;
}

TEST(MeasuredRows, WhatIsWrittenIsReadByTheSameNames) {
  MeasuredRow rejected;
  rejected.participant = "p2";
  rejected.method = "mimicry";
  rejected.rejected = "the file\nis missing";
  std::vector<std::string> notes;
  Monitor monitor;
  monitor.note = [&](const std::string& note) { notes.push_back(note); };
  const std::string table = rows_heading() + csv_row(full_row()) + csv_row(rejected);
  const StudyRows read(read_rows(table, "rows.csv", monitor), "rows.csv");
  EXPECT_TRUE(notes.empty());
  ASSERT_EQ(read.rows().size(), 2u);
  const StudyRow& row = read.rows()[0];
  EXPECT_EQ(row.participant, "p, the \"first\"");
  EXPECT_EQ(row.stroke, "1_4.json#3");
  EXPECT_EQ(row.recording, "1_4.json");
  EXPECT_EQ(row.method, "snap");
  EXPECT_EQ(row.shape, "hand");
  EXPECT_EQ(row.index, "3");
  EXPECT_EQ(row.curve, "7");
  EXPECT_EQ(row.repetition, "1");
  EXPECT_EQ(row.task, "tracing");
  EXPECT_EQ(row.simulated, "mimicry 0.1.0 seed 5");
  EXPECT_EQ(row.failed, "noisy");
  EXPECT_EQ(read.number(row, column::kDistance), 1.25);
  EXPECT_EQ(read.number(row, column::kGaps), 2);
  EXPECT_EQ(read.number(row, "pieces"), 3);
  EXPECT_EQ(read.number(row, column::kShapeNumber), 4);
  EXPECT_EQ(read.rows()[1].failed, "the file\nis missing");
  EXPECT_EQ(read.table().rows[1][*read.table().find(column::kDistance)], "");
}

TEST(MeasuredRows, EveryColumnOfThePapersMeasuresIsWritten) {
  const CsvTable table = read_rows(rows_heading(), "rows.csv");
  for (const PaperMeasure& measure : paper_measures())
    EXPECT_TRUE(table.find(measure.column)) << measure.column;
  for (const auto name : {column::kMethodNumber, column::kShapeNumber, column::kLargestJump,
                          column::kViolation, column::kRejected})
    EXPECT_TRUE(table.find(name)) << name;
  EXPECT_FALSE(table.find("repeat"));  // a reserved word of R
  EXPECT_EQ(table.columns, row_columns());
}

TEST(MeasuredRows, JsonHasTheColumnsInTheirOrder) {
  const std::string line = json_row(full_row());
  std::size_t at = 0;
  for (const std::string& name : row_columns()) {
    const std::size_t found = line.find("\"" + name + "\": ", at);
    ASSERT_NE(found, std::string::npos) << name;
    at = found;
  }
  EXPECT_THAT(line, HasSubstr("\"method_number\": null, \"shape\": \"hand\", \"shape_number\": 4"));
}

TEST(ReadRows, TablesOfMeasureOfEarlierVersions) {
  std::vector<std::string> notes;
  Monitor monitor;
  monitor.note = [&](const std::string& note) { notes.push_back(note); };
  const StudyRows rows(read_rows("method,shape,index,curve,repeat,task,K_E,participant\n"
                                 "1,3,0,4,0,tracing,7,p1\n2,0,1,4,1,tracing,8,p1\n",
                                 "old.csv", monitor),
                       "old.csv");
  ASSERT_EQ(rows.rows().size(), 2u);
  EXPECT_EQ(rows.rows()[0].method, "mimicry");
  EXPECT_EQ(rows.rows()[0].shape, "bunny");
  EXPECT_EQ(rows.rows()[0].recording, "1_3.json");
  EXPECT_EQ(rows.rows()[0].repetition, "0");
  EXPECT_EQ(rows.rows()[1].method, "2");  // a study's own
  EXPECT_EQ(rows.rows()[1].recording, "2_0.json");
  EXPECT_EQ(rows.rows()[1].repetition, "1");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], HasSubstr("old.csv"));
  EXPECT_THAT(notes[0], HasSubstr("'repeat'"));
}

TEST(ReadRows, TablesOfReplayOfEarlierVersions) {
  const StudyRows rows(read_rows("participant,stroke,method,shape,index,repeat,K_E\n"
                                 "p1,0_3.json#7,snap,bunny,7,0,1\ns.json,wave,snap,bunny,0,0,1\n",
                                 "old.csv"),
                       "old.csv");
  ASSERT_EQ(rows.rows().size(), 2u);
  EXPECT_EQ(rows.rows()[0].recording, "0_3.json");
  EXPECT_EQ(rows.rows()[1].recording, "");
}

TEST(RejectedStrokes, ReadBack) {
  RejectedStroke stroke;
  stroke.participant = "p07";
  stroke.recording = "1_3.json";
  stroke.method = "mimicry";
  stroke.method_number = 1;
  stroke.shape = "bunny";
  stroke.shape_number = 3;
  stroke.index = "4";
  stroke.reason = "frame 2: no \"T\"";
  RejectedStroke folder;
  folder.participant = "nobody";
  folder.reason = "is not there";
  EXPECT_EQ(stroke.text(), "p07/1_3.json: stroke 4: frame 2: no \"T\"");
  EXPECT_EQ(folder.text(), "nobody: is not there");
  const auto read = read_rejected(write_rejected({stroke, folder}), "r.csv");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].text(), stroke.text());
  EXPECT_EQ(read[0].method, "mimicry");
  EXPECT_EQ(read[0].shape_number, 3);
  EXPECT_EQ(read[1].text(), folder.text());
  // As they were written before.
  const auto former = read_rejected("participant,method,shape,index,reason\np1,0,4,3,x\n", "r.csv");
  ASSERT_EQ(former.size(), 1u);
  EXPECT_EQ(former[0].method, "spraycan");
  EXPECT_EQ(former[0].shape, "hand");
  EXPECT_THROW(read_rejected("a\n1\n", "r.csv"), Error);
  EXPECT_EQ(rejected_beside("study/rows.csv"), join_path("study", "rows.rejected.csv"));
}

}  // namespace
}  // namespace mimicry::lab
