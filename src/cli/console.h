#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <mimicry/assets/canvas.h>

namespace mimicry::cli {

/// A text that may come from a file or a name, for people: what is not UTF-8 and what would steer a
/// terminal is replaced by U+FFFD.
std::string printable(std::string_view text);
/// Prints "mimicry: ..." on standard error.
void complain(std::string_view sentence);

/// JSON for programs; names that are not UTF-8 have U+FFFD in place of what is wrong.
std::string json_text(const nlohmann::ordered_json& value, int indent = 2);

/// Prints rows under their headings, columns of numbers to the right, others to the left.
void print_table(const std::vector<std::string>& headings,
                 const std::vector<std::vector<std::string>>& rows);

/// A number with this many digits after the point.
std::string fixed(double value, int digits);

/// One line on a terminal that says how far long work is; nothing where standard error is a pipe.
/// Long work can be ended where it says so.
class ProgressLine {
 public:
  explicit ProgressLine(std::string what);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  /// Throws Error(cancelled) where the program was asked to end.
  void update(std::size_t done, std::size_t total);

 private:
  std::string what_;
  bool terminal_;
  int last_percent_ = -1;
};

/// What libraries tell while they work: notes as complaints, progress on a line that stands as long
/// as the monitor and its copies do. Signals cancel the work.
Monitor terminal_monitor();

}  // namespace mimicry::cli
