#include "io/gltf_buffers.h"

#include <algorithm>
#include <memory>

#include "io/gltf_meshopt.h"
#include "io/text.h"
#include "io/uri.h"

namespace mimicry {
namespace {

constexpr double kUnfoldedPerByte = 16.0;

}  // namespace

double GltfBuffers::allowance() const {
  return std::max(static_cast<double>(options_.max_unfolded),
                  kUnfoldedPerByte * static_cast<double>(read_bytes_));
}

std::string GltfBuffers::raised_with() const {
  if (options_.raises_unfolded.empty()) return "";
  return ", or raise the limit (" + options_.raises_unfolded + ")";
}

void GltfBuffers::spend(std::size_t work, const std::string& place) {
  spent_ += static_cast<double>(work);
  if (spent_ > allowance())
    gltf_.fail(
        place,
        "is one of too many parts that read the same bytes; export the file again" + raised_with(),
        ErrorKind::unsupported);
}

const std::string& GltfBuffers::keep(std::string bytes) {
  read_bytes_ += bytes.size();
  kept_.push_back(std::make_unique<const std::string>(std::move(bytes)));
  return *kept_.back();
}

std::string_view GltfBuffers::named_file(const std::string& uri, const std::string& place) {
  const std::string decoded = percent_decoded(uri);
  const auto name = name_below(decoded);
  if (!name)
    gltf_.fail(place,
               "names " + in_quotes(uri) +
                   ", which is no file in the mesh's own folder; put it there and name it without "
                   "a path, or export as GLB",
               ErrorKind::unsupported);
  if (const auto known = files_.find(*name); known != files_.end()) return known->second;
  std::optional<std::string> bytes;
  if (options_.companion) {
    bytes = options_.companion(*name);
    // Some exporters do not encode a % of the name.
    const auto plain = name_below(uri);
    if (!bytes && plain && *plain != *name) bytes = options_.companion(*plain);
  }
  if (!bytes)
    gltf_.fail(place,
               "lies in the file " + in_quotes(*name) +
                   ", which is not there; give it together with this one, beside it, or export as "
                   "GLB",
               ErrorKind::io);
  return files_[*name] = keep(std::move(*bytes));
}

std::string_view GltfBuffers::buffer(std::size_t index, const std::string& user) {
  if (const auto known = buffers_.find(index); known != buffers_.end()) return known->second;
  const Json& buffer = gltf_.item("buffers", index, user);
  const std::string place = "buffer " + std::to_string(index);
  std::string_view bytes;
  if (const Json* uri = GltfJson::find(buffer, "uri")) {
    if (!uri->is_string()) gltf_.fail(place, "'uri' is no text; export the file again");
    const std::string& text = uri->get_ref<const std::string&>();
    if (is_data_uri(text)) {
      auto data = data_of_uri(text);
      if (!data)
        gltf_.fail(place, "'uri' is not of the form data:...;base64,...; export the file again");
      bytes = keep(std::move(*data));
    } else {
      bytes = named_file(text, place);
    }
  } else if (index == 0 && glb_) {
    bytes = *glb_;
  } else {
    gltf_.fail(place, "has no data; export the file again, as GLB or with embedded buffers");
  }
  return buffers_[index] = bytes;
}

/// From where a view or its compressed form begins; length: what it says of its size.
std::string_view GltfBuffers::part(const Json& object, std::size_t& length,
                                   const std::string& place) {
  const std::string_view bytes = buffer(gltf_.whole(object, "buffer", place), place);
  const std::size_t offset = gltf_.whole(object, "byteOffset", place, 0);
  length = gltf_.whole(object, "byteLength", place);
  if (offset > bytes.size())
    gltf_.fail(place, "begins beyond its buffer of " + std::to_string(bytes.size()) +
                          " bytes; the file is cut short or wrong");
  return bytes.substr(offset);
}

GltfBuffers::View GltfBuffers::view(std::size_t index, const std::string& user) {
  const Json& object = gltf_.item("bufferViews", index, user);
  View out;
  out.place = "bufferView " + std::to_string(index);
  const Json* compressed = GltfJson::extension(object, "EXT_meshopt_compression");
  if (!compressed) compressed = GltfJson::extension(object, "KHR_meshopt_compression");
  if (!compressed || !meshopt_is_built_in()) {
    if (compressed) {  // the uncompressed twin, where the file has it
      const Json& twin = gltf_.item("buffers", gltf_.whole(object, "buffer", out.place), out.place);
      if (!GltfJson::find(twin, "uri") && !(glb_ && gltf_.whole(object, "buffer", out.place) == 0))
        fail_without_meshopt(gltf_, out.place);
    }
    out.bytes = part(object, out.length, out.place);
    out.stride = gltf_.whole(object, "byteStride", out.place, 0);
    return out;
  }
  out.stride = gltf_.whole(*compressed, "byteStride", out.place);
  const auto known = decompressed_.find(index);
  if (known != decompressed_.end()) {
    out.bytes = known->second;
  } else {
    std::size_t length = 0;
    std::string_view bytes = part(*compressed, length, out.place);
    if (length > bytes.size())
      gltf_.fail(out.place, "reaches beyond its buffer; the file is cut short or wrong");
    out.bytes = decompressed_[index] =
        keep(decode_meshopt(gltf_, *compressed, bytes.substr(0, length), out.place));
  }
  out.length = out.bytes.size();
  return out;
}

}  // namespace mimicry
