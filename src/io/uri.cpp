#include "io/uri.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "io/text.h"

namespace mimicry {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

std::optional<std::string> decode_base64(std::string_view text) {
  std::string out;
  out.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  bool ended = false;
  for (const char c : text) {
    if (is_blank(c) || c == '\n') continue;
    ended = ended || c == '=';
    if (ended && c == '=') continue;
    const int value = base64_digit(c);
    if (ended || value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      out += static_cast<char>(bits >> count & 0xff);
    }
  }
  return out;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  return to_lower(uri.substr(0, 5)) == "data:";
}

std::optional<std::string> data_of_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::string kind = to_lower(uri.substr(0, comma));
  const std::string_view data = uri.substr(comma + 1);
  const std::string_view base64 = ";base64";
  if (kind.size() < base64.size() || kind.substr(kind.size() - base64.size()) != base64)
    return percent_decoded(data);
  return data.find('%') == std::string_view::npos ? decode_base64(data)
                                                  : decode_base64(percent_decoded(data));
}

std::string percent_decoded(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '%' && k + 2 < text.size() && hex_digit(text[k + 1]) >= 0 &&
        hex_digit(text[k + 2]) >= 0) {
      out += static_cast<char>(hex_digit(text[k + 1]) * 16 + hex_digit(text[k + 2]));
      k += 2;
    } else {
      out += text[k];
    }
  }
  return out;
}

std::optional<std::string> name_below(std::string_view path) {
  const auto forbidden = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\\'; };
  if (path.empty() || path.front() == '/' || std::any_of(path.begin(), path.end(), forbidden))
    return std::nullopt;
  if (path.substr(0, path.find('/')).find(':') != std::string_view::npos) return std::nullopt;
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t slash = path.find('/');
    const std::string_view part = path.substr(0, slash);
    if (part == "..") {
      if (parts.empty()) return std::nullopt;
      parts.pop_back();
    } else if (!part.empty() && part != ".") {
      parts.push_back(part);
    }
    if (slash == std::string_view::npos) break;
    path.remove_prefix(slash + 1);
  }
  std::string name;
  for (const std::string_view part : parts) name.append(name.empty() ? "" : "/").append(part);
  if (name.empty()) return std::nullopt;
  return name;
}

}  // namespace mimicry
