#include <algorithm>
#include <optional>
#include <utility>

#include <mimicry/assets/canvas.h>

#include "io/number.h"
#include "lab/columns.h"
#include "lab/measured_rows.h"
#include "lab/participant_folder.h"
#include "lab/study_numbers.h"

namespace mimicry::lab {
namespace {

// What `repetition` was called. R takes it for a word of its own.
constexpr std::string_view kFormerRepetition = "repeat";

std::optional<Index> study_number(const std::string& cell) {
  const auto number = parse_integer(cell);
  if (!number || *number < 0 || *number > 9999) return std::nullopt;
  return static_cast<Index>(*number);
}

// Tables did not say which file of a participant's folder a stroke is in. Rows of `replay` had it
// in the stroke's name, those of `measure` in the numbers of method and shape.
std::string former_recording(const CsvTable& table, const std::vector<std::string>& row) {
  const auto cell = [&](std::string_view column) {
    const auto at = table.find(column);
    return at ? row[*at] : std::string();
  };
  const std::string stroke = cell(column::kStroke);
  if (!stroke.empty()) {
    const auto recorded = recorded_stroke_of(stroke);
    return recorded ? recorded->recording.file() : std::string();
  }
  const auto method = study_number(cell(column::kMethod)),
             shape = study_number(cell(column::kShape));
  return method && shape ? RecordingName{*method, *shape}.file() : std::string();
}

void add_recordings(CsvTable& table) {
  std::vector<std::string> recordings;
  for (const auto& row : table.rows) recordings.push_back(former_recording(table, row));
  if (std::all_of(recordings.begin(), recordings.end(), [](const auto& r) { return r.empty(); }))
    return;
  table.columns.emplace_back(column::kRecording);
  for (std::size_t i = 0; i < recordings.size(); ++i)
    table.rows[i].push_back(std::move(recordings[i]));
}

}  // namespace

CsvTable read_rows(std::string_view bytes, std::string_view name, const Monitor& monitor) {
  CsvTable table = read_csv(bytes, name);
  if (const auto at = table.find(kFormerRepetition); at && !table.find(column::kRepetition)) {
    table.columns[*at] = column::kRepetition;
    monitor.tell(std::string(name) + ": is of an earlier version; its column '" +
                 std::string(kFormerRepetition) + "' is read as '" +
                 std::string(column::kRepetition) + "', the study's numbers as names");
  }
  if (!table.find(column::kRecording)) add_recordings(table);
  const auto rename = [&](std::string_view column, std::string (*name_of)(std::string_view)) {
    if (const auto at = table.find(column))
      for (auto& row : table.rows) row[*at] = name_of(row[*at]);
  };
  rename(column::kMethod, name_of_method);
  rename(column::kShape, name_of_shape);
  return table;
}

}  // namespace mimicry::lab
