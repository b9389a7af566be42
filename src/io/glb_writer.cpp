#include <limits>

#include <nlohmann/json.hpp>

#include <mimicry/base/error.h>

#include "io/binary.h"
#include "io/mesh_writers.h"

namespace mimicry::io {

std::string write_glb(const TriangleMesh& mesh) {
  using Json = nlohmann::ordered_json;
  if (mesh.face_count() == 0)
    throw Error(ErrorKind::invalid_input, "mesh: GLB cannot hold a mesh without faces; add one");
  std::string binary;
  Eigen::AlignedBox3f box;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Eigen::Vector3f position = to_single(mesh, v, "GLB");
    box.extend(position);
    for (const float x : position) append_little_endian(binary, x);
  }
  const std::size_t indices_at = binary.size();
  for (const Face& face : mesh.faces())
    for (const Index v : face) append_little_endian(binary, v);

  const auto triple = [](const Eigen::Vector3f& x) { return Json{x[0], x[1], x[2]}; };
  constexpr int kVertices = 34962;  // ARRAY_BUFFER
  constexpr int kIndices = 34963;   // ELEMENT_ARRAY_BUFFER
  Json root;
  root["asset"] = {{"version", "2.0"}, {"generator", "mimicry"}};
  root["scene"] = 0;
  root["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
  root["nodes"] = Json::array({{{"mesh", 0}}});
  root["meshes"] = Json::array(
      {{{"primitives",
         Json::array({{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"mode", 4}}})}}});
  root["accessors"] = Json::array({{{"bufferView", 0},
                                    {"componentType", 5126},
                                    {"count", mesh.vertex_count()},
                                    {"type", "VEC3"},
                                    {"min", triple(box.min())},
                                    {"max", triple(box.max())}},
                                   {{"bufferView", 1},
                                    {"componentType", 5125},
                                    {"count", 3 * mesh.face_count()},
                                    {"type", "SCALAR"}}});
  root["bufferViews"] = Json::array(
      {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", indices_at}, {"target", kVertices}},
       {{"buffer", 0},
        {"byteOffset", indices_at},
        {"byteLength", binary.size() - indices_at},
        {"target", kIndices}}});
  root["buffers"] = Json::array({{{"byteLength", binary.size()}}});
  std::string text = root.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');

  const std::size_t size = 12 + 8 + text.size() + 8 + binary.size();
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
  append_little_endian(out, static_cast<std::uint32_t>(binary.size()));
  out.append("BIN\0", 4);
  out += binary;
  return out;
}

}  // namespace mimicry::io
