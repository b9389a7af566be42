#include "lab/participant_folder.h"

#include <filesystem>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>

#include "support/folder.h"

namespace mimicry::lab {
namespace {

RecordedStroke stroke_of(int frames) {
  RecordedStroke stroke;
  RecordedPiece& piece = stroke.pieces.emplace_back();
  piece.method = "AnchorPhong";
  for (int i = 0; i < frames; ++i) {
    RecordedFrame& frame = piece.frames.emplace_back();
    frame.point = Vec3(0.1 * i, 1.0 / 3.0, -0.25);
    frame.surface.face = i;
    frame.time_ms = 11.1 * i;
    frame.pen = Vec3(0.1 * i, 0.2, 0.3);
  }
  stroke.simulated = Simulation{"mimicry 0.1.0", 7, "mimicry"};
  return stroke;
}

TEST(ParticipantFolder, WhatIsWrittenIsReadBack) {
  const test::TestFolder folder;
  const std::vector<RecordedStroke> strokes = {stroke_of(3), stroke_of(5)};
  const StudySequence sequence{{1}, {4}, {{0, 1, 0, 2, 3, 2}}};
  const ParticipantWriter writer(folder.path("study/p07"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("study/p07")));  // nothing came there yet
  writer.write({1, 4}, strokes);
  // Without its sequence it is not whole.
  EXPECT_THROW(ParticipantFolder(folder.path("study/p07")), Error);
  writer.finish(sequence);

  for (const char* path : {"study/p07", "study/p07/"}) {
    const ParticipantFolder read(folder.path(path));
    EXPECT_EQ(read.name(), "p07");
    EXPECT_EQ(read.sequence().methods, sequence.methods);
    EXPECT_EQ(read.sequence().shapes, sequence.shapes);
    EXPECT_EQ(read.sequence().strokes, sequence.strokes);
    EXPECT_EQ(read.title({1, 4}), "p07/1_4.json");
    EXPECT_TRUE(std::filesystem::exists(read.path({1, 4})));
    const auto back = read.read({1, 4});
    ASSERT_EQ(back.size(), 2u);
    for (std::size_t i = 0; i < back.size(); ++i) {
      EXPECT_EQ(back[i].problem, "");
      EXPECT_EQ(back[i].simulated->seed, 7u);
      ASSERT_EQ(back[i].pieces.size(), 1u);
      ASSERT_EQ(back[i].pieces[0].frames.size(), strokes[i].pieces[0].frames.size());
      for (std::size_t f = 0; f < back[i].pieces[0].frames.size(); ++f) {
        const RecordedFrame &a = back[i].pieces[0].frames[f], &b = strokes[i].pieces[0].frames[f];
        EXPECT_EQ(a.point, b.point);
        EXPECT_EQ(a.surface.face, b.surface.face);
        EXPECT_EQ(a.time_ms, b.time_ms);
      }
    }
    try {
      read.read({0, 4});
      FAIL();
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("0_4.json"), std::string::npos) << error.what();
    }
  }
}

TEST(ParticipantFolder, NamesOfRecordingsAndStrokesReadBack) {
  for (const Index method : {0, 1, 27})
    for (const Index shape : {0, 5, 100}) {
      const RecordingName name{method, shape};
      EXPECT_EQ(RecordingName::of_file(name.file()), name);
      const auto stroke = recorded_stroke_of(RecordedStrokeName{name, 11}.text());
      ASSERT_TRUE(stroke);
      EXPECT_EQ(stroke->recording, name);
      EXPECT_EQ(stroke->index, 11u);
    }
  for (const char* other :
       {"", "1_3", "1_3.jsonl", "_3.json", "1_.json", "a_b.json", "+1_3.json", "01_3.json",
        "1_-3.json", "1_3_4.json", "study_sequence.json", "99999999999_0.json", "x/1_3.json"})
    EXPECT_FALSE(RecordingName::of_file(other)) << other;
  for (const char* other : {"1_3.json", "1_3.json#", "1_3.json#x", "my.json#7", "1_3.json#7#8"})
    EXPECT_FALSE(recorded_stroke_of(other)) << other;
}

TEST(ParticipantFolder, SourcesAreCalledByTheLastPartOfTheirPath) {
  EXPECT_EQ(source_name("study/p07"), "p07");
  EXPECT_EQ(source_name("study/p07/"), "p07");
  EXPECT_EQ(source_name("strokes.json"), "strokes.json");
  EXPECT_EQ(source_name("."), std::filesystem::current_path().filename().string());
  EXPECT_EQ(source_name(".."), std::filesystem::current_path().parent_path().filename().string());
}

}  // namespace
}  // namespace mimicry::lab
