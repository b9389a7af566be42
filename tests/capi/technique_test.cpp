#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/mimicry.h>

#include "handles.h"
#include "support/allocations.h"

namespace {

using namespace mimicry::test;
using testing::HasSubstr;

TEST(CApiTechniques, RowsSayAllThatAPageShows) {
  std::set<std::string> titles;
  std::set<uint32_t> colors;
  int aimed = 0;
  ASSERT_GE(mimicry_technique_count(), 13);
  for (int i = 0; i < 13; ++i) {
    const mimicry_technique_info& info = *mimicry_technique(i);
    EXPECT_TRUE(titles.insert(info.title).second) << info.name;
    EXPECT_TRUE(colors.insert(info.color).second) << info.name;
    EXPECT_GT(std::strlen(info.sentence), 10u) << info.name;
    aimed += info.steering == MIMICRY_AIMED;
    for (int k = 0; k < info.option_count; ++k) {
      const mimicry_option_info& option = info.options[k];
      EXPECT_EQ(option.count, option.kind == MIMICRY_OPTION_DIRECTION ? 3 : 1) << option.name;
      EXPECT_LE(option.lowest, option.highest);
    }
  }
  EXPECT_EQ(aimed, 1);
  const mimicry_technique_info& spray = *mimicry_technique(1);
  EXPECT_STREQ(spray.name, "spraycan");
  EXPECT_EQ(spray.steering, MIMICRY_AIMED);
  EXPECT_EQ(spray.color, 0xd55e00u);
  EXPECT_EQ(spray.options[0].kind, MIMICRY_OPTION_DIRECTION);
  EXPECT_EQ(spray.options[0].defaults[2], -1.0);
  EXPECT_EQ(spray.options[1].kind, MIMICRY_OPTION_BOOLEAN);
}

// What the callback below was last given.
struct Seen {
  int calls = 0;
  double metres_per_unit = 0.0;
  std::vector<double> options;
  int answer = MIMICRY_CLOSEST;
  double stretch = 1.0;  // of barycentrics
  int32_t face_offset = 0;
};

// Counts its frames in its memory and draws at the closest point of the frames that `every` names.
mimicry_answer step(void* user, const mimicry_target* target, const mimicry_frame* frame,
                    double metres_per_unit, const double* options, void* memory,
                    mimicry_surface_point* point) {
  Seen& seen = *static_cast<Seen*>(user);
  ++seen.calls;
  seen.metres_per_unit = metres_per_unit;
  for (std::size_t i = 0; i < seen.options.size(); ++i) seen.options[i] = options[i];
  int32_t& frames = *static_cast<int32_t*>(memory);
  if (frames++ % static_cast<int32_t>(1.0 + options[4]) != 0) return MIMICRY_NO_POINT;
  if (mimicry_target_closest_point(target, frame->controller_position,
                                   std::numeric_limits<double>::infinity(), -1, point))
    return MIMICRY_NO_POINT;
  for (double& b : point->barycentric) b *= seen.stretch;
  point->face += seen.face_offset;
  return static_cast<mimicry_answer>(seen.answer);
}

Seen& seen() {
  static Seen one;
  return one;
}

struct Row {
  const char* choices[3] = {"all", "second", "third"};
  mimicry_option_info options[3]{};
  mimicry_own_technique own{};

