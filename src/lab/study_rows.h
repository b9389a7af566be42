#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/csv.h"

namespace mimicry::lab {

/// A measured stroke: who drew what, how, and whether it counts.
struct StudyRow {
  std::size_t at = 0;       ///< row of the table
  std::string participant;  ///< empty where the table does not say
  std::string stroke;       ///< that was drawn again; empty where the curve is as recorded
  std::string recording;    ///< file of the participant's folder; empty: of a strokes file
  std::string method;       ///< technique's name
  std::string shape;
  std::string task;
  std::string index;  ///< in the order drawn
  std::string curve;
  std::string repetition;
  std::string simulated;  ///< by what: "mimicry 0.1.0 seed 1"; empty: not, as far as is known
  std::string failed;  ///< "too short, inverted" or the reason of the rejection; empty: it counts

  /// "p07, hand, curve 3 (repeated), tracing".
  std::string name() const;
};

/// The rows of a study, as `measure` and `replay` write them.
class StudyRows {
 public:
  /// table: as `read_rows` gives it; name: its file's. Throws Error(invalid_input) where a column
  /// that is needed is missing, or there are no rows.
  StudyRows(CsvTable table, std::string name);

  const std::string& file() const { return name_; }
  const CsvTable& table() const { return table_; }
  const std::vector<StudyRow>& rows() const { return rows_; }
  bool has(std::string_view column) const { return columns_.contains(column); }
  /// NaN where the row has no such number.
  double number(const StudyRow& row, std::string_view column) const;

 private:
  const std::string* cell_of(std::size_t row, std::string_view column) const;

  CsvTable table_;
  std::map<std::string, std::size_t, std::less<>> columns_;  // where each stands
  std::string name_;
  std::vector<StudyRow> rows_;
};

}  // namespace mimicry::lab
