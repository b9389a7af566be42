#include "render/palette.h"

#include <mimicry/technique/technique.h>

namespace mimicry::render {

Color technique_color(std::string_view technique) {
  const TechniqueInfo* info = technique_named(technique);
  return color_of(info ? info->color : 0x777777);
}

Color color_of(std::uint32_t rgb) {
  return {((rgb >> 16) & 255U) / 255.0, ((rgb >> 8) & 255U) / 255.0, (rgb & 255U) / 255.0};
}

}  // namespace mimicry::render
