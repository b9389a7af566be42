#include <array>

#include <mimicry/render/palette.h>

namespace mimicry::render {
namespace {

constexpr Color hex(unsigned rgb) {
  return {((rgb >> 16) & 255U) / 255.0, ((rgb >> 8) & 255U) / 255.0, (rgb & 255U) / 255.0};
}

constexpr std::array kColors = {
    PaletteEntry{"occlude", hex(0xa7b0fb)},
    PaletteEntry{"spraycan", hex(0xd55e00)},
    PaletteEntry{"head-centric", hex(0xae8657)},
    PaletteEntry{"snap", hex(0x9b84ff)},
    PaletteEntry{"snap-smooth", hex(0x2a3064)},
    PaletteEntry{"anchored-closest", hex(0xe69f00)},
    PaletteEntry{"mimicry", hex(0x0072b2)},
    PaletteEntry{"mimicry-planar", hex(0x0000cd)},
    PaletteEntry{"mimicry-offset", hex(0x007e95)},
    PaletteEntry{"mimicry-parallel", hex(0x235532)},
    PaletteEntry{"anchored-ray-plane", hex(0xddcc77)},
    PaletteEntry{"anchored-ray-transport", hex(0x903d00)},
    PaletteEntry{"mimicry-live", hex(0x0d7c6d)},
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
