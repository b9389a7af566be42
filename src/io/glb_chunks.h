#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace mimicry {

/// The two chunks of a GLB file.
struct GlbChunks {
  std::string_view json;
  std::optional<std::string_view> binary;
};

/// Whether bytes begin as a GLB file does.
bool is_glb(std::string_view bytes);

/// Lengths and alignment are taken as hints: the JSON ends where its object does, the binary chunk
/// is looked for behind it and ends with the file at the latest. What was mended is told to
/// `note`. Throws Error where there is no JSON, or the version is not 2.
GlbChunks split_glb(std::string_view bytes, std::string_view name,
                    const std::function<void(const std::string&)>& note);

}  // namespace mimicry
