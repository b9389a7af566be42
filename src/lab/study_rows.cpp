#include "lab/study_rows.h"

#include <limits>
#include <utility>

#include <mimicry/base/error.h>

#include "io/number.h"
#include "lab/columns.h"

namespace mimicry::lab {
namespace {

bool is_set(const std::string& cell) {
  return !cell.empty() && cell != "0" && cell != "false";
}

std::string joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts)
    if (!part.empty()) all += (all.empty() ? "" : ", ") + part;
  return all;
}

}  // namespace

std::string StudyRow::name() const {
  return joined({participant, stroke, shape,
                 curve.empty() ? "" : "curve " + curve + (is_set(repetition) ? " (repeated)" : ""),
                 task});
}

StudyRows::StudyRows(CsvTable table, std::string name)
    : table_(std::move(table)), name_(std::move(name)) {
  if (!table_.find(column::kMethod))
    throw Error(ErrorKind::invalid_input, name_ + ": has no column '" +
                                              std::string(column::kMethod) +
                                              "'; write it with mimicry measure or replay");
  if (table_.rows.empty())
    throw Error(ErrorKind::invalid_input, name_ + ": has no rows: no stroke was measured");
  for (std::size_t i = 0; i < table_.rows.size(); ++i) {
    const auto cell = [&](std::string_view column) {
      const auto at = table_.find(column);
      return at ? table_.rows[i][*at] : std::string();
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
    row.failed =
        is_set(cell(column::kRejected))
            ? cell(column::kRejected)
            : joined({failure(column::kShort, "too short"), failure(column::kNoisy, "noisy"),
                      failure(column::kInverted, "drawn the other way round")});
    rows_.push_back(std::move(row));
  }
}

double StudyRows::number(const StudyRow& row, std::string_view column) const {
  const auto at = table_.find(column);
  const auto value = at ? parse_double(table_.rows[row.at][*at]) : std::nullopt;
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace mimicry::lab
