#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include <mimicry/io/curves.h>

#include "io/curve_formats.h"

namespace mimicry {

/// Radius of written tubes, part of the mesh's diagonal.
inline constexpr double kTubeRadius = 0.003;

/// Of each curve: its technique's colour.
std::vector<std::array<unsigned char, 3>> curve_colors(const CurveSet& set);

/// The format of files that end so: "json", "obj", "csv", "glb", "ply"; nullopt for others.
std::optional<CurveFormat> curve_format_of(std::string_view ending);

}  // namespace mimicry
