#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/base/error.h>

#include "io/binary.h"
#include "io/mesh_builder.h"
#include "io/text.h"

namespace mimicry::io {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(Type type) {
  switch (type) {
    case Type::int8:
    case Type::uint8:
      return 1;
    case Type::int16:
    case Type::uint16:
      return 2;
    case Type::int32:
    case Type::uint32:
    case Type::float32:
      return 4;
    case Type::float64:
      break;
  }
  return 8;
}

bool is_whole(Type type) {
  return type != Type::float32 && type != Type::float64;
}

std::optional<Type> type_of(std::string_view word) {
  if (word == "char" || word == "int8") return Type::int8;
  if (word == "uchar" || word == "uint8") return Type::uint8;
  if (word == "short" || word == "int16") return Type::int16;
  if (word == "ushort" || word == "uint16") return Type::uint16;
  if (word == "int" || word == "int32") return Type::int32;
  if (word == "uint" || word == "uint32") return Type::uint32;
  if (word == "float" || word == "float32") return Type::float32;
  if (word == "double" || word == "float64") return Type::float64;
  return std::nullopt;
}

struct Property {
  std::string_view name;
  std::optional<Type> count_type;  // lists only
  Type type;
};

struct Element {
  std::string_view name;
  std::uint64_t count;
  std::vector<Property> properties;
};

enum class Encoding { text, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::size_t lines = 0;
  std::string_view body;
};

Header read_header(std::string_view bytes, std::string_view name) {
  Header header;
  Lines lines(bytes);
  std::string_view line;
  const auto fail = [&](const std::string& what) { fail_at_line(name, lines.line(), what); };
  if (!lines.next(line) || take_word(line) != "ply")
    fail("a PLY file begins with the line 'ply'; give a file of that format");
  bool has_format = false;
  while (true) {
    if (!lines.next(line)) fail("the header has no 'end_header'; the file is cut short");
    const std::string_view keyword = take_word(line);
    if (keyword == "end_header") {
      // A last line without its end cannot be told from one that is cut in the middle.
      if (!has_format) fail("the header has no 'format' line; export the file again");
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
      Property property{};
      std::string_view word = take_word(line);
      if (word == "list") {
        property.count_type = type_of(take_word(line));
        if (!property.count_type || !is_whole(*property.count_type))
          fail("the count of a list is of no whole type; export the file again");
        word = take_word(line);
      }
      const auto type = type_of(word);
      if (!type) fail(in_quotes(word) + " is no PLY type; export the file again");
      property.type = *type;
      property.name = take_word(line);
      header.elements.back().properties.push_back(property);
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      fail(in_quotes(keyword) + " is no statement of a PLY header; export the file again");
    }
  }
  header.lines = lines.line();
  header.body = lines.rest();
  return header;
}

class TextSource {
 public:
  TextSource(const Header& header, std::string_view name)
      : words_(header.body, name, header.lines + 1) {}
  double number(Type) { return words_.number("a property"); }
  std::int64_t integer(Type) { return words_.integer("a list's count or item"); }
  std::uint64_t bytes_left() const { return words_.bytes_left(); }
  [[noreturn]] void fail(const std::string& what) const { words_.fail(what); }
  // A digit and a blank.
  static std::uint64_t least_size(Type) { return 2; }
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

  double number(Type type) {
    const char* p = take(type);
    switch (type) {
      case Type::float32:
        return load<float>(p, big_endian_);
      case Type::float64:
        return load<double>(p, big_endian_);
      default:
        return static_cast<double>(whole(type, p));
    }
  }
  std::int64_t integer(Type type) { return whole(type, take(type)); }
  std::uint64_t bytes_left() const { return bytes_.size() - offset_; }
  [[noreturn]] void fail(const std::string& what) const { fail_at_byte(name_, offset_, what); }
  static std::uint64_t least_size(Type type) { return size_of(type); }
  static constexpr std::uint64_t kSlack = 0;

