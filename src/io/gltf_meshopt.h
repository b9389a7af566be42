#pragma once

#include <string>
#include <string_view>

#include "io/gltf_json.h"

namespace mimicry {

// EXT_meshopt_compression, by meshoptimizer where that was found when mimicry was built.

bool meshopt_is_built_in();
[[noreturn]] void fail_without_meshopt(const GltfJson& gltf, const std::string& place);

/// The content of a bufferView. `extension` holds its count, stride, mode and filter; `bytes` is
/// the compressed form. At most 64 times as large as that. Throws Error where it is damaged.
std::string decode_meshopt(const GltfJson& gltf, const Json& extension, std::string_view bytes,
                           const std::string& place);

}  // namespace mimicry
