#include <cstdio>

#include <mimicry/assets/canvas.h>
#include <mimicry/assets/files.h>
#include <mimicry/session/stroke_session.h>

int main(int argc, char** argv) try {
  using namespace mimicry;
  if (argc != 4) return std::puts("usage: draw MESH STROKES CURVES"), 2;
  const TechniqueInfo& technique = find_technique("mimicry");
  const Canvas canvas = load_canvas(argv[1], technique);  // bakes the mesh, once
  CurveSet drawn{argv[1], {}};
  for (const Stroke& stroke : load_strokes(argv[2]).strokes) {
    StrokeSession session(canvas, technique);
    session.begin(stroke.model_to_world);  // where the target stands in the world
    for (const Frame& frame : stroke.frames) session.add(frame);  // head and hand, as they come
    session.end();
    std::printf("%zu points, %.3f long\n", session.curve().points.size(), length(session.curve()));
    drawn.curves.push_back(curve_record(stroke, technique, session.curve()));
  }
  save_curves(argv[3], drawn, canvas.target.mesh());
} catch (const mimicry::Error& error) {
  return std::fprintf(stderr, "draw: %s\n", error.what()), 1;
}
