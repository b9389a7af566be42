#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lab/pairing.h"
#include "lab/summary.h"

namespace mimicry::lab {

/// A method's colour in the figures: "#d55e00".
using MethodColor = std::function<std::string(const std::string& method)>;

/// What the figures of a report show (report/src/data.ts), and under "comparisons" what
/// `comparison_json` says of each pair of methods. JSON on one line.
std::string figure_data(const Summary& summary, const MethodColor& color_of);

/// Groups of pairs of two methods with their comparisons, for programs; beside them the paper's
/// figures, where it has some, and what agrees with them. Indented JSON.
std::string comparison_json(const std::string& a, const std::string& b,
                            const std::vector<PairedGroup>& groups,
                            const std::vector<std::vector<Comparison>>& comparisons);

/// Letters, digits and '-' as they are, '_' for all else.
std::string file_part(std::string name);

/// Of the figures, in the page's order: names of their files, and of the page's elements.
std::string scatter_id(const MethodPair& pair);
inline constexpr const char* kBoxesId = "boxes";
inline constexpr const char* kShapesId = "shapes";

/// A stroke that stands for others of its method.
struct StrokePick {
  const StudyRow* row = nullptr;
  double value = 0.0;  ///< of the measure that it was picked by
  bool best = false;   ///< else it is among the worst
};

/// Of each method the `count` strokes that count with the largest values of a measure, the largest
/// first, then those with the smallest, the smallest first. No stroke comes twice.
std::vector<StrokePick> pick_strokes(const StudyRows& rows, const Summary& summary,
                                     const std::string& measure, int count);

}  // namespace mimicry::lab
