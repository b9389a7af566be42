#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/base/error.h>

#include "io/binary.h"
#include "io/mesh_builder.h"
#include "io/text.h"

namespace mimicry {
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

// Names of the numbers that stand for a label, as our writer puts them: "comment group 2 handle".
struct LabelNames {
  std::vector<std::pair<std::int64_t, std::string_view>> groups, materials, objects;

  void add(std::string_view comment) {
    const std::string_view kind = take_word(comment);
    auto* names = kind == "group"      ? &groups
                  : kind == "material" ? &materials
                  : kind == "object"   ? &objects
                                       : nullptr;
    if (!names) return;
    const auto number = parse_integer(take_word(comment));
    while (!comment.empty() && is_blank(comment.front())) comment.remove_prefix(1);
    while (!comment.empty() && is_blank(comment.back())) comment.remove_suffix(1);
    if (number && !comment.empty()) names->emplace_back(*number, comment);
  }
};

struct Header {
  Encoding encoding = Encoding::text;
  LabelNames labels;
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
  double number(Type) { return words_.number("a property"); }
  std::int64_t integer(Type) { return words_.integer("a list's count or item"); }
  /// NaN where it is no number: for what may be passed over.
  double number_or_nan(Type) {
    return parse_double(words_.required("a property")).value_or(std::nan(""));
  }
  void skip(Type) { words_.skip("a property"); }
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
  double number_or_nan(Type type) { return number(type); }
  std::int64_t integer(Type type) { return whole(type, take(type)); }
  void skip(Type type) { take(type); }
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

/// The count of a list, which the file can hold.
template <class Source>
std::int64_t list_size(Source& source, const Property& property) {
  const std::int64_t count = source.integer(*property.count_type);
  if (count < 0 || static_cast<std::uint64_t>(count) * source.least_size(property.type) >
                       source.bytes_left() + Source::kSlack)
    source.fail("a list of " + std::to_string(count) +
                " items, more than the file holds; it is cut short or not what its header says");
  return count;
}

// What is passed over need not be numbers.
template <class Source>
void skip_property(Source& source, const Property& property) {
  const std::int64_t count = property.count_type ? list_size(source, property) : 1;
  for (std::int64_t k = 0; k < count; ++k) source.skip(property.type);
}

/// What the numbers of a vertex are for.
enum Role { kPassedOver = -1, kX, kY, kZ, kRed, kGreen, kBlue, kAlpha, kU, kV, kRoles };

Role role_of(const Property& property) {
  if (property.count_type) return kPassedOver;
  constexpr std::pair<std::string_view, Role> kNames[] = {
      {"x", kX},         {"y", kY},         {"z", kZ},
      {"red", kRed},     {"green", kGreen}, {"blue", kBlue},
      {"alpha", kAlpha}, {"r", kRed},       {"g", kGreen},
      {"b", kBlue},      {"a", kAlpha},     {"diffuse_red", kRed},
      {"s", kU},         {"t", kV},         {"diffuse_green", kGreen},
      {"u", kU},         {"v", kV},         {"diffuse_blue", kBlue},
      {"texture_u", kU}, {"texture_v", kV}, {"diffuse_alpha", kAlpha}};
  for (const auto& [name, role] : kNames)
    if (property.name == name) return role;
  return kPassedOver;
}

/// What stands for 1 in a colour.
double most_of(Type type) {
  switch (type) {
    case Type::int8:
    case Type::uint8:
      return 255.0;
    case Type::int16:
    case Type::uint16:
      return 65535.0;
    default:
      return is_whole(type) ? 255.0 : 1.0;
  }
}

/// Eight bits are converted by a table.
class ColorOfBytes {
 public:
  ColorOfBytes() {
    for (std::size_t k = 0; k < 256; ++k)
      linear_[k] = static_cast<float>(linear_from_srgb(static_cast<double>(k) / 255.0));
  }
  std::array<float, 4> operator()(const double (&numbers)[kRoles], double most) const {
    std::array<float, 4> color;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = numbers[static_cast<std::size_t>(kRed) + k];
      color[k] = most == 255.0 && x >= 0.0 && x <= 255.0 && x == std::floor(x)
                     ? linear_[static_cast<std::size_t>(x)]
                     : static_cast<float>(linear_from_srgb(x / most));
    }
    color[3] = static_cast<float>(numbers[kAlpha] / most);
    return color;
  }

