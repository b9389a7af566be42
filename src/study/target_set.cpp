#include <cstddef>

#include <mimicry/base/error.h>
#include <mimicry/study/target_set.h>

namespace mimicry::study {

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
}

}  // namespace mimicry::study
