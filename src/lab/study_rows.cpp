#include "lab/study_rows.h"

#include <array>
#include <limits>
#include <utility>

#include <mimicry/base/error.h>

#include "base/comma_list.h"
#include "io/number.h"
#include "lab/columns.h"

namespace mimicry::lab {
std::string StudyRow::name() const {
  const std::string which =
      curve.empty() ? "" : "curve " + curve + (is_set(repetition) ? " (repeated)" : "");
  return comma_list(std::array{participant, stroke, shape, which, task});
}

StudyRows::StudyRows(CsvTable table, std::string name)
    : table_(std::move(table)), name_(std::move(name)) {
  for (std::size_t c = 0; c < table_.columns.size(); ++c) columns_.emplace(table_.columns[c], c);
  if (!has(column::kMethod))
    throw Error(ErrorKind::invalid_input, name_ + ": has no column '" +
                                              std::string(column::kMethod) +
                                              "'; write it with mimicry measure or replay");
  if (table_.rows.empty())
    throw Error(ErrorKind::invalid_input, name_ + ": has no rows: no stroke was measured");
  for (std::size_t i = 0; i < table_.rows.size(); ++i) {
    const auto cell = [&](std::string_view column) {
      const std::string* found = cell_of(i, column);
      return found ? *found : std::string();
    };
    const auto failure = [&](std::string_view column, const char* fault) {
      return is_set(cell(column)) ? fault : "";
    };
    StudyRow row;
    row.at = i;
    row.participant = cell(column::kParticipant);
    row.stroke = cell(column::kStroke);
    row.recording = cell(column::kRecording);
    row.method = cell(column::kMethod);
    row.shape = cell(column::kShape);
    row.task = cell(column::kTask);
    row.index = cell(column::kIndex);
    row.curve = cell(column::kCurve);
    row.repetition = cell(column::kRepetition);
    row.simulated = cell(column::kSimulated);
    row.failed = is_set(cell(column::kRejected))
                     ? cell(column::kRejected)
                     : comma_list(std::array{
                           failure(column::kShort, "too short"), failure(column::kNoisy, "noisy"),
                           failure(column::kInverted, "drawn the other way round")});
    rows_.push_back(std::move(row));
  }
}

const std::string* StudyRows::cell_of(std::size_t row, std::string_view column) const {
  const auto at = columns_.find(column);
  return at == columns_.end() ? nullptr : &table_.rows[row][at->second];
}

double StudyRows::number(const StudyRow& row, std::string_view column) const {
  const std::string* cell = cell_of(row.at, column);
  const auto value = cell ? parse_double(*cell) : std::nullopt;
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace mimicry::lab
