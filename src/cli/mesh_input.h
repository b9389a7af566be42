#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <mimicry/mesh/triangle_mesh.h>
#include <mimicry/spatial/target.h>

namespace mimicry::cli {

/// How meshes are named on the command line, for help texts.
inline constexpr const char* kMeshHelp =
    "a mesh file (.obj .ply .stl .off .glb .gltf; .mimicry: the mesh that was baked) or a built-in "
    "shape (shape:NAME[:RESOLUTION])";

struct NamedMesh {
  std::string name;  ///< the file's name without folders, or the shape's
  TriangleMesh mesh;
  double
      metres_per_unit;  ///< at which it is shown: the shape's own; of a file the diagonal is 0.6 m
};

/// Throws Error where the file or shape cannot be had.
NamedMesh load_mesh(const std::string& spec);

/// The mesh file of this name in a folder, whatever its kind. Throws Error(io) where there is none.
std::string find_mesh_file(const std::string& folder, const std::string& name);

/// --no-join, --strict and the former --allow-nonmanifold, which says that it is not needed.
void add_target_options(CLI::App& command, spatial::TargetOptions& options);

/// A target of the mesh; errors name it. What was mended to make it is said on stderr.
spatial::Target make_target(const NamedMesh& named, const spatial::TargetOptions& options = {});
/// The same and says nothing.
spatial::Target make_target_silently(const NamedMesh& named,
                                     const spatial::TargetOptions& options = {});

}  // namespace mimicry::cli
