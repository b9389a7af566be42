// A mesh of small whole coordinates, so that faces without area, vertices on top of each other and
// points on lines are the rule, and a pair of points on it. Nothing may crash, hang or give a
// number that is none; a path is as long as it says and no shorter than the straight line.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include <mimicry/geodesic/exact.h>
#include <mimicry/geodesic/exponential_map.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/mesh/connect.h>
#include <mimicry/mesh/surface.h>

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

bool is_left_out(const Face& f) {
  return f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
}

SurfacePoint point(Bytes& bytes, const TriangleMesh& mesh) {
  SurfacePoint p{static_cast<Index>(bytes.next() % mesh.face_count()), Vec3::Zero()};
  // Not on a face that is left out; there is one that is not.
  while (is_left_out(mesh.face(p.face))) p.face = (p.face + 1) % mesh.face_count();
  Vec3 weights(bytes.next() % 5, bytes.next() % 5, bytes.next() % 5);
  if (weights.sum() == 0.0) weights[0] = 1.0;
  p.bary = weights / weights.sum();
  return p;
}

double polyline(const TriangleMesh& mesh, const SurfacePoint& from,
                const std::vector<Crossing>& crossings, const SurfacePoint& to) {
  double length = 0.0;
  Vec3 last = mesh.position(from);
  for (const Crossing& c : crossings) {
    require(c.t >= 0.0 && c.t <= 1.0);
    length += (position(mesh, c) - last).norm();
    last = position(mesh, c);
  }
  return length + (mesh.position(to) - last).norm();
}

// #V: from a point of a face straight to its corners, then along edges.
std::vector<double> edge_paths(const TriangleMesh& mesh, Index face, const Vec3& origin) {
  std::vector<double> lengths(at(mesh.vertex_count()), kInfinity);
  for (const Index v : mesh.face(face)) lengths[at(v)] = (mesh.position(v) - origin).norm();
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (const Face& f : mesh.faces())
      for (std::size_t k = 0; k < 3; ++k)
        for (const auto& [from, to] : {std::pair{f[k], f[(k + 1) % 3]}, {f[(k + 1) % 3], f[k]}}) {
          const double length =
              lengths[at(from)] + (mesh.position(from) - mesh.position(to)).norm();
          if (length >= lengths[at(to)]) continue;
          lengths[at(to)] = length;
          shorter = true;
        }
  }
  return lengths;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes{data, size};
  const int vertices = 3 + bytes.next() % 14;
  std::vector<Vec3> positions;
  for (int v = 0; v < vertices; ++v)
    positions.emplace_back(bytes.next() % 8, bytes.next() % 8, bytes.next() % 8);
  const int count = 1 + bytes.next() % 30;
  std::vector<Face> faces;
  for (int f = 0; f < count; ++f)
    faces.push_back({bytes.next() % vertices, bytes.next() % vertices, bytes.next() % vertices});
  const Surface surface(TriangleMesh(positions, faces));
  const TriangleMesh& mesh = surface.mesh();
  // Where every face is left out `connect` returns the mesh that it got, which Target refuses.
  const ConnectReport& report = surface.connection();
  if (report.repeated_corners.count + report.doubled_faces.count == mesh.face_count()) return 0;
  const SurfacePoint a = point(bytes, mesh);
  const SurfacePoint b = point(bytes, mesh);
  const double straight = (mesh.position(a) - mesh.position(b)).norm();
  constexpr double kTolerance = 1e-6;

  ExactGeodesics exact(surface);
  exact.compute(a);
  for (Index v = 0; v < mesh.vertex_count(); ++v) require(exact.distance(v) >= 0.0);
  const double distance = exact.distance(b);
  require(distance >= straight - kTolerance);
  const ExactPath path = exact.path_to(b);
  if (path.found) {
    require(std::abs(path.length - distance) <= kTolerance);
    require(std::abs(polyline(mesh, a, path.crossings, b) - path.length) <= kTolerance);
  }

  LocalPathFinder finder(surface);
  for (const std::size_t work : {std::size_t{1}, std::size_t{20000}}) {
    std::vector<Crossing> crossings;
    LocalPathOptions options;
    options.most_windows = work;
    const LocalPath local = finder.find(a, b, crossings, options);
    if (local.label == PathLabel::disconnected) continue;
    require(std::abs(polyline(mesh, a, crossings, b) - local.length) <= kTolerance);
    require(local.length >= distance - kTolerance);
  }

  const Vec3 direction(bytes.next() - 128, bytes.next() - 128, bytes.next() - 128);
  std::vector<Crossing> crossings;
  const Trace trace = trace_straightest(surface, a, direction, 10.0, &crossings);
  require(trace.end.bary.allFinite() && trace.direction.allFinite());
  require(trace.length <= 10.0);
  require(trace.stop != TraceStop::complete || trace.length == 10.0);
  require(std::isfinite(parallel_transport(surface, a, crossings, trace.end, direction).sum()));
  DiscreteExponentialMap map(surface);
  const ExponentialPatch& patch = map.compute(a, 5.0);
  const std::vector<double> most = edge_paths(mesh, a.face, patch.origin);
  for (std::size_t k = 0; k < patch.vertices.size(); ++k) {
    const double length = patch.coordinates[k].norm();
    require(length <= most[at(patch.vertices[k])] + kTolerance);
    require(length >= (mesh.position(patch.vertices[k]) - patch.origin).norm() - kTolerance);
    require(length <= 5.0);
  }
  return 0;
}
