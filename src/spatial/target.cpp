#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/spatial/surface_search.h>
#include <mimicry/spatial/target.h>

namespace mimicry::spatial {
namespace {

constexpr double kSmallestSize = 1e-30, kLargestSize = 1e30, kFarthestQuery = 1e60;

Triangle triangle_of(std::span<const Vec3> positions, const Face& f) {
  return {positions[static_cast<std::size_t>(f[0])], positions[static_cast<std::size_t>(f[1])],
          positions[static_cast<std::size_t>(f[2])]};
}

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorKind::invalid_input, "target: " + what);
}

// Without arithmetic on what is not finite, nor comparison: both may trap.
bool is_finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

bool is_usable(const Vec3& x) {
  return is_finite(x) && x.cwiseAbs().maxCoeff() <= kFarthestQuery;
}

// Positions that a target can stand on. Vertices that no face uses must be sound, too: they count
// in the bounding box.
void check_positions(std::span<const Vec3> positions, std::span<const Face> faces) {
  std::size_t bad = 0, first_bad = 0;
  Eigen::AlignedBox3d box;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (is_finite(positions[v])) {
      box.extend(positions[v]);
    } else if (bad++ == 0) {
      first_bad = v;
    }
  }
  if (bad > 0)
    refuse(std::to_string(bad) + " vertices are not finite (first: vertex " +
           std::to_string(first_bad) + "); repair the mesh");
  if (std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()) > kLargestSize)
    refuse("coordinates beyond 1e30; scale the mesh");
  const double size = box.sizes().maxCoeff();
  if (size > 0.0 && size < kSmallestSize) refuse("smaller than 1e-30; scale the mesh");
  const bool any_area = std::any_of(faces.begin(), faces.end(), [&](const Face& f) {
    return has_area(triangle_of(positions, f));
  });
  if (!any_area)
    refuse("none of the " + std::to_string(faces.size()) +
           " faces has an area (first: face 0); repair the mesh");
}

void check_manifold(const HalfEdges& edges, Index vertices) {
  Index bad_edges = 0, first_edge = kNone, bad_vertices = 0, first_vertex = kNone;
  for (Index h = 0; h < edges.count(); ++h)
    if (edges.twin(h) == HalfEdges::kNonManifold && bad_edges++ == 0) first_edge = h;
  for (Index v = 0; v < vertices; ++v)
    if (edges.is_nonmanifold_vertex(v) && bad_vertices++ == 0) first_vertex = v;
  const std::string remedy =
      "; repair the mesh or allow non-manifold targets (--allow-nonmanifold)";
  if (bad_edges > 0)
    refuse(
        std::to_string(bad_edges) +
        " half-edges lie on edges with 3 or more faces, or between faces of opposite orientation "
        "(first: vertices " +
        std::to_string(edges.tail(first_edge)) + "-" + std::to_string(edges.head(first_edge)) +
        ")" + remedy);
  if (bad_vertices > 0)
    refuse(std::to_string(bad_vertices) +
           " vertices join faces that share no edge there (first: vertex " +
           std::to_string(first_vertex) + ")" + remedy);
}

// Unit length; zero where there is no direction.
Vec3 unit(const Vec3& direction) {
  if (!is_finite(direction)) return Vec3::Zero();
  const double largest = direction.cwiseAbs().maxCoeff();
  if (largest == 0.0) return Vec3::Zero();
  if (largest > 1e-100 && largest < 1e100) return direction / direction.norm();
  const Vec3 scaled = direction / largest;  // squares neither vanish nor overflow
  return scaled / scaled.norm();
}

}  // namespace

Target::Target(TriangleMesh mesh, const TargetOptions& options) : mesh_(std::move(mesh)) {
  if (mesh_.face_count() == 0) refuse("the mesh has no faces; give one with triangles");
  check_positions(mesh_.positions(), mesh_.faces());
  half_edges_ = HalfEdges(mesh_);
  if (!options.allow_nonmanifold && !half_edges_.is_manifold())
    check_manifold(half_edges_, mesh_.vertex_count());
  normals_ = angle_weighted_normals(mesh_);
  visible_normals_ = normals_;
  make_visible(mesh_, half_edges_, visible_normals_);
  bvh_ = Bvh<3, Triangle>(mesh_.face_count(),
                          [&](Index f) { return triangle_of(mesh_.positions(), mesh_.face(f)); });
  box_ = mimicry::bounding_box(mesh_);
  diagonal_ = box_.diagonal().norm();
}

std::optional<ClosestPoint> Target::closest_point(const Vec3& y, double upper_bound,
                                                  Index hint) const {
  if (!is_usable(y) || std::isnan(upper_bound) || upper_bound < 0.0) return std::nullopt;
  const double bound2 = upper_bound <= kFarthestQuery ? upper_bound * upper_bound : kInfinity;
  const NearestTriangle best = nearest_triangle(bvh_, y, bound2, hint, [&](Index f) {
    return triangle_of(mesh_.positions(), mesh_.face(f));
  });
  if (best.surface.face == kNone) return std::nullopt;
  return ClosestPoint{best.surface, best.position, std::sqrt(best.distance2)};
}

std::optional<RayHit> Target::first_hit(const Vec3& origin, const Vec3& direction) const {
  const Vec3 d = unit(direction);
  if (!is_usable(origin) || d.isZero(0.0)) return std::nullopt;
  const TriangleOnRay hit = first_on_ray(bvh_, Ray(origin, d));
  if (hit.surface.face == kNone) return std::nullopt;
  return RayHit{hit.surface, hit.position, hit.t};
}

void Target::all_hits(const Vec3& origin, const Vec3& direction, std::vector<RayHit>& hits) const {
  const Vec3 d = unit(direction);
  if (!is_usable(origin) || d.isZero(0.0)) return;
  const auto before = static_cast<std::ptrdiff_t>(hits.size());
  each_on_ray(bvh_, Ray(origin, d), [&](const TriangleOnRay& hit) {
    hits.push_back({hit.surface, hit.position, hit.t});
  });
  std::sort(hits.begin() + before, hits.end(), [](const RayHit& a, const RayHit& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.surface.face < b.surface.face;
  });
}

void Target::update_positions(std::span<const Vec3> positions) {
  if (positions.size() == mesh_.positions().size()) check_positions(positions, mesh_.faces());
  mesh_.set_positions(positions);
  angle_weighted_normals(mesh_, normals_);
  std::copy(normals_.begin(), normals_.end(), visible_normals_.begin());
  make_visible(mesh_, half_edges_, visible_normals_);
  bvh_.refit([&](Index f) { return triangle_of(mesh_.positions(), mesh_.face(f)); });
  box_ = mimicry::bounding_box(mesh_);
  diagonal_ = box_.diagonal().norm();
}

std::size_t Target::memory_bytes() const {
  return mesh_.memory_bytes() + half_edges_.memory_bytes() +
         (normals_.capacity() + visible_normals_.capacity()) * sizeof(Vec3) + bvh_.memory_bytes();
}

}  // namespace mimicry::spatial
