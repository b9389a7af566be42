#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <mimicry/study/comparison.h>

#include "io/csv.h"

namespace mimicry::lab {

struct PairingOptions {
  std::string method_a, method_b;     ///< techniques, by name or by the study's number
  std::vector<std::string> measures;  ///< columns; empty: those of the paper's ten that are there
  std::string by = "task";            ///< a comparison for each value of this column
  std::vector<std::string> without;   ///< COLUMN=VALUE: rows that are left out
  bool keep_failed = false;           ///< rows that failed a filter or were rejected too
};

/// The pairs of one group, in the order of method a's rows.
struct PairedGroup {
  std::string name;  ///< "task tracing"; "all" for the rows of every group
  std::vector<PairedMeasure> measures;
  /// Where the two strokes of each pair stand in the table.
  std::vector<std::pair<std::size_t, std::size_t>> rows;
  std::size_t pairs = 0;
  std::size_t failed = 0;    ///< pairs of which one side or both failed a filter or were rejected
  std::size_t unpaired = 0;  ///< rows of one method without one of the other
};

/// A group's name: "task tracing".
std::string group_name(std::string_view column, std::string_view value);
/// The group of all rows.
inline constexpr std::string_view kAllRows = "all";

/// Rows of the two methods belong together where participant, stroke, shape, curve, repetition and
/// task (those that the table has) are equal. The groups in the order of their values, then all
/// where there are more than one. In `without` methods and shapes may be called by the study's
/// numbers too. table: as `read_rows` gives it; name: its file's, for messages. Throws
/// Error(invalid_input) naming the column, method or row that is missing or double.
std::vector<PairedGroup> pair_rows(const CsvTable& table, const PairingOptions& options,
                                   const std::string& name);

}  // namespace mimicry::lab
