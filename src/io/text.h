#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/number.h"

namespace mimicry {

/// Throws Error(invalid_input, "name: line 12: what").
[[noreturn]] void fail_at_line(std::string_view name, std::size_t line, const std::string& what);
/// Throws Error(invalid_input, "name: byte 84: what").
[[noreturn]] void fail_at_byte(std::string_view name, std::size_t offset, const std::string& what);

/// A text file's content without the byte order mark of UTF-8. Throws Error(unsupported) where it
/// is UTF-16 or UTF-32, by its mark or, without one, since every second byte or three of four of
/// its first characters are 0.
std::string_view text_of(std::string_view bytes, std::string_view name);

/// A word of a file made fit for a message: quoted, printable and short.
std::string in_quotes(std::string_view word);

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// Cuts the first word off `rest`, which is one line; empty where none is left.
std::string_view take_word(std::string_view& rest);

std::string to_lower(std::string_view word);

/// A name for a place that ends with its line: line ends become blanks, what is no UTF-8 U+FFFD.
std::string one_line(std::string name);

/// A text field of a CSV file, quoted where it has to be (RFC 4180); what is no UTF-8 is U+FFFD.
std::string csv_field(const std::string& given);

/// Walks over the lines of a text and counts them from 1. Lines end in LF, CR LF or CR.
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
  const char* line_feed_ = nullptr;  // the next one, or the text's end; older than rest_: not known
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
  /// The next word; throws where none is left.
  std::string_view required(const char* what);
  /// Passes over a word, whatever it says.
  void skip(const char* what);
  std::size_t line() const { return line_; }
  std::size_t bytes_left() const { return rest_.size(); }
  [[noreturn]] void fail(const std::string& what) const { fail_at_line(name_, line_, what); }

 private:
  static bool is_space(char c) { return is_blank(c) || c == '\n'; }
  // A CR before an LF leaves the end to it.
  bool ends_line(std::size_t at) const {
    return rest_[at] == '\n' ||
           (rest_[at] == '\r' && (at + 1 == rest_.size() || rest_[at + 1] != '\n'));
  }

  std::string_view rest_;
  std::string_view name_;
  std::size_t line_;
};

}  // namespace mimicry
