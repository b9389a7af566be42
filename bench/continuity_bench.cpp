// How steadily the anchored techniques answer a steady hand: |dq| / |dp|, the motion of the curve's
// point over the motion of the pen between two frames.
//   continuity_bench [--seeds N] [--shapes NAME,NAME...] [--list N] [--only PART]
// with PART open, closed, rates or steps.
// First 90 Hz strokes of the study's curves, open and closed loop, steps of at least 0.5 mm; where
// they end at other frame rates; then every anchored technique on every shape along the same hands'
// paths in steps of 1 mm. Every step is counted, none is left out; the largest ratios are listed
// with where they happen.
// Deterministic whatever the number of threads.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <mimicry/bake/bake.h>
#include <mimicry/base/parallel.h>
#include <mimicry/io/study.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/study/simulate.h>
#include <mimicry/study/targets.h>
#include <mimicry/technique/technique.h>

#include "study_mesh.h"

namespace {

using namespace mimicry;

constexpr double kLargest = 5.0;         // a ratio above it is a jump
constexpr double kLeastMotion = 0.5e-3;  // metres; of shorter steps noise decides the ratio
constexpr double kStep = 1e-3;           // metres

struct Scene {
  std::string name;
  bool is_study;
  Target target;
  SmoothProjector projector;
  std::vector<Intention> curves;
  Similarity place{Quat::Identity(), Vec3(0, 1.2, 0), 1.0};

  Scene(std::string n, bool study, const TriangleMesh& mesh, int threads)
      : name(std::move(n)),
        is_study(study),
        target(mesh),
        projector(mimicry::bake(mesh, {}, threads), target) {}
};

struct Way {
  std::string label;
  const TechniqueInfo* info;
  TechniqueOptions options;
};

struct Jump {
  double ratio = 0.0, pen_mm = 0.0, curve_mm = 0.0, off_percent = 0.0;
  std::size_t curve = 0, frame = 0;
  int seed = 0;
  Answer before{}, after{};
};

// Of one technique on strokes of one shape.
struct Tally {
  std::vector<float> ratios;
  std::vector<Jump> jumps;  // ratios above kLargest, and the largest one
  Jump worst;
  long points = 0, fallbacks = 0;

  void add(const Tally& other) {
    ratios.insert(ratios.end(), other.ratios.begin(), other.ratios.end());
    jumps.insert(jumps.end(), other.jumps.begin(), other.jumps.end());
    if (other.worst.ratio > worst.ratio) worst = other.worst;
    points += other.points;
    fallbacks += other.fallbacks;
  }
  double quantile(double q) {
    if (ratios.empty()) return 0.0;
    const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(ratios.size() - 1));
    std::nth_element(ratios.begin(), ratios.begin() + at, ratios.end());
    return static_cast<double>(ratios[static_cast<std::size_t>(at)]);
  }
};

// A stroke is drawn frame by frame.
class Drawing {
 public:
  Drawing(const Scene& scene, const Way& way, std::size_t curve, int seed)
      : scene_(scene),
        way_(way),
        canvas_{scene.target, scene.place.scale, scene.projector},
        curve_(curve),
        seed_(seed),
        memory_(way.info->first_memory) {}

  std::optional<Vec3> add(const Frame& world) {
    const Frame frame = to_model(world, scene_.place);
    const TechniqueStep step =
        way_.info->step(canvas_, frame, way_.options.block(*way_.info).data(), memory_.data());
    ++frame_;
    if (step.answer == Answer::miss) return std::nullopt;
    ++tally_.points;
    if (step.answer >= Answer::outside_shell) ++tally_.fallbacks;
    const Vec3& pen = frame.controller.position;
    if (last_point_) {
      const double scale = scene_.place.scale;
      const double dp = scale * (pen - last_pen_).norm();
      const double dq = scale * (step.position - *last_point_).norm();
      if (dp >= kLeastMotion) {
        const Vec3 r = *last_point_ + (pen - last_pen_);
        const Jump jump{dq / dp,    1e3 * dp,
                        1e3 * dq,   100.0 * (r - step.position).norm() / scene_.target.diagonal(),
                        curve_,     frame_ - 1,
                        seed_,      last_,
                        step.answer};
        tally_.ratios.push_back(static_cast<float>(jump.ratio));
        if (jump.ratio > kLargest) tally_.jumps.push_back(jump);
        if (jump.ratio > tally_.worst.ratio) tally_.worst = jump;
      }
    }
    last_ = step.answer;
    last_pen_ = pen;
    last_point_ = step.position;
    return scene_.place.point(step.position);
  }
  const Tally& tally() const { return tally_; }

