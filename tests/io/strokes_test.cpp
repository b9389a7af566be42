#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/io/strokes.h>

namespace mimicry::io {
namespace {

using stroke::Frame;
using stroke::Stroke;
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
  stroke.intended =
      stroke::Intention{"ring", true, {{3, Vec3(0.25, 0.5, 0.25)}, {4, Vec3(1, 0, 0)}}};
  return stroke;
}

std::string error_of(const std::string& text) {
  try {
    read_strokes(text, "s.json");
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
  const std::vector<Stroke> read = read_strokes(text, "s.json");
  EXPECT_EQ(read[0].simulated->program, "mimicry 0.1.0");
  EXPECT_EQ(read[0].simulated->seed, 18446744073709551615u);
  EXPECT_EQ(read[0].simulated->technique, "snap");
  EXPECT_EQ(read[1].simulated->technique, "");
  EXPECT_FALSE(read[2].simulated);
  EXPECT_EQ(write_strokes(read), text);
  std::string broken = text;
  broken.replace(broken.find("\"seed\":0"), 8, "\"seed\":-1");
  EXPECT_THAT(error_of(broken), HasSubstr("stroke 1: simulated: seed"));
}

TEST(Strokes, ReadBackToTheSameBits) {
  const std::vector<Stroke> written = {sample_stroke(1, 40), sample_stroke(2, 0),
                                       sample_stroke(3, 1)};
  const std::vector<Stroke> read = read_strokes(write_strokes(written), "s.json");
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
  for (const auto& convention : stroke::conventions()) {
    SCOPED_TRACE(std::string(convention.name));
    const auto read = read_strokes(write_strokes(std::span(&written, 1), convention), "s.json");
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
  EXPECT_TRUE(read_strokes(text, "s.json").empty());
}

}  // namespace
}  // namespace mimicry::io
