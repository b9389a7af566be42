#include "io/gltf_attributes.h"

#include <algorithm>
#include <array>

#include <mimicry/base/error.h>

namespace mimicry {
namespace {

std::string name_in(const Json* object) {
  const Json* name = object ? GltfJson::find(*object, "name") : nullptr;
  return name && name->is_string() ? name->get<std::string>() : std::string();
}

}  // namespace

GltfAttributes::First GltfAttributes::add(const GltfPrimitive& primitive, std::size_t vertices) {
  // glTF's v runs down.
  const auto texcoord = [&](const GltfAccessor& values, std::size_t v) {
    return mesh_.attributes().texcoords.add(
        {static_cast<float>(values.at(v, 0)), static_cast<float>(1.0 - values.at(v, 1))});
  };
  const auto color = [&](const GltfAccessor& values, std::size_t v) {
    return mesh_.attributes().colors.add(
        {static_cast<float>(values.at(v, 0)), static_cast<float>(values.at(v, 1)),
         static_cast<float>(values.at(v, 2)),
         values.components() == 4 ? static_cast<float>(values.at(v, 3)) : 1.0f});
  };
  return {add(primitive, vertices, "TEXCOORD_0", primitive.texcoords, texcoord),
          add(primitive, vertices, "COLOR_0", primitive.colors, color)};
}

Index GltfAttributes::add(const GltfPrimitive& primitive, std::size_t vertices, const char* name,
                          const std::optional<GltfAccessor>& decompressed,
                          const AddValue& add_value) {
  const Json* attributes = GltfJson::find(*primitive.json, "attributes");
  if (vertices == 0 || !attributes || !GltfJson::find(*attributes, name)) return kNone;
  const auto [known, is_new] = of_primitive_.try_emplace({&primitive, name}, kNone);
  const bool is_lost =
      std::find(primitive.lost.begin(), primitive.lost.end(), name) != primitive.lost.end();
  if (!is_new || is_lost) return known->second;
  try {
    known->second = add_new(primitive, vertices, name, decompressed, add_value);
  } catch (const Error& error) {
    std::string_view why = error.what();
    const std::string file = std::string(mesh_.name()) + ": ";
    if (why.starts_with(file)) why.remove_prefix(file.size());
    gltf_.note(primitive.place + ": " + name + " is passed over: " + std::string(why));
  }
  return known->second;
}

Index GltfAttributes::add_new(const GltfPrimitive& primitive, std::size_t vertices,
                              const std::string& name,
                              const std::optional<GltfAccessor>& decompressed,
                              const AddValue& add_value) {
  const std::string place = primitive.place + " " + name;
  const auto add_all = [&](const GltfAccessor& values) {
    if (values.count() < vertices)
      gltf_.fail(place, "has " + std::to_string(values.count()) + " elements for " +
                            std::to_string(vertices) + " vertices");
    buffers_.spend(vertices, place);
    const Index first = add_value(values, 0);
    for (std::size_t v = 1; v < vertices; ++v) add_value(values, v);
    return first;
  };
  if (decompressed) return add_all(*decompressed);
  const Json& attributes = *GltfJson::find(*primitive.json, "attributes");
  const std::size_t number = gltf_.whole(attributes, name.c_str(), primitive.place);
  const auto known = of_accessor_.find({name, number, vertices});
  if (known != of_accessor_.end()) return known->second;
  const Json& accessor = gltf_.item("accessors", number, place);
  const Json* components = GltfJson::find(accessor, "componentType");
  if (components && *components == kGltfUnsignedInt)
    gltf_.fail(place, "has whole numbers of 32 bits, which glTF does not allow");
  const Json* type = GltfJson::find(accessor, "type");
  const char* wanted = name != "COLOR_0" ? "VEC2" : type && *type == "VEC3" ? "VEC3" : "VEC4";
  const Index first = add_all(GltfAccessor(gltf_, buffers_, number, wanted, place));
  of_accessor_[{name, number, vertices}] = first;
  return first;
}

void GltfAttributes::begin_material(const GltfPrimitive& primitive) {
  FaceLabelBuilder& materials = mesh_.attributes().materials;
  const Json* material = GltfJson::find(*primitive.json, "material");
  const Json& all = gltf_.array("materials");
  Index number = kNone;
  const bool is_there =
      material && material->is_number_unsigned() && material->get<std::size_t>() < all.size();
  if (material && !is_there && without_material_.insert(&primitive).second)
    gltf_.note(primitive.place + ": material " +
               (material->is_number() ? material->dump() : std::string("that is no number")) +
               " is passed over: there are " + std::to_string(all.size()));
  if (is_there) {
    const auto index = material->get<std::size_t>();
    const std::string name = name_in(&all[index]);
    number = materials.number(name.empty() ? "material " + std::to_string(index) : name);
  }
  materials.begin(mesh_.face_count(), number);
}

void GltfAttributes::begin_object(const Json* node, const Json& mesh) {
  FaceLabelBuilder& objects = mesh_.attributes().objects;
  std::string name = name_in(node);
  if (name.empty()) name = name_in(&mesh);
  objects.begin(mesh_.face_count(), name.empty() ? kNone : objects.number(name));
}

}  // namespace mimicry
