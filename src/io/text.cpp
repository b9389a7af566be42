#include "io/text.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <mimicry/base/error.h>

#include "io/json.h"

namespace mimicry {

void fail_at_line(std::string_view name, std::size_t line, const std::string& what) {
  throw Error(ErrorKind::invalid_input,
              std::string(name) + ": line " + std::to_string(line) + ": " + what);
}

void fail_at_byte(std::string_view name, std::size_t offset, const std::string& what) {
  throw Error(ErrorKind::invalid_input,
              std::string(name) + ": byte " + std::to_string(offset) + ": " + what);
}

std::string_view text_of(std::string_view bytes, std::string_view name) {
  using namespace std::string_view_literals;
  struct Mark {
    std::string_view bytes;
    const char* encoding;
  };
  // That of UTF-32 begins with that of UTF-16.
  static constexpr Mark kMarks[] = {{"\xFF\xFE\0\0"sv, "UTF-32"},
                                    {"\0\0\xFE\xFF"sv, "UTF-32"},
                                    {"\xFF\xFE"sv, "UTF-16"},
                                    {"\xFE\xFF"sv, "UTF-16"}};
  const char* encoding = nullptr;
  for (const Mark& mark : kMarks)
    if (encoding == nullptr && bytes.starts_with(mark.bytes)) encoding = mark.encoding;
  if (encoding == nullptr && bytes.size() >= 8) {
    // Two characters of Latin text, in either byte order.
    std::string zeros;
    for (const char c : bytes.substr(0, 8)) zeros += c == 0 ? '0' : 'x';
    if (zeros == "x0x0x0x0" || zeros == "0x0x0x0x") encoding = "UTF-16";
    if (zeros == "x000x000" || zeros == "000x000x") encoding = "UTF-32";
  }
  if (encoding != nullptr)
    throw Error(ErrorKind::unsupported, std::string(name) + ": is text in " + encoding +
                                            ", which is not read; save it as UTF-8");
  constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
  if (bytes.starts_with(kUtf8Mark)) bytes.remove_prefix(kUtf8Mark.size());
  return bytes;
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string out = "'";
  for (const char c : word.substr(0, kMost)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (word.size() > kMost ? "...'" : "'");
}

std::string_view take_word(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

std::string to_lower(std::string_view word) {
  std::string out(word);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

namespace {

// Bytes that are no text become the mark of that.
std::string utf8(std::string text) {
  const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  if (std::all_of(text.begin(), text.end(), is_ascii)) return text;
  return Json::parse(Json(std::move(text)).dump(-1, ' ', false, Json::error_handler_t::replace))
      .get<std::string>();
}

}  // namespace

std::string one_line(std::string name) {
  name = utf8(std::move(name));
  for (char& c : name)
    if (c == '\n' || c == '\r') c = ' ';
  return name;
}

std::string csv_field(const std::string& given) {
  const std::string value = utf8(given);
  if (value.find_first_of(",\"\n\r") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

bool Lines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const char* const begin = rest_.data();
  const char* const end = begin + rest_.size();
  // Each byte is looked at once, even where a file has no line feeds.
  if (line_feed_ == nullptr || line_feed_ < begin) {
    line_feed_ = static_cast<const char*>(std::memchr(begin, '\n', rest_.size()));
    if (line_feed_ == nullptr) line_feed_ = end;
  }
  const auto* stop = static_cast<const char*>(
      std::memchr(begin, '\r', static_cast<std::size_t>(line_feed_ - begin)));
  if (stop == nullptr) stop = line_feed_;
  line = {begin, static_cast<std::size_t>(stop - begin)};
  const char* next = stop == end ? end : stop + 1;
  if (stop != end && *stop == '\r' && next == line_feed_ && next != end) ++next;
  rest_.remove_prefix(static_cast<std::size_t>(next - begin));
  ++line_;
  return true;
}

std::string_view Words::next() {
  std::size_t begin = 0;
  for (; begin < rest_.size() && is_space(rest_[begin]); ++begin)
    if (ends_line(begin)) ++line_;
  std::size_t end = begin;
  while (end < rest_.size() && !is_space(rest_[end])) ++end;
  const std::string_view word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return word;
}

void Words::skip_line() {
  std::size_t end = 0;
  while (end < rest_.size() && !ends_line(end)) ++end;
  rest_.remove_prefix(end);
}

std::string_view Words::required(const char* what) {
  const std::string_view word = next();
  if (word.empty())
    fail(std::string("the file ends where ") + what + " should stand; it is cut short");
  return word;
}

void Words::skip(const char* what) {
  (void)required(what);
}

double Words::number(const char* what) {
  const std::string_view word = required(what);
  const auto value = parse_double(word);
  if (!value)
    fail(in_quotes(word) + " is not a number, for " + what +
         "; correct it or export the file again");
  return *value;
}

std::int64_t Words::integer(const char* what) {
  const std::string_view word = required(what);
  const auto value = parse_integer(word);
  if (!value)
    fail(in_quotes(word) + " is not a whole number, for " + what +
         "; correct it or export the file again");
  return *value;
}

}  // namespace mimicry
