#include "io/number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "base/float_traps.h"

namespace mimicry {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool equals_ignoring_case(std::string_view text, std::string_view lower) {
  return text.size() == lower.size() &&
         std::equal(text.begin(), text.end(), lower.begin(), [](char a, char b) {
           return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
         });
}

// As C and C++ libraries write it, that of Windows' "nan(ind)" and "IND" included.
std::optional<double> not_finite(std::string_view word) {
  for (const char* inf : {"inf", "infinity"})
    if (equals_ignoring_case(word, inf)) return std::numeric_limits<double>::infinity();
  const bool has_payload = word.size() >= 5 && word[3] == '(' && word.back() == ')';
  if (has_payload && equals_ignoring_case(word.substr(0, 3), "nan"))
    return std::numeric_limits<double>::quiet_NaN();
  for (const char* nan : {"nan", "qnan", "snan", "ind"})
    if (equals_ignoring_case(word, nan)) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

// More significant digits than this never change the nearest double, but for whether the rest is 0.
constexpr std::size_t kMostDigits = 800;

/// A decimal number: the digits, without point and leading zeros, times 10^exponent.
struct Decimal {
  std::array<char, kMostDigits + 1> digits;
  std::size_t count = 0;
  std::uint64_t leading = 0;  // value of the first 19 digits at most
  std::int64_t exponent = 0;

  void push(char digit) {
    if (count == 0 && digit == '0') return;
    if (count < 19) leading = 10 * leading + static_cast<std::uint64_t>(digit - '0');
    if (count < kMostDigits) {
      digits[count++] = digit;
    } else {
      if (digit != '0') digits[kMostDigits - 1] = '1';  // the rest is not 0
      ++exponent;
    }
  }
};

double nearest_double(const Decimal& decimal) {
  // Exact operands and one rounding give the nearest double (Clinger 1990, the simple case).
  static constexpr double kPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                       1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                       1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  if (decimal.count == 0) return 0.0;
  if (decimal.count <= 19 && decimal.leading <= (std::uint64_t{1} << 53) &&
      std::abs(decimal.exponent) <= 22) {
    const auto whole = static_cast<double>(decimal.leading);
    return decimal.exponent < 0 ? whole / kPowers[-decimal.exponent]
                                : whole * kPowers[decimal.exponent];
  }
  const std::int64_t magnitude = static_cast<std::int64_t>(decimal.count) + decimal.exponent;
  if (magnitude > 310) return std::numeric_limits<double>::infinity();
  if (magnitude < -330) return 0.0;
  // Without a decimal point strtod depends on no locale.
  std::array<char, kMostDigits + 16> text;
  char* end = std::copy_n(decimal.digits.begin(), decimal.count, text.begin());
  *end++ = 'e';
  end = std::to_chars(end, text.data() + text.size() - 1, decimal.exponent).ptr;
  *end = '\0';
  if (magnitude < 308) return std::strtod(text.data(), nullptr);
  const FloatTrapMask mask;  // it may overflow
  return std::strtod(text.data(), nullptr);
}

}  // namespace

std::optional<double> parse_double(std::string_view text) {
  const char* p = text.data();
  const char* const end = p + text.size();
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  const char* const start = p;

  Decimal decimal;
  bool any = false;
  for (; p != end && is_digit(*p); ++p, any = true) decimal.push(*p);
  if (p != end && *p == '.')
    for (++p; p != end && is_digit(*p); ++p, any = true) {
      decimal.push(*p);
      --decimal.exponent;
    }
  if (!any) {
    const std::string_view word = text.substr(static_cast<std::size_t>(start - text.data()));
    const auto value = not_finite(word);
    if (value && negative) return -*value;
    return value;
  }
  if (p != end && (*p == 'e' || *p == 'E')) {
    ++p;
    const bool small = p != end && *p == '-';
    if (p != end && (*p == '-' || *p == '+')) ++p;
    if (p == end) return std::nullopt;
    constexpr std::int64_t kFar = 1'000'000'000'000;  // beyond what digits could make up for
    std::int64_t exponent = 0;
    for (; p != end && is_digit(*p); ++p) exponent = std::min(kFar, 10 * exponent + (*p - '0'));
    decimal.exponent += small ? -exponent : exponent;
  }
  if (p != end) {
    // "1.#QNAN", "-1.#IND00", "1.#INF"
    const std::string_view number = text.substr(static_cast<std::size_t>(start - text.data()));
    if (*p != '#' || !number.starts_with("1.#")) return std::nullopt;
    const auto value = not_finite(number.substr(3, number.find_last_not_of('0') - 2));
    if (value && negative) return -*value;
    return value;
  }
  const double value = nearest_double(decimal);
  return negative ? -value : value;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

void append_double(std::string& out, double value) {
  if (std::isnan(value)) {
    out += "nan";
    return;
  }
  if (std::signbit(value)) out += '-';
  value = std::abs(value);
  if (std::isinf(value)) {
    out += "inf";
    return;
  }
  if (value == 0.0) {
    out += '0';
    return;
  }
  // d.ddde+xx, whatever the locale's point is, as digits and the exponent of the first one.
  Decimal decimal;
  int first_exponent = 0;
  for (int digits = 15; digits <= 17; ++digits) {
    std::array<char, 40> text;
    const int length = std::snprintf(text.data(), text.size(), "%.*e", digits - 1, value);
    const std::string_view printed(text.data(), static_cast<std::size_t>(length));
    const std::size_t e = printed.rfind('e');
    decimal = {};
    for (const char c : printed.substr(0, e))
      if (is_digit(c)) decimal.push(c);
    first_exponent = static_cast<int>(parse_integer(printed.substr(e + 1)).value_or(0));
    decimal.exponent = first_exponent + 1 - digits;
    if (nearest_double(decimal) == value) break;
  }
  std::string_view digits(decimal.digits.data(), decimal.count);
  digits = digits.substr(0, digits.find_last_not_of('0') + 1);
  const auto count = static_cast<int>(digits.size());
  if (first_exponent < -4 || first_exponent > 16) {
    out += digits[0];
    if (count > 1) {
      out += '.';
      out += digits.substr(1);
    }
    out += first_exponent < 0 ? "e-" : "e+";
    const int magnitude = std::abs(first_exponent);
    if (magnitude < 10) out += '0';
    out += std::to_string(magnitude);
  } else if (first_exponent < 0) {
    out += "0.";
    out.append(static_cast<std::size_t>(-first_exponent - 1), '0');
    out += digits;
  } else if (count <= first_exponent + 1) {
    out += digits;
    out.append(static_cast<std::size_t>(first_exponent + 1 - count), '0');
  } else {
    out += digits.substr(0, static_cast<std::size_t>(first_exponent) + 1);
    out += '.';
    out += digits.substr(static_cast<std::size_t>(first_exponent) + 1);
  }
}

std::string format_double(double value) {
  std::string out;
  append_double(out, value);
  return out;
}

}  // namespace mimicry
