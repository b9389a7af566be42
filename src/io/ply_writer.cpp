#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "io/binary.h"
#include "io/mesh_writers.h"
#include "io/number.h"

namespace mimicry {
namespace {

/// Puts the numbers of a vertex or a face, as text or as little-endian bytes.
class PlyWriter {
 public:
  PlyWriter(const TriangleMesh& mesh, bool text) : mesh_(mesh), text_(text) {
    if (!mesh.attributes()) return;
    const MeshAttributes& attributes = *mesh.attributes();
    if (!attributes.texcoords.empty()) texcoords_ = &attributes.texcoords;
    if (!attributes.colors.empty()) {
      colors_ = &attributes.colors;
      bytes_ = color_bytes(colors_->values);
      if (auto of_vertex = values_of_vertices(mesh, *colors_); of_vertex && all_have(*of_vertex))
        vertex_colors_ = std::move(*of_vertex);
    }
    add_labels("group", attributes.groups);
    add_labels("material", attributes.materials);
    add_labels("object", attributes.objects);
  }

  std::string write() {
    head();
    for (Index v = 0; v < mesh_.vertex_count(); ++v) vertex(v);
    for (Index f = 0; f < mesh_.face_count(); ++f) face(f);
    return std::move(out_);
  }

 private:
  struct Labels {
    const char* kind;
    const FaceLabels* labels;
    std::vector<std::int32_t> numbers;  // of the names, in the file
  };

  // Colours stand with the vertices where each that a face uses has one.
  bool all_have(const std::vector<Index>& of_vertex) const {
    return std::all_of(mesh_.faces().begin(), mesh_.faces().end(), [&](const Face& face) {
      return std::all_of(face.begin(), face.end(),
                         [&](Index v) { return of_vertex[at(v)] != kNone; });
    });
  }

  // Names that are whole numbers are those of a file of labels, and stay them.
  void add_labels(const char* kind, const FaceLabels& labels) {
    if (labels.empty()) return;
    Labels added{kind, &labels, {}};
    for (const std::string& name : labels.names) {
      const auto number = parse_integer(name);
      if (!number || *number < 0 || *number > std::numeric_limits<std::int32_t>::max() ||
          std::to_string(*number) != name)
        break;
      added.numbers.push_back(static_cast<std::int32_t>(*number));
    }
    if (added.numbers.size() < labels.names.size()) {
      added.numbers.clear();
      for (std::size_t n = 0; n < labels.names.size(); ++n)
        added.numbers.push_back(static_cast<std::int32_t>(n));
    }
    labels_.push_back(std::move(added));
  }

  void head() {
    out_ = std::string("ply\nformat ") + (text_ ? "ascii" : "binary_little_endian") + " 1.0\n";
    for (const Labels& l : labels_)
      for (std::size_t n = 0; n < l.numbers.size(); ++n)
        out_ += std::string("comment ") + l.kind + " " + std::to_string(l.numbers[n]) + " " +
                label_text(l.labels->names[n]) + "\n";
    out_ += "element vertex " + std::to_string(mesh_.vertex_count()) +
            "\nproperty double x\nproperty double y\nproperty double z\n";
    if (!vertex_colors_.empty())
      for (const char* name : {"red", "green", "blue", "alpha"})
        out_ += std::string("property ") + (bytes_ ? "uchar " : "double ") + name + "\n";
    out_ += "element face " + std::to_string(mesh_.face_count()) +
            "\nproperty list uchar int vertex_indices\n";
    if (texcoords_) out_ += "property list uchar float texcoord\n";
    if (colors_ && vertex_colors_.empty())
      out_ += std::string("property list uchar ") + (bytes_ ? "uchar" : "double") + " color\n";
    for (const Labels& l : labels_) out_ += std::string("property int ") + l.kind + "\n";
    out_ += "end_header\n";
  }

  void vertex(Index v) {
    first_ = true;
    for (const double x : mesh_.position(v)) number(x);
    if (!vertex_colors_.empty()) color(vertex_colors_[at(v)]);
    if (text_) out_ += '\n';
  }

  void face(Index f) {
    first_ = true;
    count(3);
    for (const Index v : mesh_.face(f)) number(v);
    if (texcoords_)
      values_of(*texcoords_, f, [&](Index t) {
        for (const float x : texcoords_->values[at(t)]) number(x);
      });
    if (colors_ && vertex_colors_.empty()) values_of(*colors_, f, [&](Index c) { color(c); });
    for (const Labels& l : labels_) {
      const Index name = l.labels->of_face[at(f)];
      number(name == kNone ? std::int32_t{-1} : l.numbers[at(name)]);
    }
    if (text_) out_ += '\n';
  }

  // A list of all corners' values, or an empty one where a corner has none.
  template <std::size_t N, class Put>
  void values_of(const CornerValues<N>& values, Index f, const Put& put) {
    const Index* corners = &values.corners[3 * at(f)];
    const bool whole = corners[0] != kNone && corners[1] != kNone && corners[2] != kNone;
    count(whole ? 3 * N : 0);
    for (std::size_t k = 0; whole && k < 3; ++k) put(corners[k]);
  }

  // kNone: white, of a vertex that no face uses.
  void color(Index c) {
    if (bytes_)
      for (std::size_t k = 0; k < 4; ++k)
        count(c == kNone ? std::size_t{255} : std::size_t{(*bytes_)[at(c)][k]});
    else
      for (const double x : c == kNone ? std::array<double, 4>{1.0, 1.0, 1.0, 1.0}
                                       : encoded_color(colors_->values[at(c)]))
        number(x);
  }

  void blank() {
    if (!first_) out_ += ' ';
    first_ = false;
  }
  // As a byte.
  void count(std::size_t n) {
    if (text_) {
      blank();
      out_ += std::to_string(n);
    } else {
      out_ += static_cast<char>(n);
    }
  }
  template <class T>
  void number(T x) {
    if (!text_) return append_little_endian(out_, x);
    blank();
    if constexpr (std::is_integral_v<T>)
      out_ += std::to_string(x);
    else
      append_double(out_, static_cast<double>(x));
  }

  const TriangleMesh& mesh_;
  bool text_;
  bool first_ = true;  // in its line
  std::string out_;
  const CornerValues<2>* texcoords_ = nullptr;
  const CornerValues<4>* colors_ = nullptr;
  std::optional<std::vector<std::array<unsigned char, 4>>> bytes_;
  std::vector<Index> vertex_colors_;  // empty: by corner, or none
  std::vector<Labels> labels_;
};

template <std::size_t N>
bool is_part(const CornerValues<N>& values, std::size_t face) {
  const auto first = values.corners.begin() + static_cast<std::ptrdiff_t>(3 * face);
  const auto missing = std::count(first, first + 3, kNone);
  return missing == 1 || missing == 2;
}

template <std::size_t N>
void tell_of_parts(const CornerValues<N>& values, const char* what, const WriteNote& note) {
  std::size_t parts = 0;
  for (std::size_t f = 0; f < values.corners.size() / 3; ++f) parts += is_part(values, f) ? 1 : 0;
  if (parts > 0)
    note(std::string("PLY holds ") + what + " of whole faces; those of " + std::to_string(parts) +
         " faces of which a corner has none are left out");
}

}  // namespace

std::string write_ply(const TriangleMesh& mesh, bool text, const WriteNote& note) {
  if (const auto& attributes = mesh.attributes()) {
    tell_of_parts(attributes->texcoords, "texture coordinates", note);
    tell_of_parts(attributes->colors, "colours", note);
  }
  return PlyWriter(mesh, text).write();
}

}  // namespace mimicry
