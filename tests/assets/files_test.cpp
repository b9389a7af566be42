#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/assets/canvas.h>
#include <mimicry/assets/files.h>
#include <mimicry/base/error.h>
#include <mimicry/session/stroke_session.h>

#include "files/file.h"
#include "support/environment.h"
#include "support/folder.h"

namespace mimicry {
namespace {

Stroke beside_the_torus() {
  Stroke stroke;
  stroke.id = "beside";
  stroke.target = "torus";
  for (int i = 0; i < 30; ++i) {
    Frame frame;
    frame.time_s = i / 90.0;
    frame.controller.position = Vec3(1.3, 0.0, 0.01 * i);
    stroke.frames.push_back(frame);
  }
  return stroke;
}

TEST(Files, ACanvasHasTheBakeThatItsTechniqueNeeds) {
  const test::TestFolder folder;
  const test::TestVariable cache("MIMICRY_CACHE", folder.path("cache"));
  const Canvas plain = load_canvas("shape:torus:12", find_technique("snap"));
  EXPECT_TRUE(plain.target);
  EXPECT_FALSE(plain.projector);
  EXPECT_FALSE(std::filesystem::exists(folder.path("cache")));

  const Canvas baked = load_canvas("shape:torus:12", find_technique("mimicry"));
  ASSERT_TRUE(baked.projector);
  EXPECT_EQ(baked.metres_per_unit, load_mesh("shape:torus:12").metres_per_unit);
  std::set<std::string> kept;
  for (const auto& file : std::filesystem::directory_iterator(folder.path("cache")))
    kept.insert(file.path().string());
  ASSERT_EQ(kept.size(), 1u);

  // The second time it is read, not made; a bake's file serves as well.
  Monitor monitor;
  monitor.progress = [](std::string_view work, double) { ADD_FAILURE() << work; };
  EXPECT_TRUE(load_canvas("shape:torus:12", find_technique("mimicry"), monitor).projector);
  const TechniqueInfo* const mimicry[] = {&find_technique("mimicry")};
  const Canvas from_file =
      make_canvas(load_target("shape:torus:12"), mimicry, monitor, *kept.begin());
  EXPECT_EQ(from_file.projector.embedding().mesh_hash, baked.projector.embedding().mesh_hash);
  EXPECT_THROW(make_canvas(load_target("shape:sphere:8"), mimicry, monitor, *kept.begin()), Error);
}

TEST(Files, StrokesComeInAndCurvesGoOut) {
  const test::TestFolder folder;
  const Stroke stroke = beside_the_torus();
  write_file_atomically(folder.path("strokes.json"), write_strokes({&stroke, 1}));
  const StrokesFile read = load_strokes(folder.path("strokes.json"));
  ASSERT_EQ(read.strokes.size(), 1u);

  const TechniqueInfo& spraycan = find_technique("spraycan");
  TechniqueOptions options(spraycan);
  const double nozzle[] = {-1.0, 0.0, 0.0};
  set_option(spraycan, options, "nozzle", nozzle);
  const Canvas canvas = load_canvas("shape:torus:12", spraycan);
  CurveSet set{"torus", {}};
  set.curves.push_back(curve_record(
      read.strokes[0], spraycan,
      project(canvas, spraycan, read.strokes[0], {.technique = options}).curve, options));
  ASSERT_EQ(set.curves[0].curve.points.size(), 30u);

  const std::string json = folder.path("curves.json");
  save_curves(json, set, canvas.target.mesh());
  const CurveSet back = read_curves_json(read_file(json), "curves.json", canvas.target.mesh());
  ASSERT_EQ(back.curves.size(), 1u);
  EXPECT_EQ(back.curves[0].stroke, "beside");
  EXPECT_EQ(back.curves[0].technique, "spraycan");
  EXPECT_EQ(back.curves[0].options.at("nozzle"), (std::vector<double>{-1.0, 0.0, 0.0}));
  EXPECT_EQ(back.curves[0].curve.points.back().position,
            set.curves[0].curve.points.back().position);

  save_curves(folder.path("curves.glb"), set, canvas.target.mesh());
  EXPECT_TRUE(read_file(folder.path("curves.glb")).starts_with("glTF"));
  save_curves(folder.path("curves.ply"), set, canvas.target.mesh());
  EXPECT_TRUE(read_file(folder.path("curves.ply")).starts_with("ply"));
  save_curves(folder.path("curves.obj"), set, canvas.target.mesh());
  save_curves(folder.path("curves.csv"), set, canvas.target.mesh());

  try {
    save_curves(folder.path("curves.dwg"), set, canvas.target.mesh());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    EXPECT_NE(std::string(error.what()).find("curves.dwg"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("curves.dwg")));
}

}  // namespace
}  // namespace mimicry
