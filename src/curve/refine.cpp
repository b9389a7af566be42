#include <algorithm>
#include <cmath>

#include <mimicry/curve/projected_curve.h>

#include "geodesic/site.h"

namespace mimicry {
namespace {

SurfacePoint snapped(const SurfacePoint& p) {
  SurfacePoint q = p;
  for (int k = 0; k < 3; ++k)
    if (q.bary[k] < kSnap) q.bary[k] = 0.0;
  q.bary /= q.bary.sum();
  return q;
}

// An edge by its vertices, smaller number first, so that all its faces agree.
struct Place {
  Site::Kind kind = Site::Kind::face;
  Index a = kNone;  // face, vertex or first vertex
  Index b = kNone;  // second vertex
  double t = 0.0;   // from a to b
};

Place place_of(const TriangleMesh& mesh, const SurfacePoint& p) {
  const Site site = site_of(mesh, p);
  if (site.kind != Site::Kind::edge) return {site.kind, site.index, kNone, 0.0};
  const Face& face = mesh.face(p.face);
  const auto k = static_cast<std::size_t>(HalfEdges::corner(site.index));
  const Index tail = face[k];
  const Index head = face[(k + 1) % 3];
  return tail < head ? Place{site.kind, tail, head, site.t}
                     : Place{site.kind, head, tail, 1.0 - site.t};
}

bool same_place(const TriangleMesh& mesh, const SurfacePoint& p, const SurfacePoint& q) {
  const Place x = place_of(mesh, p);
  const Place y = place_of(mesh, q);
  if (x.kind != y.kind || x.a != y.a || x.b != y.b) return false;
  if (x.kind == Site::Kind::face) return (p.bary - q.bary).cwiseAbs().maxCoeff() < kSnap;
  return std::abs(x.t - y.t) < kSnap;
}

// A geodesic from `end` cannot come back to an edge that `end` is on: such a crossing is rounding.
bool crosses_own_edge(const TriangleMesh& mesh, const SurfacePoint& end, const SurfacePoint& p) {
  const Place x = place_of(mesh, end);
  const Place y = place_of(mesh, p);
  if (y.kind != Site::Kind::edge) return false;
  if (x.kind == Site::Kind::vertex) return x.a == y.a || x.a == y.b;
  return x.kind == Site::Kind::edge && x.a == y.a && x.b == y.b;
}

class Refiner {
 public:
  Refiner(const TriangleMesh& mesh, const HalfEdges& half_edges)
      : mesh_(mesh), half_edges_(half_edges) {}

  void part() {
    refined_.parts.push_back(refined_.nodes.size());
    push({snapped_, mesh_.position(snapped_), along()});
  }

  void add() {
    RefinedNode& last = refined_.nodes.back();
    if (same_place(mesh_, last.point, snapped_)) return;
    const Index face = shared_face(mesh_, half_edges_, last.point, snapped_);
    if (face == kNone) {
      part();
      return;
    }
    refined_.faces.back() = face;
    const Vec3 position = mesh_.position(snapped_);
    push({snapped_, position, last.length + (position - last.position).norm()});
  }

  RefinedCurve run(const ProjectedCurve& curve) {
    std::vector<SurfacePoint> crossings;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const SurfacePoint end = snapped(curve.points[i].surface);
      const bool joined = i > 0 && curve.pieces[i - 1].kind != PieceKind::gap &&
                          curve.pieces[i - 1].kind != PieceKind::chord;
      if (joined) {
        const SurfacePoint start = snapped(curve.points[i - 1].surface);
        crossings.clear();
        for (const Crossing& c : curve.piece_crossings(i - 1)) {
          const SurfacePoint p = snapped(surface_point(c));
          if (!crossings.empty() || !crosses_own_edge(mesh_, start, p)) crossings.push_back(p);
        }
        while (!crossings.empty() && crosses_own_edge(mesh_, end, crossings.back()))
          crossings.pop_back();
        for (const SurfacePoint& p : crossings) snapped_ = p, add();
      }
      snapped_ = end;
      if (joined)
        add();
      else
        part();
      refined_.point_nodes.push_back(refined_.nodes.size() - 1);
    }
    refined_.closed = curve.closed && refined_.nodes.size() > 2 &&
                      same_place(mesh_, refined_.nodes.front().point, refined_.nodes.back().point);
    return std::move(refined_);
  }

 private:
  double along() const { return refined_.nodes.empty() ? 0.0 : refined_.nodes.back().length; }
  void push(const RefinedNode& node) {
    refined_.nodes.push_back(node);
    refined_.faces.push_back(kNone);
  }

  const TriangleMesh& mesh_;
  const HalfEdges& half_edges_;
  SurfacePoint snapped_;  // the next node
  RefinedCurve refined_;
};

}  // namespace

RefinedCurve refine(const ProjectedCurve& curve, const Surface& surface) {
  const TriangleMesh& mesh = surface.mesh();
  const HalfEdges& half_edges = surface.half_edges();
  return Refiner(mesh, half_edges).run(curve);
}

}  // namespace mimicry
