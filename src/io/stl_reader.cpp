#include <array>
#include <string>

#include "io/binary.h"
#include "io/mesh_builder.h"
#include "io/text.h"

namespace mimicry::io {
namespace {

constexpr std::size_t kHeaderSize = 84;    // 80 bytes of anything, a count
constexpr std::size_t kTriangleSize = 50;  // normal, three corners, two bytes of anything

void read_binary(std::string_view bytes, MeshBuilder& mesh) {
  if (bytes.size() < kHeaderSize)
    fail_at_byte(mesh.name(), bytes.size(),
                 "the file ends within the header of a binary STL; it is cut short or of another "
                 "format");
  const std::size_t count = load<std::uint32_t>(bytes.data() + 80);
  if ((bytes.size() - kHeaderSize) / kTriangleSize < count)
    fail_at_byte(mesh.name(), bytes.size(),
                 "the header promises " + std::to_string(count) +
                     " triangles, but the file ends after " +
                     std::to_string((bytes.size() - kHeaderSize) / kTriangleSize) +
                     "; it is cut short or of another format");
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

void read_text(std::string_view bytes, MeshBuilder& mesh) {
  Words words(bytes, mesh.name());
  const auto expect = [&](const char* keyword) {
    const std::string_view word = words.next();
    if (word.empty())
      words.fail(std::string("the file ends where '") + keyword +
                 "' should stand; it is cut short");
    if (to_lower(word) != keyword)
      words.fail(in_quotes(word) + " where '" + keyword + "' should stand; export the file again");
  };
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (to_lower(word) != "solid")
      words.fail(in_quotes(word) + " where 'solid' should stand; export the file again");
    words.skip_line();  // the name
    while (true) {
      word = words.next();
      if (word.empty()) words.fail("the file ends without 'endsolid'; it is cut short");
      const std::string keyword = to_lower(word);
      if (keyword == "endsolid") break;
      if (keyword != "facet")
        words.fail(in_quotes(word) + " where 'facet' should stand; export the file again");
      expect("normal");
      for (int k = 0; k < 3; ++k) words.number("a normal");
      expect("outer");
      expect("loop");
      std::array<Index, 3> corners;
      for (Index& corner : corners) {
        expect("vertex");
        Vec3 position;
        for (double& x : position) x = words.number("a corner");
        corner = mesh.add_vertex(position);
      }
      mesh.add_polygon(corners);
      expect("endloop");
      expect("endfacet");
    }
    words.skip_line();
  }
}

bool is_text(std::string_view bytes) {
  // Binary files may begin with "solid" as well; their size gives them away.
  if (bytes.size() >= kHeaderSize &&
      bytes.size() == kHeaderSize + kTriangleSize * static_cast<std::uint64_t>(
                                                        load<std::uint32_t>(bytes.data() + 80)))
    return false;
  Words words(bytes, {});
  return to_lower(words.next()) == "solid";
}

}  // namespace

void read_stl(std::string_view bytes, MeshBuilder& mesh) {
  if (is_text(bytes))
    read_text(bytes, mesh);
  else
    read_binary(bytes, mesh);
  mesh.merge_identical_positions();
}

}  // namespace mimicry::io
