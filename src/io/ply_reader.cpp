#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/base/error.h>

#include "io/binary.h"
#include "io/mesh_builder.h"
#include "io/ply_attributes.h"
#include "io/ply_property.h"
#include "io/text.h"

namespace mimicry {
namespace {

struct Element {
  std::string_view name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;
};

enum class Encoding { text, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::text;
  PlyLabelNames labels;
  std::vector<Element> elements;
  std::size_t lines = 0;
  std::string_view body;
};

Header read_header(std::string_view bytes, MeshBuilder& mesh) {
  const std::string_view name = mesh.name();
  Header header;
  Lines lines(bytes);
  std::string_view line;
  const auto fail = [&](const std::string& what) { fail_at_line(name, lines.line(), what); };
  if (!lines.next(line) || take_word(line) != "ply")
    fail("a PLY file begins with the line 'ply'; give a file of that format");
  // Whether lines end in CR alone: then an LF behind the header is the body's.
  const bool ends_in_cr = bytes.substr(0, bytes.find('\n')).find("\rformat") != bytes.npos;
  bool has_format = false;
  std::size_t unknown = 0;
  std::string first_unknown;
  while (true) {
    if (!lines.next(line)) fail("the header has no 'end_header'; the file is cut short");
    const char* const line_end = line.data() + line.size();
    const std::string_view keyword = take_word(line);
    if (keyword == "end_header") {
      // A last line without its end cannot be told from one that is cut in the middle.
      if (!has_format) fail("the header has no 'format' line; export the file again");
      header.body = lines.rest();
      if (ends_in_cr && !header.body.empty())
        header.body = bytes.substr(static_cast<std::size_t>(line_end - bytes.data()) + 1);
      break;
    }
    if (keyword == "format") {
      const std::string_view word = take_word(line);
      if (word == "ascii")
        header.encoding = Encoding::text;
      else if (word == "binary_little_endian")
        header.encoding = Encoding::little_endian;
      else if (word == "binary_big_endian")
        header.encoding = Encoding::big_endian;
      else
        fail(in_quotes(word) +
             " is no PLY format (ascii, binary_little_endian, binary_big_endian); "
             "export the file again");
      has_format = true;
    } else if (keyword == "element") {
      const std::string_view element = take_word(line);
      const std::string_view word = take_word(line);
      const auto count = parse_integer(word);
      if (element.empty() || !count || *count < 0)
        fail("'element' needs a name and a count, not " + in_quotes(word) +
             "; export the file again");
      header.elements.push_back({element, static_cast<std::uint64_t>(*count), {}});
    } else if (keyword == "property") {
      if (header.elements.empty())
        fail("a property stands before the first element; export the file again");
      PlyProperty property{};
      std::string_view word = take_word(line);
      if (word == "list") {
        property.count_type = ply_type_of(take_word(line));
        if (!property.count_type || !is_whole_ply_type(*property.count_type))
          fail("the count of a list is of no whole type; export the file again");
        word = take_word(line);
      }
      const auto type = ply_type_of(word);
      if (!type) fail(in_quotes(word) + " is no PLY type; export the file again");
      property.type = *type;
      property.name = take_word(line);
      header.elements.back().properties.push_back(property);
    } else if (keyword == "comment") {
      header.labels.add(line);
    } else if (keyword != "obj_info" && !keyword.empty()) {
      if (unknown++ == 0)
        first_unknown = in_quotes(keyword) + " in line " + std::to_string(lines.line());
    }
  }
  header.lines = lines.line();
  if (unknown > 0)
    mesh.note(std::to_string(unknown) +
              (unknown == 1 ? " line of the header is" : " lines of the header are") +
              " no statement of PLY and passed over (first: " + first_unknown + ")");
  return header;
}

class TextSource {
 public:
  TextSource(const Header& header, std::string_view name)
      : words_(header.body, name, header.lines + 1) {}
  double number(PlyType) { return words_.number("a property"); }
  std::int64_t integer(PlyType) { return words_.integer("a list's count or item"); }
  /// NaN where it is no number: for what may be passed over.
  double number_or_nan(PlyType) {
    return parse_double(words_.required("a property")).value_or(std::nan(""));
  }
  void skip(PlyType) { words_.skip("a property"); }
  std::uint64_t bytes_left() const { return words_.bytes_left(); }
  [[noreturn]] void fail(const std::string& what) const { words_.fail(what); }
  // A digit and a blank.
  static std::uint64_t least_size(PlyType) { return 2; }
  // The last word needs no blank.
  static constexpr std::uint64_t kSlack = 1;

