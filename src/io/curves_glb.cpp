#include <cmath>
#include <deque>
#include <utility>

#include <mimicry/io/curves_glb.h>
#include <mimicry/io/tube_mesh.h>

#include "io/glb.h"

namespace mimicry::io {
namespace {

constexpr std::array<double, 3> kTargetColor = {0.6, 0.6, 0.62};

// glTF colours are linear, ours sRGB.
double linear(unsigned char srgb) {
  const double s = srgb / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

// The parts of a curve as one mesh: a node is a curve, however many parts it has.
TubeMesh tubes_of(const curve::ProjectedCurve& curve, const TriangleMesh& mesh, double radius) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  TubeMesh all;
  for (const auto& part : curve::polylines(curve, mesh)) {
    const TubeMesh tube = tube_mesh(part, {.radius = radius});
    const auto first = static_cast<Index>(positions.size());
    positions.insert(positions.end(), tube.mesh.positions().begin(), tube.mesh.positions().end());
    all.normals.insert(all.normals.end(), tube.normals.begin(), tube.normals.end());
    for (const Face& f : tube.mesh.faces())
      faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  }
  all.mesh = TriangleMesh(std::move(positions), std::move(faces));
  return all;
}

}  // namespace

std::string write_curves_glb(const CurveSet& set, const TriangleMesh& mesh,
                             std::span<const std::array<unsigned char, 3>> colors, double radius) {
  std::deque<TubeMesh> tubes;  // parts point into it
  std::vector<GlbPart> parts = {{set.target, &mesh, {}, kTargetColor}};
  for (std::size_t i = 0; i < set.curves.size(); ++i) {
    const CurveRecord& record = set.curves[i];
    const TubeMesh& tube = tubes.emplace_back(tubes_of(record.curve, mesh, radius));
    parts.push_back({record.stroke + " " + record.technique, &tube.mesh, tube.normals,
                     std::array{linear(colors[i][0]), linear(colors[i][1]), linear(colors[i][2])}});
  }
  return write_glb_scene(parts);
}

}  // namespace mimicry::io
