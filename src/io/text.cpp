#include "io/text.h"

#include <mimicry/base/error.h>

namespace mimicry::io {

void fail_at_line(std::string_view name, std::size_t line, const std::string& what) {
  throw Error(ErrorKind::invalid_input,
              std::string(name) + ": line " + std::to_string(line) + ": " + what);
}

void fail_at_byte(std::string_view name, std::size_t offset, const std::string& what) {
  throw Error(ErrorKind::invalid_input,
              std::string(name) + ": byte " + std::to_string(offset) + ": " + what);
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

std::string one_line(std::string name) {
  for (char& c : name)
    if (c == '\n' || c == '\r') c = ' ';
  return name;
}

std::string csv_field(const std::string& value) {
  if (value.find_first_of(",\"\n\r") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

bool Lines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++line_;
  return true;
}

std::string_view Words::next() {
  std::size_t begin = 0;
  for (; begin < rest_.size() && (is_blank(rest_[begin]) || rest_[begin] == '\n'); ++begin)
    if (rest_[begin] == '\n') ++line_;
  std::size_t end = begin;
  while (end < rest_.size() && !is_blank(rest_[end]) && rest_[end] != '\n') ++end;
  const std::string_view word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return word;
}

void Words::skip_line() {
  const std::size_t end = rest_.find('\n');
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end);
}

double Words::number(const char* what) {
  const std::string_view word = next();
  if (word.empty())
    fail(std::string("the file ends where ") + what + " should stand; it is cut short");
  const auto value = parse_double(word);
  if (!value)
    fail(in_quotes(word) + " is not a number, for " + what +
         "; correct it or export the file again");
  return *value;
}

std::int64_t Words::integer(const char* what) {
  const std::string_view word = next();
  if (word.empty())
    fail(std::string("the file ends where ") + what + " should stand; it is cut short");
  const auto value = parse_integer(word);
  if (!value)
    fail(in_quotes(word) + " is not a whole number, for " + what +
         "; correct it or export the file again");
  return *value;
}

}  // namespace mimicry::io
