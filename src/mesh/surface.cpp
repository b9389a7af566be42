#include <cmath>
#include <utility>

#include <mimicry/mesh/surface.h>

namespace mimicry {
namespace {

// Zero for a mesh with a vertex that is not finite: whoever needs it refuses it by name.
std::vector<Vec3> normals_of(const TriangleMesh& mesh) {
  for (const Vec3& p : mesh.positions())
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      return std::vector<Vec3>(mesh.positions().size(), Vec3::Zero());
  return angle_weighted_normals(mesh);
}

}  // namespace

Surface::Surface(TriangleMesh mesh, const ConnectOptions& options) {
  Connected connected = connect(std::move(mesh), options);
  std::vector<Vec3> normals = normals_of(connected.mesh);
  data_ = std::make_shared<Data>(Data{std::move(connected.mesh), std::move(connected.half_edges),
                                      std::move(normals), connected.report});
}

Surface Surface::as_given(TriangleMesh mesh) {
  HalfEdges half_edges(mesh);
  std::vector<Vec3> normals = normals_of(mesh);
  Surface surface;
  surface.data_ = std::make_shared<Data>(
      Data{std::move(mesh), std::move(half_edges), std::move(normals), ConnectReport{}});
  return surface;
}

std::size_t Surface::memory_bytes() const {
  return data_->mesh.memory_bytes() + data_->half_edges.memory_bytes() +
         data_->normals.capacity() * sizeof(Vec3);
}

}  // namespace mimicry
