#include <cmath>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>

#include "base/float_traps.h"
#include "io/mesh_writers.h"
#include "io/number.h"

namespace mimicry {

void append_triple(std::string& out, const Vec3& x) {
  append_double(out, x[0]);
  out += ' ';
  append_double(out, x[1]);
  out += ' ';
  append_double(out, x[2]);
}

void append_triple(std::string& out, const Face& face, Index first_number) {
  out += std::to_string(face[0] + first_number);
  out += ' ';
  out += std::to_string(face[1] + first_number);
  out += ' ';
  out += std::to_string(face[2] + first_number);
}

Eigen::Vector3f to_single(const TriangleMesh& mesh, Index vertex, const char* format,
                          const Vec3& origin) {
  const Eigen::Vector3f position = (mesh.position(vertex) - origin).cast<float>();
  for (const float x : position)
    if (!std::isfinite(x))
      throw Error(ErrorKind::invalid_input, std::string("mesh: vertex ") + std::to_string(vertex) +
                                                " is not finite in single precision, which " +
                                                format +
                                                " holds; remove it, or write PLY, OBJ or OFF");
  return position;
}

std::string write_mesh(const TriangleMesh& mesh, MeshFormat format,
                       const MeshWriteOptions& options) {
  const FloatTrapMask mask;  // to single precision may overflow
  const WriteNote note = [&](const std::string& sentence) {
    if (options.note) options.note(sentence);
  };
  if (!options.texture_png.empty() && (!mesh.attributes() || mesh.attributes()->texcoords.empty()))
    throw Error(ErrorKind::invalid_input,
                "mesh: a texture needs texture coordinates, and the mesh has none; give it some");
  switch (format) {
    case MeshFormat::obj:
      return write_obj(mesh, options.material_file, note);
    case MeshFormat::ply:
      return write_ply(mesh, options.text, note);
    case MeshFormat::stl:
      if (mesh.attributes()) note("STL holds no attributes of meshes; they are left out");
      return write_stl(mesh, options.text);
    case MeshFormat::off:
      return write_off(mesh, note);
    case MeshFormat::glb:
      return write_glb(mesh, options.texture_png, note);
    case MeshFormat::gltf:
      break;
  }
  throw Error(ErrorKind::unsupported, "mesh: glTF text is not written; write GLB");
}

}  // namespace mimicry
