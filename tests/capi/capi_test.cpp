#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/io/curves.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mimicry.h>
#include <mimicry/session/stroke_session.h>

#include "handles.h"
#include "support/allocations.h"

extern "C" int draw_in_c(void);

namespace {

using namespace mimicry::test;
using testing::HasSubstr;

mimicry::Stroke stroke_of(const std::vector<mimicry_frame>& frames) {
  mimicry::Stroke s;
  s.model_to_world = {mimicry::Quat::Identity(), {0.1, 0.2, -0.3}, 0.5};
  for (const mimicry_frame& f : frames) {
    mimicry::Frame frame;
    frame.time_s = f.time_s;
    frame.head.position = mimicry::Vec3(f.head_position);
    frame.controller.position = mimicry::Vec3(f.controller_position);
    s.frames.push_back(frame);
  }
  return s;
}

std::string text(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(mimicry_bytes_data(bytes.get())),
          mimicry_bytes_size(bytes.get())};
}

Bytes write(const mimicry_target* target, std::vector<const mimicry_curve*> curves,
            mimicry_curve_format format) {
  return make<Bytes>(mimicry_curves_write, target, "shape", curves.data(), curves.size(), format,
                     static_cast<const uint8_t*>(nullptr), 0.01);
}

TEST(CApi, ACProgramDraws) {
  EXPECT_EQ(draw_in_c(), 0);
}

TEST(CApi, CurvesEqualTheLibrarysBitForBit) {
  const Target target = target_of("hand");
  const auto frames = wave(120);
  const mimicry::Target native(mimicry::make_shape("hand"));
  for (int i = 0; i < mimicry_technique_count(); ++i) {
    const mimicry_technique_info& info = *mimicry_technique(i);
    if (info.needs_bake) continue;
    const auto session = make<Session>(mimicry_session_create, target.get(), info.name);
    const auto curve =
        make<Curve>(mimicry_session_project, session.get(), &kPlaced, frames.data(), frames.size());
    const auto expected =
        mimicry::project({native}, mimicry::find_technique(info.name), stroke_of(frames)).curve;
    ASSERT_EQ(mimicry_curve_point_count(curve.get()), expected.points.size()) << info.name;
    for (std::size_t k = 0; k < expected.points.size(); ++k) {
      mimicry_curve_point p;
      ASSERT_EQ(mimicry_curve_point_at(curve.get(), k, &p), MIMICRY_OK);
      EXPECT_EQ(p.face, expected.points[k].surface.face);
      EXPECT_EQ(mimicry::Vec3(p.position), expected.points[k].position) << info.name << " " << k;
    }
    EXPECT_EQ(mimicry_curve_length(curve.get()), mimicry::length(expected));
    EXPECT_EQ(mimicry_curve_ink_count(curve.get()), mimicry_session_ink_count(session.get()));
  }
}

TEST(CApi, InkIsThePolylines) {
  const Target target = target_of("two-spheres");
  const auto session = make<Session>(mimicry_session_create, target.get(), "spraycan");
  ASSERT_EQ(mimicry_session_set_split_at_misses(session.get(), 1), MIMICRY_OK);
  auto frames = wave(300);
  for (auto& f : frames) f.controller_position[0] -= 0.3;
  const auto curve =
      make<Curve>(mimicry_session_project, session.get(), &kPlaced, frames.data(), frames.size());
  const mimicry::Target native(mimicry::make_shape("two-spheres"));
  mimicry::SessionOptions options;
  options.misses = mimicry::MissPolicy::split;
  const auto expected = mimicry::polylines(
      mimicry::project({native}, mimicry::find_technique("spraycan"), stroke_of(frames), options)
          .curve,
      native.mesh());
  ASSERT_GE(expected.size(), 2u) << "the stroke leaves the target once at least";
  const mimicry_ink* ink = mimicry_curve_ink(curve.get());
  for (const auto& part : expected)
    for (std::size_t i = 0; i < part.size(); ++i, ++ink) {
      EXPECT_EQ(ink->starts, i == 0);
      for (int k = 0; k < 3; ++k) EXPECT_EQ(ink->position[k], static_cast<float>(part[i][k]));
    }
  EXPECT_EQ(ink, mimicry_curve_ink(curve.get()) + mimicry_curve_ink_count(curve.get()));
}

