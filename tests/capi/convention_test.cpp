#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/mimicry.h>

#include "handles.h"

namespace {

using namespace mimicry::test;
using testing::HasSubstr;

TEST(CApiConventions, AreListed) {
  std::vector<std::string> names;
  for (int32_t i = 0; i < mimicry_convention_count(); ++i)
    names.emplace_back(mimicry_convention(i));
  EXPECT_THAT(names, testing::IsSupersetOf({"openxr", "unity", "unreal", "paper"}));
  EXPECT_EQ(mimicry_convention(-1), nullptr);
  EXPECT_EQ(mimicry_convention(100), nullptr);
}

TEST(CApiConventions, EnginesPosesComeInAndGoOut) {
  // Ahead, up and to the right of the origin, in each engine's own words.
  const double ours[] = {0.2, 1.5, -0.4};
  const double unity[] = {0.2, 1.5, 0.4};
  const double unreal[] = {40, 20, 150};
  double x[3];
  ASSERT_EQ(mimicry_positions_in("unity", unity, 1, x), MIMICRY_OK);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(x[k], ours[k], 1e-15);
  ASSERT_EQ(mimicry_positions_in("unreal", unreal, 1, x), MIMICRY_OK);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(x[k], ours[k], 1e-15);
  ASSERT_EQ(mimicry_positions_out("unreal", x, 1, x), MIMICRY_OK) << "in place";
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(x[k], unreal[k], 1e-12);
  // Directions have no unit of length.
  ASSERT_EQ(mimicry_axes_in("unreal", unreal, 1, x), MIMICRY_OK);
  EXPECT_DOUBLE_EQ(x[1], 150.0);
  ASSERT_EQ(mimicry_axes_out("unreal", x, 1, x), MIMICRY_OK);
  for (int k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(x[k], unreal[k]);

  const auto frames = wave(20);
  for (int32_t c = 0; c < mimicry_convention_count(); ++c) {
    std::vector<mimicry_frame> there(20), back(20);
    ASSERT_EQ(mimicry_frames_out(mimicry_convention(c), frames.data(), 20, there.data()),
              MIMICRY_OK);
    ASSERT_EQ(mimicry_frames_in(mimicry_convention(c), there.data(), 20, back.data()), MIMICRY_OK);
    for (std::size_t i = 0; i < 20; ++i) {
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(back[i].controller_position[k], frames[i].controller_position[k], 1e-15);
      EXPECT_NEAR(std::abs(back[i].head_orientation[3]), 1.0, 1e-15);
      EXPECT_EQ(back[i].pressure, frames[i].pressure);
    }
    mimicry_similarity placed{}, again{};
    ASSERT_EQ(mimicry_placement_out(mimicry_convention(c), &kPlaced, &placed), MIMICRY_OK);
    ASSERT_EQ(mimicry_placement_in(mimicry_convention(c), &placed, &again), MIMICRY_OK);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(again.translation[k], kPlaced.translation[k], 1e-15);
    EXPECT_NEAR(again.scale, kPlaced.scale, 1e-15);
  }
}

// A stroke on a mesh of Unity's, in Unity's coordinates, is the stroke on the mesh itself.
TEST(CApiConventions, AMeshOfUnitysIsDrawnOnAsItself) {
  const auto ours = make<Mesh>(mimicry_mesh_shape, "hand", 0);
  const auto unitys = make<Mesh>(mimicry_mesh_out, "unity", ours.get());
  const double *a = mimicry_mesh_positions(ours.get()), *b = mimicry_mesh_positions(unitys.get());
  EXPECT_EQ(a[2], -b[2]);
  const int32_t *f = mimicry_mesh_faces(ours.get()), *g = mimicry_mesh_faces(unitys.get());
  EXPECT_EQ(f[0], g[0]);
  EXPECT_EQ(f[1], g[2]);
  EXPECT_EQ(f[2], g[1]);

  const auto back = make<Mesh>(mimicry_mesh_in, "unity", unitys.get());
  mimicry_mesh_report report;
  ASSERT_EQ(mimicry_mesh_validate(back.get(), &report), MIMICRY_OK);
  EXPECT_GT(report.volume, 0.0) << "faces look outward";
  const auto theirs = make<Target>(mimicry_target_make, back.get(), nullptr);
  const Target target = target_of("hand");
  auto frames = wave(30);
  std::vector<mimicry_frame> unity_frames(30), converted(30);
  ASSERT_EQ(mimicry_frames_out("unity", frames.data(), 30, unity_frames.data()), MIMICRY_OK);
  EXPECT_EQ(unity_frames[3].controller_position[2], -frames[3].controller_position[2]);
  ASSERT_EQ(mimicry_frames_in("unity", unity_frames.data(), 30, converted.data()), MIMICRY_OK);
  const auto length = [&](const Target& on, const std::vector<mimicry_frame>& stroke) {
    const auto session = make<Session>(mimicry_session_create, on.get(), "snap");
    const auto curve =
        make<Curve>(mimicry_session_project, session.get(), &kPlaced, stroke.data(), stroke.size());
    EXPECT_EQ(mimicry_curve_point_count(curve.get()), 30u);
    return mimicry_curve_length(curve.get());
  };
  EXPECT_EQ(length(theirs, converted), length(target, frames));
}

TEST(CApiConventions, BadInputIsRefused) {
  double x[] = {1, 2, 3};
  mimicry_frame frame = wave(1)[0];
  mimicry_similarity placed = kPlaced;
  EXPECT_EQ(mimicry_positions_in("godot", x, 1, x), MIMICRY_INVALID_INPUT);
  EXPECT_THAT(mimicry_last_error(), HasSubstr("unreal"));
  EXPECT_EQ(mimicry_positions_in(nullptr, x, 1, x), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mimicry_positions_out("unity", nullptr, 1, x), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mimicry_axes_in("unity", x, 1, nullptr), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mimicry_axes_out("unity", nullptr, 0, nullptr), MIMICRY_OK);
  EXPECT_EQ(mimicry_frames_in("unity", nullptr, 1, &frame), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mimicry_frames_out("unity", &frame, 1, nullptr), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mimicry_placement_in("unity", &placed, nullptr), MIMICRY_INVALID_INPUT);
  placed.scale = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(mimicry_placement_in("unity", &placed, &placed), MIMICRY_INVALID_INPUT);
  mimicry_mesh* none = nullptr;
  EXPECT_EQ(mimicry_mesh_in("unity", nullptr, &none), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(none, nullptr);
}

}  // namespace
