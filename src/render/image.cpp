#include "render/image.h"

#include <algorithm>
#include <cmath>

namespace mimicry::render {
namespace {

std::uint8_t to_byte(double s) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(s, 0.0, 1.0)));
}

}  // namespace

Image::Image(int w, int h, const Color& fill)
    : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    rgb[i] = to_byte(fill.r);
    rgb[i + 1] = to_byte(fill.g);
    rgb[i + 2] = to_byte(fill.b);
  }
}

void Image::paste(const Image& other, int x, int y) {
  const int left = std::max(0, -x);
  const int right = std::min(other.width, width - x);
  if (left >= right) return;
  for (int v = std::max(0, -y); v < std::min(other.height, height - y); ++v) {
    std::copy_n(other.pixel(left, v), 3 * (right - left), pixel(x + left, y + v));
  }
}

void Image::blend(int x, int y, const Color& color, double alpha) {
  if (x < 0 || y < 0 || x >= width || y >= height) return;
  std::uint8_t* p = pixel(x, y);
  const double to[3] = {color.r, color.g, color.b};
  for (int c = 0; c < 3; ++c) p[c] = to_byte(p[c] / 255.0 + alpha * (to[c] - p[c] / 255.0));
}

}  // namespace mimicry::render
