// Curves between points of whole barycentric coordinates on a mesh of small whole ones: crossings
// at vertices, along edges and on top of each other are the rule. Whatever is cut, each face's
// pieces tile it, the surface keeps its topology, and equal curves give equal bits.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/mesh/validation.h>
#include <mimicry/segment/segment.h>

#include "curve/curve_builder.h"

namespace {

using namespace mimicry;

void require(bool condition) {
  if (!condition) std::abort();
}

struct Bytes {
  const std::uint8_t* data;
  std::size_t size;
  int next() {
    if (size == 0) return 0;
    --size;
    return *data++;
  }
};

ProjectedCurve curve_of(Bytes& bytes, const Surface& surface) {
  const TriangleMesh& mesh = surface.mesh();
  CurveBuilder builder(surface);
  const int count = 2 + bytes.next() % 8;
  for (int i = 0; i < count; ++i) {
    SurfacePoint p{static_cast<Index>(bytes.next() % mesh.face_count()), Vec3::Zero()};
    while (repeats_corner(mesh.face(p.face))) p.face = (p.face + 1) % mesh.face_count();
    Vec3 weights(bytes.next() % 7, bytes.next() % 7, bytes.next() % 7);
    if (weights.sum() == 0.0) weights[0] = 1.0;
    p.bary = weights / weights.sum();
    builder.append({p, mesh.position(p), surface.normal(p), i, 0.0, 0.0});
  }
  return builder.curve();
}

void check(const Surface& target, const Segmentation& cut) {
  const MeshReport before = validate(target.mesh()), after = validate(cut.surface.mesh());
  require(after.is_manifold() == before.is_manifold());
  require(after.euler == before.euler);
  require(after.boundary.loops == before.boundary.loops);
  for (Index f = 0; f < target.mesh().face_count(); ++f) {
    if (repeats_corner(target.mesh().face(f))) continue;
    double whole = 0.0;
    for (Index c = cut.first_child[at(f)]; c < cut.first_child[at(f) + 1]; ++c) {
      const auto& b = cut.barycentrics[at(c)];
      const Vec3 u = b[1] - b[0], v = b[2] - b[0];
      const double twice = u[1] * v[2] - u[2] * v[1];
      require(twice > 0.0);
      whole += twice;
    }
    require(std::abs(whole - 1.0) < 1e-12);
  }
  for (Index label = 0; at(label) < cut.parts.size(); ++label) {
    const MeshReport part = validate(part_mesh(cut, label, true));
    require(part.is_manifold());
    require(part.euler == cut.parts[at(label)].euler);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes{data, size};
  std::vector<Vec3> positions(static_cast<std::size_t>(4 + bytes.next() % 12));
  for (Vec3& x : positions) x = Vec3(bytes.next() % 5, bytes.next() % 5, bytes.next() % 5);
  const auto vertex = [&] {
    return static_cast<Index>(bytes.next() % static_cast<int>(positions.size()));
  };
  std::vector<Face> faces(static_cast<std::size_t>(2 + bytes.next() % 20));
  for (Face& f : faces) f = {vertex(), vertex(), vertex()};
  const Surface target{TriangleMesh(positions, faces)};
  const auto kept = target.mesh().faces();
  if (std::all_of(kept.begin(), kept.end(), repeats_corner)) return 0;
  // Refused where a curve meets such an edge.
  if (!target.half_edges().is_manifold()) return 0;

  std::vector<ProjectedCurve> curves;
  const int count = 1 + bytes.next() % 4;
  for (int i = 0; i < count; ++i) curves.push_back(curve_of(bytes, target));
  Segmentation cut, again;
  try {
    cut = segment(target, curves);
    check(target, cut);
    std::reverse(curves.begin(), curves.end());
    again = segment(target, curves);
  } catch (const Error&) {
    // Paths through faces without area need not be connected; doubles may have an inside.
    const MeshReport report = validate(target.mesh());
    require(report.degenerate_faces.count > 0 || report.duplicate_faces.count > 0);
    return 0;
  }
  require(cut.labels == again.labels && cut.seam_edges == again.seam_edges);
  const auto x = cut.surface.mesh().faces(), y = again.surface.mesh().faces();
  require(std::equal(x.begin(), x.end(), y.begin(), y.end()));
  return 0;
}
