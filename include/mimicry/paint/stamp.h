#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/paint/layers.h>

namespace mimicry {

/// An image to paint with: sRGB and straight alpha, with its halved levels, so that it is smooth
/// however small it is painted.
class StampImage {
 public:
  static constexpr int kMostPixels = 16384;  ///< a side

  /// texels: width by height, rows from the top. Throws Error(invalid_input) for a side out of 1 to
  /// `kMostPixels` and another count of texels. O(width height).
  StampImage(int width, int height, std::span<const Rgba8> texels);

  int width() const { return levels_.front().width; }
  int height() const { return levels_.front().height; }
  /// Linear light, premultiplied by alpha, at u to the right and v down, both 0 to 1 across the
  /// image; nothing outside, but for u where `repeats`. footprint: how much of the image what is
  /// asked for is wide, in pixels.
  std::array<float, 4> sample(double u, double v, double footprint, bool repeats = false) const;

 private:
  struct Level {
    int width, height;
    std::vector<Rgba8> texels;
  };
  std::vector<Level> levels_;
};

/// Images at even steps of the curve's length, each laid over those before by the exponential map
/// at its centre.
struct Stamp {
  double size = 0.0;          ///< of the image's longer side, > 0, model units
  double rotation_rad = 0.0;  ///< counter-clockwise as seen from outside
  /// The image's right is the curve's way. Without it its top is where `up` points along the
  /// surface.
  bool follow = true;
  Vec3 up = Vec3::UnitY();
  double spacing = 1.0;  ///< in sizes, 0.01 to 100
  double opacity = 1.0;  ///< 0 to 1, of the stroke
  /// How far each stamp's size and rotation leave these at random: part of the size, 0 to 0.9, and
  /// radians, >= 0.
  double size_jitter = 0.0;
  double rotation_jitter_rad = 0.0;
  std::uint64_t seed = 1;
};

/// An image along the stroke, repeated: its right is the curve's way (u is arc length), its top the
/// left side (v is the signed distance to the nearest point of the curve). Ends are straight; where
/// the curve bends nothing is missing, and where it crosses itself the nearer part is on top.
struct Ribbon {
  double width = 0.0;    ///< of the image's height, > 0, model units
  double opacity = 1.0;  ///< 0 to 1, of the stroke
};

/// Throw Error(invalid_input) that names the first value out of range and what it may be.
void require_valid(const Stamp& stamp);
void require_valid(const Ribbon& ribbon);

}  // namespace mimicry