 private:
  const char* take(Type type) {
    if (bytes_left() < size_of(type)) fail("the file ends within its elements; it is cut short");
    const char* p = bytes_.data() + offset_;
    offset_ += size_of(type);
    return p;
  }
  std::int64_t whole(Type type, const char* p) const {
    switch (type) {
      case Type::int8:
        return load<std::int8_t>(p, big_endian_);
      case Type::uint8:
        return load<std::uint8_t>(p, big_endian_);
      case Type::int16:
        return load<std::int16_t>(p, big_endian_);
      case Type::uint16:
        return load<std::uint16_t>(p, big_endian_);
      case Type::int32:
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

/// Reads one property of one element; list items go to `items`. Returns a scalar's value.
template <class Source>
double read_property(Source& source, const Property& property, std::vector<std::int64_t>* items) {
  if (!property.count_type) return source.number(property.type);
  const std::int64_t count = source.integer(*property.count_type);
  if (count < 0 || static_cast<std::uint64_t>(count) * source.least_size(property.type) >
                       source.bytes_left() + Source::kSlack)
    source.fail("a list of " + std::to_string(count) +
                " items, more than the file holds; it is cut short or not what its header says");
  for (std::int64_t k = 0; k < count; ++k)
    if (items)
      items->push_back(source.integer(property.type));
    else
      source.number(property.type);
  return 0.0;
}

template <class Source>
void read_vertices(Source& source, const Element& element, MeshBuilder& mesh) {
  std::vector<int> axes;  // 0, 1, 2 for x, y, z; -1 for what is passed over
  int found[3] = {};
  for (const Property& property : element.properties) {
    const bool scalar = !property.count_type;
    const int axis = !scalar                ? -1
                     : property.name == "x" ? 0
                     : property.name == "y" ? 1
                     : property.name == "z" ? 2
                                            : -1;
    axes.push_back(axis);
    if (axis >= 0) ++found[axis];
  }
  for (int axis = 0; axis < 3; ++axis)
    if (found[axis] != 1)
      source.fail(std::string("the element 'vertex' needs one property '") + "xyz"[axis] +
                  "'; export the file again");
  mesh.reserve(element.count, 0);
  for (std::uint64_t v = 0; v < element.count; ++v) {
    Vec3 position;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const double value = read_property(source, element.properties[k], nullptr);
      if (axes[k] >= 0) position[axes[k]] = value;
    }
    mesh.add_vertex(position);
  }
}

template <class Source>
void read_faces(Source& source, const Element& element, std::uint64_t vertex_count,
                MeshBuilder& mesh) {
  const auto is_corners = [](const Property& property) {
    return property.count_type &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
  };
  const auto corners_at =
      std::find_if(element.properties.begin(), element.properties.end(), is_corners);
  if (corners_at == element.properties.end())
    source.fail("the element 'face' needs a list 'vertex_indices'; export the file again");
  if (!is_whole(corners_at->type))
    source.fail("the list 'vertex_indices' is of no whole type; export the file again");
  mesh.reserve(0, element.count);
  std::vector<std::int64_t> items;
  std::vector<Index> corners;
  for (std::uint64_t f = 0; f < element.count; ++f) {
    items.clear();
    for (const Property& property : element.properties)
      read_property(source, property, &property == &*corners_at ? &items : nullptr);
    if (items.size() < 3)
      source.fail("face " + std::to_string(f) + " has " + std::to_string(items.size()) +
                  " corners where three are needed; remove it");
    corners.clear();
    for (const std::int64_t item : items) {
      if (item < 0 || static_cast<std::uint64_t>(item) >= vertex_count)
        source.fail("face " + std::to_string(f) + " refers to vertex " + std::to_string(item) +
                    ", but the header promises " + std::to_string(vertex_count) +
                    " vertices, counted from 0; correct the face");
      corners.push_back(static_cast<Index>(item));
    }
    mesh.add_polygon(corners);
  }
}

template <class Source>
void read_body(Source& source, const Header& header, MeshBuilder& mesh) {
  std::uint64_t vertex_count = 0;
  bool seen_vertices = false;
  bool seen_faces = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") vertex_count = element.count;
    // No element is smaller than its scalars and list counts: a header that promises more than the
    // file can hold is found out before anything is allocated. (One without properties is refused
    // where it is read.)
    std::uint64_t least = 0;
    for (const Property& property : element.properties)
      least += source.least_size(property.count_type ? *property.count_type : property.type);
    if (least > 0 && element.count > (source.bytes_left() + Source::kSlack) / least)
      source.fail("the header promises " + std::to_string(element.count) + " elements " +
                  in_quotes(element.name) + ", more than the file holds; it is cut short");
  }
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      if (seen_vertices) source.fail("two elements 'vertex'; export the file again");
      seen_vertices = true;
      read_vertices(source, element, mesh);
    } else if (element.name == "face") {
      if (seen_faces) source.fail("two elements 'face'; export the file again");
      seen_faces = true;
      read_faces(source, element, vertex_count, mesh);
    } else if (!element.properties.empty()) {
      for (std::uint64_t n = 0; n < element.count; ++n)
        for (const Property& property : element.properties)
          read_property(source, property, nullptr);
    }
  }
}

}  // namespace

void read_ply(std::string_view bytes, MeshBuilder& mesh) {
  const Header header = read_header(bytes, mesh.name());
  if (header.encoding == Encoding::text) {
    TextSource source(header, mesh.name());
    read_body(source, header, mesh);
  } else {
    BinarySource source(header, bytes, mesh.name());
    read_body(source, header, mesh);
  }
}

}  // namespace mimicry::io
