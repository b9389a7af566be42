#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/io/meshes.h>
#include <mimicry/io/study.h>
#include <mimicry/study/simulate.h>
#include <mimicry/technique/technique.h>

#include "technique/steps.h"

namespace mimicry {
namespace {

struct StudyShape {
  TargetShape info;
  Target target;
};

std::string bytes(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// Empty where there are no study data. Every second curve is drawn, for the time that it takes; the
// bench draws them all.
std::vector<StudyShape> study_shapes() {
  const std::filesystem::path folder = MIMICRY_STUDY_DATA;
  std::vector<StudyShape> shapes;
  if (!std::filesystem::exists(folder / "targets.json")) return shapes;
  for (auto& info : read_targets(bytes(folder / "targets.json"), "targets.json").shapes) {
    Target target(read_mesh(bytes(folder / (info.name + ".obj")), MeshFormat::obj, info.name));
    shapes.push_back({std::move(info), std::move(target)});
  }
  return shapes;
}

// A stroke is drawn frame by frame; the longest of the steps that answer 0.5 mm or more, in units
// of the hand's.
class Hand {
 public:
  Hand(const Target& target, const Similarity& place, bool soft)
      : canvas_{target, place.scale}, place_(place) {
    options_.soft_anchor = soft;
  }
  std::optional<Vec3> add(const Frame& world) {
    const Stepped<SoftAnchor> step =
        mimicry_live(canvas_, memory_, to_model(world, place_), options_);
    if (step.answer == Answer::miss) return std::nullopt;
    if (memory_.anchored) {
      const double dp = (step.memory.pen - memory_.pen).norm();
      if (dp * place_.scale >= 0.5e-3)
        worst_ = std::max(worst_, (step.position - memory_.position).norm() / dp);
    }
    memory_ = step.memory;
    return place_.point(step.position);
  }
  double worst() const { return worst_; }

 private:
  Canvas canvas_;
  Similarity place_;
  SoftAnchorOptions options_;
  SoftAnchor memory_;
  double worst_ = 0.0;
};

TEST(MimicryLiveStudy, NoStepIsLongerThanFiveTimesTheHandsOpenAndClosedLoop) {
  const auto shapes = study_shapes();
  if (shapes.empty()) GTEST_SKIP() << "no study data in " MIMICRY_STUDY_DATA;
  for (const StudyShape& shape : shapes) {
    const Similarity place{Quat::Identity(), Vec3(0, 1.2, 0), shape.info.scale};
    for (std::size_t c = 0; c < shape.info.curves.size(); c += 2) {
      const Intention curve{std::to_string(c), false, shape.info.curves[c].points};
      const auto open = simulate(shape.target, curve, place, {}, 1);
      for (const bool soft : {false, true}) {
        Hand hand(shape.target, place, soft), seeing(shape.target, place, soft);
        for (const auto& frame : open.frames) hand.add(frame);
        simulate_closed_loop(shape.target, curve, place, {}, 1,
                             [&](const Frame& f) { return seeing.add(f); });
        EXPECT_LE(hand.worst(), 5.0) << shape.info.name << " " << c << " seed 1" << soft;
        EXPECT_LE(seeing.worst(), 5.0) << shape.info.name << " " << c << " seed 1" << soft;
      }
    }
  }
}

TEST(MimicryLiveStudy, SoftAnchorEndsWithinAMillimetreFrom30To240Hz) {
  const auto shapes = study_shapes();
  if (shapes.empty()) GTEST_SKIP() << "no study data in " MIMICRY_STUDY_DATA;
  for (const StudyShape& shape : shapes) {
    const Similarity place{Quat::Identity(), Vec3(0, 1.2, 0), shape.info.scale};
    for (std::size_t c = 0; c < shape.info.curves.size(); ++c) {
      const Intention curve{std::to_string(c), false, shape.info.curves[c].points};
      SimulationOptions options;
      options.rate_hz = 720;
      const auto stroke = simulate(shape.target, curve, place, options, 2);
      // All rates see the first frame whose spray hits, and the last one.
      std::size_t first = 0;
      Hand waiting(shape.target, place, true);
      while (first < stroke.frames.size() && !waiting.add(stroke.frames[first])) ++first;
      if (first + 24 >= stroke.frames.size()) continue;
      const std::size_t last = first + (stroke.frames.size() - 1 - first) / 24 * 24;
      const auto end = [&](std::size_t every) {
        Hand hand(shape.target, place, true);
        Vec3 q = Vec3::Zero();
        for (std::size_t i = first; i <= last; i += every)
          if (const auto ink = hand.add(stroke.frames[i])) q = *ink;
        return q;
      };
      const Vec3 reference = end(8);
      for (const std::size_t every : {24u, 3u}) {
        EXPECT_LT((end(every) - reference).norm(), 1e-3)
            << shape.info.name << " " << c << " at " << 720 / every << " Hz, seed 2";
      }
    }
  }
}

}  // namespace
}  // namespace mimicry
