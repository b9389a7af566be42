// Our own reader: tinyobjloader takes text that is no number for 0 without a word and tells no line
// number for it, and keeps single precision unless all who link it agree on a macro. It is the
// independent reader of the tests.

#include <limits>
#include <string>
#include <vector>

#include "io/mesh_builder.h"
#include "io/text.h"

namespace mimicry::io {
namespace {

class ObjReader {
 public:
  explicit ObjReader(MeshBuilder& mesh) : mesh_(mesh) {}

  void statement(std::string_view text, std::size_t line) {
    line_ = line;
    const std::string_view keyword = take_word(text);
    if (keyword == "v")
      vertex(text);
    else if (keyword == "f" || keyword == "fo")
      face(text);
    // All else (normals, texture coordinates, groups, materials, lines, free-form surfaces) says
    // nothing of the triangles.
  }

  void finish() {
    if (farthest_ < static_cast<Index>(mesh_.vertex_count())) return;
    fail_at_line(mesh_.name(), farthest_line_,
                 "the face refers to vertex " + std::to_string(farthest_ + 1) +
                     ", but the file holds " + std::to_string(mesh_.vertex_count()) +
                     " vertices; it is cut short or its faces are wrong");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { fail_at_line(mesh_.name(), line_, what); }

  void vertex(std::string_view text) {
    Vec3 position;
    int count = 0;
    for (std::string_view word = take_word(text); !word.empty() && word[0] != '#';
         word = take_word(text)) {
      const auto value = parse_double(word);
      if (!value)
        fail(in_quotes(word) +
             " is not a number, for a vertex; correct it or export the file again");
      if (count < 3) position[count] = *value;  // a weight or a colour may follow
      ++count;
    }
    if (count < 3)
      fail("a vertex with " + std::to_string(count) +
           " coordinates where three are needed; the line is cut short");
    mesh_.add_vertex(position);
  }

  void face(std::string_view text) {
    corners_.clear();
    for (std::string_view word = take_word(text); !word.empty() && word[0] != '#';
         word = take_word(text))
      corners_.push_back(corner(word));
    if (corners_.size() < 3)
      fail("a face with " + std::to_string(corners_.size()) +
           " corners where three are needed; the line is cut short");
    mesh_.add_polygon(corners_);
  }

  // v, v/vt, v//vn or v/vt/vn, counted from 1, or backwards from -1. A face may stand before its
  // vertices, so that the upper end is checked last.
  Index corner(std::string_view word) {
    const std::size_t slash = word.find('/');
    const auto number = parse_integer(word.substr(0, slash));
    bool well_formed = number.has_value();
    if (slash != std::string_view::npos) {
      const std::string_view rest = word.substr(slash + 1);
      const std::size_t second = rest.find('/');
      const std::string_view texture = rest.substr(0, second);
      well_formed = well_formed && (texture.empty() || parse_integer(texture));
      if (second != std::string_view::npos) {
        const std::string_view normal = rest.substr(second + 1);
        well_formed = well_formed && (normal.empty() || parse_integer(normal));
      }
    }
    if (!well_formed)
      fail(in_quotes(word) +
           " is not a face's corner (7, 7/1, 7//1 or 7/1/1); correct it or export "
           "the file again");
    const auto count = static_cast<std::int64_t>(mesh_.vertex_count());
    if (*number == 0 || *number < -count || *number > std::numeric_limits<Index>::max())
      fail("the face refers to vertex " + std::to_string(*number) + ", but " +
           std::to_string(count) + " vertices stand before it, counted from 1; correct the face");
    const auto vertex = static_cast<Index>(*number < 0 ? count + *number : *number - 1);
    if (vertex > farthest_) {
      farthest_ = vertex;
      farthest_line_ = line_;
    }
    return vertex;
  }

  MeshBuilder& mesh_;
  std::size_t line_ = 0;
  std::vector<Index> corners_;
  Index farthest_ = kNone;
  std::size_t farthest_line_ = 0;
};

bool continues(std::string_view line) {
  return !line.empty() && line.back() == '\\';
}

}  // namespace

void read_obj(std::string_view bytes, MeshBuilder& mesh) {
  ObjReader reader(mesh);
  Lines lines(bytes);
  std::string_view line;
  std::string joined;
  while (lines.next(line)) {
    const std::size_t first = lines.line();
    if (continues(line)) {
      joined.clear();
      while (continues(line)) {
        joined += line.substr(0, line.size() - 1);
        joined += ' ';
        if (!lines.next(line)) line = {};
      }
      joined += line;
      line = joined;
    }
    reader.statement(line, first);
  }
  reader.finish();
}

}  // namespace mimicry::io