TEST(CApi, AFrameAllocatesNothing) {
  const Target target = target_of("sphere");
  const auto session = make<Session>(mimicry_session_create, target.get(), "mimicry-live");
  ASSERT_EQ(mimicry_session_begin(session.get(), &kPlaced), MIMICRY_OK);
  const auto frames = wave(200);
  const long before = mimicry::test::allocation_count();
  for (const mimicry_frame& f : frames) mimicry_session_add(session.get(), &f, nullptr);
  EXPECT_EQ(mimicry::test::allocation_count(), before);
  EXPECT_GT(mimicry_session_ink_count(session.get()), 100u);
}

TEST(CApi, EditsLeaveTheCurveAndMakeAnother) {
  const Target target = target_of("sphere");
  const auto session = make<Session>(mimicry_session_create, target.get(), "snap");
  const auto frames = wave(60);
  const auto curve =
      make<Curve>(mimicry_session_project, session.get(), &kPlaced, frames.data(), frames.size());
  const double length = mimicry_curve_length(curve.get());
  const auto few = make<Curve>(mimicry_curve_resample, curve.get(), std::size_t{10});
  EXPECT_EQ(mimicry_curve_point_count(few.get()), 10u);
  EXPECT_NEAR(mimicry_curve_length(few.get()), length, 0.1 * length);
  mimicry_curve_point first, last;
  ASSERT_EQ(mimicry_curve_point_at(few.get(), 0, &first), MIMICRY_OK);
  ASSERT_EQ(mimicry_curve_point_at(few.get(), 9, &last), MIMICRY_OK);
  EXPECT_EQ(first.frame, 0);
  EXPECT_EQ(last.frame, 59);
  EXPECT_DOUBLE_EQ(last.time_s, 59 / 90.0);
  const auto head = make<Curve>(mimicry_curve_slice, curve.get(), std::size_t{0}, std::size_t{21});
  const auto tail = make<Curve>(mimicry_curve_slice, curve.get(), std::size_t{20}, std::size_t{60});
  EXPECT_NEAR(mimicry_curve_length(head.get()) + mimicry_curve_length(tail.get()), length, 1e-12);
  EXPECT_EQ(mimicry_curve_ink_count(head.get()) + mimicry_curve_ink_count(tail.get()),
            mimicry_curve_ink_count(curve.get()) + 1);
  const auto closed = make<Curve>(mimicry_curve_close, curve.get());
  EXPECT_TRUE(mimicry_curve_is_closed(closed.get()));
  EXPECT_FALSE(mimicry_curve_is_closed(curve.get()));
  const auto smooth = make<Curve>(mimicry_curve_smooth, curve.get(), 0.5, 10);
  EXPECT_LT(mimicry_curve_length(smooth.get()), length);
  const auto simple = make<Curve>(mimicry_curve_simplify, curve.get(), 0.01);
  EXPECT_LT(mimicry_curve_point_count(simple.get()), 60u);
  EXPECT_EQ(mimicry_curve_length(curve.get()), length);
}

