// A technique of one's own: its options, its memory, its step and its row are all there is to it.
// It is then drawn with, replayed and listed by its name like the others.
#include <array>
#include <cmath>
#include <cstdio>

#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/technique/technique.h>

using namespace mimicry;

// Steady snap: the closest point to a pen that follows the hand with a delay.

enum class Start : std::int32_t { hand, head };
struct SteadyOptions {
  double tau_s = 0.1;         // after which the pen has made good 63 % of its way to the hand
  bool pause = false;         // draw nothing while the trigger is half open
  Start start = Start::hand;  // where the pen is at first
};
struct SteadyMemory {
  bool has_begun = false;
  double time_s = 0.0;
  Vec3 pen = Vec3::Zero();
  Index face = kNone;  // where to search first
};

Stepped<SteadyMemory> steady_snap(const Canvas& canvas, const SteadyMemory& memory,
                                  const Frame& frame, const SteadyOptions& options) {
  SteadyMemory next = memory;
  const Vec3& hand = frame.controller.position;
  if (!memory.has_begun) {
    next.has_begun = true;
    next.pen = options.start == Start::hand ? hand : frame.head.position;
  } else {
    next.pen +=
        (1.0 - std::exp((memory.time_s - frame.time_s) / options.tau_s)) * (hand - next.pen);
  }
  next.time_s = frame.time_s;
  if (options.pause && frame.trigger < 0.5) return {{}, next};
  const auto closest = canvas.target.closest_point(next.pen, kInfinity, memory.face);
  if (!closest) return {{}, next};
  next.face = closest->surface.face;
  return {{Answer::closest, closest->surface, closest->position}, next};
}

TechniqueInfo steady_snap_row() {
  TechniqueInfo row;
  row.name = "steady-snap";
  row.title = "Steady snap";
  row.sentence = "Draws at the closest point to a pen that follows your hand calmly.";
  row.description = "to the closest point of the surface from the smoothed pen";
  row.color = 0x8a3ffc;
  row.options = {
      option<SteadyOptions>("tau", &SteadyOptions::tau_s, "how late the pen follows the hand",
                            {.unit = "s", .lowest = 0.001, .highest = 2.0}),
      option<SteadyOptions>("pause", &SteadyOptions::pause, "draw nothing at a half open trigger"),
      option<SteadyOptions>("start", &SteadyOptions::start, "where the pen is at first",
                            {.choices = {"hand", "head"}})};
  row.set_step(steady_snap);
  return row;
}

int main() {
  register_technique(steady_snap_row());

  // From here on it is one of the techniques.
  const TechniqueInfo& steady = find_technique("steady-snap");
  SessionOptions options;
  const double tau_s = 0.2;
  set_option(steady, options.technique, "tau", {&tau_s, 1});

  const Target target(make_shape("sphere"));
  Stroke stroke;
  for (int i = 0; i < 90; ++i) {
    Frame frame;
    frame.time_s = i / 90.0;
    frame.controller.position = Vec3(0.01 * i - 0.4, 0.02 * (i % 2), 1.1);  // a trembling hand
    stroke.frames.push_back(frame);
  }
  for (const char* name : {"snap", "steady-snap"}) {
    const TechniqueInfo& technique = find_technique(name);
    const ProjectedCurve curve =
        project({target}, technique, stroke, &technique == &steady ? options : SessionOptions{})
            .curve;
    std::printf("%s: %zu points, %.3f long\n", name, curve.points.size(), length(curve));
  }
}
