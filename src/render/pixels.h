#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/base/types.h>

namespace mimicry::render {

/// The samples of one pixel that saw one object: sums while they are gathered, then means.
struct Layer {
  static constexpr std::uint32_t kNone = ~0U;

  std::uint32_t object = kNone;
  float weight = 0.0F;                                ///< number of samples
  float openness = 0.0F;                              ///< share of occlusion rays that got away
  Eigen::Vector3f ambient = Eigen::Vector3f::Zero();  ///< light that occlusion takes away, linear
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< in the unit box
};

/// A pixel's colour is lit + the sum over its layers of openness * ambient. Objects beyond the
/// second are added to `lit` as they are.
struct Pixel {
  Eigen::Vector3f lit = Eigen::Vector3f::Zero();
  std::array<Layer, 2> layers;
};

/// Rows above and below a pixel that its openness depends on.
inline constexpr int kSmoothingReach = 5;

/// Colour of pixel (x, y) with its openness smoothed over neighbours that lie on the same object
/// and nearly in the same plane: edges stay, grain goes. Of `rows` only those within
/// kSmoothingReach need be there.
Eigen::Vector3f smoothed_color(std::span<const std::vector<Pixel>> rows, int x, int y);

}  // namespace mimicry::render
