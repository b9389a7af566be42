// A participant's recorded strokes, drawn again with another technique. What the hand did is
// recorded, so that any technique can be tried on it afterwards; the same strokes give the same
// curves every time.
#include <cstdio>
#include <exception>

#include <mimicry/assets/canvas.h>
#include <mimicry/assets/files.h>
#include <mimicry/session/stroke_session.h>

using namespace mimicry;

int main(int argc, char** argv) try {
  if (argc < 4) {
    std::fprintf(stderr, "usage: replay MESH STROKES TECHNIQUE...\n");
    return 2;
  }
  const Target target = load_target(argv[1]);
  const StrokesFile recorded = load_strokes(argv[2]);
  for (const std::string& sentence : recorded.left_out)
    std::fprintf(stderr, "left out: %s\n", sentence.c_str());

  std::printf("%-12s %-20s %7s %7s %9s\n", "stroke", "technique", "points", "missed", "length cm");
  for (int i = 3; i < argc; ++i) {
    const TechniqueInfo* technique = &find_technique(argv[i]);
    // The target's bake too, where the technique needs it.
    const Canvas canvas = make_canvas(target, {&technique, 1});
    for (const Stroke& stroke : recorded.strokes) {
      // `split` breaks the curve where the technique found no point; `connect` bridges the gap.
      const ProjectedStroke drawn =
          project(canvas, *technique, stroke, {.misses = MissPolicy::split});
      std::printf("%-12s %-20s %7zu %7d %9.2f\n", stroke.id.c_str(), technique->name.c_str(),
                  drawn.curve.points.size(), drawn.counts[FrameStatus::missed],
                  100.0 * stroke.model_to_world.scale * length(drawn.curve));
    }
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "replay: %s\n", error.what());
  return 1;
}