TEST(CApi, LongEditsCanBeCancelledAndAreBounded) {
  const Target target = target_of("sphere");
  const auto session = make<Session>(mimicry_session_create, target.get(), "snap");
  const auto frames = wave(60);
  const auto curve =
      make<Curve>(mimicry_session_project, session.get(), &kPlaced, frames.data(), frames.size());
  struct Heard {
    int calls = 0, most = 0;
    double last = 0.0;
    bool ordered = true;
  };
  // Cancels after `most` calls.
  const mimicry_progress hear = [](void* user, const char* stage, double fraction) -> int32_t {
    auto& h = *static_cast<Heard*>(user);
    h.ordered = h.ordered && fraction >= 0.0 && fraction <= 1.0 && stage[0] != 0;
    h.last = fraction;
    return ++h.calls <= h.most ? 1 : 0;
  };
  const auto each = [&](auto&& edit) {
    Heard all;
    all.most = 1 << 30;
    mimicry_curve* made = nullptr;
    EXPECT_EQ(edit(hear, &all, &made), MIMICRY_OK) << mimicry_last_error();
    EXPECT_NE(made, nullptr);
    EXPECT_GT(all.calls, 1);
    EXPECT_TRUE(all.ordered);
    mimicry_curve_destroy(made);
    for (const int most : {0, 1, all.calls - 1}) {
      Heard some;
      some.most = most;
      EXPECT_EQ(edit(hear, &some, &made), MIMICRY_CANCELLED);
      EXPECT_EQ(made, nullptr);
      EXPECT_EQ(some.calls, most + 1);  // not asked again
    }
  };
  each([&](auto progress, void* user, mimicry_curve** out) {
    return mimicry_curve_smooth_with_progress(curve.get(), 0.5, 9, progress, user, out);
  });
  each([&](auto progress, void* user, mimicry_curve** out) {
    return mimicry_curve_simplify_with_progress(curve.get(), 1e-6, progress, user, out);
  });
  each([&](auto progress, void* user, mimicry_curve** out) {
    return mimicry_curve_resample_with_progress(curve.get(), 500, progress, user, out);
  });
  // What would never end is an error.
  mimicry_curve* out = nullptr;
  EXPECT_EQ(mimicry_curve_smooth(curve.get(), 0.5, INT32_MAX, &out), MIMICRY_INVALID_INPUT);
  EXPECT_NE(std::string(mimicry_last_error()).find("100000"), std::string::npos);
  EXPECT_EQ(mimicry_curve_resample(curve.get(), SIZE_MAX, &out), MIMICRY_INVALID_INPUT);
  EXPECT_NE(std::string(mimicry_last_error()).find("10000000"), std::string::npos);
}

TEST(CApi, ThreadsOfABakeAreBounded) {
  const auto mesh = make<Mesh>(mimicry_mesh_shape, "sphere", 4);
  mimicry_bake_options options = mimicry_default_bake_options();
  options.threads = 257;
  mimicry_bytes* out = nullptr;
  EXPECT_EQ(mimicry_bake(mesh.get(), &options, nullptr, nullptr, &out), MIMICRY_INVALID_INPUT);
  EXPECT_NE(std::string(mimicry_last_error()).find("256"), std::string::npos);
}

