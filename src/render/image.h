#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mimicry::render {

/// sRGB, each component in 0..1.
struct Color {
  double r = 0.0, g = 0.0, b = 0.0;
};

/// 8-bit sRGB pixels, rows from the top, three bytes a pixel.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // #pixels by 3

  Image() = default;
  Image(int w, int h, const Color& fill);

  std::uint8_t* pixel(int x, int y) { return rgb.data() + offset(x, y); }
  const std::uint8_t* pixel(int x, int y) const { return rgb.data() + offset(x, y); }

  /// Copies `other` with its top left corner at (x, y); what lies outside is cut off.
  void paste(const Image& other, int x, int y);
  /// Mixes `color` into a pixel, alpha in 0..1; outside the image nothing happens.
  void blend(int x, int y, const Color& color, double alpha);

 private:
  std::size_t offset(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x));
  }
};

}  // namespace mimicry::render
