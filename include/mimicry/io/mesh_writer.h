#pragma once

#include <string>

#include <mimicry/io/mesh_format.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

struct MeshWriteOptions {
  bool text = false;  ///< PLY and STL as text instead of binary; the other formats have one form
};

/// The bytes of a file that holds the mesh's triangles; source polygons are not put together
/// again. OBJ, OFF and PLY keep every bit of the coordinates; STL and GLB hold single precision by
/// format, in either form. STL and GLB throw Error(invalid_input) for a coordinate that is not
/// finite in single precision; GLB for a mesh without faces; glTF throws Error(unsupported), write
/// GLB. O(#V + #F).
std::string write_mesh(const TriangleMesh& mesh, MeshFormat format,
                       const MeshWriteOptions& options = {});

}  // namespace mimicry
