#pragma once

#include <cstdint>
#include <string_view>

#include "render/image.h"

namespace mimicry::render {

/// The technique's colour (`TechniqueInfo`); a middle grey for a name that is none.
/// Those of the built-in techniques are told apart also with red-green blindness.
Color technique_color(std::string_view technique);
/// rgb: 0xrrggbb.
Color color_of(std::uint32_t rgb);

inline constexpr Color kStrokeColor{0.06, 0.06, 0.06};
inline constexpr Color kInkColor{0.13, 0.13, 0.14};  // captions and legends

}  // namespace mimicry::render
