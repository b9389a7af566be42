#include "io/binary.h"
#include "io/mesh_writers.h"

namespace mimicry {

std::string write_stl(const TriangleMesh& mesh, bool text) {
  std::string out;
  if (text) {
    out = "solid mesh\n";
  } else {
    out = "binary STL";
    out.resize(80, ' ');
    append_little_endian(out, static_cast<std::uint32_t>(mesh.face_count()));
  }
  for (const Face& face : mesh.faces()) {
    Eigen::Matrix3f corners;
    for (int k = 0; k < 3; ++k)
      corners.col(k) = to_single(mesh, face[static_cast<std::size_t>(k)], "STL");
    // The normal of the corners as they are written; 0 where there is none.
    const Mat3 wide = corners.cast<double>();
    const Eigen::Vector3f normal = (wide.col(1) - wide.col(0))
                                       .cross(wide.col(2) - wide.col(0))
                                       .stableNormalized()
                                       .cast<float>();
    if (text) {
      out += "facet normal ";
      append_triple(out, normal.cast<double>());
      out += "\n outer loop\n";
      for (int k = 0; k < 3; ++k) {
        out += "  vertex ";
        append_triple(out, wide.col(k));
        out += '\n';
      }
      out += " endloop\nendfacet\n";
    } else {
      for (const float x : normal) append_little_endian(out, x);
      for (const float x : corners.reshaped()) append_little_endian(out, x);
      out += '\0';
      out += '\0';
    }
  }
  if (text) out += "endsolid mesh\n";
  return out;
}

}  // namespace mimicry
