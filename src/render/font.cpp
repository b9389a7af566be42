#include "render/text.h"

// MIMICRY_FONT is the path of the font file, set by the build.
asm(".section .rodata\n"
    ".balign 16\n"
    "mimicry_font_data:\n"
    ".incbin \"" MIMICRY_FONT
    "\"\n"
    "mimicry_font_data_end:\n"
    ".previous\n");

namespace mimicry::render {
namespace {
extern "C" {
[[gnu::visibility("hidden")]] extern const char mimicry_font_data[];
[[gnu::visibility("hidden")]] extern const char mimicry_font_data_end[];
}
}  // namespace

std::string_view font_file() {
  return {mimicry_font_data, static_cast<std::size_t>(mimicry_font_data_end - mimicry_font_data)};
}

}  // namespace mimicry::render
