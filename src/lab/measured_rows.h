#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/stroke/stroke.h>
#include <mimicry/study/measures.h>

#include "io/csv.h"

namespace mimicry::lab {

/// A row of a table of measured strokes (docs/formats.md): which stroke, and what was measured.
/// Numbers that are kNone and texts that are empty are empty cells.
struct MeasuredRow {
  std::string participant;  ///< the participant's folder, or the strokes file
  /// Which stroke a technique drew again; empty where the curve is the recorded one.
  std::string stroke;
  std::string recording;  ///< file of the participant's folder that the stroke is in
  std::string method;     ///< the technique's name
  Index method_number = kNone;
  std::string shape;
  Index shape_number = kNone;
  std::optional<std::size_t> index;  ///< of the stroke in its file
  std::string curve;                 ///< number or name of the intended curve
  bool repetition = false;           ///< the curve came before in the task
  std::string task;
  std::optional<Simulation> simulated;
  std::optional<Measures> measures;
  std::optional<std::size_t> pieces, frames, missed;
  std::string rejected;  ///< why nothing could be measured
};

/// The columns of such a table, in their order.
const std::vector<std::string>& row_columns();
/// The table's heading and a row of it as CSV, each with its line's end.
std::string rows_heading();
std::string csv_row(const MeasuredRow& row);
/// The row as a JSON object, with its line's end.
std::string json_row(const MeasuredRow& row);

/// A stroke, recording or participant that could not be measured.
struct RejectedStroke {
  std::string participant;
  std::string recording;  ///< empty where the whole folder is left out
  std::string method;
  Index method_number = kNone;
  std::string shape;
  Index shape_number = kNone;
  std::string index;  ///< of the stroke; empty where the whole file is left out
  std::string reason;

  /// "p07/1_3.json: stroke 4: has no frames".
  std::string text() const;
};

/// The table of these, which stands beside the rows.
std::string write_rejected(const std::vector<RejectedStroke>& rejected);
/// Throws Error(invalid_input) for another kind of table.
std::vector<RejectedStroke> read_rejected(std::string_view bytes, std::string_view name);
/// "study/rows.csv": "study/rows.rejected.csv".
std::string rejected_beside(const std::string& rows);

/// Reads a table of measured strokes. One of an earlier version, with the column `repeat` and with
/// methods and shapes by the study's numbers, comes with today's names, and the monitor hears of
/// it; other columns are as they are. Throws Error(invalid_input) as `read_csv` does.
CsvTable read_rows(std::string_view bytes, std::string_view name, const Monitor& monitor = {});

/// "mimicry 0.1.0 seed 1"; empty for a stroke that is not simulated.
std::string simulation_text(const std::optional<Simulation>& simulated);

}  // namespace mimicry::lab
