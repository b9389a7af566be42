#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/io/strokes.h>

namespace mimicry {
namespace {

using testing::HasSubstr;

Stroke sample_stroke(unsigned seed, int frames) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return double(random()) / double(std::mt19937::max()) - 0.5; };
  const auto vec = [&] { return Vec3(uniform(), uniform(), uniform()); };
  const auto quat = [&] {
    return Quat(uniform(), uniform(), uniform(), uniform() + 1.0).normalized();
  };
  Stroke stroke;
  stroke.id = "a \"stroke\"";
  stroke.target = "torus";
  stroke.model_to_world = {quat(), vec(), 0.4};
  for (int i = 0; i < frames; ++i) {
    Frame frame{i / 90.0, {vec(), quat()}, {vec(), quat()}, 0.75, {}};
    if (i % 2 == 1) frame.pressure = 0.5 + uniform();
    stroke.frames.push_back(frame);
  }
  stroke.intended = Intention{"ring", true, {{3, Vec3(0.25, 0.5, 0.25)}, {4, Vec3(1, 0, 0)}}};
  return stroke;
}

/// What is said of a file with a fault; "" where it has none.
std::string error_of(const std::string& text) {
  try {
    const StrokesFile file = read_strokes(text, "s.json");
    if (!file.left_out.empty()) return file.left_out.front();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Strokes, KeepTheMarkOfASimulation) {
  std::vector<Stroke> written(3, sample_stroke(1, 4));
  // Beyond what a double counts.
  written[0].simulated = {"mimicry 0.1.0", 18446744073709551615u, "snap"};
  written[1].simulated = {"other 2", 0, ""};
  const std::string text = write_strokes(written);
  const std::vector<Stroke> read = read_strokes(text, "s.json").strokes;
  EXPECT_EQ(read[0].simulated->program, "mimicry 0.1.0");
  EXPECT_EQ(read[0].simulated->seed, 18446744073709551615u);
  EXPECT_EQ(read[0].simulated->technique, "snap");
  EXPECT_EQ(read[1].simulated->technique, "");
  EXPECT_FALSE(read[2].simulated);
  EXPECT_EQ(write_strokes(read), text);
  std::string broken = text;
  broken.replace(broken.find("\"seed\":0"), 8, "\"seed\":-1");
  EXPECT_THAT(error_of(broken), HasSubstr("simulated: seed"));
}

TEST(Strokes, ReadBackToTheSameBits) {
  const std::vector<Stroke> written = {sample_stroke(1, 40), sample_stroke(2, 0),
                                       sample_stroke(3, 1)};
  const std::vector<Stroke> read = read_strokes(write_strokes(written), "s.json").strokes;
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t s = 0; s < read.size(); ++s) {
    EXPECT_EQ(read[s].id, written[s].id);
    EXPECT_EQ(read[s].target, written[s].target);
    EXPECT_EQ(read[s].model_to_world.scale, written[s].model_to_world.scale);
    EXPECT_EQ(read[s].model_to_world.rotation.coeffs(),
              written[s].model_to_world.rotation.coeffs());
    ASSERT_EQ(read[s].frames.size(), written[s].frames.size());
    for (std::size_t i = 0; i < read[s].frames.size(); ++i) {
      const Frame& a = read[s].frames[i];
      const Frame& b = written[s].frames[i];
      EXPECT_EQ(a.time_s, b.time_s);
      EXPECT_EQ(a.head.position, b.head.position);
      EXPECT_EQ(a.controller.orientation.coeffs(), b.controller.orientation.coeffs());
      EXPECT_EQ(a.trigger, b.trigger);
      EXPECT_EQ(a.pressure, b.pressure);
    }
    ASSERT_TRUE(read[s].intended);
    EXPECT_TRUE(read[s].intended->closed);
    EXPECT_EQ(read[s].intended->points[0].face, 3);
    EXPECT_EQ(read[s].intended->points[0].bary, Vec3(0.25, 0.5, 0.25));
  }
}

TEST(Strokes, EveryConventionComesBack) {
  const Stroke written = sample_stroke(5, 10);
  for (const auto& convention : conventions()) {
    SCOPED_TRACE(std::string(convention.name));
    const auto read =
        read_strokes(write_strokes(std::span(&written, 1), convention), "s.json").strokes;
    ASSERT_EQ(read.size(), 1u);
    for (std::size_t i = 0; i < written.frames.size(); ++i) {
      // Centimetres round once each way.
      EXPECT_LT((read[0].frames[i].head.position - written.frames[i].head.position).norm(), 1e-15);
      EXPECT_EQ(read[0].frames[i].head.orientation.toRotationMatrix(),
                written.frames[i].head.orientation.toRotationMatrix());
    }
  }
}

