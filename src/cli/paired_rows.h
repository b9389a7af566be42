#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/io/csv.h>
#include <mimicry/study/comparison.h>

namespace mimicry::cli {

/// The ten measures of the paper's table, as their columns are named.
inline constexpr const char* kPaperMeasures[] = {"D_ep_mm", "D_sym_mm", "K_E", "K_g", "F_g",
                                                 "T_h",     "R_h",      "T_c", "R_c", "tau_s"};

struct PairingOptions {
  std::string method_a, method_b;     ///< values of the column "method"
  std::vector<std::string> measures;  ///< columns; empty: those of the paper's ten that are there
  std::string by = "task";            ///< a comparison for each value of this column
  std::vector<std::string> without;   ///< COLUMN=VALUE: rows that are left out
  bool keep_failed = false;           ///< rows that failed a filter or were rejected too
};

/// The pairs of one group, in the order of method a's rows.
struct PairedGroup {
  std::string name;  ///< "task tracing"; "all" for the rows of every group
  std::vector<study::PairedMeasure> measures;
  /// Where the two strokes of each pair stand in the table.
  std::vector<std::pair<std::size_t, std::size_t>> rows;
  std::size_t pairs = 0;
  std::size_t failed = 0;    ///< pairs of which one side or both failed a filter or were rejected
  std::size_t unpaired = 0;  ///< rows of one method without one of the other
};

/// The column's cell names this method: by its name or by the study's number.
bool is_method(const std::string& cell, const std::string& wanted);

/// Rows of the two methods belong together where participant, stroke, shape, curve, repeat and task
/// (those that the table has) are equal. The groups in the order of their values, then all where
/// there are more than one. Methods may be called by the study's numbers or the techniques' names.
/// Throws Error(invalid_input) naming the column, method or row that is missing or double.
std::vector<PairedGroup> pair_rows(const io::CsvTable& table, const PairingOptions& options,
                                   const std::string& name);

}  // namespace mimicry::cli
