#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace mimicry::cli {

/// Prints rows under their headings, columns of numbers to the right, others to the left.
void print_table(const std::vector<std::string>& headings,
                 const std::vector<std::vector<std::string>>& rows);

/// A number with this many digits after the point.
std::string fixed(double value, int digits);

/// One line on a terminal that says how far long work is; nothing where standard error is a pipe.
class ProgressLine {
 public:
  explicit ProgressLine(std::string what);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void update(std::size_t done, std::size_t total);

 private:
  std::string what_;
  bool terminal_;
  int last_percent_ = -1;
};

}  // namespace mimicry::cli
