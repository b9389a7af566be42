#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/spatial/target.h>

#include "mesh/visible_normals.h"
#include "spatial/bvh.h"
#include "spatial/surface_search.h"
#include "spatial/triangle.h"

namespace mimicry {
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

// Positions of a surface that a target can stand on; all of them are used.
void check_positions(std::span<const Vec3> positions, const TriangleMesh& surface) {
  std::size_t bad = 0;
  Index first_bad = kNone;
  Eigen::AlignedBox3d box;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (is_finite(positions[v])) {
      box.extend(positions[v]);
    } else if (bad++ == 0) {
      first_bad = surface.source() ? surface.source()->vertex[v] : static_cast<Index>(v);
    }
  }
  if (bad > 0)
    refuse(std::to_string(bad) + " vertices are not finite (first: vertex " +
           std::to_string(first_bad) + "); repair the mesh");
  if (std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()) > kLargestSize)
    refuse("coordinates beyond 1e30; scale the mesh");
  const double size = box.sizes().maxCoeff();
  if (size > 0.0 && size < kSmallestSize) refuse("smaller than 1e-30; scale the mesh");
  const bool any_area =
      std::any_of(surface.faces().begin(), surface.faces().end(),
                  [&](const Face& f) { return has_area(triangle_of(positions, f)); });
  if (!any_area)
    refuse("none of the " + std::to_string(surface.face_count()) +
           " faces has an area (first: face 0); repair the mesh");
}

void check_flawless(ConnectReport report) {
  // What is no flaw is not told.
  report.joined_vertices = report.unused_vertices = {};
  report.joined_edges = report.seam_edges = {};
  std::string flaws;
  for (const std::string& sentence : report.sentences()) flaws += "; " + sentence;
  if (report.is_flawed())
    refuse("strictly, this mesh is refused" + flaws + "; repair it, or let it be mended");
}

Eigen::AlignedBox3d box_of(std::span<const Vec3> positions) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : positions) box.extend(p);
  return box;
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

struct Target::State {
  std::vector<Vec3> moved;            // #V, room for update_positions; empty: as the caller numbers
  std::vector<Vec3> visible_normals;  // #V
  Bvh<3, Triangle> bvh;
  Eigen::AlignedBox3d box;
  double diagonal = 0.0;
};

Target::Target(TriangleMesh mesh, const TargetOptions& options) {
  if (mesh.face_count() == 0) refuse("the mesh has no faces; give one with triangles");
  Surface surface(std::move(mesh), {.join = options.join});
  check_positions(surface.mesh().positions(), surface.mesh());
  if (options.strict) check_flawless(surface.connection());
  surface_ = std::move(surface);
  state_ = std::make_shared<State>();
  const std::span<const Vec3> positions = surface_.mesh().positions();
  const std::span<const Face> faces = surface_.mesh().faces();
  if (surface_.mesh().source()) state_->moved.resize(positions.size());
  state_->visible_normals.assign(vertex_normals().begin(), vertex_normals().end());
  make_visible(surface_.mesh(), surface_.half_edges(), state_->visible_normals);
  state_->bvh = Bvh<3, Triangle>(surface_.mesh().face_count(),
                                 [&](Index f) { return triangle_of(positions, faces[at(f)]); });
  state_->box = box_of(positions);
  state_->diagonal = state_->box.diagonal().norm();
}

std::span<const Vec3> Target::visible_normals() const {
  return state_->visible_normals;
}

const Eigen::AlignedBox3d& Target::bounding_box() const {
  return state_->box;
}

double Target::diagonal() const {
  return state_->diagonal;
}

std::optional<ClosestPoint> Target::closest_point(const Vec3& y, double upper_bound,
                                                  Index hint) const {
  if (!is_usable(y) || std::isnan(upper_bound) || upper_bound < 0.0) return std::nullopt;
  const double bound2 = upper_bound <= kFarthestQuery ? upper_bound * upper_bound : kInfinity;
  const TriangleMesh& mesh = surface_.mesh();
  const NearestTriangle best = nearest_triangle(state_->bvh, y, bound2, hint, [&](Index f) {
    return triangle_of(mesh.positions(), mesh.face(f));
  });
  if (best.surface.face == kNone) return std::nullopt;
  return ClosestPoint{best.surface, best.position, std::sqrt(best.distance2)};
}

std::optional<RayHit> Target::first_hit(const Vec3& origin, const Vec3& direction) const {
  const Vec3 d = unit(direction);
  if (!is_usable(origin) || d.isZero(0.0)) return std::nullopt;
  const TriangleOnRay hit = first_on_ray(state_->bvh, Ray(origin, d));
  if (hit.surface.face == kNone) return std::nullopt;
  return RayHit{hit.surface, hit.position, hit.t};
}

void Target::all_hits(const Vec3& origin, const Vec3& direction, std::vector<RayHit>& hits) const {
  const Vec3 d = unit(direction);
  if (!is_usable(origin) || d.isZero(0.0)) return;
  const auto before = static_cast<std::ptrdiff_t>(hits.size());
  each_on_ray(state_->bvh, Ray(origin, d), [&](const TriangleOnRay& hit) {
    hits.push_back({hit.surface, hit.position, hit.t});
  });
  std::sort(hits.begin() + before, hits.end(), [](const RayHit& a, const RayHit& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.surface.face < b.surface.face;
  });
}

void Target::update_positions(std::span<const Vec3> positions) {
  Surface::Data& surface = *surface_.data_;
  TriangleMesh& mesh = surface.mesh;
  std::vector<Vec3>& moved = state_->moved;
  if (const MeshSource* source = mesh.source()) {
    if (positions.size() != source->surface_vertex.size())
      refuse(std::to_string(positions.size()) + " new positions for " +
             std::to_string(source->surface_vertex.size()) + " vertices");
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] = positions[at(source->vertex[v])];
    positions = moved;
  }
  if (positions.size() == mesh.positions().size()) check_positions(positions, mesh);
  mesh.set_positions(positions);
  angle_weighted_normals(mesh, surface.normals);
  std::copy(surface.normals.begin(), surface.normals.end(), state_->visible_normals.begin());
  make_visible(mesh, surface.half_edges, state_->visible_normals);
  state_->bvh.refit([&](Index f) { return triangle_of(mesh.positions(), mesh.face(f)); });
  state_->box = box_of(mesh.positions());
  state_->diagonal = state_->box.diagonal().norm();
}

std::size_t Target::memory_bytes() const {
  return surface_.memory_bytes() +
         (state_->visible_normals.capacity() + state_->moved.capacity()) * sizeof(Vec3) +
         state_->bvh.memory_bytes();
}

}  // namespace mimicry
