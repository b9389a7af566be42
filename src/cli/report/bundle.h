#pragma once

#include <string_view>

namespace mimicry::cli {

/// The scripts of report/src, each one file with all that it needs, linked into the program.
std::string_view page_script();   ///< draws the figures in the page
std::string_view files_script();  ///< for Node: writes them as SVG and PNG

}  // namespace mimicry::cli
