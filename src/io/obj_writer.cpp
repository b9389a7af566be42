#include <cstdint>

#include "io/mesh_writers.h"
#include "io/number.h"

namespace mimicry {
namespace {

constexpr const char* kPaintMaterial = "paint";

void append_number(std::string& out, double x) {
  out += ' ';
  append_double(out, x);
}

/// The colours of vertices, where OBJ can say them.
std::vector<Index> colors_to_write(const TriangleMesh& mesh, const WriteNote& note) {
  const MeshAttributes* attributes = mesh.attributes().get();
  if (!attributes || attributes->colors.empty()) return {};
  const auto of_vertex = values_of_vertices(mesh, attributes->colors);
  if (!of_vertex) {
    note("OBJ has one colour a vertex, and corners of some vertices differ; colours are left out");
    return {};
  }
  for (const Index c : *of_vertex)
    if (c != kNone && attributes->colors.values[at(c)][3] != 1.0f) {
      note("OBJ has no opacity of colours; it is left out");
      break;
    }
  return *of_vertex;
}

/// Says where faces get another name.
class LabelLines {
 public:
  LabelLines(const char* keyword, const FaceLabels& labels) : keyword_(keyword), labels_(labels) {}
  void append(std::string& out, Index face) {
    if (labels_.empty() || labels_.of_face[at(face)] == last_) return;
    last_ = labels_.of_face[at(face)];
    out += keyword_;
    if (last_ != kNone) out += ' ' + label_text(labels_.names[at(last_)]);
    out += '\n';
  }

 private:
  const char* keyword_;
  const FaceLabels& labels_;
  Index last_ = kNone;
};

void append_vertices(std::string& out, const TriangleMesh& mesh, const WriteNote& note) {
  const std::vector<Index> colors = colors_to_write(mesh, note);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    out += "v ";
    append_triple(out, mesh.position(v));
    if (!colors.empty() && colors[at(v)] != kNone) {
      const auto color = encoded_color(mesh.attributes()->colors.values[at(colors[at(v)])]);
      for (std::size_t k = 0; k < 3; ++k) append_number(out, color[k]);
    }
    out += '\n';
  }
}

void append_corners(std::string& out, const Face& face, const Index* texcoords) {
  out += 'f';
  for (std::size_t k = 0; k < 3; ++k) {
    out += ' ' + std::to_string(face[k] + 1);
    if (texcoords[k] != kNone) out += '/' + std::to_string(std::int64_t{texcoords[k]} + 1);
  }
  out += '\n';
}

}  // namespace

std::string write_mtl(std::string_view texture_file) {
  std::string out = "newmtl " + std::string(kPaintMaterial) + "\nKd 1 1 1\nmap_Kd ";
  return out + label_text(std::string(texture_file)) + '\n';
}

std::string write_obj(const TriangleMesh& mesh, std::string_view material_file,
                      const WriteNote& note) {
  std::string out;
  if (!material_file.empty()) out += "mtllib " + label_text(std::string(material_file)) + '\n';
  append_vertices(out, mesh, note);
  const MeshAttributes none;
  const MeshAttributes& attributes = mesh.attributes() ? *mesh.attributes() : none;
  for (const auto& uv : attributes.texcoords.values) {
    out += "vt";
    for (const float x : uv) append_number(out, static_cast<double>(x));
    out += '\n';
  }
  const FaceLabels one_material =
      material_file.empty() ? FaceLabels{}
                            : FaceLabels{{kPaintMaterial}, std::vector<Index>(mesh.faces().size())};
  if (!material_file.empty() && !attributes.materials.empty())
    note("the OBJ has one material, with the texture; names of materials are left out");
  else if (!attributes.materials.empty())
    note(
        "the OBJ names its materials; what they look like is not known, so that no .mtl file "
        "stands beside it");
  LabelLines objects("o", attributes.objects), groups("g", attributes.groups),
      materials("usemtl", material_file.empty() ? attributes.materials : one_material);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    objects.append(out, f);
    groups.append(out, f);
    materials.append(out, f);
    if (!attributes.texcoords.empty()) {
      append_corners(out, mesh.face(f), &attributes.texcoords.corners[3 * at(f)]);
      continue;
    }
    out += "f ";
    append_triple(out, mesh.face(f), 1);
    out += '\n';
  }
  return out;
}

}  // namespace mimicry