TEST(Strokes, TruncatedAnywhereIsRefused) {
  const std::string text = write_strokes(std::vector<Stroke>{sample_stroke(7, 2)});
  const std::size_t last = text.find_last_of('}');
  for (std::size_t n = 0; n <= last; ++n)
    ASSERT_THAT(error_of(text.substr(0, n)), HasSubstr("s.json")) << "first " << n << " bytes";
}

TEST(Strokes, RefusalsNameFileStrokeAndFrame) {
  std::vector<Stroke> strokes = {sample_stroke(1, 3), sample_stroke(2, 3)};
  std::string text = write_strokes(strokes);
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string t = text;
    const auto at = t.rfind(from);
    EXPECT_NE(at, std::string::npos);
    return t.replace(at, from.size(), to);
  };
  const std::string backwards = error_of(replaced("\"time_s\":0.02222", "\"time_s\":-0.02222"));
  EXPECT_THAT(backwards, HasSubstr("s.json: stroke 1"));
  EXPECT_THAT(backwards, HasSubstr("frame 2"));
  EXPECT_THAT(backwards, HasSubstr("backwards"));
  // JSON has no NaN: the token is an error with its byte, null a value of the wrong kind.
  EXPECT_THAT(error_of(replaced("\"trigger\":0.75", "\"trigger\":NaN")), HasSubstr("at byte"));
  EXPECT_THAT(error_of(replaced("\"trigger\":0.75", "\"trigger\":null")),
              HasSubstr("frame 2: trigger"));
  EXPECT_THAT(error_of(replaced("\"trigger\":0.75", "\"trigger\":1e999")), HasSubstr("s.json"));
  EXPECT_THAT(error_of(replaced("\"trigger\"", "\"tiger\"")), HasSubstr("'trigger' is missing"));
  EXPECT_THAT(error_of(replaced("\"orientation\":[", "\"orientation\":[2,")),
              HasSubstr("array of 4"));
  EXPECT_THAT(error_of(replaced("\"version\":1", "\"version\":7")), HasSubstr("version 7"));
  EXPECT_THAT(error_of(replaced("\"openxr\"", "\"maya\"")), HasSubstr("'maya'"));
  EXPECT_THAT(error_of(replaced("mimicry-strokes", "mimicry-curves")),
              HasSubstr("is not a mimicry-strokes"));
  EXPECT_THAT(error_of("{}"), HasSubstr("no array 'strokes'"));
  EXPECT_THAT(error_of("[1,2]"), HasSubstr("no array 'strokes'"));
  EXPECT_THAT(error_of("{\"strokes\":[]}"), HasSubstr("must stand before"));
  EXPECT_THAT(error_of(""), HasSubstr("ends early"));
}

TEST(Strokes, OneWithAFaultIsLeftOutAndNamedAndTheOthersAreRead) {
  std::vector<Stroke> strokes = {sample_stroke(1, 3), sample_stroke(2, 3), sample_stroke(3, 3),
                                 sample_stroke(4, 3)};
  for (std::size_t i = 0; i < strokes.size(); ++i) strokes[i].id = "s" + std::to_string(i);
  const std::string text = write_strokes(strokes);
  const auto second = text.find("\"s1\"");
  const auto third = text.find("\"s2\"");
  // In the second frame of the second stroke.
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string t = text;
    const auto at = t.find(from, t.find("\"time_s\":0.0111", second));
    EXPECT_LT(at, third) << from;
    return t.replace(at, from.size(), to);
  };
  struct Fault {
    std::string text, said;
  };
  const Fault faults[] = {
      {with("\"orientation\":[", "\"orientation\":[0,0,0,0],\"was\":["), "quaternion of length 0"},
      {with("\"trigger\":0.75", "\"trigger\":null"), "trigger: is not a number"},
      {with("\"trigger\":0.75", "\"trigger\":NaN"), "not JSON at byte"},
      {with("\"position\":[", "\"position\":[1,"), "is not an array of 3"},
      {with("\"time_s\"", "\"tame_s\""), "'time_s' is missing"},
      {with("\"time_s\":0.0111", "\"time_s\":-0.0111"), "backwards"},
  };
  for (const Fault& fault : faults) {
    const StrokesFile file = read_strokes(fault.text, "s.json");
    ASSERT_EQ(file.strokes.size(), 3u) << fault.said;
    EXPECT_EQ(file.strokes[0].id, "s0");
    EXPECT_EQ(file.strokes[1].id, "s2");
    EXPECT_EQ(file.strokes[2].id, "s3");
    EXPECT_THAT(file.numbers, testing::ElementsAre(0u, 2u, 3u));
    ASSERT_EQ(file.left_out.size(), 1u);
    EXPECT_THAT(file.left_out[0], HasSubstr("s.json: stroke 1: "));
    EXPECT_THAT(file.left_out[0], HasSubstr("frame 1"));
    EXPECT_THAT(file.left_out[0], HasSubstr(fault.said));
    EXPECT_THAT(file.left_out[0], HasSubstr("again")) << "the remedy";
  }
  // The byte is the file's.
  const std::string not_json = with("\"trigger\":0.75", "\"trigger\":NaN");
  const std::string said = read_strokes(not_json, "s.json").left_out.at(0);
  const auto byte = std::stoul(said.substr(said.find("at byte ") + 8));
  EXPECT_EQ(not_json.substr(byte - 1, 3), "NaN") << said;
}

