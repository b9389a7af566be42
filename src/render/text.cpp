#include "render/text.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/float_traps.h"

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wpedantic"
#endif
#include <stb/stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace mimicry::render {
namespace {

constexpr int kReplacement = 0xfffd;

/// Takes the next character off the front of UTF-8 text.
int next_character(std::string_view& text) {
  const auto lead = static_cast<unsigned char>(text.front());
  text.remove_prefix(1);
  if (lead < 0x80) return lead;
  const int following = lead >= 0xf0 && lead < 0xf8   ? 3
                        : lead >= 0xe0 && lead < 0xf0 ? 2
                        : lead >= 0xc0 && lead < 0xe0 ? 1
                                                      : 0;
  if (following == 0) return kReplacement;
  int code = lead & (0x3f >> following);
  for (int i = 0; i < following; ++i) {
    if (text.empty() || (static_cast<unsigned char>(text.front()) & 0xc0) != 0x80) {
      return kReplacement;
    }
    code = (code << 6) | (static_cast<unsigned char>(text.front()) & 0x3f);
    text.remove_prefix(1);
  }
  return code;
}

stbtt_fontinfo open_font() {
  stbtt_fontinfo font;
  [[maybe_unused]] const int good =
      stbtt_InitFont(&font, reinterpret_cast<const unsigned char*>(font_file().data()), 0);
  assert(good != 0);
  return font;
}

/// Calls place(glyph, x) for each character with its pen position, and returns the pen's last.
template <typename Place>
double lay_out(const stbtt_fontinfo& font, std::string_view text, double scale,
               const Place& place) {
  double pen = 0.0;
  int previous = 0;
  while (!text.empty()) {
    const int glyph = stbtt_FindGlyphIndex(&font, next_character(text));
    if (previous != 0) pen += scale * stbtt_GetGlyphKernAdvance(&font, previous, glyph);
    place(glyph, pen);
    int advance = 0;
    int bearing = 0;
    stbtt_GetGlyphHMetrics(&font, glyph, &advance, &bearing);
    pen += scale * advance;
    previous = glyph;
  }
  return pen;
}

}  // namespace

double text_width(std::string_view text, double size_px) {
  const FloatTrapMask mask;
  const stbtt_fontinfo font = open_font();
  const double scale = stbtt_ScaleForPixelHeight(&font, static_cast<float>(size_px));
  return lay_out(font, text, scale, [](int, double) {});
}

void draw_text(Image& image, std::string_view text, double x, double y, double size_px,
               const Color& color) {
  const FloatTrapMask mask;
  const stbtt_fontinfo font = open_font();
  const float scale = stbtt_ScaleForPixelHeight(&font, static_cast<float>(size_px));
  std::vector<unsigned char> coverage;
  lay_out(font, text, scale, [&](int glyph, double pen) {
    const double left = std::floor(x + pen);
    const auto shift = static_cast<float>(x + pen - left);
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(&font, glyph, scale, scale, shift, 0.0F, &x0, &y0, &x1, &y1);
    const int w = x1 - x0;
    const int h = y1 - y0;
    if (w <= 0 || h <= 0) return;
    coverage.assign(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0);
    stbtt_MakeGlyphBitmapSubpixel(&font, coverage.data(), w, h, w, scale, scale, shift, 0.0F,
                                  glyph);
    const int row = static_cast<int>(std::lround(y)) + y0;
    const int column = static_cast<int>(left) + x0;
    for (int v = 0; v < h; ++v) {
      for (int u = 0; u < w; ++u) {
        const unsigned char c = coverage[static_cast<std::size_t>(v) * static_cast<std::size_t>(w) +
                                         static_cast<std::size_t>(u)];
        if (c != 0) image.blend(column + u, row + v, color, c / 255.0);
      }
    }
  });
}

}  // namespace mimicry::render
