#pragma once

#include <string>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/io/csv.h>

namespace mimicry::cli {

/// A measured stroke: who drew what, how, and whether it counts.
struct StudyRow {
  std::size_t at = 0;       ///< row of the table
  std::string participant;  ///< empty where the table does not say
  std::string stroke;       ///< likewise
  std::string method;       ///< technique's name
  std::string shape;
  std::string task;
  std::string index;  ///< in the order drawn
  std::string curve;
  std::string repeat;
  std::string simulated;  ///< by what: "mimicry 0.1.0 seed 1"; empty: not, as far as is known
  std::string failed;  ///< "too short, inverted" or the reason of the rejection; empty: it counts
  std::string method_cell, shape_cell;  ///< as the table has them: numbers in a study

  /// "p07, hand, curve 3 (repeated), tracing".
  std::string name() const;
};

/// A stroke that was not even measured.
struct RejectedStroke {
  std::string participant, method, shape, index, reason;
};

/// The rows of a study, as `measure` and `replay` write them.
class StudyRows {
 public:
  /// Throws Error(invalid_input) where a column that is needed is missing.
  StudyRows(io::CsvTable table, std::string name);

  const std::string& file() const { return name_; }
  const io::CsvTable& table() const { return table_; }
  const std::vector<StudyRow>& rows() const { return rows_; }
  bool has(const std::string& column) const { return table_.find(column).has_value(); }
  /// NaN where the row has no such number.
  double number(const StudyRow& row, const std::string& column) const;

 private:
  io::CsvTable table_;
  std::string name_;
  std::vector<StudyRow> rows_;
};

/// What `measure` lists beside its rows. Throws Error(invalid_input) for another kind of table.
std::vector<RejectedStroke> read_rejected(const io::CsvTable& table, const std::string& name);

/// The technique or shape of a study's number; other names as they are.
std::string method_name(const std::string& cell);
std::string shape_name(const std::string& cell);

}  // namespace mimicry::cli