 private:
  const Scene& scene_;
  const Way& way_;
  Canvas canvas_;
  std::size_t curve_;
  int seed_;
  TechniqueMemory memory_;
  Vec3 last_pen_ = Vec3::Zero();
  std::optional<Vec3> last_point_;
  Answer last_ = Answer::miss;
  std::size_t frame_ = 0;
  Tally tally_;
};

// The same hand's path in steps of kStep.
std::vector<Frame> even_steps(const std::vector<Frame>& frames) {
  std::vector<Frame> result = {frames.front()};
  double left = kStep;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const Frame &a = frames[i - 1], &b = frames[i];
    const double length = (b.controller.position - a.controller.position).norm();
    double at = left;
    for (; at <= length; at += kStep) {
      const double t = at / length;
      Frame f = a;
      f.time_s = a.time_s + t * (b.time_s - a.time_s);
      for (const auto pose : {&Frame::head, &Frame::controller}) {
        (f.*pose).position = (1.0 - t) * (a.*pose).position + t * (b.*pose).position;
        (f.*pose).orientation = (a.*pose).orientation.slerp(t, (b.*pose).orientation);
      }
      result.push_back(f);
    }
    left = at - length;
  }
  return result;
}

enum class Hand { open, closed, even };

std::vector<Tally> draw_all(const Scene& scene, const std::vector<Way>& ways, Hand hand, int seeds,
                            int threads) {
  const std::size_t strokes = scene.curves.size() * static_cast<std::size_t>(seeds);
  std::vector<std::vector<Tally>> each(strokes);
  parallel_for(strokes, threads, [&](std::size_t s) {
    const std::size_t c = s / static_cast<std::size_t>(seeds);
    const int seed = static_cast<int>(s % static_cast<std::size_t>(seeds)) + 1;
    const Intention& curve = scene.curves[c];
    std::vector<Frame> frames;
    if (hand != Hand::closed)
      frames =
          simulate(scene.target, curve, scene.place, {}, static_cast<std::uint64_t>(seed)).frames;
    if (hand == Hand::even) frames = even_steps(frames);
    for (const Way& way : ways) {
      Drawing drawing(scene, way, c, seed);
      if (hand == Hand::closed)
        simulate_closed_loop(scene.target, curve, scene.place, {}, static_cast<std::uint64_t>(seed),
                             [&](const Frame& f) { return drawing.add(f); });
      for (const Frame& f : frames) drawing.add(f);
      each[s].push_back(drawing.tally());
    }
  });
  std::vector<Tally> result(ways.size());
  for (const auto& stroke : each)
    for (std::size_t w = 0; w < ways.size(); ++w) result[w].add(stroke[w]);
  return result;
}

void print_jump(const Scene& scene, const Way& way, const Jump& j) {
  std::printf(
      "    %-14s %-24s curve %2zu seed %d frame %3zu: %6.2f (pen %.2f mm, curve %.2f mm, "
      "%.2f %% of the diagonal off r), %s after %s\n",
      scene.name.c_str(), way.label.c_str(), j.curve, j.seed, j.frame, j.ratio, j.pen_mm,
      j.curve_mm, j.off_percent, answer_name(j.after).data(), answer_name(j.before).data());
}

