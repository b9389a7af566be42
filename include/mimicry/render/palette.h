#pragma once

#include <span>
#include <string_view>

#include <mimicry/render/image.h>

namespace mimicry::render {

struct PaletteEntry {
  std::string_view name;
  Color color;
};

/// One fixed colour per technique, told apart also with red-green blindness.
std::span<const PaletteEntry> technique_colors();
/// The technique's colour; a middle grey for a name that is not in the palette.
Color technique_color(std::string_view technique);

inline constexpr Color kStrokeColor{0.06, 0.06, 0.06};
inline constexpr Color kInkColor{0.13, 0.13, 0.14};  // captions and legends

}  // namespace mimicry::render
