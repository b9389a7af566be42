#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/image.h"

namespace mimicry::render {

/// The bytes of a PNG file, 8-bit sRGB. Throws Error(invalid_input) on an image without pixels or
/// whose array does not match its size, Error(io) where the encoder fails.
std::string write_png(const Image& image);

/// The pixels of a PNG file as 8-bit sRGB with straight alpha, rows from the top.
struct RgbaImage {
  int width = 0;
  int height = 0;
  std::vector<std::array<std::uint8_t, 4>> pixels;
};

/// Reads a PNG file of any kind. name: for messages. Throws Error(invalid_input) where it cannot be
/// read or a side has more than `most` pixels, before they are held in memory.
RgbaImage read_png(std::string_view bytes, std::string_view name, int most);

}  // namespace mimicry::render