 private:
  Words words_;
};

class BinarySource {
 public:
  BinarySource(const Header& header, std::string_view bytes, std::string_view name)
      : big_endian_(header.encoding == Encoding::big_endian),
        bytes_(bytes),
        offset_(bytes.size() - header.body.size()),
        name_(name) {}

  double number(PlyType type) {
    const char* p = take(type);
    switch (type) {
      case PlyType::float32:
        return load<float>(p, big_endian_);
      case PlyType::float64:
        return load<double>(p, big_endian_);
      default:
        return static_cast<double>(whole(type, p));
    }
  }
  double number_or_nan(PlyType type) { return number(type); }
  std::int64_t integer(PlyType type) { return whole(type, take(type)); }
  void skip(PlyType type) { take(type); }
  std::uint64_t bytes_left() const { return bytes_.size() - offset_; }
  [[noreturn]] void fail(const std::string& what) const { fail_at_byte(name_, offset_, what); }
  static std::uint64_t least_size(PlyType type) { return ply_size_of(type); }
  static constexpr std::uint64_t kSlack = 0;

 private:
  const char* take(PlyType type) {
    if (bytes_left() < ply_size_of(type))
      fail("the file ends within its elements; it is cut short");
    const char* p = bytes_.data() + offset_;
    offset_ += ply_size_of(type);
    return p;
  }
  std::int64_t whole(PlyType type, const char* p) const {
    switch (type) {
      case PlyType::int8:
        return load<std::int8_t>(p, big_endian_);
      case PlyType::uint8:
        return load<std::uint8_t>(p, big_endian_);
      case PlyType::int16:
        return load<std::int16_t>(p, big_endian_);
      case PlyType::uint16:
        return load<std::uint16_t>(p, big_endian_);
      case PlyType::int32:
        return load<std::int32_t>(p, big_endian_);
      default:
        return load<std::uint32_t>(p, big_endian_);
    }
  }

  bool big_endian_;
  std::string_view bytes_;
  std::size_t offset_;
  std::string_view name_;
};

/// by_corner: what faces have in lists of their own and vertices need not tell.
struct ByCorner {
  bool texcoords = false, colors = false;
};

template <class Source>
void read_vertices(Source& source, const Element& element, const ByCorner& by_corner,
                   MeshBuilder& mesh) {
  std::vector<PlyRole> roles;
  std::array<double, kPlyRoles> most;  // what stands for 1
  most.fill(1.0);
  int found[kPlyRoles] = {};
  for (const PlyProperty& property : element.properties) {
    PlyRole role = ply_role_of(property);
    if (role >= kPlyRed && found[role] > 0) role = kPlyPassedOver;  // the first counts
    roles.push_back(role);
    if (role < 0) continue;
    ++found[role];
    most[static_cast<std::size_t>(role)] = ply_most_of(property.type);
  }
  for (int axis = 0; axis < 3; ++axis)
    if (found[axis] != 1)
      source.fail(std::string("the element 'vertex' needs one property '") + "xyz"[axis] +
                  "'; export the file again");
  const bool has_color =
      !by_corner.colors && found[kPlyRed] > 0 && found[kPlyGreen] > 0 && found[kPlyBlue] > 0;
  const bool has_texcoord = !by_corner.texcoords && found[kPlyU] > 0 && found[kPlyV] > 0;
  for (PlyRole& role : roles)
    if (role >= kPlyU ? !has_texcoord : role >= kPlyRed && !has_color) role = kPlyPassedOver;
  const PlyColor to_color;
  mesh.reserve(element.count, 0);
  double numbers[kPlyRoles] = {};
  numbers[kPlyAlpha] = 1.0;
  for (std::uint64_t v = 0; v < element.count; ++v) {
    for (std::size_t k = 0; k < roles.size(); ++k) {
      const PlyType type = element.properties[k].type;
      if (roles[k] == kPlyPassedOver)
        skip_ply_property(source, element.properties[k]);
      else
        numbers[roles[k]] = roles[k] <= kPlyZ ? source.number(type) : source.number_or_nan(type);
    }
    const Index vertex = mesh.add_vertex({numbers[kPlyX], numbers[kPlyY], numbers[kPlyZ]});
    if (has_color) mesh.attributes().colors.set_of_vertex(vertex, to_color(numbers, most));
    if (has_texcoord)
      mesh.attributes().texcoords.set_of_vertex(
          vertex, {static_cast<float>(numbers[kPlyU]), static_cast<float>(numbers[kPlyV])});
  }
}

/// The list of an element's that names vertices.
template <class Source>
const PlyProperty& list_of_corners(Source& source, const Element& element) {
  for (const PlyProperty& property : element.properties) {
    if (!property.count_type ||
        (property.name != "vertex_indices" && property.name != "vertex_index"))
      continue;
    if (!is_whole_ply_type(property.type))
      source.fail("the list " + in_quotes(property.name) +
                  " is of no whole type; export the file again");
    return property;
  }
  source.fail("the element " + in_quotes(element.name) +
              " needs a list 'vertex_indices'; export the file again");
}

/// Hands over the corners of each of an element's faces or strips, and to `other` what else they
/// have.
template <class Source, class Other, class Visit>
void read_corners(Source& source, const Element& element, std::uint64_t vertex_count,
                  bool has_restarts, const Other& other, const Visit& visit) {
  if (element.count == 0) return;
  const PlyProperty& list = list_of_corners(source, element);
  std::vector<Index> corners;
  for (std::uint64_t f = 0; f < element.count; ++f) {
    corners.clear();
    for (const PlyProperty& property : element.properties) {
      if (&property != &list) {
        other(property);
        continue;
      }
      const std::int64_t count = ply_list_size(source, list);
      for (std::int64_t k = 0; k < count; ++k) {
        const std::int64_t item = source.integer(list.type);
        if (has_restarts && item == -1) {
          corners.push_back(kNone);
          continue;
        }
        if (item < 0 || static_cast<std::uint64_t>(item) >= vertex_count)
          source.fail((has_restarts ? "strip " : "face ") + std::to_string(f) +
                      " refers to vertex " + std::to_string(item) + ", but the header promises " +
                      std::to_string(vertex_count) + " vertices, counted from 0; correct the face");
        corners.push_back(static_cast<Index>(item));
      }
    }
    visit(corners);
  }
}

/// Every other triangle of a strip is turned; -1 begins another strip. Triangles that repeat a
/// vertex only lead the strip on, and are left out.
void add_strip(std::span<const Index> corners, MeshBuilder& mesh) {
  std::size_t first = 0;  // of the strip
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (corners[k] == kNone) first = k + 1;
    if (k < first + 2) continue;
    Face face = {corners[k - 2], corners[k - 1], corners[k]};
    if ((k - first) % 2 == 1) std::swap(face[0], face[1]);
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) mesh.add_polygon(face);
  }
}

