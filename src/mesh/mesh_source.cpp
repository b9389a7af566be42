#include <utility>

#include <mimicry/mesh/connect.h>

namespace mimicry {
namespace {

bool is_turned(const TriangleMesh& surface, Index f) {
  return surface.source() && surface.source()->turned[at(f)];
}

// Corner k of a face in the order of its other side.
constexpr int other_corner(int k) {
  return (3 - k) % 3;
}

}  // namespace

SurfacePoint source_point(const TriangleMesh& surface, SurfacePoint p) {
  if (p.face >= 0 && is_turned(surface, p.face)) std::swap(p.bary[1], p.bary[2]);
  return p;
}

Crossing source_crossing(const TriangleMesh& surface, const Crossing& c) {
  const Index f = HalfEdges::face(c.half_edge);
  if (!is_turned(surface, f)) return c;
  const int tail = other_corner(HalfEdges::corner(c.half_edge));
  // The other order runs along this edge the other way, from the corner where this one ends.
  if (c.t == 0.0) return {3 * f + tail, 0.0};
  return {3 * f + (tail + 2) % 3, 1.0 - c.t};
}

Index source_vertex(const TriangleMesh& surface, Index f, int k) {
  const MeshSource* source = surface.source();
  if (!source) return surface.face(f)[at(k)];
  return source->faces[at(f)][at(source->turned[at(f)] ? other_corner(k) : k)];
}

Index source_corner(const TriangleMesh& surface, Index f, int k) {
  return surface.source() ? surface.source()->faces[at(f)][at(k)] : surface.face(f)[at(k)];
}

Index source_vertex_count(const TriangleMesh& surface) {
  const MeshSource* source = surface.source();
  return source ? static_cast<Index>(source->surface_vertex.size()) : surface.vertex_count();
}

}  // namespace mimicry
