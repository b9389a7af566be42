#pragma once

#include <nlohmann/json.hpp>

#include "cli/report/summary.h"

namespace mimicry::cli {

/// What the figures show (report/src/data.ts), and under "comparisons" what `compare --json` prints
/// for each pair of methods.
nlohmann::ordered_json figure_data(const Summary& summary);

/// Letters, digits and '-' as they are, '_' for all else.
std::string file_part(std::string name);

/// Of the figures, in the page's order: names of their files, and of the page's elements.
std::string scatter_id(const MethodPair& pair);
inline constexpr const char* kBoxesId = "boxes";
inline constexpr const char* kShapesId = "shapes";

/// "#d55e00".
std::string method_color(const std::string& method);

}  // namespace mimicry::cli
