#pragma once

#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>

namespace mimicry {

/// A glTF that a test writes by hand: JSON, and one buffer that bytes are appended to.
struct GltfBuilder {
  using Json = nlohmann::json;

  Json root = {{"asset", {{"version", "2.0"}}}, {"buffers", Json::array()}};
  std::string data;

  int view(const void* bytes, std::size_t size) {
    data.resize((data.size() + 3) / 4 * 4);
    root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", size}});
    data.append(static_cast<const char*>(bytes), size);
    return static_cast<int>(root["bufferViews"].size()) - 1;
  }
  template <class T>
  int view(const std::vector<T>& values) {
    return view(values.data(), values.size() * sizeof(T));
  }
  /// type: of glTF, "VEC3".
  template <class T>
  int accessor(const std::vector<T>& values, const char* type, int components) {
    return accessor(view(values), type, component_type<T>(), values.size() / components);
  }
  int accessor(std::optional<int> view, const char* type, int component_type, std::size_t count) {
    Json accessor = {{"componentType", component_type}, {"count", count}, {"type", type}};
    if (view) accessor["bufferView"] = *view;
    root["accessors"].push_back(accessor);
    return static_cast<int>(root["accessors"].size()) - 1;
  }
  int positions(const std::vector<float>& values) { return accessor(values, "VEC3", 3); }
  int indices(const std::vector<std::uint16_t>& values) { return accessor(values, "SCALAR", 1); }

  /// A mesh of one primitive; more of it may be added to the JSON.
  Json& mesh(int positions, std::optional<int> indices = std::nullopt) {
    Json primitive = {{"attributes", {{"POSITION", positions}}}};
    if (indices) primitive["indices"] = *indices;
    root["meshes"].push_back({{"primitives", {primitive}}});
    return root["meshes"].back()["primitives"][0];
  }
  /// A node of the scene.
  Json& node(Json node) {
    root["scene"] = 0;
    root["scenes"][0]["nodes"].push_back(root.contains("nodes") ? root["nodes"].size() : 0);
    root["nodes"].push_back(std::move(node));
    return root["nodes"].back();
  }

  template <class T>
  static constexpr int component_type() {
    if constexpr (std::is_same_v<T, float>) return 5126;
    if constexpr (std::is_same_v<T, std::uint32_t>) return 5125;
    if constexpr (std::is_same_v<T, std::uint16_t>) return 5123;
    if constexpr (std::is_same_v<T, std::int16_t>) return 5122;
    if constexpr (std::is_same_v<T, std::uint8_t>) return 5121;
    if constexpr (std::is_same_v<T, std::int8_t>) return 5120;
  }

  /// The JSON, with the buffer in another file, or in the GLB's chunk where no URI is given.
  std::string json(const char* uri = nullptr) const {
    Json out = root;
    if (out["buffers"].empty()) {
      out["buffers"] = {{{"byteLength", data.size()}}};
      if (uri) out["buffers"][0]["uri"] = uri;
    }
    return out.dump();
  }
  static std::string word(std::size_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    std::string out(4, '\0');
    for (std::size_t k = 0; k < 4; ++k) out[k] = static_cast<char>(bits >> 8 * k & 0xff);
    return out;
  }
  std::string glb() const {
    std::string text = json();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string binary = data;
    binary.resize((binary.size() + 3) / 4 * 4);
    return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" +
           text + word(binary.size()) + std::string("BIN\0", 4) + binary;
  }
  TriangleMesh read(const MeshReadOptions& options = {}) const {
    return read_mesh(glb(), MeshFormat::glb, "name", options);
  }
};

/// A cube from -1 to 1: 8 vertices, 12 triangles, area 24.
inline const std::vector<float> kCubePositions = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                                  -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
inline const std::vector<std::uint16_t> kCubeIndices = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7,
                                                        0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5,
                                                        2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

inline GltfBuilder cube_gltf() {
  GltfBuilder out;
  const int positions = out.positions(kCubePositions);
  out.mesh(positions, out.indices(kCubeIndices));
  out.node({{"mesh", 0}});
  return out;
}

inline double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (Index f = 0; f < mesh.face_count(); ++f) area += 0.5 * mesh.area_vector(f).norm();
  return area;
}

/// The content of a file of MIMICRY_CASES; empty where it is not there.
inline std::string case_file(const std::string& name) {
  std::ifstream file(std::string(MIMICRY_CASES) + "/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// What a reader says; "" where it takes the file.
inline std::string said(const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace mimicry