  explicit Row(const char* name) {
    options[0].name = "towards";
    options[0].kind = MIMICRY_OPTION_DIRECTION;
    options[0].defaults[1] = 1.0;
    options[0].lowest = -1.0;
    options[0].highest = 1.0;
    options[1].name = "size";
    options[1].unit = "m";
    options[1].kind = MIMICRY_OPTION_NUMBER;
    options[1].defaults[0] = 0.25;
    options[1].highest = 2.0;
    options[2].name = "every";
    options[2].kind = MIMICRY_OPTION_CHOICE;
    options[2].choices = choices;
    options[2].choice_count = 3;
    own.name = name;
    own.sentence = "Draws at the closest point now and then.";
    own.options = options;
    own.option_count = 3;
    own.color = 0xabcdef;
    own.steering = MIMICRY_MOVED;
    own.memory_size = sizeof(int32_t);
    own.step = step;
    own.user = &seen();
  }
};

int32_t registered() {
  static const int32_t number = [] {
    const Row row("test-now-and-then");
    int32_t n = -1;
    EXPECT_EQ(mimicry_technique_register(&row.own, &n), MIMICRY_OK) << mimicry_last_error();
    return n;
  }();
  return number;
}

TEST(CApiTechniques, OneOfTheCallersIsListedAndDrawnWith) {
  const mimicry_technique_info* info = mimicry_technique(registered());
  ASSERT_NE(info, nullptr);
  EXPECT_STREQ(info->name, "test-now-and-then");
  EXPECT_STREQ(info->title, "test-now-and-then");
  EXPECT_STREQ(info->source, "-");
  EXPECT_EQ(info->color, 0xabcdefu);
  ASSERT_EQ(info->option_count, 3);
  EXPECT_EQ(info->options[2].choice_count, 3);
  EXPECT_STREQ(info->options[2].choices[1], "second");
  EXPECT_EQ(mimicry_technique(mimicry_technique_count()), nullptr);

  const Target target = target_of("hand");
  const auto session = make<Session>(mimicry_session_create, target.get(), "test-now-and-then");
  const auto snap = make<Session>(mimicry_session_create, target.get(), "snap");
  const auto frames = wave(60);
  seen() = {};
  seen().options.resize(5);
  const auto drawn =
      make<Curve>(mimicry_session_project, session.get(), &kPlaced, frames.data(), frames.size());
  const auto snapped =
      make<Curve>(mimicry_session_project, snap.get(), &kPlaced, frames.data(), frames.size());
  EXPECT_EQ(seen().calls, 60);
  EXPECT_EQ(seen().metres_per_unit, 0.5);
  EXPECT_EQ(seen().options, (std::vector<double>{0, 1, 0, 0.25, 0}));
  ASSERT_EQ(mimicry_curve_point_count(drawn.get()), 60u);
  for (std::size_t i = 0; i < 60; ++i) {
    mimicry_curve_point a, b;
    ASSERT_EQ(mimicry_curve_point_at(drawn.get(), i, &a), MIMICRY_OK);
    ASSERT_EQ(mimicry_curve_point_at(snapped.get(), i, &b), MIMICRY_OK);
    ASSERT_EQ(a.face, b.face);
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(a.position[k], b.position[k], 1e-15);
  }

  const double third = 2.0, half = 0.5;
  ASSERT_EQ(mimicry_session_set_option(session.get(), "every", &third, 1), MIMICRY_OK);
  for (const int pass : {1, 2}) {  // the memory is 0 again when a stroke starts
    const auto some =
        make<Curve>(mimicry_session_project, session.get(), &kPlaced, frames.data(), frames.size());
    EXPECT_EQ(mimicry_curve_point_count(some.get()), 20u) << pass;
  }
  EXPECT_EQ(mimicry_session_set_option(session.get(), "every", &half, 1), MIMICRY_INVALID_INPUT);
}

TEST(CApiTechniques, PointsOffTheTargetAreNone) {
  ASSERT_GE(registered(), 0);
  const Target target = target_of("sphere", 4);
  const auto session = make<Session>(mimicry_session_create, target.get(), "test-now-and-then");
  const auto frames = wave(10);
  const auto points = [&] {
    const auto curve =
        make<Curve>(mimicry_session_project, session.get(), &kPlaced, frames.data(), frames.size());
    return mimicry_curve_point_count(curve.get());
  };
  seen() = {};
  EXPECT_EQ(points(), 10u);
  for (const double stretch : {0.5, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    seen().stretch = stretch;
    EXPECT_EQ(points(), 0u) << stretch;
  }
  seen() = {};
  for (const int32_t offset : {1'000'000, -1'000'000}) {
    seen().face_offset = offset;
    EXPECT_EQ(points(), 0u) << offset;
  }
  seen() = {};
  for (const int answer : {0, -1, 8, 1000}) {
    seen().answer = answer;
    EXPECT_EQ(points(), 0u) << answer;
  }
}

TEST(CApiTechniques, AFrameOfTheCallersAllocatesNothing) {
  ASSERT_GE(registered(), 0);
  const Target target = target_of("sphere", 4);
  const auto session = make<Session>(mimicry_session_create, target.get(), "test-now-and-then");
  seen() = {};
  const auto frames = wave(40);
  ASSERT_EQ(mimicry_session_begin(session.get(), &kPlaced), MIMICRY_OK);
  ASSERT_EQ(mimicry_session_add(session.get(), frames.data(), nullptr), MIMICRY_OK);
  const long before = mimicry::test::allocation_count();
  for (std::size_t i = 1; i < frames.size(); ++i)
    ASSERT_EQ(mimicry_session_add(session.get(), &frames[i], nullptr), MIMICRY_OK);
  EXPECT_EQ(mimicry::test::allocation_count(), before);
  EXPECT_EQ(seen().calls, 40);
  EXPECT_EQ(mimicry_session_ink_count(session.get()), 40u);
}

TEST(CApiTechniques, WhatIsNotSoundIsRefused) {
  const int32_t count = mimicry_technique_count();
  const auto refused = [&](Row& row, const char* why) {
    int32_t number = 77;
    EXPECT_EQ(mimicry_technique_register(&row.own, &number), MIMICRY_INVALID_INPUT) << why;
    EXPECT_THAT(mimicry_last_error(), HasSubstr(why));
    EXPECT_EQ(number, 77);
  };
  const auto wrong = [&](const char* why, auto&& change) {
    Row row("test-unsound");
    change(row);
    refused(row, why);
  };
  EXPECT_EQ(mimicry_technique_register(nullptr, nullptr), MIMICRY_INVALID_INPUT);
  wrong("exists already", [](Row& r) { r.own.name = "snap"; });
  wrong("lower case", [](Row& r) { r.own.name = "No Name"; });
  wrong("name is NULL", [](Row& r) { r.own.name = nullptr; });
  wrong("steered in no known way",
        [](Row& r) { r.own.steering = static_cast<mimicry_steering>(5); });
  wrong("'test-unsound': step is NULL", [](Row& r) { r.own.step = nullptr; });
  wrong("options is NULL", [](Row& r) { r.own.options = nullptr; });
  wrong("options; give 0 to 64", [](Row& r) { r.own.option_count = -1; });
  wrong("options; give 0 to 64", [](Row& r) { r.own.option_count = 65; });
  wrong("bytes of memory", [](Row& r) { r.own.memory_size = (std::size_t{1} << 20) + 1; });
  wrong("test-unsound: option 'towards' is of no known kind",
        [](Row& r) { r.options[0].kind = static_cast<mimicry_option_kind>(9); });
  wrong("its default", [](Row& r) { r.options[0].defaults[1] = 0.0; });
  wrong("its default", [](Row& r) { r.options[1].defaults[0] = 3.0; });
  wrong("its default",
        [](Row& r) { r.options[1].defaults[0] = std::numeric_limits<double>::quiet_NaN(); });
  wrong("its default", [](Row& r) { r.options[2].defaults[0] = 3.0; });
  wrong("its default", [](Row& r) { r.options[2].defaults[0] = kNaN; });
  wrong("test-unsound: option 'every', its default: 1.5",
        [](Row& r) { r.options[2].defaults[0] = 1.5; });
  for (const double off : {0.5, -1.0, kNaN})
    wrong("test-unsound: option 'size', its default", [off](Row& r) {
      r.options[1].kind = MIMICRY_OPTION_BOOLEAN;
      r.options[1].defaults[0] = off;
    });
  wrong("its lowest", [](Row& r) { r.options[1].lowest = kNaN; });
  wrong("its lowest", [](Row& r) { r.options[1].lowest = 2.5; });
  wrong("without names", [](Row& r) { r.options[2].choice_count = 0; });
  wrong("test-unsound: option 'every': choices is NULL",
        [](Row& r) { r.options[2].choices = nullptr; });
  wrong("two options 'size'", [](Row& r) { r.options[2].name = "size"; });
  wrong("lower case", [](Row& r) { r.options[2].name = nullptr; });
  EXPECT_EQ(mimicry_technique_count(), count);
}

}  // namespace
