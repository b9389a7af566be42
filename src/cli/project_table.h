#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/session/stroke_session.h>
#include <mimicry/spatial/target.h>
#include <mimicry/stroke/stroke.h>
#include <mimicry/technique/technique.h>

namespace mimicry::cli {

/// Sums over strokes of what the study measures (docs/study.md).
struct MeasureSums {
  std::size_t strokes = 0;   ///< measured: those that drew something
  std::size_t intended = 0;  ///< of these, with an intended curve
  double d_ep_m = 0.0;       ///< over those with an intended curve
  double k_e_rad_per_m = 0.0;
  double share_jumping = 0.0;

  /// Measures a stroke's curve. K_E is over the intended curve's length, or the drawn one's where
  /// nothing was intended. A curve without length is passed over.
  void add(const Target& target, const Stroke& stroke, const ProjectedCurve& curve);
  double mean_k_e() const { return k_e_rad_per_m / static_cast<double>(strokes); }
  double mean_share_jumping() const { return share_jumping / static_cast<double>(strokes); }
  std::optional<double> mean_d_ep_m() const;
};

struct StrokeCounts {
  std::string stroke;
  std::size_t points;
  AnswerCounts answers;
};

/// What the table says of one technique, over all strokes.
struct TechniqueRow {
  const TechniqueInfo* technique = nullptr;
  std::size_t frames = 0;
  std::size_t points = 0;
  std::size_t missed = 0;
  double length_m = 0.0;
  double distance_sum_m = 0.0;  // to the intended curves, crossings included
  std::size_t distances = 0;    // strokes that have one
  double seconds = 0.0;
  std::vector<StrokeCounts> strokes = {};
  MeasureSums measures = {};
  MeasureSums beside = {};  // of the strokes beside them

  /// Plain closest points in place of smooth ones.
  std::size_t fallbacks() const;
};

/// What the strokes of a file are, for the table.
enum class Drawers {
  recorded,     ///< by people, as far as the file says
  closed_loop,  ///< simulated people who saw their ink
  open_loop,    ///< simulated, blind
};
/// Of strokes that differ: recorded.
Drawers drawers_of(const std::vector<Stroke>& strokes);

struct TableTitles {
  Drawers strokes = Drawers::recorded;
  std::optional<Drawers> beside;
};

/// The table for people, with a legend.
void print_rows(const std::vector<TechniqueRow>& rows, const TableTitles& titles);
/// The same and more for programs.
void print_rows_json(const std::vector<TechniqueRow>& rows, const std::vector<std::string>& files);

}  // namespace mimicry::cli
