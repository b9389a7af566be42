#include "render/font.h"

// MIMICRY_FONT is the path of the font file, set by the build.
asm(".section .rodata\n"
    ".balign 16\n"
    "mimicry_font_data:\n"
    ".incbin \"" MIMICRY_FONT
    "\"\n"
    ".previous\n");

namespace mimicry::render {
namespace {
extern "C" {
[[gnu::visibility("hidden")]] extern const unsigned char mimicry_font_data[];
}
}  // namespace

const unsigned char* font_data() {
  return mimicry_font_data;
}

}  // namespace mimicry::render
