#include <algorithm>
#include <cmath>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/paint/stamp.h>

#include "paint/srgb.h"

namespace mimicry {
namespace {

using Color = std::array<float, 4>;

Color linear(const Rgba8& texel) {
  const SrgbTables& srgb = srgb_tables();
  const float a = static_cast<float>(texel[3]) / 255.0f;
  return {a * srgb.linear[texel[0]], a * srgb.linear[texel[1]], a * srgb.linear[texel[2]], a};
}

Rgba8 encoded(const Color& c) {
  Rgba8 texel = {0, 0, 0, static_cast<std::uint8_t>(std::lrint(255.0f * c[3]))};
  if (c[3] > 0.0f)
    for (std::size_t k = 0; k < 3; ++k) texel[k] = srgb_tables().encode(c[k] / c[3]);
  return texel;
}

[[noreturn]] void refuse_image(const std::string& why) {
  throw Error(ErrorKind::invalid_input, why);
}

bool is_outside(double value, double low, double high) {
  return std::isnan(value) || value < low || value > high;
}

}  // namespace

StampImage::StampImage(int width, int height, std::span<const Rgba8> texels) {
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels)
    refuse_image("image: " + std::to_string(width) + " x " + std::to_string(height) +
                 " pixels; give 1 to " + std::to_string(kMostPixels) + " a side");
  if (texels.size() != at(width) * at(height))
    refuse_image("image: " + std::to_string(texels.size()) + " pixels for " +
                 std::to_string(width) + " x " + std::to_string(height) + "; give one for each");
  levels_.push_back({width, height, {texels.begin(), texels.end()}});
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& from = levels_.back();
    Level to{(from.width + 1) / 2, (from.height + 1) / 2, {}};
    to.texels.reserve(at(to.width) * at(to.height));
    for (int y = 0; y < to.height; ++y)
      for (int x = 0; x < to.width; ++x) {
        Color sum = {};
        for (int i = 0; i < 4; ++i) {
          const int sx = std::min(2 * x + i % 2, from.width - 1);
          const int sy = std::min(2 * y + i / 2, from.height - 1);
          const Color c = linear(from.texels[at(sy) * at(from.width) + at(sx)]);
          for (std::size_t k = 0; k < 4; ++k) sum[k] += 0.25f * c[k];
        }
        to.texels.push_back(encoded(sum));
      }
    levels_.push_back(std::move(to));
  }
}

std::array<float, 4> StampImage::sample(double u, double v, double footprint, bool repeats) const {
  std::size_t l = 0;
  while (l + 1 < levels_.size() && footprint >= 2.0) {
    footprint *= 0.5;
    ++l;
  }
  const Level& level = levels_[l];
  if (repeats) u -= std::floor(u);
  const double x = u * level.width - 0.5, y = v * level.height - 0.5;
  Color sum = {};
  if (is_outside(x, -1.0, level.width) || is_outside(y, -1.0, level.height)) return sum;
  const double x0 = std::floor(x), y0 = std::floor(y);
  for (int i = 0; i < 4; ++i) {
    int tx = static_cast<int>(x0) + i % 2;
    const int ty = static_cast<int>(y0) + i / 2;
    if (repeats) tx = (tx + level.width) % level.width;
    if (tx < 0 || ty < 0 || tx >= level.width || ty >= level.height) continue;
    const double weight =
        (i % 2 == 0 ? 1.0 - (x - x0) : x - x0) * (i / 2 == 0 ? 1.0 - (y - y0) : y - y0);
    const Color c = linear(level.texels[at(ty) * at(level.width) + at(tx)]);
    for (std::size_t k = 0; k < 4; ++k) sum[k] += static_cast<float>(weight) * c[k];
  }
  return sum;
}

void require_valid(const Stamp& stamp) {
  if (is_outside(stamp.size, 0.0, kInfinity) || stamp.size == 0.0 || std::isinf(stamp.size))
    refuse_image("stamp: its size is not above 0; give a length");
  if (is_outside(stamp.spacing, 0.01, 100.0))
    refuse_image("stamp: its spacing is out of range; give 0.01 to 100");
  if (is_outside(stamp.opacity, 0.0, 1.0))
    refuse_image("stamp: its opacity is out of range; give 0 to 1");
  if (is_outside(stamp.size_jitter, 0.0, 0.9))
    refuse_image("stamp: its size_jitter is out of range; give 0 to 0.9");
  if (!std::isfinite(stamp.rotation_rad))
    refuse_image("stamp: its rotation is not finite; give an angle");
  if (!std::isfinite(stamp.rotation_jitter_rad) || stamp.rotation_jitter_rad < 0.0)
    refuse_image("stamp: its rotation_jitter is out of range; give an angle from 0 on");
  if (!stamp.up.allFinite()) refuse_image("stamp: its up is not finite; give a direction");
}

void require_valid(const Ribbon& ribbon) {
  if (is_outside(ribbon.width, 0.0, kInfinity) || ribbon.width == 0.0 || std::isinf(ribbon.width))
    refuse_image("ribbon: its width is not above 0; give a length");
  if (is_outside(ribbon.opacity, 0.0, 1.0))
    refuse_image("ribbon: its opacity is out of range; give 0 to 1");
}

}  // namespace mimicry
