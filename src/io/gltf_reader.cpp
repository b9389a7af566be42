// Read with a JSON library alone: tinygltf builds the whole model with materials, animations and
// images, and leaves it to the caller to check accessors against their buffers, which is the
// larger part of this file. It is the independent reader of the tests.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/base/error.h>

#include "io/binary.h"
#include "io/json.h"
#include "io/mesh_builder.h"
#include "io/text.h"

namespace mimicry::io {
namespace {

using Transform = Eigen::Transform<double, 3, Eigen::AffineCompact>;

constexpr std::uint32_t kGlbMagic = 0x46546c67;     // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942;  // "BIN"

constexpr int kTriangles = 4;
constexpr int kStrip = 5;
constexpr int kFan = 6;

std::optional<std::string> decode_base64(std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string out;
  out.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    std::uint32_t value;
    if (c >= 'A' && c <= 'Z')
      value = static_cast<std::uint32_t>(c - 'A');
    else if (c >= 'a' && c <= 'z')
      value = static_cast<std::uint32_t>(c - 'a' + 26);
    else if (c >= '0' && c <= '9')
      value = static_cast<std::uint32_t>(c - '0' + 52);
    else if (c == '+' || c == '-')
      value = 62;
    else if (c == '/' || c == '_')
      value = 63;
    else
      return std::nullopt;
    bits = bits << 6 | value;
    count += 6;
    if (count >= 8) {
      count -= 8;
      out += static_cast<char>(bits >> count & 0xff);
    }
  }
  return out;
}

/// One accessor whose elements are known to lie within their buffer.
struct View {
  const char* data = nullptr;
  std::size_t count = 0;
  std::size_t stride = 0;
  int component_type = 0;
  bool normalized = false;
};

std::size_t component_size(int type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

double component(const View& view, std::size_t element, std::size_t k) {
  const char* p = view.data + view.stride * element + component_size(view.component_type) * k;
  switch (view.component_type) {
    case 5120:
      return view.normalized ? std::max(load<std::int8_t>(p) / 127.0, -1.0) : load<std::int8_t>(p);
    case 5121:
      return load<std::uint8_t>(p) / (view.normalized ? 255.0 : 1.0);
    case 5122:
      return view.normalized ? std::max(load<std::int16_t>(p) / 32767.0, -1.0)
                             : load<std::int16_t>(p);
    case 5123:
      return load<std::uint16_t>(p) / (view.normalized ? 65535.0 : 1.0);
    case 5125:
      return load<std::uint32_t>(p);
    default:
      return load<float>(p);
  }
}

class GltfReader {
 public:
  GltfReader(MeshBuilder& mesh, std::string_view text, std::string_view binary_chunk,
             bool has_binary_chunk)
      : mesh_(mesh), binary_chunk_(binary_chunk), has_binary_chunk_(has_binary_chunk) {
    try {
      root_ = parse_json(text);
    } catch (const Json::parse_error& error) {
      fail_at_byte(mesh_.name(), error.byte,
                   "the JSON of the file is broken or cut short; export it again");
    } catch (const Json::exception&) {
      fail("", "the JSON holds a number beyond double precision; export the file again");
    }
    if (!root_.is_object()) fail("", "the JSON is no object; give a glTF 2.0 file");
  }

  void read() {
    check_version();
    load_buffers();
    const Json& nodes = array("nodes");
    visited_.assign(nodes.size(), false);
    for (const std::size_t node : roots(nodes)) read_tree(nodes, node);
    mesh_.merge_identical_positions();
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    throw Error(ErrorKind::invalid_input,
                std::string(mesh_.name()) + ": " + place + (place.empty() ? "" : ": ") + what);
  }
  [[noreturn]] void fail_unsupported(const std::string& place, const std::string& what) const {
    throw Error(ErrorKind::unsupported,
                std::string(mesh_.name()) + ": " + place + (place.empty() ? "" : ": ") + what);
  }

  static const Json* find(const Json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto at = object.find(key);
    return at == object.end() ? nullptr : &*at;
  }

  /// A whole number that is not negative; `otherwise` where the key is missing.
  std::size_t whole(const Json& object, const char* key, const std::string& place,
                    std::optional<std::size_t> otherwise = std::nullopt) const {
    const Json* value = find(object, key);
    if (!value && otherwise) return *otherwise;
    if (!value) fail(place, std::string("'") + key + "' is missing; export the file again");
    return whole_value(*value, key, place);
  }
  std::size_t whole_value(const Json& value, const char* key, const std::string& place) const {
    if (value.is_number_unsigned()) return value.get<std::size_t>();
    if (value.is_number_float()) {  // some exporters write 3.0
      const double number = value.get<double>();
      if (number >= 0.0 && number < 9e15 && number == std::floor(number))
        return static_cast<std::size_t>(number);
    }
    fail(place, std::string("'") + key + "' is not a whole number from 0; export the file again");
  }

  /// A list at the top of the file; empty where it is missing.
  const Json& array(const char* key) const {
    static const Json none = Json::array();
    const Json* value = find(root_, key);
    if (!value) return none;
    if (!value->is_array()) fail(key, "is not a list; export the file again");
    return *value;
  }
  const Json& item(const char* key, std::size_t index, const std::string& place) const {
    const Json& list = array(key);
    if (index >= list.size())
      fail(place, "refers to " + std::string(key) + " " + std::to_string(index) +
                      ", but there are " + std::to_string(list.size()) + "; export the file again");
    return list[index];
  }

  void check_version() const {
    const Json* asset = find(root_, "asset");
    const Json* version = asset ? find(*asset, "version") : nullptr;
    if (!version || !version->is_string())
      fail("asset", "'version' is missing; give a glTF 2.0 file");
    if (version->get_ref<const std::string&>().substr(0, 2) != "2.")
      fail_unsupported("asset", "version " + in_quotes(version->get_ref<const std::string&>()) +
                                    " is not handled; export it as glTF 2.0");
    for (const Json& extension : array("extensionsRequired")) {
      const std::string name = extension.is_string() ? extension.get<std::string>() : "";
      const bool harmless = name.rfind("KHR_materials_", 0) == 0 ||
                            name.rfind("KHR_texture_", 0) == 0 ||
                            name.rfind("EXT_texture_", 0) == 0 || name == "KHR_lights_punctual" ||
                            name == "KHR_mesh_quantization";
      if (!harmless)
        fail_unsupported("extensionsRequired", in_quotes(name) +
                                                   " is not handled; export the file without it "
                                                   "(without compression)");
    }
  }

  void load_buffers() {
    const Json& list = array("buffers");
    decoded_.resize(list.size());
    for (std::size_t b = 0; b < list.size(); ++b) {
      const std::string place = "buffer " + std::to_string(b);
      const Json* uri = find(list[b], "uri");
      std::string_view bytes = binary_chunk_;
      if (uri) {
        if (!uri->is_string()) fail(place, "'uri' is no text; export the file again");
        const std::string_view text = uri->get_ref<const std::string&>();
        const std::size_t comma = text.find(',');
        if (text.substr(0, 5) != "data:")
          fail_unsupported(place, "lies in another file, " + in_quotes(text) +
                                      "; export as GLB or with embedded buffers");
        const std::string_view kind = text.substr(0, comma);
        if (comma == std::string_view::npos || kind.size() < 7 ||
            kind.substr(kind.size() - 7) != ";base64")
          fail(place, "'uri' is not of the form data:...;base64,...; export the file again");
        auto decoded = decode_base64(text.substr(comma + 1));
        if (!decoded) fail(place, "'uri' holds what is not base64; export the file again");
        decoded_[b] = std::move(*decoded);
        bytes = decoded_[b];
      } else if (b != 0 || !has_binary_chunk_) {
        fail_unsupported(place, "has no data; export as GLB or with embedded buffers");
      }
      const std::size_t length = whole(list[b], "byteLength", place);
      if (length > bytes.size())
        fail(place, "promises " + std::to_string(length) + " bytes, but holds " +
                        std::to_string(bytes.size()) + "; it is cut short");
      buffers_.push_back(bytes.substr(0, length));
    }
  }

  View view(std::size_t index, const char* type, std::size_t components,
            const std::string& user) const {
    const Json& accessor = item("accessors", index, user);
    const std::string place = "accessor " + std::to_string(index);
    const Json* kind = find(accessor, "type");
    if (!kind || *kind != type)
      fail(place, std::string("is not of type ") + type + " as " + user + " needs");
    if (find(accessor, "sparse") || !find(accessor, "bufferView"))
      fail_unsupported(place, "is sparse; export the file without sparse accessors");
    View out;
    out.count = whole(accessor, "count", place);
    const std::size_t component_type = whole(accessor, "componentType", place);
    out.component_type = component_type < 10000 ? static_cast<int>(component_type) : 0;
    const std::size_t size = components * component_size(out.component_type);
    if (size == 0) fail(place, "has the unknown component type " + std::to_string(component_type));
    if (const Json* normalized = find(accessor, "normalized"))
      out.normalized = normalized->is_boolean() && normalized->get<bool>();

    const std::size_t view_index = whole(accessor, "bufferView", place);
    const Json& buffer_view = item("bufferViews", view_index, place);
    const std::string view_place = "bufferView " + std::to_string(view_index);
    const std::size_t buffer = whole(buffer_view, "buffer", view_place);
    if (buffer >= buffers_.size())
      fail(view_place, "refers to buffer " + std::to_string(buffer) + ", but there are " +
                           std::to_string(buffers_.size()));
    std::string_view bytes = buffers_[buffer];
    const std::size_t view_offset = whole(buffer_view, "byteOffset", view_place, 0);
    const std::size_t view_length = whole(buffer_view, "byteLength", view_place);
    if (view_offset > bytes.size() || view_length > bytes.size() - view_offset)
      fail(view_place, "reaches beyond its buffer of " + std::to_string(bytes.size()) +
                           " bytes; the file is cut short or wrong");
    bytes = bytes.substr(view_offset, view_length);

    out.stride = whole(buffer_view, "byteStride", view_place, size);
    const std::size_t offset = whole(accessor, "byteOffset", place, 0);
    const bool fits =
        out.count == 0 ||
        (offset <= bytes.size() && bytes.size() - offset >= size && out.stride >= size &&
         (bytes.size() - offset - size) / out.stride >= out.count - 1);
    if (!fits)
      fail(place, std::to_string(out.count) +
                      " elements reach beyond the bufferView; the file is cut short or wrong");
    out.data = out.count == 0 ? nullptr : bytes.data() + offset;
    return out;
  }

  std::vector<std::size_t> roots(const Json& nodes) const {
    std::vector<std::size_t> out;
    const Json& scenes = array("scenes");
    if (!scenes.empty()) {
      const std::size_t index = whole(root_, "scene", "scene", 0);
      const Json& scene = item("scenes", index, "scene");
      append_nodes(scene, "nodes", nodes.size(), "scene " + std::to_string(index), out);
      return out;
    }
    // Without a scene: all nodes that are nobody's child.
    std::vector<std::size_t> children;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      append_nodes(nodes[n], "children", nodes.size(), "node " + std::to_string(n), children);
    std::vector<bool> is_child(nodes.size(), false);
    for (const std::size_t child : children) is_child[child] = true;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (!is_child[n]) out.push_back(n);
    return out;
  }

  void append_nodes(const Json& object, const char* key, std::size_t node_count,
                    const std::string& place, std::vector<std::size_t>& out) const {
    const Json* list = find(object, key);
    if (!list) return;
    if (!list->is_array()) fail(place, std::string("'") + key + "' is not a list");
    for (const Json& value : *list) {
      const std::size_t node = whole_value(value, key, place);
      if (node >= node_count)
        fail(place, "refers to node " + std::to_string(node) + ", but there are " +
                        std::to_string(node_count) + "; export the file again");
      out.push_back(node);
    }
  }

  void read_tree(const Json& nodes, std::size_t root) {
    struct Visit {
      std::size_t node;
      Transform parent;
    };
    std::vector<Visit> stack = {{root, Transform::Identity()}};
    std::vector<std::size_t> children;
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const std::string place = "node " + std::to_string(visit.node);
      if (visited_[visit.node])
        fail(place, "stands twice in the scene or in a ring; export the file again");
      visited_[visit.node] = true;
      const Json& node = nodes[visit.node];
      const Transform transform = visit.parent * local_transform(node, place);
      if (find(node, "mesh")) {
        const std::size_t mesh = whole(node, "mesh", place);
        const Json* primitives = find(item("meshes", mesh, place), "primitives");
        if (primitives && primitives->is_array())
          for (std::size_t p = 0; p < primitives->size(); ++p)
            read_primitive((*primitives)[p], transform,
                           "mesh " + std::to_string(mesh) + " primitive " + std::to_string(p));
      }
      children.clear();
      append_nodes(node, "children", nodes.size(), place, children);
      for (std::size_t k = children.size(); k-- > 0;) stack.push_back({children[k], transform});
    }
  }

  template <std::size_t N>
  std::optional<std::array<double, N>> numbers(const Json& node, const char* key,
                                               const std::string& place) const {
    const Json* list = find(node, key);
    if (!list) return std::nullopt;
    std::array<double, N> out;
    bool good = list->is_array() && list->size() == N;
    for (std::size_t k = 0; good && k < N; ++k) {
      good = (*list)[k].is_number();
      if (good) out[k] = (*list)[k].get<double>();
    }
    if (!good)
      fail(place, std::string("'") + key + "' is not a list of " + std::to_string(N) + " numbers");
    return out;
  }

  Transform local_transform(const Json& node, const std::string& place) const {
    Transform transform = Transform::Identity();
    if (const auto m = numbers<16>(node, "matrix", place)) {
      const Eigen::Map<const Eigen::Matrix4d> matrix(m->data());
      transform.matrix() = matrix.topRows<3>();
      return transform;
    }
    if (const auto t = numbers<3>(node, "translation", place))
      transform.translation() = Vec3(t->data());
    if (const auto r = numbers<4>(node, "rotation", place)) {
      const Quat q((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
      const double norm = q.norm();
      if (!(std::abs(norm - 1.0) < 1e-2))
        fail(place, "'rotation' is no unit quaternion; export the file again");
      transform.linear() = q.normalized().toRotationMatrix();
    }
    if (const auto s = numbers<3>(node, "scale", place))
      transform.linear() = transform.linear() * Vec3(s->data()).asDiagonal();
    return transform;
  }

  void read_primitive(const Json& primitive, const Transform& transform, const std::string& place) {
    const std::size_t mode = whole(primitive, "mode", place, kTriangles);
    if (mode < kTriangles) return;  // points and lines
    if (mode > kFan) fail(place, "'mode' " + std::to_string(mode) + " is unknown");
    const Json* attributes = find(primitive, "attributes");
    if (!attributes || !find(*attributes, "POSITION")) return;  // as the specification asks
    const View positions =
        view(whole(*attributes, "POSITION", place), "VEC3", 3, place + " POSITION");
    const auto first = static_cast<Index>(mesh_.vertex_count());
    for (std::size_t v = 0; v < positions.count; ++v)
      mesh_.add_vertex(transform * Vec3(component(positions, v, 0), component(positions, v, 1),
                                        component(positions, v, 2)));

    std::vector<Index> corners;
    if (find(primitive, "indices")) {
      const View indices =
          view(whole(primitive, "indices", place), "SCALAR", 1, place + " indices");
      if (indices.component_type == 5126) fail(place, "'indices' are no whole numbers");
      corners.reserve(indices.count);
      for (std::size_t k = 0; k < indices.count; ++k) {
        const double index = component(indices, k, 0);
        if (!(index >= 0.0 && index < static_cast<double>(positions.count)))
          fail(place, "index " + std::to_string(k) + " refers to vertex " + format_double(index) +
                          ", but there are " + std::to_string(positions.count) +
                          "; export the file again");
        corners.push_back(first + static_cast<Index>(index));
      }
    } else {
      for (std::size_t v = 0; v < positions.count; ++v)
        corners.push_back(first + static_cast<Index>(v));
    }
    if (mode == kTriangles && corners.size() % 3 != 0)
      fail(place, std::to_string(corners.size()) + " corners do not make whole triangles");
    // A mirroring transform turns the triangles' sides.
    add_triangles(static_cast<int>(mode), corners, transform.linear().determinant() < 0.0);
  }

  void add_triangles(int mode, const std::vector<Index>& c, bool mirrored) {
    const auto add = [&](Index i, Index j, Index k) {
      if (mirrored) std::swap(j, k);
      mesh_.add_polygon(std::array{i, j, k});
    };
    if (mode == kTriangles)
      for (std::size_t k = 0; k + 2 < c.size(); k += 3) add(c[k], c[k + 1], c[k + 2]);
    if (mode == kFan)
      for (std::size_t k = 0; k + 2 < c.size(); ++k) add(c[0], c[k + 1], c[k + 2]);
    if (mode == kStrip)
      for (std::size_t k = 0; k + 2 < c.size(); ++k)
        if (c[k] != c[k + 1] && c[k + 1] != c[k + 2] && c[k] != c[k + 2])
          add(c[k], c[k + 1 + k % 2], c[k + 2 - k % 2]);
  }

  MeshBuilder& mesh_;
  std::string_view binary_chunk_;
  bool has_binary_chunk_;
  Json root_;
  std::vector<std::string> decoded_;
  std::vector<std::string_view> buffers_;
  std::vector<bool> visited_;
};

}  // namespace

void read_gltf(std::string_view bytes, MeshBuilder& mesh) {
  GltfReader(mesh, bytes, {}, false).read();
}

void read_glb(std::string_view bytes, MeshBuilder& mesh) {
  const std::string_view name = mesh.name();
  if (bytes.size() < 12 || load<std::uint32_t>(bytes.data()) != kGlbMagic)
    fail_at_byte(name, 0,
                 "a GLB file begins with 'glTF' and two numbers; give a file of that format");
  const std::uint32_t version = load<std::uint32_t>(bytes.data() + 4);
  if (version != 2)
    throw Error(ErrorKind::unsupported, std::string(name) + ": GLB version " +
                                            std::to_string(version) +
                                            " is not handled; export it as glTF 2.0");
  const std::uint32_t length = load<std::uint32_t>(bytes.data() + 8);
  if (length > bytes.size() || length < 12)
    fail_at_byte(name, 8,
                 "the header promises " + std::to_string(length) + " bytes, but the file holds " +
                     std::to_string(bytes.size()) + "; it is cut short");
  std::string_view text;
  std::string_view binary;
  bool has_binary = false;
  std::size_t offset = 12;
  for (int chunk = 0; length - offset >= 8; ++chunk) {
    const std::size_t size = load<std::uint32_t>(bytes.data() + offset);
    const std::uint32_t type = load<std::uint32_t>(bytes.data() + offset + 4);
    offset += 8;
    if (size > length - offset)
      fail_at_byte(name, offset,
                   "a chunk of " + std::to_string(size) +
                       " bytes, more than the file holds; it is cut short");
    if (chunk == 0) {
      if (type != kJsonChunk)
        fail_at_byte(name, offset, "the first chunk is not JSON; export the file again");
      text = bytes.substr(offset, size);
    } else if (type == kBinaryChunk && !has_binary) {
      binary = bytes.substr(offset, size);
      has_binary = true;
    }
    offset += size;
    offset += std::min<std::size_t>((4 - offset % 4) % 4, length - offset);
  }
  GltfReader(mesh, text, binary, has_binary).read();
}

}  // namespace mimicry::io
