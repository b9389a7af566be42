#pragma once

#include <span>
#include <string_view>

namespace mimicry::lab {

/// Names of the columns that say which stroke a row of a table is of, and what became of it
/// (docs/formats.md). Tables are written and read by these.
namespace column {

inline constexpr std::string_view kParticipant = "participant";
inline constexpr std::string_view kStroke = "stroke";
inline constexpr std::string_view kRecording = "recording";
inline constexpr std::string_view kMethod = "method";
inline constexpr std::string_view kMethodNumber = "method_number";
inline constexpr std::string_view kShape = "shape";
inline constexpr std::string_view kShapeNumber = "shape_number";
inline constexpr std::string_view kIndex = "index";
inline constexpr std::string_view kCurve = "curve";
inline constexpr std::string_view kRepetition = "repetition";
inline constexpr std::string_view kTask = "task";
inline constexpr std::string_view kSimulated = "simulated";
inline constexpr std::string_view kRejected = "rejected";
inline constexpr std::string_view kReason = "reason";  ///< in tables of what was left out

// The measures that are looked for by name; all have their names in measured_rows.cpp.
inline constexpr std::string_view kDistance = "D_ep_mm";
inline constexpr std::string_view kEuclideanCurvature = "K_E";
inline constexpr std::string_view kGeodesicCurvature = "K_g";
inline constexpr std::string_view kFairness = "F_g";
inline constexpr std::string_view kShort = "short";
inline constexpr std::string_view kNoisy = "noisy";
inline constexpr std::string_view kInverted = "inverted";
inline constexpr std::string_view kViolation = "mimicry_violation";
inline constexpr std::string_view kLargestJump = "largest_jump";
inline constexpr std::string_view kShareJumping = "share_jumping";
inline constexpr std::string_view kGaps = "gaps";

}  // namespace column

/// Whether a cell of a filter or a mark says yes.
inline bool is_set(std::string_view cell) {
  return !cell.empty() && cell != "0" && cell != "false";
}

/// A measure of the paper's table, and how it is written.
struct PaperMeasure {
  std::string_view column;  ///< of our tables
  std::string_view html;    ///< "D<sub>ep</sub>"
  std::string_view title;   ///< with its unit, plain
  std::string_view unit;
};

/// The ten, in the paper's order.
std::span<const PaperMeasure> paper_measures();
/// nullptr for a column that is none of them.
const PaperMeasure* paper_measure(std::string_view column);

}  // namespace mimicry::lab
