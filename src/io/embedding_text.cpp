#include "io/embedding_text.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <mimicry/base/error.h>

#include "io/text.h"

namespace mimicry {
namespace {

constexpr std::size_t kColumns = 8;
constexpr double kLargest = 1e30;

class TextReader {
 public:
  TextReader(std::string_view bytes, std::string_view name)
      : lines_(text_of(bytes, name)), name_(name) {}

  EmbeddingText read(int corners) {
    const std::size_t vertices = count("vertices"), elements = count("elements");
    // A vertex takes at least 22 bytes on its two lines, a corner 2.
    const auto per_element = static_cast<std::size_t>(corners);
    if (vertices > lines_.rest().size() / 22 + 1 ||
        elements > lines_.rest().size() / (2 * per_element) + 1)
      fail("it promises " + std::to_string(vertices) + " vertices and " + std::to_string(elements) +
           " elements, more than the file holds; it is cut short");
    EmbeddingText text;
    text.positions.resize(vertices);
    text.values.resize(vertices * kColumns);
    for (std::size_t v = 0; v < vertices; ++v) {
      const std::string what = "vertex " + std::to_string(v);
      numbers(text.positions[v].data(), 3, "the position of " + what);
      numbers(&text.values[v * kColumns], kColumns, "the position in R^8 of " + what);
    }
    text.elements.resize(elements * per_element);
    for (std::size_t e = 0; e < elements; ++e)
      corners_of(e, &text.elements[e * per_element], per_element, vertices);
    if (next_line())
      fail(in_quotes(line_) + " after the last element; the counts do not fit the file");
    return text;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    fail_at_line(name_, lines_.line(), what);
  }

  bool next_line() {
    while (lines_.next(line_)) {
      std::string_view rest = line_;
      if (!take_word(rest).empty()) return true;
    }
    return false;
  }
  void require_line(const std::string& what) {
    if (!next_line()) fail("the file ends where " + what + " should stand; it is cut short");
  }
  void require_end(std::string_view rest, std::size_t wanted, const std::string& what) const {
    if (!take_word(rest).empty())
      fail("more than " + std::to_string(wanted) + " numbers, for " + what +
           "; this is not a file of that format");
  }

  std::size_t count(const std::string& what) {
    require_line("the number of " + what);
    std::string_view rest = line_;
    const std::string_view word = take_word(rest);
    const auto value = parse_integer(word);
    if (!value || *value < 0 || *value > std::numeric_limits<Index>::max() / 4)
      fail(in_quotes(word) + " is not a number of " + what +
           "; the file must begin with two lines, the number of vertices and of elements");
    require_end(rest, 1, "the number of " + what);
    return static_cast<std::size_t>(*value);
  }

  void numbers(double* out, std::size_t wanted, const std::string& what) {
    require_line(what);
    std::string_view rest = line_;
    for (std::size_t k = 0; k < wanted; ++k) {
      const std::string_view word = take_word(rest);
      if (word.empty())
        fail(std::to_string(k) + " numbers where " + std::to_string(wanted) +
             " should stand, for " + what);
      const auto value = parse_double(word);
      if (!value) fail(in_quotes(word) + " is not a number, for " + what);
      if (!std::isfinite(*value) || std::abs(*value) > kLargest)
        fail(in_quotes(word) + " is not finite or beyond 1e30, for " + what +
             "; compute the embedding again");
      out[k] = *value;
    }
    require_end(rest, wanted, what);
  }

