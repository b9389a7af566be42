#include <cstddef>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/study/targets.h>

namespace mimicry {

void require_fits(const TargetShape& shape, const TriangleMesh& mesh) {
  for (std::size_t c = 0; c < shape.curves.size(); ++c)
    for (std::size_t i = 0; i < shape.curves[c].points.size(); ++i) {
      const Index face = shape.curves[c].points[i].face;
      if (face < 0 || face >= mesh.face_count())
        throw Error(ErrorKind::invalid_input,
                    "targets: shape " + shape.name + ": curve " + std::to_string(c) + ": point " +
                        std::to_string(i) + " lies on face " + std::to_string(face) +
                        ", but the mesh has " + std::to_string(mesh.face_count()) +
                        " faces; pass the mesh that the curves were made on");
    }
  // Faces that the mesh happens to have: the points are all over it.
  constexpr double kLargestStep = 0.25;
  if (mesh.vertex_count() == 0) return;
  Vec3 low = mesh.position(Index{0}), high = low;
  for (const Vec3& x : mesh.positions()) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  for (std::size_t c = 0; c < shape.curves.size(); ++c)
    for (std::size_t i = 1; i < shape.curves[c].points.size(); ++i) {
      const std::vector<SurfacePoint>& points = shape.curves[c].points;
      const double step = (mesh.position(points[i]) - mesh.position(points[i - 1])).norm();
      if (step > kLargestStep * (high - low).norm())
        throw Error(ErrorKind::invalid_input,
                    "targets: shape " + shape.name + ": curve " + std::to_string(c) +
                        " jumps across the mesh at point " + std::to_string(i) +
                        "; pass the mesh that the curves were made on");
    }
}

}  // namespace mimicry
