#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/io/meshes.h>

#include "io/gltf_json.h"

namespace mimicry {

/// The bytes that accessors lie in. A buffer is looked at when something needs it, once: what no
/// triangle needs may be missing, empty or broken.
class GltfBuffers {
 public:
  /// glb: the binary chunk of a GLB. file_size: of the file itself. The options must outlive this.
  GltfBuffers(const GltfJson& gltf, std::optional<std::string_view> glb, std::size_t file_size,
              const MeshReadOptions& options)
      : gltf_(gltf), glb_(glb), read_bytes_(file_size), options_(options) {}

  /// Part of a buffer, or what it holds in compressed form.
  struct View {
    std::string_view bytes;  // from its begin; may go on where the view ends
    std::size_t length = 0;  // the view's own
    std::size_t stride = 0;  // 0: elements are packed
    std::string place;       // for messages
  };
  View view(std::size_t index, const std::string& user);

  /// The size of the file and of all that was loaded beside it.
  std::size_t read_bytes() const { return read_bytes_; }
  /// What a file of that size may unfold to (MeshReadOptions::max_unfolded).
  double allowance() const;
  /// The end of a sentence that says what raises it; empty where its reader cannot.
  std::string raised_with() const;
  /// Counts work that a file can ask for again and again with a few bytes. Throws
  /// Error(unsupported) where it is more than the allowance.
  void spend(std::size_t work, const std::string& place);

 private:
  std::string_view buffer(std::size_t index, const std::string& user);
  std::string_view named_file(const std::string& uri, const std::string& place);
  const std::string& keep(std::string bytes);
  std::string_view part(const Json& object, std::size_t& length, const std::string& place);

  const GltfJson& gltf_;
  std::optional<std::string_view> glb_;
  std::vector<std::unique_ptr<const std::string>> kept_;
  std::size_t read_bytes_;
  const MeshReadOptions& options_;
  double spent_ = 0.0;
  std::map<std::size_t, std::string_view> buffers_;
  std::map<std::string, std::string_view> files_;  // by name
  std::map<std::size_t, std::string_view> decompressed_;
};

}  // namespace mimicry
