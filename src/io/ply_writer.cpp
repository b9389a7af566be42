#include "io/binary.h"
#include "io/mesh_writers.h"

namespace mimicry {

std::string write_ply(const TriangleMesh& mesh, bool text) {
  std::string out = std::string("ply\nformat ") + (text ? "ascii" : "binary_little_endian") +
                    " 1.0\nelement vertex " + std::to_string(mesh.vertex_count()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                    std::to_string(mesh.face_count()) +
                    "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& position : mesh.positions()) {
    if (text) {
      append_triple(out, position);
      out += '\n';
    } else {
      for (const double x : position) append_little_endian(out, x);
    }
  }
  for (const Face& face : mesh.faces()) {
    if (text) {
      out += "3 ";
      append_triple(out, face);
      out += '\n';
    } else {
      out += '\x03';
      for (const Index v : face) append_little_endian(out, v);
    }
  }
  return out;
}

}  // namespace mimicry
