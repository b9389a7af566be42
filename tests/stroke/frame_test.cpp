#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/stroke/stroke.h>

namespace mimicry {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Frame, ModelSpaceUndoesTheTargetsPlacement) {
  Similarity placed;
  placed.rotation = Quat(Eigen::AngleAxisd(0.9, Vec3(1, 1, 0).normalized()));
  placed.translation = Vec3(0.5, 1.2, -0.7);
  placed.scale = 0.25;
  Frame world;
  world.controller.position = placed.point(Vec3(1, 2, 3));
  world.controller.orientation = placed.rotation * Quat(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
  const Frame model = to_model(world, placed);
  EXPECT_LT((model.controller.position - Vec3(1, 2, 3)).norm(), 1e-14);
  EXPECT_LT((placed.direction(model.controller.forward()) - world.controller.forward()).norm(),
            1e-15);
}

TEST(Frame, ProblemsAreNamed) {
  EXPECT_FALSE(frame_problem(Frame{}));
  Frame frame;
  frame.time_s = kNan;
  EXPECT_THAT(*frame_problem(frame), HasSubstr("time"));
  frame = {};
  frame.head.position.y() = kNan;
  EXPECT_THAT(*frame_problem(frame), HasSubstr("head position"));
  frame = {};
  frame.controller.orientation = Quat(1.01, 0, 0, 0);
  EXPECT_THAT(*frame_problem(frame), HasSubstr("controller orientation"));
  frame = {};
  frame.trigger = 1.5;
  EXPECT_THAT(*frame_problem(frame), HasSubstr("trigger"));
  frame = {};
  frame.pressure = -0.1;
  EXPECT_THAT(*frame_problem(frame), HasSubstr("pressure"));
  EXPECT_THAT(*frame_problem(Frame{}, 1.0), HasSubstr("backwards"));
  EXPECT_FALSE(frame_problem(Frame{}, 0.0)) << "equal times are legal";
}

TEST(Stroke, RefusalNamesStrokeAndFrame) {
  Stroke stroke;
  stroke.id = "s7";
  EXPECT_NO_THROW(require_usable(stroke));
  stroke.frames.resize(3);
  stroke.frames[2].time_s = -1.0;
  try {
    require_usable(stroke);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("'s7'"));
    EXPECT_THAT(error.what(), HasSubstr("frame 2"));
  }
}

TEST(Stroke, PlacementThatIsNoSimilarityIsRefused) {
  Stroke stroke;
  stroke.model_to_world.scale = 0.0;
  EXPECT_THROW(require_usable(stroke), Error);
  stroke.model_to_world.scale = kNan;
  EXPECT_THROW(require_usable(stroke), Error);
}

}  // namespace
}  // namespace mimicry
