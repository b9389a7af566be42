#pragma once

#include <string>

namespace mimicry::cli {

/// Draws FOLDER/data.json to SVG and PNG files beside it with Node. False where there is no program
/// `node`; throws Error(io) where it fails (what it says goes to standard error).
bool draw_figure_files(const std::string& folder);

}  // namespace mimicry::cli
