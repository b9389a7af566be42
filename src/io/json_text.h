#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "io/json.h"

namespace mimicry {

/// JSON that is written as text at once, without spaces and as Json's dump() writes it. Nothing is
/// held but the text: where memory ends, `std::bad_alloc` leaves it. (A tree of Json takes memory
/// to be given back, and would end the program.)
class JsonText {
 public:
  /// `bracket` is [ or {, ] or }.
  JsonText& begin(char bracket) {
    separate();
    text_ += bracket;
    follows_ = false;
    return *this;
  }
  JsonText& end(char bracket) {
    text_ += bracket;
    follows_ = true;
    return *this;
  }
  JsonText& key(std::string_view name) {
    value(name);
    text_ += ':';
    follows_ = false;
    return *this;
  }

  JsonText& value(bool truth) { return put(truth ? "true" : "false"); }
  template <std::integral Number>
  JsonText& value(Number number) {
    char digits[24];
    return put(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
  }
  /// null where it is not finite; 1.0 and not 1, as files have had it.
  JsonText& value(double number) {
    if (!std::isfinite(number)) return put("null");
    char digits[64];
    return put(digits, nlohmann::detail::to_chars(digits, digits + sizeof digits, number));
  }
  /// U+FFFD stands for what is not UTF-8.
  JsonText& value(std::string_view text) {
    return put(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  JsonText& value(const std::string& text) { return value(std::string_view(text)); }
  JsonText& value(const char* text) { return value(std::string_view(text)); }
  JsonText& value(const Vec3& v) { return value(std::span<const double>(v.data(), 3)); }
  /// x, y, z, w, as in glTF and WebXR.
  JsonText& value(const Quat& q) { return value(std::span<const double>(q.coeffs().data(), 4)); }
  /// An array of numbers.
  template <class Numbers>
  requires requires(const Numbers& numbers) { numbers.begin() != numbers.end(); }
  JsonText& value(const Numbers& numbers) {
    begin('[');
    for (const auto& number : numbers) value(number);
    return end(']');
  }

  /// A member of the object that is open.
  template <class Value>
  JsonText& member(std::string_view name, const Value& content) {
    return key(name).value(content);
  }

  const std::string& text() const { return text_; }

 private:
  void separate() {
    if (follows_) text_ += ',';
  }
  JsonText& put(std::string_view piece) {
    separate();
    text_ += piece;
    follows_ = true;
    return *this;
  }

  JsonText& put(const char* from, const char* to) {
    return put(std::string_view(from, static_cast<std::size_t>(to - from)));
  }

  std::string text_;
  bool follows_ = false;  // a value stands before, in the same array or object
};

}  // namespace mimicry
