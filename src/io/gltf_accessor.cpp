#include "io/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <iterator>

#include "io/binary.h"
#include "io/text.h"

namespace mimicry {
namespace {

std::size_t component_size(int type) {
  switch (type) {
    case kGltfByte:
    case kGltfUnsignedByte:
      return 1;
    case kGltfShort:
    case kGltfUnsignedShort:
      return 2;
    case kGltfUnsignedInt:
    case kGltfFloat:
      return 4;
    default:
      return 0;
  }
}

double load_component(const char* p, int type, bool normalized) {
  switch (type) {
    case kGltfByte:
      return normalized ? std::max(load<std::int8_t>(p) / 127.0, -1.0) : load<std::int8_t>(p);
    case kGltfUnsignedByte:
      return load<std::uint8_t>(p) / (normalized ? 255.0 : 1.0);
    case kGltfShort:
      return normalized ? std::max(load<std::int16_t>(p) / 32767.0, -1.0) : load<std::int16_t>(p);
    case kGltfUnsignedShort:
      return load<std::uint16_t>(p) / (normalized ? 65535.0 : 1.0);
    case kGltfUnsignedInt:
      return load<std::uint32_t>(p);
    default:
      return load<float>(p);
  }
}

std::size_t components_of(std::string_view type) {
  if (type == "SCALAR") return 1;
  return type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

int component_type_of(const GltfJson& gltf, const Json& object, const std::string& place) {
  const std::size_t type = gltf.whole(object, "componentType", place);
  if (type > 10'000 || component_size(static_cast<int>(type)) == 0)
    gltf.fail(place, "has the unknown component type " + std::to_string(type));
  return static_cast<int>(type);
}

/// The first of `count` elements of `size` bytes. Throws where one is beyond the buffer; one beyond
/// the view only is a wrong length field.
const char* elements(const GltfJson& gltf, const GltfBuffers::View& view, std::size_t offset,
                     std::size_t count, std::size_t stride, std::size_t size,
                     const std::string& place) {
  const auto fit = [&](std::size_t bytes) {
    return count == 0 || (offset <= bytes && bytes - offset >= size && stride >= size &&
                          (bytes - offset - size) / stride >= count - 1);
  };
  if (!fit(view.bytes.size()))
    gltf.fail(place, std::to_string(count) + " elements reach beyond " + view.place +
                         "; the file is cut short or wrong");
  if (!fit(view.length))
    gltf.note(place + " reaches beyond " + view.place + ", whose length is wrong; mended");
  return count == 0 ? nullptr : view.bytes.data() + offset;
}

}  // namespace

std::string accessor_place(std::size_t index) {
  return "accessor " + std::to_string(index);
}

GltfAccessor::GltfAccessor(const GltfJson& gltf, GltfBuffers& buffers, std::size_t index,
                           const char* type, const std::string& user) {
  const Json& accessor = gltf.item("accessors", index, user);
  const std::string place = accessor_place(index);
  const Json* kind = GltfJson::find(accessor, "type");
  if (!kind || *kind != type)
    gltf.fail(place, std::string("is not of type ") + type + " as " + user + " needs");
  components_ = components_of(type);
  component_type_ = component_type_of(gltf, accessor, place);
  stride_ = components_ * component_size(component_type_);
  count_ = gltf.whole(accessor, "count", place);
  const Json* normalized = GltfJson::find(accessor, "normalized");
  normalized_ = normalized && normalized->is_boolean() && normalized->get<bool>();
  if (GltfJson::find(accessor, "bufferView")) read_view(gltf, buffers, accessor, place);
  if (GltfJson::find(accessor, "sparse")) read_sparse(gltf, buffers, accessor, place);
}

GltfAccessor::GltfAccessor(std::string_view bytes, std::size_t count, std::size_t components,
                           int component_type, bool normalized)
    : data_(bytes.data()),
      count_(count),
      stride_(components * component_size(component_type)),
      components_(components),
      component_type_(component_type),
      normalized_(normalized) {}

void GltfAccessor::read_view(const GltfJson& gltf, GltfBuffers& buffers, const Json& accessor,
                             const std::string& place) {
  const auto view = buffers.view(gltf.whole(accessor, "bufferView", place), place);
  const std::size_t size = stride_;
  if (view.stride != 0) stride_ = view.stride;
  data_ = elements(gltf, view, gltf.whole(accessor, "byteOffset", place, 0), count_, stride_, size,
                   place);
}

void GltfAccessor::read_sparse(const GltfJson& gltf, GltfBuffers& buffers, const Json& accessor,
                               const std::string& place) {
  const Json& sparse = *GltfJson::find(accessor, "sparse");
  const std::size_t count = gltf.whole(sparse, "count", place);
  if (count == 0) return;
  const Json* index_part = GltfJson::find(sparse, "indices");
  const Json* value_part = GltfJson::find(sparse, "values");
  if (!index_part || !value_part)
    gltf.fail(place, "is sparse and lacks 'indices' or 'values'; export the file again");
  const auto first = [&](const Json& object, std::size_t size) {
    const auto view = buffers.view(gltf.whole(object, "bufferView", place), place);
    return elements(gltf, view, gltf.whole(object, "byteOffset", place, 0), count, size, size,
                    place);
  };
  const int index_type = component_type_of(gltf, *index_part, place);
  const std::size_t index_size = component_size(index_type);
  const std::size_t size = components_ * component_size(component_type_);
  const char* indices = first(*index_part, index_size);
  const char* values = first(*value_part, size);
  buffers.spend(4 * count, place);  // as much memory as some vertices
  sparse_.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double element = load_component(indices + index_size * k, index_type, false);
    if (!(element >= 0.0 && element < static_cast<double>(count_)))
      gltf.fail(place, "has a sparse value for element " + format_double(element) +
                           ", but there are " + std::to_string(count_) + "; export the file again");
    sparse_.push_back({static_cast<std::size_t>(element), values + size * k});
  }
  std::stable_sort(sparse_.begin(), sparse_.end(),
                   [](const Sparse& a, const Sparse& b) { return a.element < b.element; });
}

bool GltfAccessor::holds_whole_numbers() const {
  return component_type_ != kGltfFloat;
}

double GltfAccessor::at(std::size_t element, std::size_t k) const {
  const char* p = data_ ? data_ + stride_ * element : nullptr;
  if (!sparse_.empty()) {
    const auto next =
        std::upper_bound(sparse_.begin(), sparse_.end(), element,
                         [](std::size_t e, const Sparse& sparse) { return e < sparse.element; });
    if (next != sparse_.begin() && std::prev(next)->element == element) p = std::prev(next)->data;
  }
  if (!p) return 0.0;
  return load_component(p + component_size(component_type_) * k, component_type_, normalized_);
}

}  // namespace mimicry