 private:
  float linear_[256];
};

/// by_corner: what faces have in lists of their own and vertices need not tell.
struct ByCorner {
  bool texcoords = false, colors = false;
};

template <class Source>
void read_vertices(Source& source, const Element& element, const ByCorner& by_corner,
                   MeshBuilder& mesh) {
  std::vector<Role> roles;
  int found[kRoles] = {};
  double most = 1.0;
  for (const Property& property : element.properties) {
    Role role = role_of(property);
    if (role >= kRed && found[role] > 0) role = kPassedOver;  // the first counts
    roles.push_back(role);
    if (role >= 0) ++found[role];
    if (role == kRed) most = most_of(property.type);
  }
  for (int axis = 0; axis < 3; ++axis)
    if (found[axis] != 1)
      source.fail(std::string("the element 'vertex' needs one property '") + "xyz"[axis] +
                  "'; export the file again");
  const bool has_color =
      !by_corner.colors && found[kRed] > 0 && found[kGreen] > 0 && found[kBlue] > 0;
  const bool has_texcoord = !by_corner.texcoords && found[kU] > 0 && found[kV] > 0;
  for (Role& role : roles)
    if (role >= kU ? !has_texcoord : role >= kRed && !has_color) role = kPassedOver;
  const ColorOfBytes to_color;
  mesh.reserve(element.count, 0);
  double numbers[kRoles] = {};
  numbers[kAlpha] = most;
  for (std::uint64_t v = 0; v < element.count; ++v) {
    for (std::size_t k = 0; k < roles.size(); ++k) {
      const Type type = element.properties[k].type;
      if (roles[k] == kPassedOver)
        skip_property(source, element.properties[k]);
      else
        numbers[roles[k]] = roles[k] <= kZ ? source.number(type) : source.number_or_nan(type);
    }
    const Index vertex = mesh.add_vertex({numbers[kX], numbers[kY], numbers[kZ]});
    if (has_color) mesh.attributes().colors.set_of_vertex(vertex, to_color(numbers, most));
    if (has_texcoord)
      mesh.attributes().texcoords.set_of_vertex(
          vertex, {static_cast<float>(numbers[kU]), static_cast<float>(numbers[kV])});
  }
}

/// The list of an element's that names vertices.
template <class Source>
const Property& list_of_corners(Source& source, const Element& element) {
  for (const Property& property : element.properties) {
    if (!property.count_type ||
        (property.name != "vertex_indices" && property.name != "vertex_index"))
      continue;
    if (!is_whole(property.type))
      source.fail("the list " + in_quotes(property.name) +
                  " is of no whole type; export the file again");
    return property;
  }
  source.fail("the element " + in_quotes(element.name) +
              " needs a list 'vertex_indices'; export the file again");
}

/// What faces and strips have beside their corners.
class FaceAttributes {
 public:
  FaceAttributes(const Header& header, MeshBuilder& mesh) : header_(header), mesh_(mesh) {}

  /// The lists of corners' values among an element's properties.
  static bool is_texcoords(const Property& p) { return p.count_type && p.name == "texcoord"; }
  static bool is_colors(const Property& p) { return p.count_type && p.name == "color"; }

  template <class Source>
  void read(Source& source, const Property& property) {
    if (is_texcoords(property)) return read_list(source, property, texcoords_);
    if (is_colors(property)) return read_list(source, property, colors_);
    const bool is_number = !property.count_type && is_whole(property.type);
    const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
      return is_number && std::find(names.begin(), names.end(), property.name) != names.end();
    };
    if (is_one_of({"group", "group_id", "label", "segment", "segment_id"}))
      read_label(source, property, mesh_.attributes().groups, groups_, header_.labels.groups);
    else if (is_one_of({"material", "material_index"}))
      read_label(source, property, mesh_.attributes().materials, materials_,
                 header_.labels.materials);
    else if (is_one_of({"object", "object_index"}))
      read_label(source, property, mesh_.attributes().objects, objects_, header_.labels.objects);
    else
      skip_property(source, property);
  }

  void add_polygon(std::span<const Index> corners) {
    number_values<2>(
        texcoords_, corners, mesh_.attributes().texcoords, texcoord_numbers_, [](const double* x) {
          return std::array<float, 2>{static_cast<float>(x[0]), static_cast<float>(x[1])};
        });
    const auto color = [](const double* x) { return color_from_srgb(x[0], x[1], x[2], x[3]); };
    if (colors_.size() == 3 * corners.size() && !corners.empty()) {  // without alpha
      colors_.resize(4 * corners.size());
      for (std::size_t k = corners.size(); k-- > 0;) {
        for (std::size_t i = 3; i-- > 0;) colors_[4 * k + i] = colors_[3 * k + i];
        colors_[4 * k + 3] = 1.0;
      }
    }
    number_values<4>(colors_, corners, mesh_.attributes().colors, color_numbers_, color);
    mesh_.add_polygon(corners, texcoord_numbers_, color_numbers_);
    texcoords_.clear();
    colors_.clear();
    ++faces_;
  }

  void tell() const {
    if (misfits_ > 0)
      mesh_.note(std::to_string(misfits_) +
                 (misfits_ == 1 ? " list of texture coordinates or colours does"
                                : " lists of texture coordinates or colours do") +
                 " not fit the face's corners and " + (misfits_ == 1 ? "is" : "are") +
                 " passed over (first: face " + std::to_string(first_misfit_) + ")");
  }

