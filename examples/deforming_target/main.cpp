// A target whose vertices move, as an animated character's do. The curve is kept as faces and
// barycentric coordinates, so that it follows the surface; a stroke that is drawn later meets the
// surface where it is by then.
#include <cmath>
#include <cstdio>
#include <vector>

#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>

using namespace mimicry;

// Along the equator of a sphere of radius 1, with the pen 0.1 away.
Stroke around_the_equator() {
  Stroke stroke;
  for (int i = 0; i < 90; ++i) {
    const double angle = 0.02 * i;
    Frame frame;
    frame.time_s = i / 90.0;
    frame.controller.position = 1.1 * Vec3(std::cos(angle), 0.0, std::sin(angle));
    stroke.frames.push_back(frame);
  }
  return stroke;
}

double mean_pen_distance(const ProjectedCurve& curve) {
  double sum = 0.0;
  for (const CurvePoint& point : curve.points) sum += point.pen_distance;
  return sum / static_cast<double>(curve.points.size());
}

int main() {
  Target target(make_sphere(32));
  const TechniqueInfo& snap = find_technique("snap");
  const Stroke stroke = around_the_equator();
  ProjectedCurve curve = project({target}, snap, stroke).curve;
  std::printf("at rest:   %.3f long, the pen %.3f away\n", length(curve), mean_pen_distance(curve));

  // The caller's vertices, in its own order. They are moved as often as frames are shown.
  const TriangleMesh mesh = make_sphere(32);
  std::vector<Vec3> moved(mesh.positions().begin(), mesh.positions().end());
  for (int step = 1; step <= 10; ++step) {
    const double growth = 1.0 + 0.005 * step;
    for (std::size_t v = 0; v < moved.size(); ++v)
      moved[v] = growth * mesh.positions()[static_cast<Index>(v)];
    target.update_positions(moved);  // all copies of the target; nobody may read it meanwhile
    follow(curve, target.mesh(), target.vertex_normals());
  }
  const ProjectedCurve again = project({target}, snap, stroke).curve;
  std::printf("grown 5 %%: %.3f long, the pen %.3f away\n", length(curve),
              mean_pen_distance(again));
}
