#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <mimicry/io/meshes.h>

#include "any_memory.h"
#include "presses.h"

namespace mimicry {
namespace {

// The study's meshes, pressed as by a pen on a screen, and as by a hand that dips the pen into
// them.
TEST(FirstPointStudy, IsWhatWasPressed) {
  constexpr std::uint64_t kSeed = 21;
  const std::filesystem::path folder = MIMICRY_STUDY_DATA;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no study data in " MIMICRY_STUDY_DATA;
  int looked_at = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".obj") continue;
    std::ostringstream bytes;
    bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    const std::string name = entry.path().stem().string();
    const Target target(read_mesh(bytes.str(), MeshFormat::obj, name));
    const Canvas canvas{target};
    for (const Press& press : presses(target, 200, kSeed)) {
      const double hair = 1e-5 * target.diagonal();
      const auto out =
          target.first_hit(press.hit.position + hair * press.direction, press.direction);
      const double chord = out ? out->distance : 0.0;
      const double dip = std::min(0.3 * chord, 0.005 * target.diagonal());
      for (const double depth : {-1e-6 * target.diagonal(), 0.0, dip}) {
        const Frame frame = frame_of(press, press.hit.position + depth * press.direction);
        for (const TechniqueInfo& info : techniques()) {
          if (!starts_at_the_pen(info)) continue;
          const AnyStep step =
              any_step(info, canvas, {}, frame, options_with(info, "dipped-pen", 1.0));
          ASSERT_NE(step.answer, Answer::miss) << name << " " << info.name;
          EXPECT_LE((step.position - press.hit.position).norm(), 0.01 * target.diagonal())
              << name << ", " << info.name << ", depth " << depth << ", seed " << kSeed;
          ++looked_at;
        }
      }
    }
  }
  EXPECT_GT(looked_at, 10000);
}

}  // namespace
}  // namespace mimicry
