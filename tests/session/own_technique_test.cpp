#include <array>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>

#include "support/allocations.h"

namespace mimicry {
namespace {

using testing::HasSubstr;

// A technique in one file and one row: it draws at the closest point to the pen, moved by `lift`,
// of every second frame or of all, as often as its memory lets it.
enum class Every : std::int32_t { frame, second };
struct LiftOptions {
  Vec3 direction = Vec3::UnitZ();
  double lift = 0.0;
  bool still = false;
  Every every = Every::frame;
};
struct LiftMemory {
  int frames = 0;
  std::array<double, 1000> heights{};  // larger than any memory of the library's own
};

Stepped<LiftMemory> lift_step(const Canvas& canvas, const LiftMemory& memory, const Frame& frame,
                              const LiftOptions& options) {
  LiftMemory next = memory;
  next.heights[static_cast<std::size_t>(next.frames) % next.heights.size()] =
      frame.controller.position.z();
  ++next.frames;
  if (options.still || (options.every == Every::second && memory.frames % 2 == 1))
    return {{}, next};
  const auto closest =
      canvas.target.closest_point(frame.controller.position + options.lift * options.direction);
  return {{Answer::closest, closest->surface, closest->position}, next};
}

TechniqueInfo lift_row(const std::string& name) {
  TechniqueInfo row;
  row.name = name;
  row.color = 0x123456;
  row.steering = Steering::aims;
  row.options = {option<LiftOptions>("direction", &LiftOptions::direction, "where to"),
                 option<LiftOptions>("lift", &LiftOptions::lift, "how far",
                                     {.unit = "units", .lowest = -1.0, .highest = 2.0}),
                 option<LiftOptions>("still", &LiftOptions::still, "draw nothing"),
                 option<LiftOptions>("every", &LiftOptions::every, "which frames",
                                     {.choices = {"frame", "second"}})};
  row.set_step(lift_step);
  return row;
}

const TechniqueInfo& lift() {
  static const TechniqueInfo& row = register_technique(lift_row("test-lift"));
  return row;
}

Stroke wave() {
  Stroke stroke;
  for (int i = 0; i < 60; ++i) {
    Frame frame;
    frame.time_s = i / 90.0;
    frame.controller.position = Vec3(0.01 * i - 0.3, 0.2 * std::sin(0.1 * i), 1.3);
    stroke.frames.push_back(frame);
  }
  return stroke;
}

void set(TechniqueOptions& options, std::string_view name, double value) {
  set_option(lift(), options, name, {&value, 1});
}

TEST(OwnTechnique, IsDrawnWithReplayedAndListed) {
  const Target target(make_sphere(8));
  const std::size_t before = techniques().size();
  EXPECT_EQ(&lift(), &techniques()[before]) << "it is added at the end";
  EXPECT_EQ(&find_technique("test-lift"), &lift());
  EXPECT_EQ(lift().title, "test-lift") << "the name stands for a missing title";
  EXPECT_EQ(lift().source, "-") << "it is of no paper";

  const Stroke stroke = wave();
  StrokeSession session({target}, lift());
  for (const int pass : {1, 2}) {
    session.begin(stroke.model_to_world);
    for (const Frame& frame : stroke.frames)
      ASSERT_EQ(session.add(frame), FrameStatus::inked) << pass;
    session.end();
  }
  const ProjectedCurve again = project({target}, lift(), stroke).curve;
  ASSERT_EQ(session.curve().points.size(), 60u);
  ASSERT_EQ(again.points.size(), 60u);
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_EQ(again.points[i].position, session.curve().points[i].position);
    EXPECT_EQ(again.points[i].position,
              target.closest_point(stroke.frames[i].controller.position)->position);
  }
}

TEST(OwnTechnique, HasOptionsOfEveryKind) {
  const Target target(make_sphere(8));
  SessionOptions options;
  set(options.technique, "every", 1.0);
  EXPECT_EQ(project({target}, lift(), wave(), options).curve.points.size(), 30u)
      << "the memory counts frames from the stroke's start";
  set(options.technique, "still", 1.0);
  EXPECT_EQ(project({target}, lift(), wave(), options).curve.points.size(), 0u);
  set(options.technique, "still", 0.0);
  set(options.technique, "lift", -0.5);
  const std::array<double, 3> up = {0, 1, 0};
  set_option(lift(), options.technique, "direction", up);
  const Stroke stroke = wave();
  const ProjectedCurve lifted = project({target}, lift(), stroke, options).curve;
  const Vec3 query = stroke.frames[0].controller.position - 0.5 * Vec3::UnitY();
  EXPECT_EQ(lifted.points[0].position, target.closest_point(query)->position);

  EXPECT_THROW(set(options.technique, "still", 0.5), Error);
  EXPECT_THROW(set(options.technique, "every", 2.0), Error);
  EXPECT_THROW(set(options.technique, "every", 0.5), Error);
  EXPECT_THROW(set(options.technique, "lift", 2.5), Error);
  EXPECT_THROW(set(options.technique, "lift", std::nan("")), Error);
}

TEST(OwnTechnique, OptionsOfAnotherTechniqueAreRefused) {
  const Target target(make_sphere(8));
  SessionOptions options;
  set(options.technique, "lift", 0.5);
  try {
    StrokeSession session({target}, find_technique("spraycan"), options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("test-lift"));
    EXPECT_THAT(error.what(), HasSubstr("spraycan"));
  }
}

TEST(OwnTechnique, AllocatesNothingInAFrame) {
  const Target target(make_sphere(8));
  const Stroke stroke = wave();
  StrokeSession session({target}, lift());
  session.begin(stroke.model_to_world);
  session.add(stroke.frames[0]);
  const long before = test::allocation_count();
  for (std::size_t i = 1; i < stroke.frames.size(); ++i) session.add(stroke.frames[i]);
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_EQ(session.curve().points.size(), stroke.frames.size());
}

std::string refusal(TechniqueInfo row) {
  try {
    register_technique(std::move(row));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  return "";
}

TEST(OwnTechnique, WhatIsNotSoundIsRefused) {
  const std::size_t count = techniques().size();
  EXPECT_THAT(refusal(lift_row("spraycan")), HasSubstr("exists already"));
  EXPECT_THAT(refusal(lift_row("Test")), HasSubstr("lower case"));
  EXPECT_THAT(refusal(lift_row("")), HasSubstr("lower case"));
  EXPECT_THAT(refusal(lift_row("two words")), HasSubstr("lower case"));
  EXPECT_THAT(refusal(lift_row("two--words")), HasSubstr("lower case"));
  TechniqueInfo row = lift_row("test-unsound");
  row.step = nullptr;
  EXPECT_THAT(refusal(row), HasSubstr("no step"));
  row = lift_row("test-unsound");
  row.options[1].name = "direction";
  EXPECT_THAT(refusal(row), HasSubstr("two options 'direction'"));
  row = lift_row("test-unsound");
  row.options[0].offset = sizeof(LiftOptions) - 8;
  EXPECT_THAT(refusal(row), HasSubstr("outside the block"));
  row = lift_row("test-unsound");
  row.options[1].offset += 1;
  EXPECT_THAT(refusal(row), HasSubstr("where no member of its kind can"));
  row = lift_row("test-unsound");
  row.options[3].choices = {"frame", "frame"};
  EXPECT_THAT(refusal(row), HasSubstr("two choices 'frame'"));
  row = lift_row("test-unsound");
  row.options[1].lowest = 1.0;
  EXPECT_THAT(refusal(row), HasSubstr("its default"));
  row = lift_row("test-unsound");
  row.color = 0x1000000;
  EXPECT_THAT(refusal(row), HasSubstr("0xrrggbb"));
  EXPECT_EQ(techniques().size(), count);
}

TEST(OwnTechnique, APointOffTheMeshIsAMiss) {
  const double nan = std::nan("");
  const TechniqueStep sound{Answer::closest, {0, Vec3(0.5, 0.25, 0.25)}, Vec3::Zero()};
  const auto drawn = [](const TechniqueStep& step) {
    TechniqueInfo row = lift_row("test-off");
    row.step = [step](const Canvas&, const Frame&, const void*, void*) { return step; };
    StrokeSession session({Target(make_sphere(4))}, row);
    session.begin({});
    const bool inked = session.add(Frame{}) == FrameStatus::inked;
    EXPECT_EQ(session.curve().points.size(), inked ? 1u : 0u);
    EXPECT_EQ(session.answers()[Answer::closest], inked ? 1 : 0);
    EXPECT_EQ(session.answers()[Answer::miss], inked ? 0 : 1);
    return inked;
  };
  EXPECT_TRUE(drawn(sound));
  const auto misses = [&](auto&& change) {
    TechniqueStep step = sound;
    change(step);
    EXPECT_FALSE(drawn(step));
  };
  for (const Index face : {Index{-1}, Index{1000000}})
    misses([&](TechniqueStep& step) { step.surface.face = face; });
  for (const Vec3& bary :
       {Vec3(0.5, 0.5, 0.5), Vec3(2.0, -1.0, 0.0), Vec3(nan, 0.5, 0.5), Vec3(0.0, 0.0, 0.0)})
    misses([&](TechniqueStep& step) { step.surface.bary = bary; });
  misses([&](TechniqueStep& step) { step.position.y() = nan; });
  misses([](TechniqueStep& step) { step.answer = static_cast<Answer>(200); });
}

TEST(StrokeSession, ACanvasWithoutWhatTheTechniqueNeedsIsRefused) {
  const Target target(make_sphere(4));
  const auto why = [](const Canvas& canvas, const char* technique) -> std::string {
    try {
      StrokeSession session(canvas, find_technique(technique));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(why({}, "snap"), HasSubstr("no target"));
  EXPECT_THAT(why({target}, "mimicry"), HasSubstr("'mimicry' needs the target's bake"));
  EXPECT_EQ(why({target}, "snap"), "");
}

#ifndef __EMSCRIPTEN__  // which has no threads
TEST(OwnTechnique, AreRegisteredFromSeveralThreadsAtOnce) {
  const std::size_t count = techniques().size();
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([t] {
      for (int i = 0; i < 4; ++i) {
        const std::string name = "test-" + std::to_string(t) + "-" + std::to_string(i);
        const TechniqueInfo& row = register_technique(lift_row(name));
        EXPECT_EQ(&find_technique(name), &row);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(techniques().size(), count + 16);
}
#endif

}  // namespace
}  // namespace mimicry
