#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh_writers.h"
#include "io/number.h"

namespace mimicry {
namespace {

bool every_corner_has_one(const TriangleMesh& mesh, const std::vector<Index>& of_vertex) {
  for (const Face& face : mesh.faces())
    for (const Index v : face)
      if (of_vertex[at(v)] == kNone) return false;
  return true;
}

/// The values of vertices, where OFF can say them: each vertex of a face has one.
template <std::size_t N>
std::vector<Index> values_to_write(const TriangleMesh& mesh, const CornerValues<N>& values,
                                   const char* what, const WriteNote& note) {
  if (values.empty()) return {};
  std::optional<std::vector<Index>> of_vertex = values_of_vertices(mesh, values);
  if (of_vertex && every_corner_has_one(mesh, *of_vertex)) return *std::move(of_vertex);
  note(std::string("OFF needs one of each vertex's own, and not every vertex has one; ") + what +
       " are left out");
  return {};
}

}  // namespace

std::string write_off(const TriangleMesh& mesh, const WriteNote& note) {
  const MeshAttributes none;
  const MeshAttributes& attributes = mesh.attributes() ? *mesh.attributes() : none;
  const std::vector<Index> texcoords =
      values_to_write(mesh, attributes.texcoords, "texture coordinates", note);
  const std::vector<Index> colors = values_to_write(mesh, attributes.colors, "colours", note);
  const auto bytes = color_bytes(attributes.colors.values);
  if (!attributes.groups.empty() || !attributes.materials.empty() || !attributes.objects.empty())
    note("OFF has no names of groups, materials and objects; they are left out");
  std::string out = texcoords.empty() ? "" : "ST";
  out += colors.empty() ? "OFF\n" : "COFF\n";
  out += std::to_string(mesh.vertex_count()) + " " + std::to_string(mesh.face_count()) + " 0\n";
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    append_triple(out, mesh.position(v));
    if (!colors.empty()) {
      const Index c = colors[at(v)];  // white: of no face
      if (bytes) {
        for (std::size_t k = 0; k < 4; ++k)
          out += ' ' + std::to_string(c == kNone ? 255 : int{(*bytes)[at(c)][k]});
      } else {
        const auto color = c == kNone ? std::array<double, 4>{1.0, 1.0, 1.0, 1.0}
                                      : encoded_color(attributes.colors.values[at(c)]);
        for (std::size_t k = 0; k < 4; ++k) {
          out += ' ';
          append_double(out, color[k]);
        }
      }
    }
    if (!texcoords.empty())
      for (std::size_t k = 0; k < 2; ++k) {
        const Index t = texcoords[at(v)];
        out += ' ';
        append_double(
            out, t == kNone ? 0.0 : static_cast<double>(attributes.texcoords.values[at(t)][k]));
      }
    out += '\n';
  }
  for (const Face& face : mesh.faces()) {
    out += "3 ";
    append_triple(out, face);
    out += '\n';
  }
  return out;
}

}  // namespace mimicry
