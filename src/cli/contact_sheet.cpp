#include "cli/contact_sheet.h"

#include "cli/console.h"
#include "render/figure.h"
#include "render/palette.h"
#include "render/png.h"

namespace mimicry::cli {
namespace {

constexpr render::Color kCurveColor{0.10, 0.35, 0.65};
constexpr render::Color kKeypointColor{0.85, 0.33, 0.10};

std::string caption_of(std::size_t number, const TargetCurve& curve) {
  return std::to_string(number) + ":  k_G " + fixed(curve.parameters->k_g, 2) + ", k_N " +
         fixed(curve.parameters->k_n_deg, 0) + "\u00b0, " + std::to_string(curve.keypoints.size()) +
         " keypoints";
}

}  // namespace

std::optional<std::string> contact_sheet(const Target& target,
                                         const std::vector<TargetCurve>& curves, const Vec3& up) {
  std::vector<render::Scene> panels;
  const double radius = 0.005 * target.diagonal();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    render::Scene& panel = panels.emplace_back();
    panel.up = up;
    panel.surfaces.emplace_back().mesh = &target.mesh();
    render::Tube& tube = panel.tubes.emplace_back();
    for (const SurfacePoint& p : curves[i].points) tube.points.push_back(target.position(p));
    tube.radius = radius;
    tube.color = kCurveColor;
    for (const Index k : curves[i].keypoints) {
      const Vec3 place = target.position(curves[i].points[static_cast<std::size_t>(k)]);
      panel.tubes.push_back({{place}, 2.0 * radius, kKeypointColor, "", 0.0});
    }
    panel.caption = caption_of(i, curves[i]);
  }
  render::FigureOptions options;
  options.one_camera = false;
  options.columns = 5;
  options.panel.width = 360;
  options.panel.height = 320;
  return render::write_png(render::figure(panels, {}, options));
}

}  // namespace mimicry::cli
