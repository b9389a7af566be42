#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "io/binary.h"
#include "io/mesh_builder.h"
#include "io/text.h"

namespace mimicry {
namespace {

constexpr std::size_t kHeaderSize = 84;    // 80 bytes of anything, a count
constexpr std::size_t kTriangleSize = 50;  // normal, three corners, two bytes of anything
constexpr std::size_t kCornersEnd = 48;    // of a triangle

/// Whether no byte near its beginning is one that only binary files hold.
bool looks_like_text(std::string_view bytes) {
  return std::none_of(bytes.begin(),
                      bytes.begin() + std::min<std::ptrdiff_t>(std::ssize(bytes), 1024),
                      [](char c) { return c >= 0 && c < ' ' && !is_blank(c) && c != '\n'; });
}

/// How many triangles a binary file holds, whatever its header says, which some programs never
/// fill in. `last`: bytes of one more that is cut short.
struct Triangles {
  std::size_t triangles;
  std::size_t last;
};

Triangles triangles_of(std::string_view bytes, MeshBuilder& mesh) {
  const std::size_t count = load<std::uint32_t>(bytes.data() + 80);
  const std::size_t held = (bytes.size() - kHeaderSize) / kTriangleSize;
  const std::size_t rest = (bytes.size() - kHeaderSize) % kTriangleSize;
  const std::string said = "the header promises " + std::to_string(count) + " triangles";
  if (count == held && rest == 0) return {held, 0};
  const bool never_written = count == 0 || count == std::numeric_limits<std::uint32_t>::max();
  if (count <= held && !never_written) {
    mesh.note(said + ", and more follows, which is passed over");
    return {count, 0};
  }
  const bool last_is_cut = count == held + 1 && rest > 0;
  const bool is_whole = held > 0 && rest == 0 && !looks_like_text(bytes);
  if (!last_is_cut && !is_whole && (held == 0 || !never_written))
    fail_at_byte(mesh.name(), bytes.size(),
                 said + ", but the file ends after " + std::to_string(held) +
                     "; it is cut short or of another format");
  if (!last_is_cut)
    mesh.note(said + ", but the file holds " + std::to_string(held) + ", which are read");
  return {held, rest};
}

void read_binary(std::string_view bytes, MeshBuilder& mesh) {
  if (bytes.size() < kHeaderSize)
    fail_at_byte(mesh.name(), bytes.size(),
                 "the file ends within the header of a binary STL; it is cut short or of another "
                 "format");
  auto [count, last] = triangles_of(bytes, mesh);
  if (last >= kCornersEnd) {
    ++count;
    mesh.note("the last triangle lacks its attribute bytes, which are of no use");
  } else if (last > 0) {
    mesh.note("the last triangle is cut short and left out");
  }
  mesh.reserve(3 * count, count);
  for (std::size_t f = 0; f < count; ++f) {
    std::array<Index, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const char* p = bytes.data() + kHeaderSize + kTriangleSize * f + 12 + 12 * k;
      corners[k] = mesh.add_vertex({load<float>(p), load<float>(p + 4), load<float>(p + 8)});
    }
    mesh.add_polygon(corners);
  }
}

class StlTextReader {
 public:
  StlTextReader(std::string_view text, MeshBuilder& mesh)
      : words_(text, mesh.name()), mesh_(mesh) {}

  void read() {
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      if (to_lower(word) != "solid")
        words_.fail(in_quotes(word) + " where 'solid' should stand; export the file again");
      words_.skip_line();  // the name
      if (!solid()) return;
      words_.skip_line();
    }
  }

 private:
  // False where the file ends within it.
  bool solid() {
    while (true) {
      const std::string_view word = words_.next();
      const std::string keyword = to_lower(word);
      if (keyword == "endsolid") return true;
      if (word.empty()) {
        mesh_.note("the file ends without 'endsolid'; it may be cut short");
        return false;
      }
      if (keyword != "facet" && !is_cut(word, "facet") && !is_cut(word, "endsolid"))
        words_.fail(in_quotes(word) + " where 'facet' should stand; export the file again");
      if (!facet()) {
        mesh_.note("the file ends within its last triangle, which is left out");
        return false;
      }
    }
  }

  // False where the file ends within it, or may do so.
  bool facet() {
    // The normal is passed over.
    std::string word = to_lower(words_.next());
    while (!word.empty() && word != "outer") {
      if (word == "vertex" || word == "endfacet")
        words_.fail(in_quotes(word) + " where 'outer loop' should stand; export the file again");
      word = to_lower(words_.next());
    }
    if (!word.empty()) word = to_lower(words_.next());
    if (word != "loop" && !is_cut(word, "loop")) wrong(word, "loop");
    corners_.clear();
    for (word = to_lower(words_.next()); word == "vertex"; word = to_lower(words_.next())) {
      Vec3 position;
      for (double& x : position) {
        const std::string_view digits = words_.next();
        const auto value = parse_double(digits);
        if (!value && words_.bytes_left() == 0) return false;
        if (!value)
          words_.fail(in_quotes(digits) +
                      " is not a number, for a corner; correct it or export the file again");
        x = *value;
      }
      corners_.push_back(position);
    }
    // Without it, the last number may be cut as well.
    if (is_cut(word, "endloop") || is_cut(word, "vertex")) return false;
    if (word != "endloop") wrong(word, "endloop");
    polygon_.clear();
    for (const Vec3& position : corners_) polygon_.push_back(mesh_.add_vertex(position));
    mesh_.add_polygon(polygon_);
    word = to_lower(words_.next());
    if (word != "endfacet" && !is_cut(word, "endfacet")) wrong(word, "endfacet");
    return true;
  }

  bool is_cut(std::string_view word, std::string_view keyword) const {
    return words_.bytes_left() == 0 && word != keyword && keyword.starts_with(to_lower(word));
  }
  [[noreturn]] void wrong(std::string_view word, const std::string& keyword) const {
    words_.fail(in_quotes(word) + " where '" + keyword + "' should stand; export the file again");
  }

  Words words_;
  MeshBuilder& mesh_;
  std::vector<Vec3> corners_;
  std::vector<Index> polygon_;
};

bool is_text(std::string_view bytes, std::string_view name) {
  // Binary files may begin with "solid" as well; their size gives them away, or a byte that no
  // text holds.
  if (bytes.size() >= kHeaderSize &&
      bytes.size() == kHeaderSize + kTriangleSize * static_cast<std::uint64_t>(
                                                        load<std::uint32_t>(bytes.data() + 80)))
    return false;
  const std::string_view text = text_of(bytes, name);
  Words words(text, name);
  return to_lower(words.next()) == "solid" && looks_like_text(text);
}

}  // namespace

void read_stl(std::string_view bytes, MeshBuilder& mesh) {
  if (is_text(bytes, mesh.name()))
    StlTextReader(text_of(bytes, mesh.name()), mesh).read();
  else
    read_binary(bytes, mesh);
  mesh.merge_identical_positions();
}

}  // namespace mimicry
