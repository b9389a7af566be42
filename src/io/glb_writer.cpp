#include <limits>

#include <mimicry/base/error.h>

#include "io/binary.h"
#include "io/glb.h"
#include "io/json.h"
#include "io/mesh_writers.h"

namespace mimicry {
namespace {

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kVertices = 34962;  // ARRAY_BUFFER
constexpr int kIndices = 34963;   // ELEMENT_ARRAY_BUFFER
constexpr int kLineStripMode = 3;
constexpr int kTrianglesMode = 4;

bool has_faces(const GlbPart& part) {
  return part.mesh != nullptr && part.mesh->face_count() > 0;
}

// Collects the binary chunk and the lists of the JSON chunk that point into it.
struct Scene {
  Vec3 origin = Vec3::Zero();  // of the numbers in the file; the nodes carry it
  std::string binary;
  OrderedJson views = OrderedJson::array();
  OrderedJson accessors = OrderedJson::array();
  OrderedJson meshes = OrderedJson::array();
  OrderedJson nodes = OrderedJson::array();
  OrderedJson materials = OrderedJson::array();
  OrderedJson textures = OrderedJson::array();
  OrderedJson images = OrderedJson::array();
  OrderedJson samplers = OrderedJson::array();

  // The bytes from `start` to the end become a view with an accessor; its number is returned.
  std::size_t close_view(std::size_t start, int target, int component, Index count,
                         const char* type) {
    views.push_back({{"buffer", 0},
                     {"byteOffset", start},
                     {"byteLength", binary.size() - start},
                     {"target", target}});
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", component},
                         {"count", count},
                         {"type", type}});
    return accessors.size() - 1;
  }

  // position(i): of the i-th vertex, in single precision.
  template <class Position>
  std::size_t add_positions(Index count, Position&& position) {
    const std::size_t start = binary.size();
    Eigen::AlignedBox3f box;
    for (Index v = 0; v < count; ++v) {
      const Eigen::Vector3f x = position(v);
      box.extend(x);
      for (const float c : x) append_little_endian(binary, c);
    }
    const std::size_t accessor = close_view(start, kVertices, kFloat, count, "VEC3");
    accessors[accessor]["min"] = {box.min()[0], box.min()[1], box.min()[2]};
    accessors[accessor]["max"] = {box.max()[0], box.max()[1], box.max()[2]};
    return accessor;
  }

  std::size_t add_normals(std::span<const Vec3> normals) {
    const std::size_t start = binary.size();
    for (const Vec3& n : normals)
      for (const double x : n) append_little_endian(binary, static_cast<float>(x));
    return close_view(start, kVertices, kFloat, static_cast<Index>(normals.size()), "VEC3");
  }

  template <std::size_t N>
  std::size_t add_values(std::span<const std::array<float, N>> values, const char* type) {
    const std::size_t start = binary.size();
    for (const auto& value : values)
      for (const float x : value) append_little_endian(binary, x);
    return close_view(start, kVertices, kFloat, static_cast<Index>(values.size()), type);
  }

  std::size_t add_faces(std::span<const Face> faces) {
    const std::size_t start = binary.size();
    for (const Face& face : faces)
      for (const Index v : face) append_little_endian(binary, v);
    return close_view(start, kIndices, kUnsignedInt, static_cast<Index>(3 * faces.size()),
                      "SCALAR");
  }

  void add_triangles(const GlbPart& part, OrderedJson& primitives) {
    const TriangleMesh& mesh = *part.mesh;
    OrderedJson attributes = {{"POSITION", add_positions(mesh.vertex_count(), [&](Index v) {
                                 return to_single(mesh, v, "GLB", origin);
                               })}};
    if (!part.normals.empty()) attributes["NORMAL"] = add_normals(part.normals);
    if (!part.texcoords.empty()) {
      std::vector<std::array<float, 2>> down(part.texcoords.begin(), part.texcoords.end());
      for (auto& uv : down) uv[1] = 1.0f - uv[1];
      attributes["TEXCOORD_0"] = add_values<2>(down, "VEC2");
    }
    if (!part.vertex_colors.empty())
      attributes["COLOR_0"] = add_values<4>(part.vertex_colors, "VEC4");
    const std::size_t first_material = materials.size();
    if (part.materials)
      for (const std::string& name : part.materials->names) materials.push_back({{"name", name}});
    const auto material = [&](std::size_t f) {
      return part.materials ? part.materials->of_face[f] : kNone;
    };
    for (std::size_t f = 0; f < mesh.faces().size();) {
      std::size_t end = f + 1;
      while (end < mesh.faces().size() && material(end) == material(f)) ++end;
      OrderedJson primitive = {{"attributes", attributes},
                               {"indices", add_faces(mesh.faces().subspan(f, end - f))},
                               {"mode", kTrianglesMode}};
      if (material(f) != kNone)
        primitive["material"] = first_material + static_cast<std::size_t>(material(f));
      primitives.push_back(primitive);
      f = end;
    }
  }