void sweep(const std::vector<std::unique_ptr<Scene>>& scenes, const std::vector<Way>& ways,
           Hand hand, int seeds, int threads, std::size_t most) {
  std::printf("%-14s %-24s %8s %7s %7s %7s %8s %6s %9s\n", "shape", "technique", "steps", "median",
              "p99", "p99.9", "largest", "> 5", "fallbacks");
  const auto row = [](const char* shape, const Way& way, Tally& tally) {
    std::printf("%-14s %-24s %8zu %7.2f %7.2f %7.2f %8.2f %6zu %9ld\n", shape, way.label.c_str(),
                tally.ratios.size(), tally.quantile(0.5), tally.quantile(0.99),
                tally.quantile(0.999), tally.worst.ratio, tally.jumps.size(), tally.fallbacks);
  };
  std::vector<Tally> all(ways.size());
  for (const auto& scene : scenes) {
    std::vector<Tally> tallies = draw_all(*scene, ways, hand, seeds, threads);
    for (std::size_t w = 0; w < ways.size(); ++w) {
      row(scene->name.c_str(), ways[w], tallies[w]);
      all[w].add(tallies[w]);
    }
    for (std::size_t w = 0; w < ways.size(); ++w) {
      auto& jumps = tallies[w].jumps;
      std::stable_sort(jumps.begin(), jumps.end(),
                       [](const Jump& a, const Jump& b) { return a.ratio > b.ratio; });
      if (jumps.empty() && most > 0) jumps.push_back(tallies[w].worst);
      for (std::size_t k = 0; k < std::min(most, jumps.size()); ++k)
        print_jump(*scene, ways[w], jumps[k]);
    }
    std::fflush(stdout);
  }
  for (std::size_t w = 0; w < ways.size(); ++w) row("all", ways[w], all[w]);
}

// Where the same strokes end at 30 and 240 Hz, beside 90 Hz: distances in millimetres. All rates
// see the first frame whose spray hits, and the last one.
void compare_rates(const std::vector<std::unique_ptr<Scene>>& scenes, const std::vector<Way>& ways,
                   int seeds, int threads, std::size_t most) {
  constexpr std::size_t kEvery30 = 24, kEvery90 = 8, kEvery240 = 3;  // of 720 Hz
  struct End {
    double apart_mm;
    std::string where;
  };
  SimulationOptions options;
  options.rate_hz = 720;
  std::vector<std::vector<End>> ends(ways.size());
  for (const auto& scene : scenes) {
    const std::size_t strokes = scene->curves.size() * static_cast<std::size_t>(seeds);
    std::vector<std::vector<std::vector<End>>> each(strokes);
    parallel_for(strokes, threads, [&](std::size_t s) {
      const std::size_t c = s / static_cast<std::size_t>(seeds);
      const int seed = static_cast<int>(s % static_cast<std::size_t>(seeds)) + 1;
      const auto frames = simulate(scene->target, scene->curves[c], scene->place, options,
                                   static_cast<std::uint64_t>(seed))
                              .frames;
      each[s].resize(ways.size());
      for (std::size_t w = 0; w < ways.size(); ++w) {
        std::size_t first = 0;
        Drawing waiting(*scene, ways[w], c, seed);
        while (first < frames.size() && !waiting.add(frames[first])) ++first;
        if (first + kEvery30 >= frames.size()) continue;
        const std::size_t last = first + (frames.size() - 1 - first) / kEvery30 * kEvery30;
        const auto end = [&](std::size_t every) {
          Drawing drawing(*scene, ways[w], c, seed);
          Vec3 q = Vec3::Zero();
          for (std::size_t i = first; i <= last; i += every)
            if (const auto ink = drawing.add(frames[i])) q = *ink;
          return q;
        };
        const Vec3 at_90 = end(kEvery90);
        for (const std::size_t every : {kEvery30, kEvery240})
          each[s][w].push_back({1e3 * (end(every) - at_90).norm(),
                                scene->name + " curve " + std::to_string(c) + " seed " +
                                    std::to_string(seed) +
                                    (every == kEvery30 ? " at 30 Hz" : " at 240 Hz")});
      }
    });
    for (auto& stroke : each)
      for (std::size_t w = 0; w < ways.size(); ++w)
        for (End& e : stroke[w]) ends[w].push_back(std::move(e));
  }
  std::printf("%-24s %6s %8s %8s %8s %6s\n", "technique", "ends", "median", "p99", "largest",
              "> 1 mm");
  for (std::size_t w = 0; w < ways.size(); ++w) {
    auto& of = ends[w];
    if (of.empty()) continue;
    std::stable_sort(of.begin(), of.end(),
                     [](const End& a, const End& b) { return a.apart_mm < b.apart_mm; });
    const auto over =
        std::find_if(of.begin(), of.end(), [](const End& e) { return e.apart_mm > 1; });
    const auto at = [&](double q) {
      return of[static_cast<std::size_t>(q * static_cast<double>(of.size() - 1))].apart_mm;
    };
    std::printf("%-24s %6zu %8.3f %8.3f %8.3f %6d\n", ways[w].label.c_str(), of.size(), at(0.5),
                at(0.99), of.back().apart_mm, static_cast<int>(of.end() - over));
    for (std::size_t k = 0; k < std::min(most, of.size()); ++k)
      std::printf("    %s: %.2f mm\n", of[of.size() - 1 - k].where.c_str(),
                  of[of.size() - 1 - k].apart_mm);
  }
}

}  // namespace

