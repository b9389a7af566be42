#include <algorithm>
#include <array>

#include "io/gltf_json.h"
#include "io/text.h"

namespace mimicry {
namespace {

/// What the reader handles, or whose absence it reports where it is met.
constexpr std::array kHandled = {
    "KHR_mesh_quantization",   "KHR_draco_mesh_compression", "EXT_meshopt_compression",
    "KHR_meshopt_compression", "EXT_mesh_gpu_instancing",
};

/// Words of the names of extensions that say how things look, sound or move, or what they mean.
constexpr std::array kNotGeometry = {"_material",    "_texture",   "_light",    "_image",
                                     "_audio",       "_animation", "_xmp",      "_camera",
                                     "_environment", "_sampler",   "_metadata", "_feature",
                                     "_physics",     "_emitter",   "_interact", "_technique"};

/// What can change where a triangle is.
constexpr std::array kGeometry = {"scenes",    "nodes",       "meshes", "skins",
                                  "accessors", "bufferViews", "buffers"};
constexpr std::array kLook = {"materials", "textures",   "images",
                              "samplers",  "animations", "cameras"};

bool carries(const GltfJson& gltf, const char* list, const char* name) {
  const Json& items = gltf.array(list);
  return std::any_of(items.begin(), items.end(), [&](const Json& item) {
    if (GltfJson::extension(item, name)) return true;
    const Json* primitives = GltfJson::find(item, "primitives");
    return primitives && primitives->is_array() &&
           std::any_of(primitives->begin(), primitives->end(),
                       [&](const Json& p) { return GltfJson::extension(p, name) != nullptr; });
  });
}

bool says_nothing_of_geometry(const GltfJson& gltf, const std::string& name) {
  const std::string lower = to_lower(name);
  if (std::any_of(kNotGeometry.begin(), kNotGeometry.end(),
                  [&](const char* word) { return lower.find(word) != std::string::npos; }))
    return true;
  const auto carried = [&](const char* list) { return carries(gltf, list, name.c_str()); };
  return std::any_of(kLook.begin(), kLook.end(), carried) &&
         std::none_of(kGeometry.begin(), kGeometry.end(), carried);
}

}  // namespace

void GltfJson::check_extensions() const {
  for (const Json& required : array("extensionsRequired")) {
    const std::string name = required.is_string() ? required.get<std::string>() : "";
    if (std::find(kHandled.begin(), kHandled.end(), name) != kHandled.end()) continue;
    if (!says_nothing_of_geometry(*this, name))
      fail("extensionsRequired",
           in_quotes(name) + " is not handled, and could change the geometry; export without it",
           ErrorKind::unsupported);
    note("the extension " + in_quotes(name) + " says nothing of geometry and was passed over");
  }
}

}  // namespace mimicry