  OrderedJson line_strip(const std::vector<Vec3>& line) {
    const auto position = [&](Index v) -> Eigen::Vector3f {
      return (line[static_cast<std::size_t>(v)] - origin).cast<float>();
    };
    const OrderedJson attributes = {
        {"POSITION", add_positions(static_cast<Index>(line.size()), position)}};
    return {{"attributes", attributes}, {"mode", kLineStripMode}};
  }

  // A rough material of this base colour.
  void add_material(OrderedJson color) {
    color["metallicFactor"] = 0.0;
    color["roughnessFactor"] = 0.8;
    materials.push_back({{"pbrMetallicRoughness", color}});
  }

  // No mip levels: what lies side by side in the texture need not on the surface.
  void add_texture(std::string_view png) {
    constexpr int kLinear = 9729, kClampToEdge = 33071;
    const std::size_t start = binary.size();
    binary += png;
    views.push_back({{"buffer", 0}, {"byteOffset", start}, {"byteLength", png.size()}});
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    images.push_back({{"bufferView", views.size() - 1}, {"mimeType", "image/png"}});
    samplers = OrderedJson::array({{{"magFilter", kLinear},
                                    {"minFilter", kLinear},
                                    {"wrapS", kClampToEdge},
                                    {"wrapT", kClampToEdge}}});
    textures.push_back({{"sampler", 0}, {"source", images.size() - 1}});
    add_material({{"baseColorTexture", {{"index", textures.size() - 1}}}});
  }

  void add(const GlbPart& part) {
    OrderedJson primitives = OrderedJson::array();
    if (has_faces(part)) add_triangles(part, primitives);
    for (const auto& line : part.lines)
      if (line.size() > 1) primitives.push_back(line_strip(line));
    if (primitives.empty()) return;
    if (part.color) {
      const auto& [r, g, b] = *part.color;
      add_material({{"baseColorFactor", {r, g, b, 1.0}}});
    } else if (!part.texture_png.empty()) {
      add_texture(part.texture_png);
    }
    if (part.color || !part.texture_png.empty())
      for (OrderedJson& primitive : primitives) primitive["material"] = materials.size() - 1;
    OrderedJson mesh = {{"primitives", primitives}};
    OrderedJson node = {{"mesh", meshes.size()}};
    if (origin != Vec3::Zero()) node["translation"] = {origin.x(), origin.y(), origin.z()};
    if (!part.name.empty()) mesh["name"] = node["name"] = part.name;
    meshes.push_back(mesh);
    nodes.push_back(node);
  }

  std::string text() const {
    OrderedJson numbers = OrderedJson::array();
    for (std::size_t i = 0; i < nodes.size(); ++i) numbers.push_back(i);
    OrderedJson root;
    root["asset"] = {{"version", "2.0"}, {"generator", "mimicry"}};
    root["scene"] = 0;
    root["scenes"] = OrderedJson::array({{{"nodes", numbers}}});
    root["nodes"] = nodes;
    root["meshes"] = meshes;
    if (!materials.empty()) root["materials"] = materials;
    if (!textures.empty()) {
      root["textures"] = textures;
      root["samplers"] = samplers;
      root["images"] = images;
    }
    root["accessors"] = accessors;
    root["bufferViews"] = views;
    root["buffers"] = OrderedJson::array({{{"byteLength", binary.size()}}});
    std::string padded = root.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    padded.resize((padded.size() + 3) / 4 * 4, ' ');
    return padded;
  }
};

}  // namespace

std::string write_glb_scene(std::span<const GlbPart> parts) {
  Scene scene;
  Eigen::AlignedBox3d box;
  for (const GlbPart& part : parts) {
    if (part.mesh != nullptr) box.extend(bounding_box(*part.mesh));
    for (const auto& line : part.lines)
      for (const Vec3& x : line) box.extend(x);
  }
  // Single precision keeps 1e-7 of the distance from the origin: up to here 1e-6 of the object.
  if (!box.isEmpty() && box.center().norm() > 10.0 * box.diagonal().norm())
    scene.origin = box.center();
  for (const GlbPart& part : parts) scene.add(part);
  if (scene.nodes.empty())
    throw Error(ErrorKind::invalid_input, "mesh: GLB cannot hold a mesh without faces; add one");
  const std::string text = scene.text();
  const std::size_t size = 12 + 8 + text.size() + 8 + scene.binary.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::unsupported,
                "mesh: too large for GLB, which counts bytes with 32 bits; write PLY");
  std::string out = "glTF";
  out.reserve(size);
  append_little_endian(out, std::uint32_t{2});
  append_little_endian(out, static_cast<std::uint32_t>(size));
  append_little_endian(out, static_cast<std::uint32_t>(text.size()));
  out += "JSON";
  out += text;
  append_little_endian(out, static_cast<std::uint32_t>(scene.binary.size()));
  out.append("BIN\0", 4);
  out += scene.binary;
  return out;
}

}  // namespace mimicry
