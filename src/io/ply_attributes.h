#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mesh_builder.h"
#include "io/ply_property.h"
#include "io/text.h"

namespace mimicry {

/// Names of the numbers that stand for a label, as our writer puts them: "comment group 2 handle".
struct PlyLabelNames {
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

/// What the numbers of a vertex are for.
enum PlyRole {
  kPlyPassedOver = -1,
  kPlyX,
  kPlyY,
  kPlyZ,
  kPlyRed,
  kPlyGreen,
  kPlyBlue,
  kPlyAlpha,
  kPlyU,
  kPlyV,
  kPlyRoles
};

inline PlyRole ply_role_of(const PlyProperty& property) {
  if (property.count_type) return kPlyPassedOver;
  constexpr std::pair<std::string_view, PlyRole> kNames[] = {
      {"x", kPlyX},         {"y", kPlyY},         {"z", kPlyZ},
      {"red", kPlyRed},     {"green", kPlyGreen}, {"blue", kPlyBlue},
      {"alpha", kPlyAlpha}, {"r", kPlyRed},       {"g", kPlyGreen},
      {"b", kPlyBlue},      {"a", kPlyAlpha},     {"diffuse_red", kPlyRed},
      {"s", kPlyU},         {"t", kPlyV},         {"diffuse_green", kPlyGreen},
      {"u", kPlyU},         {"v", kPlyV},         {"diffuse_blue", kPlyBlue},
      {"texture_u", kPlyU}, {"texture_v", kPlyV}, {"diffuse_alpha", kPlyAlpha}};
  for (const auto& [name, role] : kNames)
    if (property.name == name) return role;
  return kPlyPassedOver;
}

/// What stands for 1 in a colour.
inline double ply_most_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 255.0;
    case PlyType::int16:
    case PlyType::uint16:
      return 65535.0;
    default:
      return is_whole_ply_type(type) ? 255.0 : 1.0;
  }
}

/// Eight bits are converted by a table.
class PlyColor {
 public:
  PlyColor() {
    for (std::size_t k = 0; k < 256; ++k)
      linear_[k] = static_cast<float>(linear_from_srgb(static_cast<double>(k) / 255.0));
  }
  /// most: what stands for 1 in each of the numbers.
  std::array<float, 4> operator()(const double (&numbers)[kPlyRoles],
                                  const std::array<double, kPlyRoles>& most) const {
    std::array<float, 4> color;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t role = kPlyRed + k;
      const double x = numbers[role];
      color[k] = most[role] == 255.0 && x >= 0.0 && x <= 255.0 && x == std::floor(x)
                     ? linear_[static_cast<std::size_t>(x)]
                     : static_cast<float>(linear_from_srgb(x / most[role]));
    }
    color[3] = static_cast<float>(numbers[kPlyAlpha] / most[kPlyAlpha]);
    return color;
  }

 private:
  float linear_[256];
};

/// What faces and strips have beside their corners.
class PlyFaceAttributes {
 public:
  PlyFaceAttributes(const PlyLabelNames& names, MeshBuilder& mesh) : names_(names), mesh_(mesh) {}

  /// The lists of corners' values among an element's properties.
  static bool is_texcoords(const PlyProperty& p) { return p.count_type && p.name == "texcoord"; }
  static bool is_colors(const PlyProperty& p) { return p.count_type && p.name == "color"; }

  /// The properties that are read from here on; they must outlive this.
  void begin(std::span<const PlyProperty> properties) {
    properties_ = properties;
    kinds_.clear();
    for (const PlyProperty& property : properties) kinds_.push_back(kind_of(property));
  }

  /// property: one of those.
  template <class Source>
  void read(Source& source, const PlyProperty& property) {
    AttributeBuilder& attributes = mesh_.attributes();
    switch (kinds_[static_cast<std::size_t>(&property - properties_.data())]) {
      case Kind::texcoords:
        return read_list(source, property, texcoords_);
      case Kind::colors:
        return read_list(source, property, colors_);
      case Kind::group:
        return read_label(source, property, attributes.groups, groups_, names_.groups);
      case Kind::material:
        return read_label(source, property, attributes.materials, materials_, names_.materials);
      case Kind::object:
        return read_label(source, property, attributes.objects, objects_, names_.objects);
      case Kind::other:
        return skip_ply_property(source, property);
    }
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
  enum class Kind { other, texcoords, colors, group, material, object };

  static Kind kind_of(const PlyProperty& property) {
    if (is_texcoords(property)) return Kind::texcoords;
    if (is_colors(property)) return Kind::colors;
    if (property.count_type || !is_whole_ply_type(property.type)) return Kind::other;
    const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
      return std::find(names.begin(), names.end(), property.name) != names.end();
    };
    if (is_one_of({"group", "group_id", "label", "segment", "segment_id"})) return Kind::group;
    if (is_one_of({"material", "material_index"})) return Kind::material;
    if (is_one_of({"object", "object_index"})) return Kind::object;
    return Kind::other;
  }

  template <class Source>
  static void read_list(Source& source, const PlyProperty& property, std::vector<double>& out) {
    const std::int64_t count = ply_list_size(source, property);
    out.clear();
    for (std::int64_t k = 0; k < count; ++k) out.push_back(source.number_or_nan(property.type));
    if (is_colors(property) && ply_most_of(property.type) > 1.0)
      for (double& x : out) x /= ply_most_of(property.type);
  }

  struct Labels {
    std::map<std::int64_t, Index> numbers;
    std::int64_t last = -1;
    Index last_number = kNone;
  };

  template <class Source>
  void read_label(Source& source, const PlyProperty& property, FaceLabelBuilder& labels,
                  Labels& known,
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

  const PlyLabelNames& names_;
  MeshBuilder& mesh_;
  std::span<const PlyProperty> properties_;
  std::vector<Kind> kinds_;                 // of each
  std::vector<double> texcoords_, colors_;  // of the face that is read
  std::vector<Index> texcoord_numbers_, color_numbers_;
  Labels groups_, materials_, objects_;
  std::uint64_t faces_ = 0, misfits_ = 0, first_misfit_ = 0;
};

}  // namespace mimicry