  void corners_of(std::size_t element, Index* out, std::size_t wanted, std::size_t vertices) {
    const std::string what = "element " + std::to_string(element);
    require_line(what);
    std::string_view rest = line_;
    for (std::size_t k = 0; k < wanted; ++k) {
      const std::string_view word = take_word(rest);
      if (word.empty())
        fail(std::to_string(k) + " corners where " + std::to_string(wanted) +
             " should stand, for " + what +
             (k == 3 ? "; give the surface's file first, then the shell's" : ""));
      const auto corner = parse_integer(word);
      if (!corner) fail(in_quotes(word) + " is not a vertex, for " + what);
      if (*corner < 0 || static_cast<std::size_t>(*corner) >= vertices)
        fail(what + " refers to vertex " + std::to_string(*corner) + ", but there are " +
             std::to_string(vertices) + " vertices, counted from 0");
      out[k] = static_cast<Index>(*corner);
    }
    if (!take_word(rest).empty())
      fail("more than " + std::to_string(wanted) + " corners, for " + what +
           (wanted == 3 ? "; give the surface's file first, then the shell's" : ""));
  }

  Lines lines_;
  std::string_view name_;
  std::string_view line_;
};

bool begins_with(const EmbeddingText& shell, const EmbeddingText& surface) {
  return shell.positions.size() >= surface.positions.size() &&
         std::equal(surface.positions.begin(), surface.positions.end(), shell.positions.begin()) &&
         std::equal(surface.values.begin(), surface.values.end(), shell.values.begin());
}

}  // namespace

EmbeddingText read_embedding_text(std::string_view bytes, std::string_view name, int corners) {
  return TextReader(bytes, name).read(corners);
}

Embedding make_embedding(EmbeddingText surface, EmbeddingText shell) {
  const auto refuse = [](const std::string& what) {
    throw Error(ErrorKind::invalid_input, "embedding: " + what);
  };
  if (surface.elements.empty()) refuse("the surface has no faces");
  if (shell.elements.empty()) refuse("the shell has no tetrahedra");
  Embedding e;
  e.dimension = static_cast<std::int32_t>(kColumns);
  e.options.dimension = e.dimension;
  e.options.samples = 0;
  e.mesh_vertex_count = static_cast<Index>(surface.positions.size());
  for (std::size_t i = 0; i < surface.elements.size(); i += 3)
    e.faces.push_back({surface.elements[i], surface.elements[i + 1], surface.elements[i + 2]});

  const Index shift = begins_with(shell, surface) ? 0 : e.mesh_vertex_count;
  if (shift == 0) {
    e.positions = std::move(shell.positions);
    e.values = std::move(shell.values);
  } else {
    e.positions = std::move(surface.positions);
    e.positions.insert(e.positions.end(), shell.positions.begin(), shell.positions.end());
    e.values = std::move(surface.values);
    e.values.insert(e.values.end(), shell.values.begin(), shell.values.end());
  }
  const auto position = [&e](Index v) -> const Vec3& {
    return e.positions[static_cast<std::size_t>(v)];
  };
  for (std::size_t i = 0; i < shell.elements.size(); i += 4) {
    std::array<Index, 4> t;
    for (std::size_t k = 0; k < 4; ++k) t[k] = shell.elements[i + k] + shift;
    const Vec3& a = position(t[0]);
    if ((position(t[1]) - a).cross(position(t[2]) - a).dot(position(t[3]) - a) < 0.0)
      std::swap(t[2], t[3]);
    e.tets.push_back(t);
  }

  Eigen::Matrix<double, kColumns, 1> mean = Eigen::Matrix<double, kColumns, 1>::Zero();
  const auto value = [&e](std::size_t v) {
    return Eigen::Map<Eigen::Matrix<double, kColumns, 1>>(&e.values[v * kColumns]);
  };
  const auto count = static_cast<std::size_t>(e.mesh_vertex_count);
  for (std::size_t v = 0; v < count; ++v) mean += value(v) / static_cast<double>(count);
  for (std::size_t v = 0; v < e.positions.size(); ++v) value(v) -= mean;

  const TriangleMesh mesh = mesh_of(e);
  e.mesh_hash = content_hash(mesh);
  e.diagonal = diagonal(mesh);
  sort_for_search(e);
  return e;
}

}  // namespace mimicry