TEST(CApi, TubesAreAsThickAsTheirPoints) {
  const Target target = target_of("sphere");
  const auto session = make<Session>(mimicry_session_create, target.get(), "snap");
  const auto frames = wave(60);
  const auto plain =
      make<Curve>(mimicry_session_project, session.get(), &kPlaced, frames.data(), frames.size());
  std::vector<double> radii(60, 0.02);
  const auto even = make<Curve>(mimicry_curve_with_radii, plain.get(), radii.data());
  // The same as the radius for all, also in the triangles of mimicry_curve_tube.
  for (const auto format : {MIMICRY_CURVES_PLY, MIMICRY_CURVES_GLB})
    EXPECT_EQ(
        text(write(target.get(), {even.get()}, format)),
        text(make<Bytes>(mimicry_curves_write, target.get(), "shape",
                         std::vector<const mimicry_curve*>{plain.get()}.data(), std::size_t{1},
                         format, static_cast<const uint8_t*>(nullptr), 0.02)));
  for (std::size_t i = 0; i < 60; ++i) radii[i] = 0.001 + 0.00002 * double(i);
  const auto growing = make<Curve>(mimicry_curve_with_radii, plain.get(), radii.data());
  const auto tube = make<Tube>(mimicry_curve_tube, growing.get(), 0.0, 12, 0.0);
  const float* x = mimicry_tube_positions(tube.get());
  const auto off = [&](std::size_t point) {
    mimicry_curve_point p;
    EXPECT_EQ(mimicry_curve_point_at(growing.get(), point, &p), MIMICRY_OK);
    double nearest = 1e9;
    for (std::size_t v = 0; v < mimicry_tube_vertex_count(tube.get()); ++v)
      nearest = std::min(nearest, std::hypot(x[3 * v] - p.position[0], x[3 * v + 1] - p.position[1],
                                             x[3 * v + 2] - p.position[2]));
    return nearest;
  };
  for (const std::size_t point : {0u, 20u, 59u})
    EXPECT_NEAR(off(point), radii[point], 0.1 * radii[point]);
  // Radii stay with the points of a slice, and go where points are new.
  const auto file = [&](const Curve& curve, double radius) {
    const mimicry_curve* list[] = {curve.get()};
    mimicry_bytes* bytes = nullptr;
    const mimicry_status status = mimicry_curves_write(target.get(), "shape", list, 1,
                                                       MIMICRY_CURVES_PLY, nullptr, radius, &bytes);
    mimicry_bytes_destroy(bytes);
    return status;
  };
  EXPECT_EQ(
      file(make<Curve>(mimicry_curve_slice, growing.get(), std::size_t{5}, std::size_t{20}), 0.0),
      MIMICRY_OK);
  EXPECT_EQ(file(make<Curve>(mimicry_curve_smooth, growing.get(), 0.5, 2), 0.0), MIMICRY_OK);
  EXPECT_EQ(file(make<Curve>(mimicry_curve_resample, growing.get(), std::size_t{10}), 0.0),
            MIMICRY_INVALID_INPUT);
  EXPECT_EQ(file(make<Curve>(mimicry_curve_with_radii, growing.get(),
                             static_cast<const double*>(nullptr)),
                 0.0),
            MIMICRY_INVALID_INPUT);
  radii[7] = 0.0;
  mimicry_curve* none = nullptr;
  EXPECT_EQ(mimicry_curve_with_radii(plain.get(), radii.data(), &none), MIMICRY_INVALID_INPUT);
  EXPECT_NE(std::string(mimicry_last_error()).find("radius 7"), std::string::npos);
}

TEST(CApi, FilesComeBack) {
  const Target target = target_of("cube");
  const auto session = make<Session>(mimicry_session_create, target.get(), "mimicry-live");
  const auto frames = wave(50);
  auto curve =
      make<Curve>(mimicry_session_project, session.get(), &kPlaced, frames.data(), frames.size());
  curve = make<Curve>(mimicry_curve_with_stroke, curve.get(), "s1");
  const Bytes file = write(target.get(), {curve.get(), curve.get()}, MIMICRY_CURVES_JSON);
  const auto list = make<List>(mimicry_curves_read, target.get(), mimicry_bytes_data(file.get()),
                               mimicry_bytes_size(file.get()), "a.json");
  ASSERT_EQ(mimicry_curve_list_count(list.get()), 2u);
  const auto again = make<Curve>(mimicry_curve_list_get, list.get(), std::size_t{1});
  EXPECT_STREQ(mimicry_curve_stroke(again.get()), "s1");
  EXPECT_STREQ(mimicry_curve_technique(again.get()), "mimicry-live");
  EXPECT_EQ(text(write(target.get(), {curve.get(), again.get()}, MIMICRY_CURVES_JSON)), text(file));
  for (const auto format :
       {MIMICRY_CURVES_OBJ, MIMICRY_CURVES_CSV, MIMICRY_CURVES_PLY, MIMICRY_CURVES_GLB,
        MIMICRY_CURVES_OBJ_POLYLINES, MIMICRY_CURVES_PLY_LINES, MIMICRY_CURVES_GLB_LINES})
    EXPECT_GT(text(write(target.get(), {curve.get()}, format)).size(), 100u);
  for (const int unknown : {-1, 17, 1 << 30}) {
    mimicry_bytes* none = nullptr;
    const mimicry_curve* one = curve.get();
    EXPECT_EQ(
        mimicry_curves_write(target.get(), "shape", &one, 1,
                             static_cast<mimicry_curve_format>(unknown), nullptr, 0.01, &none),
        MIMICRY_INVALID_INPUT);
    EXPECT_EQ(none, nullptr);
    EXPECT_THAT(mimicry_last_error(), HasSubstr(std::to_string(unknown)));
  }

  const auto strokes = make<Strokes>(mimicry_strokes_create);
  ASSERT_EQ(
      mimicry_strokes_append(strokes.get(), "s1", "cube", &kPlaced, frames.data(), frames.size()),
      MIMICRY_OK);
  const auto bytes = make<Bytes>(mimicry_strokes_write, strokes.get());
  const auto read = make<Strokes>(mimicry_strokes_read, mimicry_bytes_data(bytes.get()),
                                  mimicry_bytes_size(bytes.get()), "s.json");
  ASSERT_EQ(mimicry_strokes_count(read.get()), 1u);
  EXPECT_STREQ(mimicry_strokes_id(read.get(), 0), "s1");
  EXPECT_STREQ(mimicry_strokes_target(read.get(), 0), "cube");
  EXPECT_EQ(mimicry_strokes_id(read.get(), 1), nullptr);
  ASSERT_EQ(mimicry_strokes_frame_count(read.get(), 0), frames.size());
  std::vector<mimicry_frame> back(frames.size());
  ASSERT_EQ(mimicry_strokes_frames(read.get(), 0, back.data()), MIMICRY_OK);
  EXPECT_EQ(std::memcmp(back.data(), frames.data(), frames.size() * sizeof(mimicry_frame)), 0);
  mimicry_similarity placed;
  ASSERT_EQ(mimicry_strokes_placement(read.get(), 0, &placed), MIMICRY_OK);
  EXPECT_EQ(std::memcmp(&placed, &kPlaced, sizeof placed), 0);
  EXPECT_EQ(mimicry_strokes_left_out_count(read.get()), 0u);
  EXPECT_EQ(mimicry_strokes_left_out(read.get(), 0), nullptr);
}

