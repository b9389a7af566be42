#include "cli/report/study_rows.h"

#include <limits>

#include <mimicry/base/error.h>
#include <mimicry/io/number.h>
#include <mimicry/study/protocol.h>

#include "cli/paired_rows.h"

namespace mimicry::cli {
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

std::string method_name(const std::string& cell) {
  for (const char* name : {"spraycan", "mimicry"})
    if (is_method(cell, name)) return name;
  return cell;
}

std::string shape_name(const std::string& cell) {
  const auto number = io::parse_integer(cell);
  if (!number || *number < 0 || *number >= static_cast<long long>(study::kStudyShapes.size()))
    return cell;
  return std::string(study::kStudyShapes[static_cast<std::size_t>(*number)]);
}

std::string StudyRow::name() const {
  return joined({participant, stroke, shape,
                 curve.empty() ? "" : "curve " + curve + (is_set(repeat) ? " (repeated)" : ""),
                 task});
}

StudyRows::StudyRows(io::CsvTable table, std::string name)
    : table_(std::move(table)), name_(std::move(name)) {
  if (!table_.find("method"))
    throw Error(ErrorKind::invalid_input,
                name_ + ": has no column 'method'; write it with mimicry measure or replay");
  if (table_.rows.empty())
    throw Error(ErrorKind::invalid_input, name_ + ": has no rows: no stroke was measured");
  for (std::size_t i = 0; i < table_.rows.size(); ++i) {
    const auto cell = [&](const char* column) {
      const auto at = table_.find(column);
      return at ? table_.rows[i][*at] : std::string();
    };
    StudyRow row;
    row.at = i;
    row.participant = cell("participant");
    row.stroke = cell("stroke");
    row.method_cell = cell("method");
    row.shape_cell = cell("shape");
    row.method = method_name(row.method_cell);
    row.shape = shape_name(row.shape_cell);
    row.task = cell("task");
    row.index = cell("index");
    row.curve = cell("curve");
    row.repeat = cell("repeat");
    row.simulated = cell("simulated");
    row.failed = is_set(cell("rejected"))
                     ? cell("rejected")
                     : joined({is_set(cell("short")) ? "too short" : "",
                               is_set(cell("noisy")) ? "noisy" : "",
                               is_set(cell("inverted")) ? "drawn the other way round" : ""});
    rows_.push_back(std::move(row));
  }
}

double StudyRows::number(const StudyRow& row, const std::string& column) const {
  const auto at = table_.find(column);
  const auto value = at ? io::parse_double(table_.rows[row.at][*at]) : std::nullopt;
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::vector<RejectedStroke> read_rejected(const io::CsvTable& table, const std::string& name) {
  std::vector<RejectedStroke> rejected;
  const auto reason = table.find("reason");
  if (!reason) throw Error(ErrorKind::invalid_input, name + ": has no column 'reason'");
  for (const auto& row : table.rows) {
    const auto cell = [&](const char* column) {
      const auto at = table.find(column);
      return at ? row[*at] : std::string();
    };
    rejected.push_back({cell("participant"), method_name(cell("method")), shape_name(cell("shape")),
                        cell("index"), row[*reason]});
  }
  return rejected;
}

}  // namespace mimicry::cli
