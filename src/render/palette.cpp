#include <array>

#include <mimicry/render/palette.h>

namespace mimicry::render {
namespace {

constexpr Color hex(unsigned rgb) {
  return {((rgb >> 16) & 255U) / 255.0, ((rgb >> 8) & 255U) / 255.0, (rgb & 255U) / 255.0};
}

constexpr std::array kColors = {
    PaletteEntry{"occlude", hex(0x576aff)},
    PaletteEntry{"spraycan", hex(0xd55e00)},
    PaletteEntry{"head-centric", hex(0x7d6f3c)},
    PaletteEntry{"snap", hex(0xcaa2ff)},
    PaletteEntry{"snap-smooth", hex(0x442567)},
    PaletteEntry{"anchored-closest", hex(0xe69f00)},
    PaletteEntry{"mimicry", hex(0x0072b2)},
    PaletteEntry{"mimicry-planar", hex(0x0000f9)},
    PaletteEntry{"mimicry-offset", hex(0x00788d)},
    PaletteEntry{"mimicry-parallel", hex(0x165e3c)},
    PaletteEntry{"anchored-ray-plane", hex(0x95c86c)},
    PaletteEntry{"anchored-ray-transport", hex(0x7a2800)},
    PaletteEntry{"mimicry-live", hex(0x009e73)},
};

}  // namespace

std::span<const PaletteEntry> technique_colors() {
  return kColors;
}

Color technique_color(std::string_view technique) {
  for (const PaletteEntry& entry : kColors) {
    if (entry.name == technique) return entry.color;
  }
  return hex(0x777777);
}

}  // namespace mimicry::render
