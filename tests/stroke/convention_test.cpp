#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include <mimicry/stroke/stroke.h>

namespace mimicry {
namespace {

// acos resolves angles near 0 to the square root of rounding only: compare with 1e-7.
double angle_between(const Quat& a, const Quat& b) {
  return 2.0 * std::acos(std::min(1.0, std::abs(a.normalized().dot(b.normalized()))));
}

TEST(CoordinateConvention, RoundTripsOfPosesAreTheIdentity) {
  Frame frame;
  frame.time_s = 1.5;
  frame.head = {Vec3(0.1, 1.7, -0.3), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))};
  frame.controller = {Vec3(-0.2, 1.1, 0.4),
                      Quat(Eigen::AngleAxisd(3.0, Vec3(-2, 1, 1).normalized()))};
  for (const CoordinateConvention& c : conventions()) {
    SCOPED_TRACE(std::string(c.name));
    const Frame back = c.frame_in(c.frame_out(frame));
    EXPECT_LT((back.head.position - frame.head.position).norm(), 1e-15);
    EXPECT_LT((back.controller.position - frame.controller.position).norm(), 1e-15);
    // Up to the sign of the double cover, the same bits.
    EXPECT_EQ(back.head.orientation.toRotationMatrix(), frame.head.orientation.toRotationMatrix());
    EXPECT_EQ(back.controller.orientation.toRotationMatrix(),
              frame.controller.orientation.toRotationMatrix());
    EXPECT_EQ(back.time_s, frame.time_s);
  }
}

TEST(CoordinateConvention, EachProgramsUpAndForwardBecomeOurs) {
  struct Case {
    const char* name;
    Vec3 forward, up, right;
    double metre;
  };
  const Case cases[] = {{"openxr", -Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX(), 1.0},
                        {"unity", Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX(), 1.0},
                        {"unreal", Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY(), 100.0}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const CoordinateConvention* convention = find_convention(c.name);
    ASSERT_NE(convention, nullptr);
    EXPECT_EQ(convention->position_in(c.metre * c.forward), -Vec3::UnitZ());
    EXPECT_EQ(convention->position_in(c.metre * c.up), Vec3::UnitY());
    EXPECT_EQ(convention->position_in(c.metre * c.right), Vec3::UnitX());
    EXPECT_LT(angle_between(convention->orientation_in(Quat::Identity()), Quat::Identity()), 1e-12);
  }
}

TEST(CoordinateConvention, PaperSpraysAlongPlusZ) {
  const CoordinateConvention* paper = find_convention("paper");
  ASSERT_NE(paper, nullptr);
  const Pose pose{Vec3::Zero(), paper->orientation_in(Quat::Identity())};
  EXPECT_LT((pose.forward() - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((pose.up() - Vec3::UnitY()).norm(), 1e-15);
}

TEST(CoordinateConvention, LeftHandedTurnsBecomeTheSameMotionSeenInOurAxes) {
  // Unity turns the view to the right with a positive angle about y; ours is a negative one.
  const Quat unity(Eigen::AngleAxisd(std::numbers::pi / 6, Vec3::UnitY()));
  const Quat ours = find_convention("unity")->orientation_in(unity);
  EXPECT_LT(angle_between(ours, Quat(Eigen::AngleAxisd(-std::numbers::pi / 6, Vec3::UnitY()))),
            1e-7);
}

TEST(CoordinateConvention, PlacedModelStandsWhereTheOtherProgramShowsIt) {
  // A vertex converted by the axes and then placed as the other program does, is where ours is.
  const Similarity ours{Quat(Eigen::AngleAxisd(0.8, Vec3(1, -2, 0.5).normalized())),
                        Vec3(0.3, 1, -2), 0.4};
  const Vec3 vertex(0.7, -0.2, 1.1);
  for (const CoordinateConvention& c : conventions()) {
    SCOPED_TRACE(std::string(c.name));
    const Similarity theirs = c.placement_out(ours);
    const Vec3 shown = theirs.point(c.world_axes.transpose() * vertex);
    EXPECT_LT((c.position_in(shown) - ours.point(vertex)).norm(), 1e-14);
    const Similarity back = c.placement_in(theirs);
    EXPECT_LT((back.point(vertex) - ours.point(vertex)).norm(), 1e-14);
  }
}

TEST(CoordinateConvention, UnknownNameIsNull) {
  EXPECT_EQ(find_convention("blender"), nullptr);
}

}  // namespace
}  // namespace mimicry
