#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <mimicry/io/number.h>

namespace mimicry::io {

/// Throws Error(invalid_input, "name: line 12: what").
[[noreturn]] void fail_at_line(std::string_view name, std::size_t line, const std::string& what);
/// Throws Error(invalid_input, "name: byte 84: what").
[[noreturn]] void fail_at_byte(std::string_view name, std::size_t offset, const std::string& what);

/// A word of a file made fit for a message: quoted, printable and short.
std::string in_quotes(std::string_view word);

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// Cuts the first word off `rest`, which is one line; empty where none is left.
std::string_view take_word(std::string_view& rest);

std::string to_lower(std::string_view word);

/// A name for a place that ends with its line: line ends become blanks.
std::string one_line(std::string name);

/// A text field of a CSV file, quoted where it has to be (RFC 4180).
std::string csv_field(const std::string& value);

/// Walks over the lines of a text and counts them from 1.
class Lines {
 public:
  explicit Lines(std::string_view text, std::size_t first_line = 1)
      : rest_(text), line_(first_line - 1) {}

  /// The next line without its end; false where there is none.
  bool next(std::string_view& line);
  std::size_t line() const { return line_; }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t line_;
};

/// Walks over the words of a text, whatever the lines, for formats that are read word by word.
class Words {
 public:
  Words(std::string_view text, std::string_view name, std::size_t first_line = 1)
      : rest_(text), name_(name), line_(first_line) {}

  /// The next word; empty at the end of the text.
  std::string_view next();
  /// Skips what is left of the current line.
  void skip_line();
  double number(const char* what);
  std::int64_t integer(const char* what);
  std::size_t line() const { return line_; }
  std::size_t bytes_left() const { return rest_.size(); }
  [[noreturn]] void fail(const std::string& what) const { fail_at_line(name_, line_, what); }

 private:
  std::string_view rest_;
  std::string_view name_;
  std::size_t line_;
};

}  // namespace mimicry::io
