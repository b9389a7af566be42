#include <cmath>
#include <deque>
#include <utility>

#include <mimicry/io/curves.h>

#include "io/creased_mesh.h"
#include "io/curve_tubes.h"
#include "io/glb.h"

namespace mimicry {
namespace {

using Color = std::array<unsigned char, 3>;

/// Faces that meet at more than this are shown with an edge, as in the studio.
constexpr std::array<double, 3> kTargetColor = {0.6, 0.6, 0.62};

// glTF colours are linear, ours sRGB.
double linear(unsigned char srgb) {
  const double s = srgb / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

// The target's node first; a curve's is told what it looks like.
template <class Fill>
std::string scene(const CurveSet& set, const TriangleMesh& mesh, std::span<const Color> colors,
                  Fill&& fill) {
  const CreasedMesh target = creased_mesh(mesh, kCrease_rad);
  std::vector<GlbPart> parts = {{set.target, &target.mesh, target.normals, kTargetColor, {}}};
  for (std::size_t i = 0; i < set.curves.size(); ++i) {
    const CurveRecord& record = set.curves[i];
    GlbPart& part = parts.emplace_back();
    part.name = record.stroke + " " + record.technique;
    part.color = {linear(colors[i][0]), linear(colors[i][1]), linear(colors[i][2])};
    fill(record, part);
  }
  return write_glb_scene(parts);
}

}  // namespace

std::string write_curves_glb(const CurveSet& set, const TriangleMesh& mesh,
                             std::span<const Color> colors, double radius) {
  const std::vector<Vec3> normals = normals_for_lifts(set, mesh);
  std::deque<TubeMesh> tubes;  // parts point into it
  return scene(set, mesh, colors, [&](const CurveRecord& record, GlbPart& part) {
    const TubeMesh& tube = tubes.emplace_back(curve_tubes(record, mesh, radius, normals));
    part.mesh = &tube.mesh;
    part.normals = tube.normals;
  });
}

std::string write_curves_glb_lines(const CurveSet& set, const TriangleMesh& mesh,
                                   std::span<const Color> colors) {
  std::deque<std::vector<std::vector<Vec3>>> lines;
  return scene(set, mesh, colors, [&](const CurveRecord& record, GlbPart& part) {
    part.lines = lines.emplace_back(polylines(record.curve, mesh));
  });
}

}  // namespace mimicry