int main(int argc, char** argv) {
  int seeds = 5;
  std::size_t most = 3;
  std::string only;
  std::vector<std::string> wanted;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string word = argv[i];
    if (word == "--seeds") seeds = std::atoi(argv[i + 1]);
    if (word == "--only") only = argv[i + 1];
    if (word == "--list") most = static_cast<std::size_t>(std::atoi(argv[i + 1]));
    if (word == "--shapes") {
      std::istringstream names(argv[i + 1]);
      for (std::string name; std::getline(names, name, ',');) wanted.push_back(name);
    }
  }
  const auto is_wanted = [&](const std::string& name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
  };
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));

  std::vector<std::unique_ptr<Scene>> study_scenes, built_in;
  try {
    const auto set = read_targets(read_file(MIMICRY_STUDY_DATA "/targets.json"), "targets.json");
    for (const TargetShape& shape : set.shapes) {
      const std::string name = "study:" + shape.name;
      const auto mesh = bench::study_mesh(shape.name);
      if (!mesh || !is_wanted(name)) continue;
      auto scene = std::make_unique<Scene>(name, true, *mesh, threads);
      for (const TargetCurve& c : shape.curves) scene->curves.push_back({"", false, c.points});
      scene->place.scale = shape.scale;
      study_scenes.push_back(std::move(scene));
    }
  } catch (const std::exception& e) {
    std::printf("without the study's shapes: %s\n", e.what());
  }
  for (const ShapeInfo& info : builtin_shapes()) {
    const std::string name(info.name);
    if (!is_wanted(name)) continue;
    auto scene = std::make_unique<Scene>(name, false, make_shape(name), threads);
    scene->curves = intended_curves(name, scene->target);
    scene->place.scale = info.metres_per_unit;
    built_in.push_back(std::move(scene));
  }

  std::vector<Way> anchored;
  for (const auto& info : techniques())
    if (info.anchored) anchored.push_back({std::string(info.name), &info, {}});
  const auto& mimicry = find_technique("mimicry");
  const auto& live = find_technique("mimicry-live");
  const double on = 1.0;
  TechniqueOptions mimicry_soft, live_soft;
  set_option(mimicry, mimicry_soft, "soft-anchor", {&on, 1});
  set_option(live, live_soft, "soft-anchor", {&on, 1});
  anchored.push_back({"mimicry soft", &mimicry, mimicry_soft});
  anchored.push_back({"mimicry-live soft", &live, live_soft});
  const std::vector<Way> main_ways = {{"mimicry", &mimicry, {}},
                                      {"mimicry-live", &live, {}},
                                      {"mimicry soft", &mimicry, mimicry_soft},
                                      {"mimicry-live soft", &live, live_soft}};

  const auto is_due = [&](const char* part) { return only.empty() || only == part; };
  if (!study_scenes.empty() && is_due("open")) {
    std::printf("the study's curves, %d seeds, 90 Hz, open loop\n", seeds);
    sweep(study_scenes, main_ways, Hand::open, seeds, threads, most);
  }
  if (!study_scenes.empty() && is_due("closed")) {
    std::printf("\nthe study's curves, %d seeds, 90 Hz, closed loop\n", seeds);
    sweep(study_scenes, main_ways, Hand::closed, seeds, threads, most);
  }
  if (!study_scenes.empty() && is_due("rates")) {
    std::printf("\nthe study's curves, %d seeds: ends at 30 and 240 Hz from those at 90 Hz, mm\n",
                seeds);
    compare_rates(study_scenes, {main_ways[2], main_ways[3]}, seeds, threads, most);
  }
  if (!is_due("steps")) return 0;
  std::printf("\nevery anchored technique, steps of 1 mm, %d seeds\n", seeds);
  for (auto& scene : study_scenes) built_in.push_back(std::move(scene));
  sweep(built_in, anchored, Hand::even, seeds, threads, most);
  return 0;
}