TEST(CApi, StrokeWithAFaultIsLeftOutOfAFile) {
  const auto strokes = make<Strokes>(mimicry_strokes_create);
  const auto frames = wave(3);
  for (const char* id : {"s0", "s1"})
    ASSERT_EQ(
        mimicry_strokes_append(strokes.get(), id, "cube", &kPlaced, frames.data(), frames.size()),
        MIMICRY_OK);
  const auto bytes = make<Bytes>(mimicry_strokes_write, strokes.get());
  std::string file = text(bytes);
  file.replace(file.find("\"trigger\""), 9, "\"tr\"");
  const auto read = make<Strokes>(mimicry_strokes_read, file.data(), file.size(), "s.json");
  ASSERT_EQ(mimicry_strokes_count(read.get()), 1u);
  EXPECT_STREQ(mimicry_strokes_id(read.get(), 0), "s1");
  ASSERT_EQ(mimicry_strokes_left_out_count(read.get()), 1u);
  EXPECT_THAT(mimicry_strokes_left_out(read.get(), 0), HasSubstr("s.json: stroke 0: stroke 's0'"));
  EXPECT_THAT(mimicry_strokes_left_out(read.get(), 0), HasSubstr("frame 0: 'trigger' is missing"));
  EXPECT_EQ(mimicry_strokes_left_out(read.get(), 1), nullptr);
  file.replace(file.rfind("\"trigger\""), 9, "\"tr\"");
  mimicry_strokes* none = nullptr;
  EXPECT_EQ(mimicry_strokes_read(file.data(), file.size(), "s.json", &none), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(none, nullptr);
}

TEST(CApi, BakesAndDrawsWithIt) {
  const auto mesh = make<Mesh>(mimicry_mesh_shape, "sphere", 6);
  const auto target = make<Target>(mimicry_target_create, mesh.get(), 0);
  mimicry_session* none = nullptr;
  EXPECT_EQ(mimicry_session_create(target.get(), "mimicry", &none), MIMICRY_INVALID_INPUT);
  EXPECT_THAT(mimicry_last_error(), HasSubstr("needs the target's bake"));
  EXPECT_EQ(none, nullptr);

  mimicry_bake_options options = mimicry_default_bake_options();
  options.samples = 60;
  int calls = 0;
  const mimicry_progress count = [](void* user, const char* stage, double fraction) -> int32_t {
    EXPECT_GT(std::strlen(stage), 0u);
    EXPECT_GE(fraction, 0.0);
    EXPECT_LE(fraction, 1.0);
    return ++*static_cast<int*>(user);
  };
  const auto file = make<Bytes>(mimicry_bake, mesh.get(), &options, count, &calls);
  EXPECT_GT(calls, 3);
  mimicry_bytes* stopped = nullptr;
  EXPECT_EQ(mimicry_bake(
                mesh.get(), &options, [](void*, const char*, double) -> int32_t { return 0; },
                nullptr, &stopped),
            MIMICRY_CANCELLED);
  const auto baked =
      make<Target>(mimicry_target_with_embedding, target.get(), mimicry_bytes_data(file.get()),
                   mimicry_bytes_size(file.get()), "sphere.mimicry");
  EXPECT_TRUE(mimicry_target_has_embedding(baked.get()));
  EXPECT_FALSE(mimicry_target_has_embedding(target.get()));
  const auto session = make<Session>(mimicry_session_create, baked.get(), "mimicry");
  const auto frames = wave(40);
  const auto curve =
      make<Curve>(mimicry_session_project, session.get(), &kPlaced, frames.data(), frames.size());
  EXPECT_EQ(mimicry_curve_point_count(curve.get()), 40u);

  // Of another mesh.
  const Target other = target_of("cube");
  mimicry_target* refused = nullptr;
  EXPECT_EQ(
      mimicry_target_with_embedding(other.get(), mimicry_bytes_data(file.get()),
                                    mimicry_bytes_size(file.get()), "sphere.mimicry", &refused),
      MIMICRY_INVALID_INPUT);
  EXPECT_THAT(mimicry_last_error(), HasSubstr("sphere.mimicry"));
}

TEST(CApi, QueriesTellNothingFromAnError) {
  const Target target = target_of("sphere");
  mimicry_surface_point p;
  const double far[3] = {0, 0, 3}, away[3] = {0, 0, 1}, to[3] = {0, 0, -2};
  ASSERT_EQ(mimicry_target_first_hit(target.get(), far, to, &p), MIMICRY_OK);
  EXPECT_GE(p.face, 0);
  EXPECT_NEAR(p.distance, 2.0, 1e-2);
  EXPECT_NEAR(p.normal[2], 1.0, 1e-2);
  ASSERT_EQ(mimicry_target_first_hit(target.get(), far, away, &p), MIMICRY_OK);
  EXPECT_EQ(p.face, -1);
  const double infinity = std::numeric_limits<double>::infinity();
  ASSERT_EQ(mimicry_target_closest_point(target.get(), far, infinity, -1, &p), MIMICRY_OK);
  EXPECT_NEAR(p.distance, 2.0, 1e-2);
  ASSERT_EQ(mimicry_target_closest_point(target.get(), far, 1.0, 7, &p), MIMICRY_OK);
  EXPECT_EQ(p.face, -1);
}

TEST(CApi, ReportsAMesh) {
  const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int32_t faces[] = {0, 1, 2};
  const auto mesh =
      make<Mesh>(mimicry_mesh_create, positions, std::size_t{3}, faces, std::size_t{1}, "corner");
  mimicry_mesh_report report;
  ASSERT_EQ(mimicry_mesh_validate(mesh.get(), &report), MIMICRY_OK);
  EXPECT_DOUBLE_EQ(report.area, 0.5);
  EXPECT_EQ(report.boundary_loops, 1);
  EXPECT_EQ(report.closed, 0);
  EXPECT_EQ(report.manifold, 1);
  EXPECT_TRUE(std::isnan(report.volume));
  EXPECT_DOUBLE_EQ(report.box_max[1], 1.0);
  EXPECT_NEAR(mimicry_mesh_metres_per_unit(mesh.get()), 0.6 / std::sqrt(2.0), 1e-12);
}

TEST(CApi, TargetsStandOnTheSurfaceAndSpeakOfTheMesh) {
  // A square of two triangles with vertices of their own, the second turned; a stray vertex.
  const double positions[] = {9, 9, 9, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0};
  const int32_t faces[] = {1, 2, 3, 4, 6, 5};
  const auto mesh =
      make<Mesh>(mimicry_mesh_create, positions, std::size_t{7}, faces, std::size_t{2}, "square");
  const auto target = make<Target>(mimicry_target_make, mesh.get(), nullptr);
  EXPECT_THAT(mimicry_target_notes(target.get()), HasSubstr("1 seam edge was closed"));
  EXPECT_THAT(mimicry_target_notes(target.get()), HasSubstr("1 face was turned"));
  ASSERT_EQ(mimicry_target_surface_vertex_count(target.get()), 4u);
  const int32_t* sources = mimicry_target_surface_sources(target.get());
  EXPECT_EQ(std::vector<int32_t>(sources, sources + 4), (std::vector<int32_t>{1, 2, 3, 6}));
  const int32_t* vertices = mimicry_target_surface_vertices(target.get());
  EXPECT_EQ(std::vector<int32_t>(vertices, vertices + 7),
            (std::vector<int32_t>{-1, 0, 1, 2, 0, 2, 3}));
  const int32_t* corners = mimicry_target_surface_faces(target.get());
  EXPECT_EQ(std::vector<int32_t>(corners, corners + 6), (std::vector<int32_t>{0, 1, 2, 0, 2, 3}));
  const double* normals = mimicry_target_vertex_normals(target.get());
  EXPECT_EQ(normals[2], 0.0);
  for (int v = 1; v < 7; ++v) EXPECT_EQ(normals[3 * v + 2], 1.0) << v;
  EXPECT_DOUBLE_EQ(mimicry_target_diagonal(target.get()), std::sqrt(2.0));
  // Barycentrics are of the mesh's own corners.
  const double y[] = {0.2, 0.7, 1.0};
  mimicry_surface_point found;
  ASSERT_EQ(mimicry_target_closest_point(target.get(), y, INFINITY, -1, &found), MIMICRY_OK);
  ASSERT_EQ(found.face, 1);
  for (int d = 0; d < 3; ++d) {
    double x = 0;
    for (int k = 0; k < 3; ++k) x += found.barycentric[k] * positions[3 * faces[3 + k] + d];
    EXPECT_NEAR(x, found.position[d], 1e-15);
  }
  const mimicry_target_options strict{1, 1};
  mimicry_target* none = nullptr;
  EXPECT_EQ(mimicry_target_make(mesh.get(), &strict, &none), MIMICRY_INVALID_INPUT);
  EXPECT_THAT(mimicry_last_error(), HasSubstr("square: target: strictly"));
  const mimicry_target_options apart{0, 0};
  const auto open = make<Target>(mimicry_target_make, mesh.get(), &apart);
  EXPECT_EQ(mimicry_target_surface_vertex_count(open.get()), 6u);
  EXPECT_THAT(mimicry_target_notes(open.get()), HasSubstr("1 seam edge is not joined"));
}

TEST(CApi, AMeshOfSeveralFiles) {
  const char gltf[] =
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
      R"({"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"count":3,)"
      R"("componentType":5126,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
      R"("buffers":[{"byteLength":36,"uri":"corner.bin"}],"images":[{"uri":"wood.png"}]})";
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const mimicry_file files[] = {{"a/corner.bin", "no triangle", 11},
                                {"b/corner.bin", positions, sizeof positions},
                                {"b/corner.gltf", gltf, sizeof gltf - 1},
                                {"b/wood.png", nullptr, 0},
                                {"other.obj", "v", 1}};
  const auto mesh = make<Mesh>(mimicry_mesh_read_files, files, std::size_t{5}, "b/corner.gltf");
  EXPECT_EQ(mimicry_mesh_face_count(mesh.get()), 1u);
  EXPECT_EQ(mimicry_mesh_positions(mesh.get())[3], 1.0);
  mimicry_mesh* none = nullptr;
  EXPECT_EQ(mimicry_mesh_read_files(files, 5, nullptr, &none), MIMICRY_INVALID_INPUT);
  EXPECT_THAT(mimicry_last_error(), HasSubstr("b/corner.gltf and other.obj"));
  EXPECT_EQ(mimicry_mesh_read_files(files, 4, "c.gltf", &none), MIMICRY_INVALID_INPUT);
  EXPECT_THAT(mimicry_last_error(), HasSubstr("c.gltf: is not among the files"));
  EXPECT_EQ(mimicry_mesh_read_files(files, 2, nullptr, &none), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mimicry_mesh_read_files(files + 2, 2, nullptr, &none), MIMICRY_IO);
  EXPECT_THAT(mimicry_last_error(), HasSubstr("corner.bin"));
  EXPECT_EQ(mimicry_mesh_read_files(nullptr, 1, nullptr, &none), MIMICRY_INVALID_INPUT);
  // Without folders, as a browser drops them.
  const mimicry_file flat[] = {{"corner.gltf", gltf, sizeof gltf - 1},
                               {"x/corner.bin", positions, sizeof positions}};
  EXPECT_EQ(mimicry_mesh_face_count(
                make<Mesh>(mimicry_mesh_read_files, flat, std::size_t{2}, nullptr).get()),
            1u);
}

