#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/base/types.h>

#include "io/gltf_buffers.h"
#include "io/gltf_json.h"

namespace mimicry {

/// Component types of accessors.
constexpr int kGltfByte = 5120;
constexpr int kGltfUnsignedByte = 5121;
constexpr int kGltfShort = 5122;
constexpr int kGltfUnsignedShort = 5123;
constexpr int kGltfUnsignedInt = 5125;
constexpr int kGltfFloat = 5126;

/// The numbers of an accessor, which are known to lie within their buffers. Without a bufferView
/// they are zeros; sparse ones replace them.
class GltfAccessor {
 public:
  GltfAccessor() = default;
  /// type: "SCALAR", "VEC2", "VEC3", "VEC4" or "MAT4". user: who needs it, for messages. Throws
  /// Error where it is of another type or its bytes are not there.
  GltfAccessor(const GltfJson& gltf, GltfBuffers& buffers, std::size_t index, const char* type,
               const std::string& user);
  /// Elements that were decoded elsewhere, packed; `bytes` must outlive this.
  GltfAccessor(std::string_view bytes, std::size_t count, std::size_t components,
               int component_type, bool normalized);

  std::size_t count() const { return count_; }
  std::size_t components() const { return components_; }
  bool holds_whole_numbers() const;
  /// Component k of an element, normalized where the accessor says so.
  double at(std::size_t element, std::size_t k) const;
  Vec3 vec3(std::size_t element) const { return {at(element, 0), at(element, 1), at(element, 2)}; }

 private:
  void read_view(const GltfJson& gltf, GltfBuffers& buffers, const Json& accessor,
                 const std::string& place);
  void read_sparse(const GltfJson& gltf, GltfBuffers& buffers, const Json& accessor,
                   const std::string& place);

  const char* data_ = nullptr;  // null: zeros
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
  std::size_t components_ = 0;
  int component_type_ = 0;
  bool normalized_ = false;
  struct Sparse {
    std::size_t element;
    const char* data;
  };
  std::vector<Sparse> sparse_;  // by element
};

/// What messages call the accessor.
std::string accessor_place(std::size_t index);

}  // namespace mimicry
