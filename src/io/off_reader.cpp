#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/base/error.h>

#include "io/mesh_builder.h"
#include "io/text.h"

namespace mimicry {
namespace {

/// Where vertices and faces end. Files are written as lines are: a vertex or a face each, with a
/// colour, a normal or whatever may follow. Geomview's own reader takes words instead.
enum class OffLayout {
  lines,          ///< a vertex or a face on each, the rest of it is passed over
  words_by_face,  ///< words; a face begins a line, and what follows its corners is passed over
  words,          ///< words, with nothing between them that is not counted
};

/// What the keyword says of a vertex's words.
struct OffKeyword {
  bool homogeneous = false;  // a fourth coordinate, by which the others are divided
  bool has_dimension = false;
  bool has_normals = false, has_colors = false, has_texcoords = false;
  std::size_t more_words = 0;  // after the position: normal, colour, texture coordinates
};

struct OffHeader {
  OffKeyword keyword;
  std::size_t vertices = 0, faces = 0;
  std::string_view body;  // after the line of the number of faces
  std::size_t line = 0;   // of that
  std::string_view rest_of_line;
};

class OffReader {
 public:
  OffReader(std::string_view bytes, MeshBuilder& mesh) : bytes_(bytes), mesh_(mesh) {}

  void read() {
    read_header();
    // A vertex takes at least 6 bytes and a face 2, with the blanks.
    if (header_.vertices > bytes_.size() / 6 + 1 || header_.faces > bytes_.size() / 2 + 1)
      fail("the header promises " + std::to_string(header_.vertices) + " vertices and " +
           std::to_string(header_.faces) + " faces, more than the file holds; it is cut short");
    try {
      read_body(OffLayout::lines, true);
    } catch (const Error& error) {
      // What is said of lines is what most files mean, if nothing else fits either.
      if (error.kind() != ErrorKind::invalid_input || !read_words()) throw;
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { fail_at_line(mesh_.name(), line_, what); }

  void read_header() {
    start(bytes_, 1);
    std::string_view word = required("the header");
    const std::size_t off = to_lower(word).find("off");
    // Some write the counts alone, or the first one behind the keyword.
    if (off != std::string::npos) {
      read_keyword(word, off);
      word.remove_prefix(off + 3);
    } else if (!parse_integer(word)) {
      fail(in_quotes(word) + " where 'OFF' should stand; give a file of that format");
    }
    if (word.empty()) word = required("the counts");
    if (to_lower(word) == "binary")
      throw Error(ErrorKind::unsupported,
                  std::string(mesh_.name()) + ": binary OFF is not handled; export it as text");
    if (header_.keyword.has_dimension) {
      if (word != "3") refuse_dimension(word);
      word = required("the counts");
    }
    header_.vertices = count(word, "vertices");
    header_.faces = count(required("the number of faces"), "faces");
    // The number of edges is of no use and often missing or wrong.
    header_.rest_of_line = rest_;
    header_.body = lines_.rest();
    header_.line = line_;
  }

  // [ST][C][N][4][n]OFF. "nOFF" has another dimension, "NOFF" and "noff" have normals.
  void read_keyword(std::string_view word, std::size_t off) {
    OffKeyword& keyword = header_.keyword;
    for (std::size_t k = 0; k < off; ++k) {
      const std::string_view rest = word.substr(k);
      if (to_lower(rest.substr(0, 2)) == "st") {
        keyword.more_words += 2;
        keyword.has_texcoords = true;
        ++k;
      } else if (rest[0] == 'C' || rest[0] == 'c') {
        keyword.more_words += 4;
        keyword.has_colors = true;
      } else if (rest[0] == '4') {
        keyword.homogeneous = true;
      } else if (rest.starts_with("nOFF")) {
        keyword.has_dimension = true;
      } else if (rest[0] == 'N' || rest[0] == 'n') {
        keyword.more_words += 3;
        keyword.has_normals = true;
      } else {
        fail(in_quotes(word) + " where 'OFF' should stand; give a file of that format");
      }
    }
  }

  [[noreturn]] void refuse_dimension(std::string_view dimension) const {
    throw Error(ErrorKind::unsupported, std::string(mesh_.name()) + ": vertices of " +
                                            std::string(dimension) +
                                            " coordinates are not handled; export it with three");
  }

  std::size_t count(std::string_view word, const char* what) const {
    const auto value = parse_integer(word);
    if (!value || *value < 0)
      fail(in_quotes(word) + " where the number of " + what +
           " should stand; export the file again");
    return static_cast<std::size_t>(*value);
  }

  /// Whether the body has a line for each vertex and face: then one of them is wrong, and words
  /// taken together would only seem to fit.
  bool has_line_for_each() {
    start(header_.body, header_.line + 1);
    std::size_t lines = 0;
    for (; lines <= header_.vertices + header_.faces && next_line(); ++lines) rest_ = {};
    return lines == header_.vertices + header_.faces;
  }

  bool read_words() {
    if (has_line_for_each()) return false;
    const bool may_lack_edges = is_empty(header_.rest_of_line);
    for (const OffLayout layout : {OffLayout::words, OffLayout::words_by_face})
      for (const bool has_edges : {true, false}) try {
          if (!has_edges && !may_lack_edges) continue;
          read_body(layout, has_edges);
          mesh_.note("vertices and faces do not stand on a line each; they are read word by word");
          return true;
        } catch (const Error& error) {
          if (error.kind() != ErrorKind::invalid_input) throw;
        }
    return false;
  }

  // has_edges: the word after the number of faces is the number of edges.
  void read_body(OffLayout layout, bool has_edges) {
    layout_ = layout;
    mesh_.clear();
    colors_.clear();
    whole_colors_ = true;
    most_color_ = 0.0;
    mesh_.reserve(header_.vertices, header_.faces);
    start(header_.body, header_.line + 1);
    if (layout != OffLayout::lines) {
      rest_ = header_.rest_of_line;
      line_ = header_.line;
      if (has_edges) count(required("the number of edges"), "edges");
    }
    for (std::size_t v = 0; v < header_.vertices; ++v) vertex();
    for (std::size_t f = 0; f < header_.faces; ++f) face();
    if (layout != OffLayout::lines && next_line())
      fail("more follows than the header promises; export the file again");
    add_colors();
  }

  void start(std::string_view text, std::size_t first_line) {
    lines_ = Lines(text, first_line);
    line_ = first_line;
    rest_ = {};
  }
  static bool is_empty(std::string_view line) {
    return std::all_of(line.begin(), line.end(), is_blank);
  }
  /// Goes on to the next line that holds more than a comment, unless this one does.
  bool next_line() {
    while (true) {
      if (!is_empty(rest_)) return true;
      if (!lines_.next(rest_)) return false;
      rest_ = rest_.substr(0, rest_.find('#'));
      line_ = lines_.line();
    }
  }
  std::string_view required(const char* what) {
    if (!next_line())
      fail(std::string("the file ends where ") + what + " should stand; it is cut short");
    return take_word(rest_);
  }
  /// The next word of a vertex or a face that has begun.
  std::string_view word(const char* what) {
    return layout_ == OffLayout::lines ? take_word(rest_) : required(what);
  }

  void vertex() {
    const char* const what = "a vertex";
    if (!next_line()) required(what);
    Eigen::Vector4d position(0.0, 0.0, 0.0, 1.0);
    const OffKeyword& keyword = header_.keyword;
    for (Eigen::Index k = 0; k < (keyword.homogeneous ? 4 : 3); ++k) {
      const std::string_view digits = word(what);
      const auto value = parse_double(digits);
      if (!value)
        fail(in_quotes(digits) +
             " is not a number, for a vertex; correct it or export the file again");
      position[k] = *value;
    }
    const Index vertex = mesh_.add_vertex(
        keyword.homogeneous ? Vec3(position.head<3>() / position[3]) : Vec3(position.head<3>()));
    more_words_.clear();
    if (layout_ != OffLayout::lines)
      for (std::size_t k = 0; k < keyword.more_words; ++k) more_words_.push_back(required(what));
    else if (keyword.has_colors || keyword.has_texcoords)
      for (std::string_view more; !(more = take_word(rest_)).empty();) more_words_.push_back(more);
    if (layout_ == OffLayout::lines) rest_ = {};
    take_attributes(vertex);
  }

  // Normal, colour (3 or 4 words), texture coordinates, as far as the keyword promises them.
  void take_attributes(Index vertex) {
    const OffKeyword& keyword = header_.keyword;
    std::span<const std::string_view> words = more_words_;
    if (keyword.has_normals) words = words.subspan(std::min<std::size_t>(3, words.size()));
    if (keyword.has_texcoords && words.size() >= 2) {
      const auto u = parse_double(words[words.size() - 2]), v = parse_double(words.back());
      words = words.first(words.size() - 2);
      if (u && v)
        mesh_.attributes().texcoords.set_of_vertex(
            vertex, {static_cast<float>(*u), static_cast<float>(*v)});
    }
    if (!keyword.has_colors || words.size() < 3 || words.size() > 4) return;
    std::array<double, 4> color = {0.0, 0.0, 0.0, std::nan("")};
    for (std::size_t k = 0; k < words.size(); ++k) {
      const auto value = parse_double(words[k]);
      if (!value) return;
      color[k] = *value;
      most_color_ = std::max(most_color_, *value);
      whole_colors_ = whole_colors_ && parse_integer(words[k]).has_value();
    }
    colors_.emplace_back(vertex, color);
  }

  // Geomview's colours are fractions; most programs write whole numbers to 255.
  void add_colors() {
    const double most = whole_colors_ && most_color_ > 1.0 ? 255.0 : 1.0;
    for (const auto& [vertex, c] : colors_)
      mesh_.attributes().colors.set_of_vertex(
          vertex, color_from_srgb(c[0] / most, c[1] / most, c[2] / most,
                                  std::isnan(c[3]) ? 1.0 : c[3] / most));
  }

  void face() {
    const char* const what = "a face";
    if (layout_ == OffLayout::words_by_face && !is_empty(rest_))
      fail("a face does not begin a line; export the file again");
    if (!next_line()) required(what);
    const std::string_view count_word = word(what);
    const auto size = parse_integer(count_word);
    // Word by word a count below three would rather be another number.
    if (!size || *size < (layout_ == OffLayout::lines ? 0 : 3))
      fail("a face of " + in_quotes(count_word) + " corners; correct it or export the file again");
    corners_.clear();
    for (std::int64_t k = 0; k < *size; ++k) {
      const std::string_view digits = word(what);
      const auto corner = parse_integer(digits);
      if (!corner)
        fail(in_quotes(digits) + " where corner " + std::to_string(k) + " of " +
             std::to_string(*size) + " should stand; the line is cut short or wrong");
      if (*corner < 0 || *corner >= static_cast<std::int64_t>(mesh_.vertex_count()))
        fail("the face refers to vertex " + std::to_string(*corner) + ", but there are " +
             std::to_string(mesh_.vertex_count()) + " vertices, counted from 0; correct the face");
      corners_.push_back(static_cast<Index>(*corner));
    }
    mesh_.add_polygon(corners_);
    if (layout_ != OffLayout::words) rest_ = {};
  }

  std::string_view bytes_;
  MeshBuilder& mesh_;
  OffHeader header_;
  OffLayout layout_ = OffLayout::words;
  Lines lines_{std::string_view()};
  std::size_t line_ = 1;
  std::string_view rest_;  // of the line
  std::vector<Index> corners_;
  std::vector<std::string_view> more_words_;                     // of a vertex, behind its position
  std::vector<std::pair<Index, std::array<double, 4>>> colors_;  // as they stand; alpha may be NaN
  bool whole_colors_ = true;                                     // no fraction among them
  double most_color_ = 0.0;
};

}  // namespace

void read_off(std::string_view bytes, MeshBuilder& mesh) {
  OffReader(bytes, mesh).read();
}

}  // namespace mimicry
