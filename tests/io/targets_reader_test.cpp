#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>
#include <mimicry/io/study.h>

#include "support/sanitized.h"

namespace mimicry {
namespace {

constexpr const char* kSmall = R"({"note": "x", "shapes": [{"name": "pad", "scale": 0.4, "curves": [
  {"face": [0, 3], "bary": [[1, -2e-07, 2e-07], [0.2, 0.3, 0.5]], "parameters": {},
   "keypoints": [0, 1]},
  {"face": [], "bary": []}]}]})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string message(const std::string& text) {
  try {
    read_targets(text, "t.json");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Targets, ReadsShapesCurvesAndKeypoints) {
  const TargetSet set = read_targets(kSmall, "t.json");
  ASSERT_NE(set.find("pad"), nullptr);
  EXPECT_EQ(set.find("cat"), nullptr);
  const TargetShape& pad = *set.find("pad");
  EXPECT_EQ(pad.scale, 0.4);
  ASSERT_EQ(pad.curves.size(), 2u);
  ASSERT_EQ(pad.curves[0].points.size(), 2u);
  EXPECT_EQ(pad.curves[0].points[1].face, 3);
  EXPECT_NEAR(pad.curves[0].points[1].bary[1], 0.3, 1e-15);
  EXPECT_EQ(pad.curves[0].keypoints, (std::vector<Index>{0, 1}));
  // Rounded barycentrics become legal ones.
  EXPECT_EQ(pad.curves[0].points[0].bary.minCoeff(), 0);
  EXPECT_NEAR(pad.curves[0].points[0].bary.sum(), 1, 1e-15);
  EXPECT_TRUE(pad.curves[1].points.empty());
}

TEST(Targets, RefusalsNameFileShapeCurveAndPoint) {
  const std::string small = kSmall;
  using testing::HasSubstr;
  EXPECT_THAT(message(small.substr(0, 100)), HasSubstr("t.json: the text ends early"));
  EXPECT_THAT(message("{}"), HasSubstr("'shapes' is missing"));
  EXPECT_THAT(message("[]"), HasSubstr("t.json: is not an object"));
  EXPECT_THAT(message(replaced(small, "0.4", "-1")), HasSubstr("shape 0 (pad): 'scale'"));
  EXPECT_THAT(message(replaced(small, "0.2, 0.3", "0.2, 0.4")),
              HasSubstr("shape 0 (pad): curve 0: point 1: barycentric"));
  EXPECT_THAT(message(replaced(small, "[0, 3]", "[0, 3, 4]")), HasSubstr("3 entries, 'bary' 2"));
  EXPECT_THAT(message(replaced(small, "[0, 3]", "[0, -3]")), HasSubstr("curve 0: point 1"));
  EXPECT_THAT(message(replaced(small, "[0, 1]", "[0, 2]")), HasSubstr("keypoint 2"));
  EXPECT_THAT(message(replaced(small, "[0, 1]", "[1, 1]")), HasSubstr("keypoint 1"));
  EXPECT_THAT(message(replaced(small, "\"pad\"", "7")), HasSubstr("name: is not a string"));
}

TEST(Targets, FacesThatTheMeshHasNotAreRefused) {
  const TargetSet set = read_targets(kSmall, "t.json");
  const TriangleMesh triangle({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}});
  try {
    require_fits(set.shapes[0], triangle);
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("pad: curve 0: point 1 lies on face 3"));
  }
}

TEST(Targets, TheStudysFileFitsItsMeshes) {
  const std::filesystem::path folder = MIMICRY_STUDY_DATA;
  if (!std::filesystem::exists(folder / "targets.json"))
    GTEST_SKIP() << "no study data in " << folder;
  const auto bytes = [](const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  };
  const TargetSet set = read_targets(bytes(folder / "targets.json"), "targets.json");
  ASSERT_EQ(set.shapes.size(), 6u);
  for (const TargetShape& shape : set.shapes) {
    SCOPED_TRACE(shape.name);
    EXPECT_EQ(shape.curves.size(), 10u);
    if (test::kSanitized && &shape != &set.shapes.front()) continue;  // one mesh takes ten seconds
    const TriangleMesh mesh =
        read_mesh(bytes(folder / (shape.name + ".obj")), MeshFormat::obj, shape.name);
    EXPECT_NO_THROW(require_fits(shape, mesh));
    // Of another mesh that has all the faces, too.
    for (const TargetShape& other : set.shapes) {
      if (other.name == shape.name) continue;
      EXPECT_THROW(require_fits(other, mesh), Error) << other.name;
    }
    // Consecutive points are neighbours: the faces are numbered as the mesh has them. The published
    // curves have about 500 points over up to one and a half diagonals.
    for (const TargetCurve& curve : shape.curves)
      for (std::size_t i = 1; i < curve.points.size(); ++i)
        ASSERT_LT((mesh.position(curve.points[i]) - mesh.position(curve.points[i - 1])).norm(),
                  0.05 * diagonal(mesh));
  }
}

}  // namespace
}  // namespace mimicry
