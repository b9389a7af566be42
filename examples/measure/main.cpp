// The measures of the curve that a technique drew, against the curve that its drawer meant: the
// target curve that the stroke was recorded with.
#include <cstdio>
#include <exception>

#include <mimicry/assets/canvas.h>
#include <mimicry/assets/files.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/study/measures.h>

using namespace mimicry;

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "usage: measure MESH STROKES TECHNIQUE\n");
    return 2;
  }
  const TechniqueInfo& technique = find_technique(argv[3]);
  const Canvas canvas = load_canvas(argv[1], technique);
  const Target& target = canvas.target;
  int measured = 0;
  for (const Stroke& stroke : load_strokes(argv[2]).strokes) {
    if (!stroke.intended) continue;
    TargetCurve meant;
    meant.points = stroke.intended->points;
    // Measures are of the size at which the target was shown: metres and radians per metre.
    const IntendedCurve intended =
        intended_curve(target.mesh(), meant, stroke.model_to_world.scale);

    const ProjectedStroke drawn = project(canvas, technique, stroke);
    const Measures m = measure(target.surface(), intended, drawn.curve, motion_of(stroke));
    std::printf("%s, %s\n", stroke.id.c_str(), technique.name.c_str());
    std::printf("  distance, point by point   %8.2f mm\n", 1e3 * m.d_ep_m);
    std::printf("  distance, closest points   %8.2f mm\n", 1e3 * m.d_sym_m);
    std::printf("  curvature in space         %8.2f rad/m\n", m.k_e_rad_per_m);
    std::printf("  geodesic curvature         %8.2f rad/m\n", m.k_g_rad_per_m);
    std::printf("  steps that jump            %8.2f %%\n", 100.0 * m.share_jumping);
    std::printf("  length                     %8.2f of the target curve's\n", m.length_ratio);
    ++measured;
  }
  if (measured > 0) return 0;
  std::fprintf(stderr, "measure: %s: no stroke has an intended curve\n", argv[2]);
  return 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "measure: %s\n", error.what());
  return 1;
}
