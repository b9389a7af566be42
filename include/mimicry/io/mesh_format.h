#pragma once

#include <string_view>

namespace mimicry {

enum class MeshFormat { obj, ply, stl, off, glb, gltf };

/// The format that a file name's ending stands for, in either case (.obj .ply .stl .off .glb
/// .gltf). Throws Error(unsupported) for any other ending.
MeshFormat mesh_format_of(std::string_view file_name);
/// Whether it ends in one of those.
bool is_mesh_name(std::string_view file_name);

}  // namespace mimicry
