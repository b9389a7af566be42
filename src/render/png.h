#pragma once

#include <string>

#include "render/image.h"

namespace mimicry::render {

/// The bytes of a PNG file, 8-bit sRGB. Throws Error(invalid_input) on an image without pixels or
/// whose array does not match its size, Error(io) where the encoder fails.
std::string write_png(const Image& image);

}  // namespace mimicry::render