template <class Source>
void read_body(Source& source, const Header& header, MeshBuilder& mesh) {
  std::uint64_t vertex_count = 0;
  bool seen_vertices = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") vertex_count = element.count;
    // No element is smaller than its scalars and list counts: a header that promises more than the
    // file can hold is found out before anything is allocated. (One without properties is refused
    // where it is read.)
    std::uint64_t least = 0;
    for (const PlyProperty& property : element.properties)
      least += source.least_size(property.count_type ? *property.count_type : property.type);
    if (least > 0 && element.count > (source.bytes_left() + Source::kSlack) / least)
      source.fail("the header promises " + std::to_string(element.count) + " elements " +
                  in_quotes(element.name) + ", more than the file holds; it is cut short");
  }
  PlyFaceAttributes attributes(header.labels, mesh);
  ByCorner by_corner;
  for (const Element& element : header.elements)
    for (const PlyProperty& property : element.properties) {
      if (element.name != "face") continue;
      by_corner.texcoords = by_corner.texcoords || PlyFaceAttributes::is_texcoords(property);
      by_corner.colors = by_corner.colors || PlyFaceAttributes::is_colors(property);
    }
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      if (seen_vertices) source.fail("two elements 'vertex'; export the file again");
      seen_vertices = true;
      read_vertices(source, element, by_corner, mesh);
    } else if (element.name == "face") {
      mesh.reserve(0, element.count);
      attributes.begin(element.properties);
      read_corners(
          source, element, vertex_count, false,
          [&](const PlyProperty& property) { attributes.read(source, property); },
          [&](std::span<const Index> corners) { attributes.add_polygon(corners); });
    } else if (element.name == "tristrips") {
      read_corners(
          source, element, vertex_count, true,
          [&](const PlyProperty& property) { skip_ply_property(source, property); },
          [&](std::span<const Index> corners) { add_strip(corners, mesh); });
    } else if (!element.properties.empty()) {
      for (std::uint64_t n = 0; n < element.count; ++n)
        for (const PlyProperty& property : element.properties) skip_ply_property(source, property);
    }
  }
  attributes.tell();
}

}  // namespace

void read_ply(std::string_view bytes, MeshBuilder& mesh) {
  const Header header = read_header(bytes, mesh);
  if (header.encoding == Encoding::text) {
    TextSource source(header, mesh.name());
    read_body(source, header, mesh);
  } else {
    BinarySource source(header, bytes, mesh.name());
    read_body(source, header, mesh);
  }
}

}  // namespace mimicry
