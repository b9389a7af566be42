#pragma once

#include <string>
#include <vector>

#include <mimicry/stroke/stroke.h>

namespace mimicry::cli {

/// The sound strokes of a file. What is left out is told on standard error, and `status` becomes
/// kPartly. Throws where none is left.
std::vector<Stroke> load_strokes(const std::string& path, int& status);

/// Tells of something that is left out, and notes it in `status`.
void tell_left_out(const std::string& what, int& status);

}  // namespace mimicry::cli
