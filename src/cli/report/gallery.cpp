#include "cli/report/gallery.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>

#include "cli/console.h"
#include "lab/drawn_strokes.h"
#include "render/figure.h"
#include "render/palette.h"
#include "render/png.h"

namespace mimicry::cli {
namespace {

// White target curves must stand out in small pictures.
constexpr render::Color kIntendedThumbnail{1.0, 1.0, 0.97};
constexpr render::Color kSurfaceColor{0.66, 0.66, 0.68};

std::string draw(const lab::StudyRow& row, lab::DrawnStrokes& strokes, int threads) {
  const lab::DrawnStroke drawn = strokes.find(row);
  const TriangleMesh& mesh = drawn.target->mesh();
  const double radius = 0.006 * drawn.target->diagonal();
  render::Scene scene;
  scene.up = drawn.stroke.model_to_world.inverse_direction(Vec3::UnitY());
  render::Surface& surface = scene.surfaces.emplace_back();
  surface.mesh = &mesh;
  surface.color = kSurfaceColor;
  const auto add = [&](std::vector<Vec3> points, double thickness, const render::Color& color,
                       double weight) {
    if (points.empty()) return;
    render::Tube& tube = scene.tubes.emplace_back();
    tube.points = std::move(points);
    tube.radius = thickness * radius;
    tube.color = color;
    tube.camera_weight = weight;
  };
  std::vector<Vec3> pen;
  for (const Frame& frame : drawn.stroke.frames)
    pen.push_back(drawn.stroke.model_to_world.inverse_point(frame.controller.position));
  add(std::move(pen), 0.5, render::kStrokeColor, 0.2);
  add(drawn.intended, 0.85, kIntendedThumbnail, 1.0);
  for (auto& part : polylines(drawn.curve, mesh))
    add(std::move(part), 1.0, render::technique_color(row.method), 1.0);
  render::RenderOptions options;
  options.width = 440;
  options.height = 360;
  options.threads = threads;
  return render::write_png(render::picture(scene, {}, options));
}

}  // namespace

std::string method_color(const std::string& method) {
  const render::Color color = render::technique_color(method);
  char text[8];
  const auto byte = [](double c) { return static_cast<unsigned>(std::lround(255 * c)) & 255U; };
  std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(color.r), byte(color.g), byte(color.b));
  return text;
}

Gallery make_gallery(const lab::StudyRows& rows, const lab::Summary& summary,
                     const GalleryOptions& options) {
  Gallery gallery;
  if (options.count == 0) return gallery;
  const Monitor monitor = terminal_monitor();
  lab::DrawnStrokes strokes(options.sources, monitor, options.threads);
  const std::vector<lab::StrokePick> picks =
      lab::pick_strokes(rows, summary, options.measure, options.count);
  for (std::size_t i = 0; i < picks.size(); ++i) {
    const lab::StudyRow& row = *picks[i].row;
    try {
      gallery.pictures.push_back({picks[i], draw(row, strokes, options.threads)});
    } catch (const Error& error) {
      gallery.problems.push_back(row.method + ", " + row.name() + ": " + error.what());
    }
    monitor.report("pictures", i + 1, picks.size());
  }
  return gallery;
}

}  // namespace mimicry::cli
