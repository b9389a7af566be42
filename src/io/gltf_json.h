#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/json.h"
#include "io/json_document.h"

namespace mimicry {

/// The JSON of a glTF file. Its members are looked up with checks whose errors name the file, the
/// place in it and the remedy.
class GltfJson {
 public:
  /// text: may be followed by padding or garbage, which is told to `note`.
  GltfJson(std::string_view text, std::string_view name,
           std::function<void(const std::string&)> note);

  const Json& root() const { return document_.root(); }
  [[noreturn]] void fail(const std::string& place, const std::string& what,
                         ErrorKind kind = ErrorKind::invalid_input) const;
  /// Tells it once; after the twentieth only that there are more.
  void note(const std::string& sentence) const;

  /// A member; null where there is none or `object` is no object.
  static const Json* find(const Json& object, const char* key);
  /// The object that an extension adds; null where there is none.
  static const Json* extension(const Json& object, const char* name);

  /// A whole number that is not negative; `otherwise` where the key is missing.
  std::size_t whole(const Json& object, const char* key, const std::string& place,
                    std::optional<std::size_t> otherwise = std::nullopt) const;
  /// Whole numbers below `end`; none where the key is missing. what: what they number, for errors.
  std::vector<std::size_t> numbers_of(const Json& object, const char* key, std::size_t end,
                                      const std::string& place, const char* what) const;
  /// Any numbers; none where the key is missing.
  std::optional<std::vector<double>> numbers(const Json& object, const char* key,
                                             const std::string& place) const;
  template <std::size_t N>
  std::optional<std::array<double, N>> numbers(const Json& object, const char* key,
                                               const std::string& place) const {
    const auto list = numbers(object, key, place);
    if (!list) return std::nullopt;
    if (list->size() != N)
      fail(place, std::string("'") + key + "' is not a list of " + std::to_string(N) + " numbers");
    std::array<double, N> out = {};
    std::copy(list->begin(), list->end(), out.begin());
    return out;
  }

  /// A list at the top of the file; empty where it is missing.
  const Json& array(const char* key) const;
  const Json& item(const char* key, std::size_t index, const std::string& user) const;

 private:
  void check_version() const;
  void check_extensions() const;

  std::string name_;
  std::function<void(const std::string&)> note_;
  mutable std::set<std::string> told_;
  JsonDocument document_;
};

/// Where the JSON object that `bytes` begin with ends, blanks before it included; 0 where it does
/// not end or they begin with something else.
std::size_t json_object_size(std::string_view bytes);

}  // namespace mimicry
