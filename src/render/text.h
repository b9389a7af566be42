#pragma once

#include <string_view>

#include "render/image.h"

namespace mimicry::render {

/// Width in pixels of a line of UTF-8 text set in DejaVu Sans; size_px is the height of the line
/// from ascender to descender, > 0. Bytes that are not UTF-8 count as replacement characters.
double text_width(std::string_view text, double size_px);

/// Draws a line of text, antialiased, its left end at x and its baseline at y; what lies outside
/// the image is cut off.
void draw_text(Image& image, std::string_view text, double x, double y, double size_px,
               const Color& color);

/// The font as a TrueType file: DejaVu Sans, linked into the program.
std::string_view font_file();

}  // namespace mimicry::render
