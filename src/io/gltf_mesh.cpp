#include "io/gltf_mesh.h"

#include <algorithm>
#include <utility>

namespace mimicry {
namespace {

constexpr std::size_t kTriangles = 4;
constexpr std::size_t kFan = 6;
constexpr const char* kDraco = "KHR_draco_mesh_compression";

bool moves_vertices(const std::string& attribute) {
  return attribute == "POSITION" || attribute.rfind("JOINTS_", 0) == 0 ||
         attribute.rfind("WEIGHTS_", 0) == 0;
}

/// What vertices carry beside their places, and triangles do without.
bool is_attribute(const std::string& name) {
  return name == "TEXCOORD_0" || name == "COLOR_0";
}

/// What a primitive's vertices are made of, as far as it moves them.
Json vertex_key(const Json& primitive) {
  Json key = Json::object();
  for (const auto& [name, accessor] : primitive.at("attributes").items())
    if (moves_vertices(name)) key[name] = accessor;
  if (const Json* targets = GltfJson::find(primitive, "targets")) {
    Json& moved = key["targets"] = Json::array();
    for (const Json& target : targets->is_array() ? *targets : Json::array()) {
      const Json* positions = GltfJson::find(target, "POSITION");
      moved.push_back(positions ? *positions : Json());
    }
  }
  return key;
}

}  // namespace

std::size_t GltfPrimitive::triangles() const {
  if (mode == static_cast<int>(kTriangles)) return corners / 3;
  return std::max<std::size_t>(corners, 2) - 2;
}

GltfMesh::GltfMesh(const GltfJson& gltf, GltfBuffers& buffers, std::size_t index)
    : gltf_(gltf), buffers_(buffers) {
  const std::string place = "mesh " + std::to_string(index);
  const Json& mesh = gltf.item("meshes", index, place);
  if (const auto weights = gltf.numbers(mesh, "weights", place)) morphs_ = morphs_of(*weights);
  const Json* primitives = GltfJson::find(mesh, "primitives");
  if (!primitives || !primitives->is_array()) return;
  for (std::size_t p = 0; p < primitives->size(); ++p)
    add_primitive((*primitives)[p], place + " primitive " + std::to_string(p));
  for (const GltfPrimitive& primitive : primitives_)
    triangles_ += static_cast<double>(primitive.triangles());
  for (const GltfVertices& vertices : vertices_) {
    const auto count = static_cast<double>(vertices.positions.count());
    vertex_count_ += count;
    influences_ += count * static_cast<double>(vertices.influences.size());
  }
}

std::vector<GltfMorph> morphs_of(const std::vector<double>& weights) {
  std::vector<GltfMorph> out;
  for (std::size_t t = 0; t < weights.size(); ++t)
    if (weights[t] != 0.0) out.push_back({t, weights[t]});
  return out;
}

void GltfMesh::add_primitive(const Json& primitive, const std::string& place) {
  const std::size_t mode = gltf_.whole(primitive, "mode", place, kTriangles);
  if (mode > kFan) gltf_.fail(place, "'mode' " + std::to_string(mode) + " is unknown");
  const Json* attributes = GltfJson::find(primitive, "attributes");
  if (!attributes || !GltfJson::find(*attributes, "POSITION")) return;  // as glTF asks
  if (mode < kTriangles) {
    gltf_.note(place + " has points or lines, which were passed over");
    return;
  }
  GltfPrimitive out;
  out.place = place;
  out.json = &primitive;
  out.mode = static_cast<int>(mode);
  const Json* draco = GltfJson::extension(primitive, kDraco);
  if (draco && !draco_is_built_in()) {
    const std::size_t positions = gltf_.whole(*attributes, "POSITION", place);
    if (!GltfJson::find(gltf_.item("accessors", positions, place), "bufferView"))
      fail_without_draco(gltf_, place);
    draco = nullptr;  // the uncompressed twin
  }
  if (draco) return add_compressed(primitive, *draco, std::move(out));
  out.vertices = shared_vertices(primitive, place);
  out.corners = vertices_[out.vertices].positions.count();
  if (GltfJson::find(primitive, "indices")) {
    out.indices.emplace(gltf_, buffers_, gltf_.whole(primitive, "indices", place), "SCALAR",
                        place + " indices");
    if (!out.indices->holds_whole_numbers()) gltf_.fail(place, "'indices' are no whole numbers");
    out.corners = out.indices->count();
  }
  if (mode == kTriangles && out.corners % 3 != 0)
    gltf_.note(place + ": " + std::to_string(out.corners) +
               " corners do not make whole triangles; the last " + std::to_string(out.corners % 3) +
               " were passed over");
  primitives_.push_back(std::move(out));
}

std::size_t GltfMesh::shared_vertices(const Json& primitive, const std::string& place) {
  const auto [known, is_new] = known_vertices_.try_emplace(vertex_key(primitive), vertices_.size());
  if (is_new) vertices_.push_back(read_vertices(primitive, {}, place));
  return known->second;
}

GltfVertices GltfMesh::read_vertices(const Json& primitive, const Attributes& decompressed,
                                     const std::string& place) const {
  const Json& attributes = *GltfJson::find(primitive, "attributes");
  const auto attribute = [&](const std::string& name, const char* type) {
    const auto known = decompressed.find(name);
    if (known != decompressed.end()) return known->second;
    return GltfAccessor(gltf_, buffers_, gltf_.whole(attributes, name.c_str(), place), type,
                        place + " " + name);
  };
  const auto require_count = [&](const GltfAccessor& accessor, std::size_t count,
                                 const std::string& name) {
    if (accessor.count() < count)
      gltf_.fail(place, name + " has " + std::to_string(accessor.count()) + " elements for " +
                            std::to_string(count) + " vertices; export the file again");
  };
  GltfVertices out;
  out.positions = attribute("POSITION", "VEC3");
  const std::size_t count = out.positions.count();
  for (std::size_t set = 0;; ++set) {  // joints and weights come in sets of four
    const std::string joints = "JOINTS_" + std::to_string(set);
    const std::string weights = "WEIGHTS_" + std::to_string(set);
    if (!GltfJson::find(attributes, joints.c_str()) || !GltfJson::find(attributes, weights.c_str()))
      break;
    out.influences.push_back({attribute(joints, "VEC4"), attribute(weights, "VEC4")});
    require_count(out.influences.back().joints, count, joints);
    require_count(out.influences.back().weights, count, weights);
  }
  const Json* targets = GltfJson::find(primitive, "targets");
  if (!targets || !targets->is_array()) return out;
  for (std::size_t t = 0; t < targets->size(); ++t) {
    out.targets.emplace_back();
    const std::string name = "target " + std::to_string(t);
    if (!GltfJson::find((*targets)[t], "POSITION")) continue;
    out.targets.back().emplace(gltf_, buffers_,
                               gltf_.whole((*targets)[t], "POSITION", place + " " + name), "VEC3",
                               place + " " + name);
    require_count(*out.targets.back(), count, name);
  }
  return out;
}

void GltfMesh::add_compressed(const Json& primitive, const Json& extension, GltfPrimitive out) {
  const auto view = buffers_.view(gltf_.whole(extension, "bufferView", out.place), out.place);
  if (view.length > view.bytes.size())
    gltf_.fail(view.place, "reaches beyond its buffer; the file is cut short or wrong");
  const std::string_view bytes = view.bytes.substr(0, view.length);
  out.mode = static_cast<int>(kTriangles);  // whatever it was made of
  buffers_.spend(bytes.size(), out.place);
  out.corners = 3 * draco_face_count(gltf_, bytes, out.place);
  // As the accessors promise it; decoded with the triangles, and not shared.
  out.vertices = vertices_.size();
  vertices_.push_back(read_vertices(primitive, {}, out.place));
  compressed_.push_back({&primitive, primitives_.size(), bytes});
  primitives_.push_back(std::move(out));
}

void GltfMesh::decode() {
  for (const Compressed& compressed : std::exchange(compressed_, {})) decode(compressed);
}

void GltfMesh::decode(const Compressed& compressed) {
  GltfPrimitive& primitive = primitives_[compressed.primitive];
  const Json* names = GltfJson::find(*GltfJson::extension(*compressed.json, kDraco), "attributes");
  const Json& accessors = *GltfJson::find(*compressed.json, "attributes");
  if (!names || !GltfJson::find(*names, "POSITION"))
    gltf_.fail(primitive.place, "its compressed form has no positions; export the file again");
  std::vector<std::string> used;
  std::vector<std::size_t> ids;
  for (const auto& [name, id] : names->items()) {
    if (!(moves_vertices(name) || is_attribute(name)) || !GltfJson::find(accessors, name.c_str()))
      continue;
    used.push_back(name);
    ids.push_back(gltf_.whole(*names, name.c_str(), primitive.place));
  }
  decoded_.push_back(std::make_unique<const DracoMesh>(
      decode_draco(gltf_, compressed.bytes, ids, primitive.place)));
  const DracoMesh& mesh = *decoded_.back();
  const std::size_t promised = vertices_[primitive.vertices].positions.count();
  if (mesh.points != promised || mesh.corners.size() / 4 != primitive.corners)
    gltf_.fail(primitive.place, "its compressed form holds " + std::to_string(mesh.points) +
                                    " vertices and not the " + std::to_string(promised) +
                                    " of its accessor; export the file again");
  Attributes attributes;
  for (std::size_t k = 0; k < used.size(); ++k) {
    const DracoAttribute& values = mesh.attributes[k];
    if (is_attribute(used[k])) {
      keep_attribute(primitive, used[k], values, mesh.points);
      continue;
    }
    if (values.components == 0)
      gltf_.fail(primitive.place, "its compressed form has no attribute " + std::to_string(ids[k]) +
                                      "; export the file again");
    if (values.component_type == 0)
      gltf_.fail(primitive.place, "its compressed form has numbers of a kind that glTF has not");
    if (values.components != (used[k] == "POSITION" ? 3u : 4u))
      gltf_.fail(primitive.place, "its compressed " + used[k] + " has " +
                                      std::to_string(values.components) + " components");
    attributes.emplace(used[k], decompressed(primitive, used[k], values, mesh.points));
  }
  vertices_[primitive.vertices] = read_vertices(*compressed.json, attributes, primitive.place);
  primitive.indices.emplace(mesh.corners, primitive.corners, 1, kGltfUnsignedInt, false);
}

GltfAccessor GltfMesh::decompressed(const GltfPrimitive& primitive, const std::string& name,
                                    const DracoAttribute& values, std::size_t points) const {
  const Json& accessors = *GltfJson::find(*primitive.json, "attributes");
  const Json& accessor = gltf_.item(
      "accessors", gltf_.whole(accessors, name.c_str(), primitive.place), primitive.place);
  const Json* normalized = GltfJson::find(accessor, "normalized");
  return {values.bytes, points, values.components, values.component_type,
          normalized && *normalized == true};
}

void GltfMesh::keep_attribute(GltfPrimitive& primitive, const std::string& name,
                              const DracoAttribute& values, std::size_t points) const {
  const bool is_color = name == "COLOR_0";
  const bool fits =
      is_color ? values.components == 3 || values.components == 4 : values.components == 2;
  if (!fits || values.component_type == 0) {
    gltf_.note(primitive.place + ": its compressed " + name + " cannot be read and is passed over");
    primitive.lost.push_back(name);
    return;
  }
  (is_color ? primitive.colors : primitive.texcoords)
      .emplace(decompressed(primitive, name, values, points));
}

}  // namespace mimicry
