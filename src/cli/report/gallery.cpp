#include "cli/report/gallery.h"

#include <algorithm>
#include <cmath>

#include <mimicry/base/error.h>
#include <mimicry/render/figure.h>
#include <mimicry/render/palette.h>
#include <mimicry/render/png.h>

#include "cli/console.h"
#include "cli/report/drawn_strokes.h"

namespace mimicry::cli {
namespace {

// White target curves must stand out in small pictures.
constexpr render::Color kIntendedThumbnail{1.0, 1.0, 0.97};
constexpr render::Color kSurfaceColor{0.66, 0.66, 0.68};

// The `count` worst and best strokes of a method that count.
std::vector<GalleryPicture> picks(const StudyRows& rows, const Summary& summary,
                                  const std::string& method, const GalleryOptions& options) {
  std::vector<GalleryPicture> all;
  for (const StudyRow* row : summary.counted) {
    const double value = rows.number(*row, options.measure);
    if (row->method == method && std::isfinite(value)) all.push_back({row, value, false, {}});
  }
  std::stable_sort(all.begin(), all.end(), [](const GalleryPicture& a, const GalleryPicture& b) {
    return a.value > b.value;
  });
  const auto count = static_cast<std::size_t>(options.count);
  std::vector<GalleryPicture> some(all.begin(),
                                   all.begin() + static_cast<long>(std::min(count, all.size())));
  for (std::size_t i = std::max(all.size() - std::min(count, all.size()), some.size());
       i < all.size(); ++i) {
    some.push_back(all[i]);
    some.back().best = true;
  }
  // The very best stands first among the best.
  std::reverse(std::find_if(some.begin(), some.end(), [](const auto& p) { return p.best; }),
               some.end());
  return some;
}

std::string draw(const StudyRow& row, DrawnStrokes& strokes, int threads) {
  const DrawnStroke drawn = strokes.find(row);
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
  for (const stroke::Frame& frame : drawn.stroke.frames)
    pen.push_back(drawn.stroke.model_to_world.inverse_point(frame.controller.position));
  add(std::move(pen), 0.5, render::kStrokeColor, 0.2);
  add(drawn.intended, 0.85, kIntendedThumbnail, 1.0);
  for (auto& part : curve::polylines(drawn.curve, mesh))
    add(std::move(part), 1.0, render::technique_color(row.method), 1.0);
  render::RenderOptions options;
  options.width = 440;
  options.height = 360;
  options.threads = threads;
  return render::write_png(render::picture(scene, {}, options));
}

}  // namespace

Gallery make_gallery(const StudyRows& rows, const Summary& summary, const GalleryOptions& options) {
  Gallery gallery;
  if (options.count == 0) return gallery;
  DrawnStrokes strokes(options.sources);
  std::vector<GalleryPicture> wanted;
  for (const std::string& method : summary.methods)
    for (GalleryPicture& pick : picks(rows, summary, method, options)) wanted.push_back(pick);
  ProgressLine progress("pictures");
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    GalleryPicture& picture = wanted[i];
    try {
      picture.png = draw(*picture.row, strokes, options.threads);
      gallery.pictures.push_back(std::move(picture));
    } catch (const Error& error) {
      gallery.problems.push_back(picture.row->method + ", " + picture.row->name() + ": " +
                                 error.what());
    }
    progress.update(i + 1, wanted.size());
  }
  return gallery;
}

}  // namespace mimicry::cli