TEST(Strokes, FileThatIsCutOffGivesTheStrokesBeforeTheCut) {
  const std::vector<Stroke> strokes = {sample_stroke(1, 3), sample_stroke(2, 3)};
  const std::string text = write_strokes(strokes);
  const StrokesFile file = read_strokes(text.substr(0, text.size() - 100), "s.json");
  EXPECT_EQ(file.strokes.size(), 1u);
  ASSERT_EQ(file.left_out.size(), 1u);
  EXPECT_THAT(file.left_out[0], HasSubstr("s.json: stroke 1: frame 2: the text ends early"));
}

TEST(Strokes, ByteOrderMarkIsPassedOverAndUtf16IsNamed) {
  const Stroke written = sample_stroke(1, 2);
  const std::string text = write_strokes(std::span(&written, 1));
  EXPECT_EQ(read_strokes("\xEF\xBB\xBF" + text, "s.json").strokes.size(), 1u);
  std::string wide;
  for (const char c : text) wide.append(1, c).append(1, '\0');
  EXPECT_THAT(error_of(wide), HasSubstr("s.json: is text in UTF-16"));
  EXPECT_THAT(error_of("\xFF\xFE" + wide), HasSubstr("save it as UTF-8"));
}

TEST(Strokes, FaultOfTheFileIsToldOnce) {
  const std::vector<Stroke> strokes = {sample_stroke(1, 1), sample_stroke(2, 1)};
  std::string text = write_strokes(strokes);
  text.replace(text.find("openxr"), 6, "maya");
  EXPECT_THROW(read_strokes(text, "s.json"), Error);
}

// 50 frames into the second of three strokes an orientation is 0 0 0 0.
TEST(Strokes, RecordedFileWithOneBadFrame) {
  std::ifstream in(MIMICRY_CASES "/20-one-bad-frame/zero_quaternion.json", std::ios::binary);
  if (!in) GTEST_SKIP() << "no cases in " MIMICRY_CASES;
  std::stringstream text;
  text << in.rdbuf();
  const StrokesFile file = read_strokes(text.str(), "z.json");
  EXPECT_EQ(file.strokes.size(), 2u);
  EXPECT_THAT(file.numbers, testing::ElementsAre(0u, 2u));
  ASSERT_EQ(file.left_out.size(), 1u);
  EXPECT_THAT(file.left_out[0], HasSubstr("stroke 1"));
  EXPECT_THAT(file.left_out[0], HasSubstr("frame 50"));
}

TEST(Strokes, NonUnitQuaternionIsRefused) {
  const Stroke written = sample_stroke(1, 1);
  std::string text = write_strokes(std::span(&written, 1));
  const auto at = text.find("\"orientation\":[") + 15;
  text.replace(at, text.find(']', at) - at, "0,0,0,2");
  EXPECT_THAT(error_of(text), HasSubstr("quaternion of length 2"));
}

TEST(Strokes, UnusableStrokeIsNotWritten) {
  Stroke bad = sample_stroke(1, 2);
  bad.frames[1].time_s = -5;
  std::string text;
  StrokeWriter writer([&](std::string_view piece) { text += piece; });
  EXPECT_THROW(writer.write(bad), Error);
  writer.finish();
  EXPECT_TRUE(read_strokes(text, "s.json").strokes.empty());
}

}  // namespace
}  // namespace mimicry
