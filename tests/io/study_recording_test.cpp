#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/io/study.h>

namespace mimicry {
namespace {

using testing::HasSubstr;

Vec3 any(Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

std::vector<RecordedStroke> strokes(std::uint64_t seed) {
  Random random(seed);
  std::vector<RecordedStroke> result(3);
  for (std::size_t s = 0; s < result.size(); ++s)
    for (std::size_t p = 0; p < s; ++p) {
      RecordedPiece piece;
      piece.method = p == 0 ? "AnchorPhong" : "Spray";
      for (Eigen::Index i = 0; i < 16; ++i) piece.model_to_world.data()[i] = random.normal();
      for (std::size_t i = 0; i < 4 * p; ++i) {
        RecordedFrame f;
        for (Vec3* v : {&f.point, &f.normal, &f.surface.bary, &f.head, &f.pen, &f.head_up,
                        &f.head_forward, &f.pen_up, &f.pen_forward, &f.spray})
          *v = any(random);
        f.surface.face = static_cast<Index>(random.below(10000));
        f.pen_distance = random.uniform();
        f.time_ms = 1e6 * random.uniform();
        piece.frames.push_back(f);
      }
      result[s].pieces.push_back(piece);
    }
  return result;
}

TEST(StudyRecording, KeepsTheMarkOfASimulation) {
  auto written = strokes(2);
  written[2].simulated = {"mimicry 0.1.0", 7, "spraycan"};
  const std::string text = write_recording(written);
  const auto read = read_recording(text, "1_0.json");
  EXPECT_FALSE(read[1].simulated);
  ASSERT_TRUE(read[2].simulated);
  EXPECT_EQ(read[2].simulated->program, "mimicry 0.1.0");
  EXPECT_EQ(read[2].simulated->seed, 7u);
  EXPECT_EQ(read[2].simulated->technique, "spraycan");
  EXPECT_EQ(write_recording(read), text);
}

TEST(StudyRecording, ReadsBackToTheSameBits) {
  const auto written = strokes(1);
  const std::string text = write_recording(written);
  const auto read = read_recording(text, "1_0.json");
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t s = 0; s < read.size(); ++s) {
    EXPECT_EQ(read[s].problem, "");
    ASSERT_EQ(read[s].pieces.size(), written[s].pieces.size());
    for (std::size_t p = 0; p < read[s].pieces.size(); ++p) {
      const RecordedPiece& a = read[s].pieces[p];
      const RecordedPiece& b = written[s].pieces[p];
      EXPECT_EQ(a.method, b.method);
      EXPECT_EQ(a.model_to_world, b.model_to_world);
      ASSERT_EQ(a.frames.size(), b.frames.size());
      for (std::size_t i = 0; i < a.frames.size(); ++i) {
        const RecordedFrame &x = a.frames[i], &y = b.frames[i];
        EXPECT_EQ(x.surface.face, y.surface.face);
        EXPECT_EQ(x.time_ms, y.time_ms);
        EXPECT_EQ(x.pen_distance, y.pen_distance);
        for (auto member :
             {&RecordedFrame::point, &RecordedFrame::normal, &RecordedFrame::head,
              &RecordedFrame::pen, &RecordedFrame::head_up, &RecordedFrame::head_forward,
              &RecordedFrame::pen_up, &RecordedFrame::pen_forward, &RecordedFrame::spray})
          EXPECT_EQ(x.*member, y.*member);
        EXPECT_EQ(x.surface.bary, y.surface.bary);
      }
    }
  }
  EXPECT_EQ(write_recording(read), text);
}

TEST(StudyRecording, AStrokeThatCannotBeReadLeavesTheOthers) {
  std::string text = write_recording(strokes(2));
  const std::size_t at = text.rfind("\"CU\"");
  text.replace(at, 4, "\"CX\"");
  const auto read = read_recording(text, "1_0.json");
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ(read[1].problem, "");
  EXPECT_THAT(read[2].problem, HasSubstr("piece 1: frame 3: DF: 'CU' is missing"));
}

TEST(StudyRecording, NanIsAMissingNumberButNotInWords) {
  std::string text = write_recording(strokes(3));
  const std::size_t at = text.find("\"T\":") + 4;
  text.replace(at, text.find(',', at) - at, "-Infinity");
  const std::size_t word = text.find("Spray");
  text.replace(word, 5, "NaN\\\"N");
  const auto read = read_recording(text, "1_0.json");
  EXPECT_EQ(read[2].pieces[1].method, "NaN\"N");
  EXPECT_TRUE(std::isnan(read[2].pieces[1].frames[0].time_ms));
  // What is not finite is written as nothing, and comes back as that.
  EXPECT_THAT(write_recording(read), HasSubstr("\"T\":null"));
}

TEST(StudyRecording, RefusesWhatIsNoRecording) {
  for (const char* text : {"", "{}", "[", "5", "[[{}]", "nonsense"})
    EXPECT_THROW(read_recording(text, "x.json"), Error) << text;
  EXPECT_TRUE(read_recording("[]", "x.json").empty());
  EXPECT_THAT(read_recording("[5, {}, [7]]", "x.json")[2].problem, HasSubstr("piece 0"));
  EXPECT_THAT(read_recording("[5, {}, [7]]", "x.json")[0].problem, HasSubstr("not an array"));
}

StudySequence sequence(const std::string& methods, const std::string& shapes,
                       const std::string& strokes) {
  return read_study_sequence("{\"MethodSequence\":" + methods + ",\"ShapeSequence\":" + shapes +
                                 ",\"StrokeSequence\":" + strokes + "}",
                             "s.json");
}

TEST(StudySequence, HasOneMeaningInAllItsForms) {
  const std::vector<Index> a = {1, 0, 1, 2, 3, 2}, b = {3, 2, 3, 0, 1, 0};
  const auto lists = [](const StudySequence& s) { return s.strokes; };
  using Lists = std::vector<std::vector<Index>>;
  EXPECT_EQ(lists(sequence("[1,0]", "[4,5]", "[1,0,1,2,3,2]")), (Lists{a, a}));
  EXPECT_EQ(lists(sequence("[1,0]", "[4,5]", "[1,0,2,3]")), (Lists{a, a}));
  EXPECT_EQ(lists(sequence("[1,0]", "[4,5]", "[[1,0,2,3],[3,2,0,1]]")), (Lists{a, b}));
  EXPECT_EQ(lists(sequence("[1,0]", "[4,5]", "[1,0,1,2,3,2,3,2,3,0,1,0]")), (Lists{a, b}));
  EXPECT_EQ(lists(sequence("[1,0]", "[4]", "[[[1,0,2,3]],[[3,2,0,1]]]")), (Lists{a, b}));
  const auto parallel = sequence("[1,1,1,1,0,0,0,0]", "[4,4,4,4,4,4,4,4]", "[1,0,2,3,3,2,0,1]");
  EXPECT_EQ(parallel.methods, (std::vector<Index>{1, 0}));
  EXPECT_EQ(parallel.shapes, (std::vector<Index>{4}));
  EXPECT_EQ(lists(parallel), (Lists{a, b}));
  const auto again = read_study_sequence(write_study_sequence(parallel), "s.json");
  EXPECT_EQ(again.strokes, parallel.strokes);
  EXPECT_EQ(again.methods, parallel.methods);
}

TEST(StudySequence, RefusesWhatDoesNotFit) {
  for (const char* strokes : {"[]", "[1]", "[1,1]", "[[1,0],[2]]", "{}", "[[1,0],[0,1],[1,0]]",
                              "[-1,2]", "[1,0,1,2,3,2,3,2,3,0,1]"})
    EXPECT_THROW(sequence("[1,0]", "[4,5]", strokes), Error) << strokes;
  EXPECT_THROW(sequence("[]", "[4]", "[1,0]"), Error);
  EXPECT_THROW(read_study_sequence("{\"MethodSequence\":[0]}", "s.json"), Error);
  EXPECT_THROW(read_study_sequence("[", "s.json"), Error);
}

TEST(TargetsWriter, ReadsBackToTheSameBits) {
  TargetSet set;
  TargetShape shape{"pad \"x\"", 0.1 + 0.2, {}};
  shape.curves.push_back({{{3, Vec3(0.5, 0.25, 0.25)}, {0, Vec3(1, 0, 0)}}, {0, 1}, {}});
  shape.curves.push_back({{{7, Vec3(0.125, 0.125, 0.75)}}, {}, TargetParameters{9, 0.1, 45}});
  set.shapes.push_back(shape);
  const std::string text = write_targets(set, "a note");
  const TargetSet read = read_targets(text, "t.json");
  ASSERT_EQ(read.shapes.size(), 1u);
  EXPECT_EQ(read.shapes[0].name, shape.name);
  EXPECT_EQ(read.shapes[0].scale, shape.scale);
  ASSERT_EQ(read.shapes[0].curves.size(), 2u);
  EXPECT_EQ(read.shapes[0].curves[0].keypoints, shape.curves[0].keypoints);
  EXPECT_EQ(read.shapes[0].curves[0].points[0].bary, shape.curves[0].points[0].bary);
  EXPECT_FALSE(read.shapes[0].curves[0].parameters);
  ASSERT_TRUE(read.shapes[0].curves[1].parameters);
  EXPECT_EQ(read.shapes[0].curves[1].parameters->control_points, 9);
  EXPECT_EQ(write_targets(read, "a note"), text);
}

}  // namespace
}  // namespace mimicry
