#pragma once

#include <string>

#include <mimicry/mesh/triangle_mesh.h>
#include <mimicry/spatial/target.h>

#include "assets/work.h"

namespace mimicry::assets {

struct NamedMesh {
  std::string name;  ///< the file's name without folders, or the shape's
  TriangleMesh mesh;
  double
      metres_per_unit;  ///< at which it is shown: the shape's own; of a file the diagonal is 0.6 m
};

/// The mesh of a file (.obj .ply .stl .off .glb .gltf; .mimicry: the mesh that was baked) or a
/// built-in shape (shape:NAME[:RESOLUTION]). The monitor hears what the reader mended. Throws Error
/// where the file or shape cannot be had.
NamedMesh load_mesh(const std::string& spec, const Monitor& monitor = {});

/// The mesh file of this name in a folder, whatever its kind. Throws Error(io) where there is none.
std::string find_mesh_file(const std::string& folder, const std::string& name);

/// What load_mesh takes for the shape of this name: a file of the folder (by its own name, or with
/// the ending of a mesh), or a built-in shape where there is no folder. Throws Error(io).
std::string mesh_spec(const std::string& folder, const std::string& shape);

/// A target of the mesh; errors name it. The monitor hears what was mended to make it.
Target make_target(const NamedMesh& named, const TargetOptions& options = {},
                   const Monitor& monitor = {});

}  // namespace mimicry::assets