 private:
  template <class Source>
  static void read_list(Source& source, const Property& property, std::vector<double>& out) {
    const std::int64_t count = list_size(source, property);
    out.clear();
    for (std::int64_t k = 0; k < count; ++k) out.push_back(source.number_or_nan(property.type));
    if (is_colors(property) && most_of(property.type) > 1.0)
      for (double& x : out) x /= most_of(property.type);
  }

  struct Labels {
    std::map<std::int64_t, Index> numbers;
    std::int64_t last = -1;
    Index last_number = kNone;
  };

  template <class Source>
  void read_label(Source& source, const Property& property, FaceLabelBuilder& labels, Labels& known,
                  const std::vector<std::pair<std::int64_t, std::string_view>>& names) {
    const double label = source.number_or_nan(property.type);
    if (known.numbers.empty())
      for (const auto& [number, name] : names)
        known.numbers.try_emplace(number, labels.number(name));
    // Below 0, and what is no number: none.
    const auto number = label >= 0.0 && label < 1e15 ? static_cast<std::int64_t>(label) : -1;
    if (number != known.last) {
      known.last = number;
      const auto found = known.numbers.find(number);
      if (number < 0)
        known.last_number = kNone;
      else if (found != known.numbers.end())
        known.last_number = found->second;
      else
        known.last_number = known.numbers[number] = labels.number(std::to_string(number));
    }
    labels.begin(mesh_.face_count(), known.last_number);
  }

  // Empty where the list does not fit. Neighbours in a face often share nothing: each corner gets
  // a value of its own, but for one that repeats the last.
  template <std::size_t N, class Convert>
  void number_values(const std::vector<double>& list, std::span<const Index> corners,
                     CornerValueBuilder<N>& values, std::vector<Index>& numbers,
                     const Convert& convert) {
    numbers.clear();
    if (list.empty()) return;
    if (list.size() != N * corners.size()) {
      if (misfits_++ == 0) first_misfit_ = faces_;
      return;
    }
    for (std::size_t k = 0; k < corners.size(); ++k)
      numbers.push_back(values.add_at(corners[k], convert(&list[N * k])));
  }

  const Header& header_;
  MeshBuilder& mesh_;
  std::vector<double> texcoords_, colors_;  // of the face that is read
  std::vector<Index> texcoord_numbers_, color_numbers_;
  Labels groups_, materials_, objects_;
  std::uint64_t faces_ = 0, misfits_ = 0, first_misfit_ = 0;
};

/// Hands over the corners of each of an element's faces or strips, and to `other` what else they
/// have.
template <class Source, class Other, class Visit>
void read_corners(Source& source, const Element& element, std::uint64_t vertex_count,
                  bool has_restarts, const Other& other, const Visit& visit) {
  if (element.count == 0) return;
  const Property& list = list_of_corners(source, element);
  std::vector<Index> corners;
  for (std::uint64_t f = 0; f < element.count; ++f) {
    corners.clear();
    for (const Property& property : element.properties) {
      if (&property != &list) {
        other(property);
        continue;
      }
      const std::int64_t count = list_size(source, list);
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
    for (const Property& property : element.properties)
      least += source.least_size(property.count_type ? *property.count_type : property.type);
    if (least > 0 && element.count > (source.bytes_left() + Source::kSlack) / least)
      source.fail("the header promises " + std::to_string(element.count) + " elements " +
                  in_quotes(element.name) + ", more than the file holds; it is cut short");
  }
  FaceAttributes attributes(header, mesh);
  ByCorner by_corner;
  for (const Element& element : header.elements)
    for (const Property& property : element.properties) {
      if (element.name != "face") continue;
      by_corner.texcoords = by_corner.texcoords || FaceAttributes::is_texcoords(property);
      by_corner.colors = by_corner.colors || FaceAttributes::is_colors(property);
    }
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      if (seen_vertices) source.fail("two elements 'vertex'; export the file again");
      seen_vertices = true;
      read_vertices(source, element, by_corner, mesh);
    } else if (element.name == "face") {
      mesh.reserve(0, element.count);
      read_corners(
          source, element, vertex_count, false,
          [&](const Property& property) { attributes.read(source, property); },
          [&](std::span<const Index> corners) { attributes.add_polygon(corners); });
    } else if (element.name == "tristrips") {
      read_corners(
          source, element, vertex_count, true,
          [&](const Property& property) { skip_property(source, property); },
          [&](std::span<const Index> corners) { add_strip(corners, mesh); });
    } else if (!element.properties.empty()) {
      for (std::uint64_t n = 0; n < element.count; ++n)
        for (const Property& property : element.properties) skip_property(source, property);
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
