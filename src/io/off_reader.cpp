#include <string>
#include <vector>

#include <mimicry/base/error.h>

#include "io/mesh_builder.h"
#include "io/text.h"

namespace mimicry::io {
namespace {

class OffReader {
 public:
  OffReader(std::string_view bytes, MeshBuilder& mesh) : lines_(bytes), mesh_(mesh) {}

  void read() {
    std::string_view line = next_line("the header");
    read_keyword(take_word(line));
    std::string_view word = take_word(line);
    if (to_lower(word) == "binary")
      throw Error(ErrorKind::unsupported,
                  std::string(mesh_.name()) + ": binary OFF is not handled; export it as text");
    if (word.empty()) {
      line = next_line("the counts");
      word = take_word(line);
    }
    const std::size_t vertices = count(word, "vertices");
    const std::size_t faces = count(take_word(line), "faces");
    // The number of edges is of no use and often missing or wrong.

    // A vertex takes at least 6 bytes and a face 8, with the end of the line.
    if (vertices > lines_.rest().size() / 6 + 1 || faces > lines_.rest().size() / 8 + 1)
      fail("the header promises " + std::to_string(vertices) + " vertices and " +
           std::to_string(faces) + " faces, more than the file holds; it is cut short");
    mesh_.reserve(vertices, faces);
    for (std::size_t v = 0; v < vertices; ++v) vertex(next_line("a vertex"));
    for (std::size_t f = 0; f < faces; ++f) face(next_line("a face"));
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    fail_at_line(mesh_.name(), lines_.line(), what);
  }

  /// The next line that holds more than a comment, without it.
  std::string_view next_line(const char* what) {
    std::string_view line;
    while (lines_.next(line)) {
      line = line.substr(0, line.find('#'));
      std::string_view rest = line;
      if (!take_word(rest).empty()) return line;
    }
    fail(std::string("the file ends where ") + what + " should stand; it is cut short");
  }

  void read_keyword(std::string_view word) const {
    std::string_view prefix = word;
    const bool ends_well = prefix.size() >= 3 && prefix.substr(prefix.size() - 3) == "OFF";
    if (ends_well) prefix.remove_suffix(3);
    if (!ends_well || prefix.find_first_not_of("STCN4n") != std::string_view::npos)
      fail(in_quotes(word) + " where 'OFF' should stand; give a file of that format");
    if (prefix.find_first_of("4n") != std::string_view::npos)
      throw Error(ErrorKind::unsupported,
                  std::string(mesh_.name()) + ": vertices of other than three coordinates (" +
                      std::string(word) + ") are not handled; export it as OFF");
  }

  std::size_t count(std::string_view word, const char* what) const {
    const auto value = parse_integer(word);
    if (!value || *value < 0)
      fail(in_quotes(word) + " where the number of " + what +
           " should stand; export the file again");
    return static_cast<std::size_t>(*value);
  }

  // Normal, colour and texture coordinate come after the position, in each variant.
  void vertex(std::string_view line) {
    Vec3 position;
    for (double& x : position) {
      const std::string_view word = take_word(line);
      const auto value = parse_double(word);
      if (!value)
        fail(in_quotes(word) +
             " is not a number, for a vertex; correct it or export the file again");
      x = *value;
    }
    mesh_.add_vertex(position);
  }

  // A colour may come after the corners.
  void face(std::string_view line) {
    const std::string_view count_word = take_word(line);
    const auto size = parse_integer(count_word);
    if (!size || *size < 3)
      fail("a face of " + in_quotes(count_word) + " corners where three are needed; remove it");
    corners_.clear();
    for (std::int64_t k = 0; k < *size; ++k) {
      const std::string_view word = take_word(line);
      const auto corner = parse_integer(word);
      if (!corner)
        fail(in_quotes(word) + " where corner " + std::to_string(k) + " of " +
             std::to_string(*size) + " should stand; the line is cut short or wrong");
      if (*corner < 0 || *corner >= static_cast<std::int64_t>(mesh_.vertex_count()))
        fail("the face refers to vertex " + std::to_string(*corner) + ", but there are " +
             std::to_string(mesh_.vertex_count()) + " vertices, counted from 0; correct the face");
      corners_.push_back(static_cast<Index>(*corner));
    }
    mesh_.add_polygon(corners_);
  }

  Lines lines_;
  MeshBuilder& mesh_;
  std::vector<Index> corners_;
};

}  // namespace

void read_off(std::string_view bytes, MeshBuilder& mesh) {
  OffReader(bytes, mesh).read();
}

}  // namespace mimicry::io
