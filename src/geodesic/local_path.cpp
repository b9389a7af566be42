#include <mimicry/geodesic/paths.h>

#include "geodesic/path_search.h"
#include "geodesic/site.h"
#include "geodesic/strip_path.h"

namespace mimicry {

struct LocalPathFinder::State {
  explicit State(const Surface& surface)
      : held(surface),
        mesh(held.mesh()),
        half_edges(held.half_edges()),
        search(mesh, half_edges),
        strip(mesh, half_edges) {}

  const Surface held;  // keeps alive what the others refer to
  const TriangleMesh& mesh;
  const HalfEdges& half_edges;
  PathSearch search;
  StripPath strip;
};

LocalPathFinder::LocalPathFinder(const Surface& surface)
    : state_(std::make_unique<State>(surface)) {}
LocalPathFinder::~LocalPathFinder() = default;
LocalPathFinder::LocalPathFinder(LocalPathFinder&&) noexcept = default;
LocalPathFinder& LocalPathFinder::operator=(LocalPathFinder&&) noexcept = default;

static bool face_holds(const TriangleMesh& mesh, const HalfEdges& half_edges, Index face,
                       const SurfacePoint& p) {
  if (face == p.face) return true;
  const Site site = site_of(mesh, p);
  if (site.kind == Site::Kind::face) return false;
  if (site.kind == Site::Kind::edge) {
    const Index twin = half_edges.twin(site.index);
    return twin >= 0 && HalfEdges::face(twin) == face;
  }
  const Face& f = mesh.face(face);
  return f[0] == site.index || f[1] == site.index || f[2] == site.index;
}

static bool share_a_face(const TriangleMesh& mesh, const HalfEdges& half_edges,
                         const SurfacePoint& a, const SurfacePoint& b) {
  if (face_holds(mesh, half_edges, a.face, b) || face_holds(mesh, half_edges, b.face, a))
    return true;
  const Site site = site_of(mesh, a);
  if (site.kind == Site::Kind::edge) {
    const Index twin = half_edges.twin(site.index);
    return twin >= 0 && face_holds(mesh, half_edges, HalfEdges::face(twin), b);
  }
  if (site.kind == Site::Kind::vertex) {
    const Index first = half_edges.outgoing(site.index);
    Index h = first;
    do {
      if (face_holds(mesh, half_edges, HalfEdges::face(h), b)) return true;
      h = half_edges.ccw(h);
    } while (h >= 0 && h != first);
  }
  return false;
}

LocalPath LocalPathFinder::find(const SurfacePoint& from, const SurfacePoint& to,
                                std::vector<Crossing>& crossings, const LocalPathOptions& options) {
  State& s = *state_;
  check_surface_point(s.mesh, from, "first point");
  check_surface_point(s.mesh, to, "second point");
  const SurfacePoint a = normalised(from);
  const SurfacePoint b = normalised(to);
  if (share_a_face(s.mesh, s.half_edges, a, b))
    return {PathLabel::same_face, (s.mesh.position(a) - s.mesh.position(b)).norm(), 0};

  const PathSearch::Outcome outcome = s.search.run(a, b, options.most_windows);
  LocalPath path;
  path.windows = s.search.windows();
  if (outcome == PathSearch::Outcome::unreachable) return path;
  path.length = s.search.length();
  if (outcome == PathSearch::Outcome::shortest) {
    path.label = PathLabel::shortest;
    s.search.append_crossings(crossings);
    return path;
  }

  if (!s.strip.run(a, b)) return {PathLabel::disconnected, kInfinity, path.windows};
  path.label = PathLabel::locally_shortest;
  const std::size_t first = crossings.size();
  if (path.length < s.strip.length()) {
    s.search.append_crossings(crossings);
    bool bends = false;
    for (std::size_t i = first; i < crossings.size(); ++i) bends = bends || crossings[i].t == 0.0;
    if (!bends) return path;
    crossings.resize(first);
  }
  path.length = s.strip.length();
  s.strip.append_crossings(crossings);
  return path;
}

}  // namespace mimicry
