#include "io/mesh_writers.h"

namespace mimicry {

std::string write_obj(const TriangleMesh& mesh) {
  std::string out;
  for (const Vec3& position : mesh.positions()) {
    out += "v ";
    append_triple(out, position);
    out += '\n';
  }
  for (const Face& face : mesh.faces()) {
    out += "f ";
    append_triple(out, face, 1);
    out += '\n';
  }
  return out;
}

}  // namespace mimicry
