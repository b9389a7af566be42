#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf_json.h"

namespace mimicry {

// KHR_draco_mesh_compression, by Google's draco where that was found when mimicry was built.

bool draco_is_built_in();
[[noreturn]] void fail_without_draco(const GltfJson& gltf, const std::string& place);

/// The number of triangles that the compressed form announces; nothing is decoded. The decoder
/// makes no more of them.
std::size_t draco_face_count(const GltfJson& gltf, std::string_view bytes,
                             const std::string& place);

struct DracoAttribute {
  std::string bytes;           // packed, an element for each point
  std::size_t components = 0;  // 0: there is no such attribute
  int component_type = 0;      // glTF's; 0: of a kind that glTF has not, without bytes
};

struct DracoMesh {
  std::size_t points = 0;
  std::string corners;  // packed 32-bit numbers of points, 3 a triangle
  std::vector<DracoAttribute> attributes;
};

/// ids: of the attributes that are wanted, as the bytes number them. Throws Error where the bytes
/// are damaged.
DracoMesh decode_draco(const GltfJson& gltf, std::string_view bytes,
                       const std::vector<std::size_t>& ids, const std::string& place);

}  // namespace mimicry