TEST(CApi, BadInputIsAStatusAndASentence) {
  mimicry_mesh* mesh = nullptr;
  EXPECT_EQ(mimicry_mesh_read("hello", 5, "notes.txt", &mesh), MIMICRY_UNSUPPORTED);
  EXPECT_EQ(mimicry_mesh_read("v 0 0 x", 7, "bad.obj", &mesh), MIMICRY_INVALID_INPUT);
  EXPECT_THAT(mimicry_last_error(), HasSubstr("bad.obj"));
  EXPECT_EQ(mimicry_mesh_read(nullptr, 9, "a.obj", &mesh), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mimicry_mesh_read("", 0, nullptr, &mesh), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mimicry_mesh_read("", 0, "a.obj", nullptr), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mimicry_mesh_shape("teapot", 0, &mesh), MIMICRY_INVALID_INPUT);
  const int32_t beyond[] = {0, 1, 2};
  EXPECT_EQ(mimicry_mesh_create(nullptr, 0, beyond, 1, nullptr, &mesh), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mesh, nullptr);
  mimicry_mesh_destroy(nullptr);
  EXPECT_EQ(mimicry_mesh_vertex_count(nullptr), 0u);

  const Target target = target_of("sphere", 4);
  mimicry_session* session = nullptr;
  EXPECT_EQ(mimicry_session_create(target.get(), "magic", &session), MIMICRY_INVALID_INPUT);
  EXPECT_THAT(mimicry_last_error(), HasSubstr("spraycan"));
  const auto drawing = make<Session>(mimicry_session_create, target.get(), "spraycan");
  const double value = 1.0;
  EXPECT_EQ(mimicry_session_set_option(drawing.get(), "colour", &value, 1), MIMICRY_INVALID_INPUT);
  mimicry_similarity squashed = kPlaced;
  squashed.scale = 0.0;
  EXPECT_EQ(mimicry_session_begin(drawing.get(), &squashed), MIMICRY_INVALID_INPUT);
  mimicry_frame frame = wave(1)[0];
  mimicry_frame_status status = MIMICRY_FRAME_INKED;
  EXPECT_EQ(mimicry_session_add(drawing.get(), &frame, &status), MIMICRY_OK);
  EXPECT_EQ(status, MIMICRY_FRAME_REJECTED) << "no stroke is open";
  EXPECT_EQ(mimicry_technique(-1), nullptr);
  EXPECT_EQ(mimicry_technique(1000), nullptr);
  EXPECT_EQ(mimicry_shape(1000), nullptr);
}

#ifndef __EMSCRIPTEN__
TEST(CApi, EachThreadHasItsOwnMessage) {
  mimicry_mesh* mesh = nullptr;
  ASSERT_NE(mimicry_mesh_shape("teapot", 0, &mesh), MIMICRY_OK);
  std::thread([] { EXPECT_STREQ(mimicry_last_error(), ""); }).join();
  EXPECT_THAT(mimicry_last_error(), HasSubstr("teapot"));
}
#endif

}  // namespace
