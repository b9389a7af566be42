#include "segment/parts.h"

#include <algorithm>

namespace mimicry {
namespace {

// Numbers faces by what can be reached without a blocked half-edge, lowest face first.
std::vector<Index> flooded(const HalfEdges& edges, const std::vector<bool>& blocked, Index& count) {
  std::vector<Index> labels(at(edges.count() / 3), kNone);
  std::vector<Index> open;
  count = 0;
  for (std::size_t begin = 0; begin < labels.size(); ++begin) {
    if (labels[begin] != kNone) continue;
    labels[begin] = count;
    open.push_back(static_cast<Index>(begin));
    while (!open.empty()) {
      const Index f = open.back();
      open.pop_back();
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        if (blocked[at(h)] || !edges.has_twin(h)) continue;
        const Index g = HalfEdges::face(edges.twin(h));
        if (labels[at(g)] != kNone) continue;
        labels[at(g)] = count;
        open.push_back(g);
      }
    }
    ++count;
  }
  return labels;
}

void count_loops(const HalfEdges& edges, const std::vector<bool>& ends, Segmentation& cut) {
  std::vector<bool> seen(ends.size(), false);
  for (Index begin = 0; begin < edges.count(); ++begin) {
    if (!ends[at(begin)] || seen[at(begin)]) continue;
    ++cut.parts[at(cut.labels[at(HalfEdges::face(begin))])].boundary_loops;
    for (Index h = begin; !seen[at(h)];) {
      seen[at(h)] = true;
      h = HalfEdges::next(h);
      while (!ends[at(h)]) h = HalfEdges::next(edges.twin(h));
    }
  }
}

}  // namespace

std::vector<Index> fan_numbers(const HalfEdges& edges, const std::vector<bool>& blocked) {
  std::vector<Index> fans(at(edges.count()), kNone);
  Index count = 0;
  for (Index begin = 0; begin < edges.count(); ++begin) {
    if (fans[at(begin)] != kNone) continue;
    // Clockwise to where the fan begins, then all of it.
    Index first = begin;
    while (!blocked[at(first)] && edges.has_twin(first)) {
      first = HalfEdges::next(edges.twin(first));
      if (first == begin) break;
    }
    for (Index h = first; fans[at(h)] == kNone;) {
      fans[at(h)] = count;
      const Index side = HalfEdges::previous(h);
      if (blocked[at(side)] || !edges.has_twin(side)) break;
      h = edges.twin(side);
    }
    ++count;
  }
  return fans;
}

void find_parts(Segmentation& cut) {
  const HalfEdges& edges = cut.surface.half_edges();
  const TriangleMesh& mesh = cut.surface.mesh();
  Index components = 0, count = 0;
  flooded(edges, std::vector<bool>(at(edges.count()), false), components);
  cut.labels = flooded(edges, cut.seam_edges, count);
  cut.parts.assign(at(count), {});
  cut.separated = count > components;

  std::vector<bool> ends = cut.seam_edges;  // a boundary of the surface as cut open
  for (Index h = 0; h < edges.count(); ++h)
    if (!edges.has_twin(h)) ends[at(h)] = true;
  const std::vector<Index> fans = fan_numbers(edges, ends);
  Index fan_count = 0;
  double total = 0.0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    SurfacePart& part = cut.parts[at(cut.labels[at(f)])];
    if (part.faces == 0) part.first_parent = cut.parents[at(f)];
    ++part.faces;
    ++part.euler;
    const double area = 0.5 * mesh.area_vector(f).norm();
    part.area += area;
    total += area;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      if (fans[at(h)] >= fan_count) {  // they are numbered in this order
        fan_count = fans[at(h)] + 1;
        ++part.euler;
      }
      if (ends[at(h)] || h < edges.twin(h)) --part.euler;
    }
  }
  for (SurfacePart& part : cut.parts) part.area_share = total > 0.0 ? part.area / total : 0.0;
  count_loops(edges, ends, cut);
}

}  // namespace mimicry
