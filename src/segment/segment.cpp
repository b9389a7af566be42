#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/segment/segment.h>

#include "geodesic/site.h"
#include "segment/assemble.h"
#include "segment/ends.h"
#include "segment/parts.h"

namespace mimicry {
namespace {

void note_curves(Segmentation& cut) {
  const HalfEdges& edges = cut.surface.half_edges();
  for (std::size_t c = 0; c < cut.seams.size(); ++c) {
    const std::string name = "curve " + std::to_string(c);
    const ProjectedCurve& seam = cut.seams[c];
    if (seam.points.empty())
      cut.notes.push_back(name + ": it is shorter than the snapping distance and cuts nothing");
  }
  if (cut.crossings > 0)
    cut.notes.push_back("curves cross inside faces in " + std::to_string(cut.crossings) +
                        (cut.crossings == 1 ? " place" : " places"));
  bool both = false;
  for (Index h = 0; h < edges.count() && !both; ++h)
    both = cut.seam_edges[at(h)] && edges.has_twin(h) &&
           cut.labels[at(HalfEdges::face(h))] == cut.labels[at(HalfEdges::face(edges.twin(h)))];
  if (both)
    cut.notes.push_back(
        "a part lies on both sides of a curve: it is cut there, but not separated from itself (" +
        std::to_string(cut.parts.size()) + (cut.parts.size() == 1 ? " part" : " parts") +
        " in all)");
}

// Barycentric coordinates of a point of the parent in one of its children; the least of them.
double child_bary(const std::array<Vec3, 3>& child, const Vec3& p, Vec3& bary) {
  const auto area = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
  };
  const double whole = area(child[0], child[1], child[2]);
  bary =
      Vec3(area(p, child[1], child[2]), area(child[0], p, child[2]), area(child[0], child[1], p)) /
      whole;
  return bary.minCoeff();
}

}  // namespace

Segmentation segment(const Surface& target, std::span<const ProjectedCurve> curves,
                     const SegmentOptions& options) {
  if (!(options.snap >= 1e-7 && options.snap <= 0.1))
    throw Error(ErrorKind::invalid_input,
                "segment: the snapping distance must be from 1e-7 to 0.1 of an edge");
  const double size = diagonal(target.mesh());
  std::vector<ProjectedCurve> ended;
  std::vector<std::string> notes;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    require_cuttable(target, curves[c], c, size);
    EndedCurve end = with_ends(curves[c], target, options.close);
    if (!end.note.empty()) notes.push_back("curve " + std::to_string(c) + ": " + end.note);
    ended.push_back(options.method == CutMethod::vertices ? along_vertices(end.curve, target)
                                                          : std::move(end.curve));
  }
  Segmentation cut = assemble(target, curve_network(target, ended, options.snap), options);
  cut.notes = std::move(notes);
  find_parts(cut);
  note_curves(cut);
  return cut;
}

SurfacePoint target_point(const Segmentation& cut, const SurfacePoint& p) {
  const auto& corners = cut.barycentrics[at(p.face)];
  return {cut.parents[at(p.face)],
          p.bary[0] * corners[0] + p.bary[1] * corners[1] + p.bary[2] * corners[2]};
}

SurfacePoint cut_point(const Segmentation& cut, const SurfacePoint& p) {
  SurfacePoint best;
  double deepest = -kInfinity;
  for (Index f = cut.first_child[at(p.face)]; f < cut.first_child[at(p.face) + 1]; ++f) {
    Vec3 bary;
    const double least = child_bary(cut.barycentrics[at(f)], p.bary, bary);
    if (least <= deepest) continue;
    deepest = least;
    best = {f, bary};
  }
  if (best.face != kNone) best = normalised(best);
  return best;
}

}  // namespace mimicry
