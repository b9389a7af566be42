#include "io/mesh_writers.h"

namespace mimicry {

std::string write_off(const TriangleMesh& mesh) {
  std::string out = "OFF\n" + std::to_string(mesh.vertex_count()) + " " +
                    std::to_string(mesh.face_count()) + " 0\n";
  for (const Vec3& position : mesh.positions()) {
    append_triple(out, position);
    out += '\n';
  }
  for (const Face& face : mesh.faces()) {
    out += "3 ";
    append_triple(out, face);
    out += '\n';
  }
  return out;
}

}  // namespace mimicry
