#include "lab/measured_rows.h"

#include <cstdint>
#include <filesystem>
#include <utility>

#include <mimicry/base/error.h>

#include "files/names.h"
#include "lab/columns.h"
#include "lab/participant_folder.h"
#include "lab/study_numbers.h"

namespace mimicry::lab {
namespace {

template <class Row>
struct Column {
  std::string_view name;
  Cell (*cell)(const Row&);
};

Cell text(const std::string& value) {
  if (value.empty()) return std::monostate();
  return value;
}
Cell number(Index value) {
  if (value == kNone) return std::monostate();
  return std::int64_t{value};
}
Cell count(std::size_t value) {
  return static_cast<std::int64_t>(value);
}
Cell count(const std::optional<std::size_t>& value) {
  return value ? count(*value) : Cell();
}
Cell yes(bool is) {
  return std::int64_t{is};
}

using Identity = Column<MeasuredRow>;
constexpr Identity kIdentity[] = {
    {column::kParticipant, [](const auto& r) { return text(r.participant); }},
    {column::kStroke, [](const auto& r) { return text(r.stroke); }},
    {column::kRecording, [](const auto& r) { return text(r.recording); }},
    {column::kMethod, [](const auto& r) { return text(r.method); }},
    {column::kMethodNumber, [](const auto& r) { return number(r.method_number); }},
    {column::kShape, [](const auto& r) { return text(r.shape); }},
    {column::kShapeNumber, [](const auto& r) { return number(r.shape_number); }},
    {column::kIndex, [](const auto& r) { return count(r.index); }},
    {column::kCurve, [](const auto& r) { return text(r.curve); }},
    {column::kRepetition, [](const auto& r) { return yes(r.repetition); }},
    {column::kTask, [](const auto& r) { return text(r.task); }},
    {column::kSimulated, [](const auto& r) { return text(simulation_text(r.simulated)); }},
};

using Measure = Column<Measures>;
// The paper's measures and filters.
constexpr Measure kMeasures[] = {
    {column::kDistance, [](const auto& m) -> Cell { return 1e3 * m.d_ep_m; }},
    {"D_sym_mm", [](const auto& m) -> Cell { return 1e3 * m.d_sym_m; }},
    {column::kEuclideanCurvature, [](const auto& m) -> Cell { return m.k_e_rad_per_m; }},
    {column::kGeodesicCurvature, [](const auto& m) -> Cell { return m.k_g_rad_per_m; }},
    {column::kFairness, [](const auto& m) -> Cell { return m.f_g_rad_per_m; }},
    {"T_h", [](const auto& m) -> Cell { return m.t_h; }},
    {"R_h", [](const auto& m) -> Cell { return m.r_h_rad_per_m; }},
    {"T_c", [](const auto& m) -> Cell { return m.t_c; }},
    {"R_c", [](const auto& m) -> Cell { return m.r_c_rad_per_m; }},
    {"tau_s", [](const auto& m) -> Cell { return m.tau_s; }},
    {column::kShort, [](const auto& m) { return yes(m.filters.too_short); }},
    {column::kNoisy, [](const auto& m) { return yes(m.filters.noisy); }},
    {column::kInverted, [](const auto& m) { return yes(m.filters.inverted); }},
    {column::kViolation, [](const auto& m) -> Cell { return m.mimicry_violation; }},
    {"L_X_m", [](const auto& m) -> Cell { return m.l_x_m; }},
};

constexpr std::string_view kPieces = "pieces";

// Ours.
constexpr Measure kMoreMeasures[] = {
    {"K_g_normalised", [](const auto& m) -> Cell { return m.k_g_normalised_rad_per_m; }},
    {column::kLargestJump, [](const auto& m) -> Cell { return m.largest_jump; }},
    {column::kShareJumping, [](const auto& m) -> Cell { return m.share_jumping; }},
    {column::kGaps, [](const auto& m) { return count(m.gaps); }},
    {"frechet_mm", [](const auto& m) -> Cell { return 1e3 * m.frechet_m; }},
    {"end_lag_mm", [](const auto& m) -> Cell { return 1e3 * m.end_lag_m; }},
    {"length_ratio", [](const auto& m) -> Cell { return m.length_ratio; }},
    {"boundary_nodes", [](const auto& m) { return count(m.boundary_nodes); }},
    {"undefined_nodes", [](const auto& m) { return count(m.undefined_nodes); }},
};

constexpr Identity kOutcome[] = {
    {"frames", [](const auto& r) { return count(r.frames); }},
    {"missed", [](const auto& r) { return count(r.missed); }},
    {column::kRejected, [](const auto& r) { return text(r.rejected); }},
};

std::vector<Cell> cells_of(const MeasuredRow& row) {
  std::vector<Cell> cells;
  const auto add_measures = [&](std::span<const Measure> columns) {
    for (const Measure& c : columns) cells.push_back(row.measures ? c.cell(*row.measures) : Cell());
  };
  for (const Identity& c : kIdentity) cells.push_back(c.cell(row));
  add_measures(kMeasures);
  cells.push_back(count(row.pieces));
  add_measures(kMoreMeasures);
  for (const Identity& c : kOutcome) cells.push_back(c.cell(row));
  return cells;
}

using Rejected = Column<RejectedStroke>;
constexpr Rejected kRejectedColumns[] = {
    {column::kParticipant, [](const auto& r) { return text(r.participant); }},
    {column::kRecording, [](const auto& r) { return text(r.recording); }},
    {column::kMethod, [](const auto& r) { return text(r.method); }},
    {column::kMethodNumber, [](const auto& r) { return number(r.method_number); }},
    {column::kShape, [](const auto& r) { return text(r.shape); }},
    {column::kShapeNumber, [](const auto& r) { return number(r.shape_number); }},
    {column::kIndex, [](const auto& r) { return text(r.index); }},
    {column::kReason, [](const auto& r) { return text(r.reason); }},
};

}  // namespace

const std::vector<std::string>& row_columns() {
  static const std::vector<std::string> columns = [] {
    std::vector<std::string> names;
    for (const Identity& c : kIdentity) names.emplace_back(c.name);
    for (const Measure& c : kMeasures) names.emplace_back(c.name);
    names.emplace_back(kPieces);
    for (const Measure& c : kMoreMeasures) names.emplace_back(c.name);
    for (const Identity& c : kOutcome) names.emplace_back(c.name);
    return names;
  }();
  return columns;
}

std::string rows_heading() {
  return csv_heading(row_columns());
}

std::string csv_row(const MeasuredRow& row) {
  return csv_line(cells_of(row));
}

std::string json_row(const MeasuredRow& row) {
  return json_line(row_columns(), cells_of(row));
}

std::string simulation_text(const std::optional<Simulation>& simulated) {
  if (!simulated) return {};
  return simulated->program + " seed " + std::to_string(simulated->seed);
}

std::string RejectedStroke::text() const {
  return participant + (recording.empty() ? "" : "/" + recording) +
         (index.empty() ? "" : ": stroke " + index) + ": " + reason;
}

std::string write_rejected(const std::vector<RejectedStroke>& rejected) {
  std::vector<std::string> columns;
  for (const Rejected& c : kRejectedColumns) columns.emplace_back(c.name);
  std::string table = csv_heading(columns);
  for (const RejectedStroke& stroke : rejected) {
    std::vector<Cell> cells;
    for (const Rejected& c : kRejectedColumns) cells.push_back(c.cell(stroke));
    table += csv_line(cells);
  }
  return table;
}

std::vector<RejectedStroke> read_rejected(std::string_view bytes, std::string_view name) {
  const CsvTable table = read_csv(bytes, name);
  if (!table.find(column::kReason))
    throw Error(ErrorKind::invalid_input, std::string(name) + ": has no column '" +
                                              std::string(column::kReason) +
                                              "'; write it with mimicry measure");
  std::vector<RejectedStroke> rejected;
  for (const auto& row : table.rows) {
    const auto cell = [&](std::string_view column) {
      const auto at = table.find(column);
      return at ? row[*at] : std::string();
    };
    RejectedStroke& stroke = rejected.emplace_back();
    stroke.participant = cell(column::kParticipant);
    stroke.recording = cell(column::kRecording);
    stroke.method = name_of_method(cell(column::kMethod));
    stroke.method_number = number_of_method(stroke.method);
    stroke.shape = name_of_shape(cell(column::kShape));
    stroke.shape_number = number_of_shape(stroke.shape);
    stroke.index = cell(column::kIndex);
    stroke.reason = cell(column::kReason);
  }
  return rejected;
}

std::string rejected_beside(const std::string& rows) {
  const std::filesystem::path path = to_path(rows);
  return join_path(to_text(path.parent_path()), file_stem(rows) + ".rejected.csv");
}

}  // namespace mimicry::lab
