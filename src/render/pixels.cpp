#include "render/pixels.h"

#include <algorithm>
#include <cmath>

namespace mimicry::render {
namespace {

constexpr int kReach = kSmoothingReach;
/// Distance off the plane, in the unit box, at which a neighbour counts half.
constexpr float kPlaneSpread = 2e-3F;
/// Neighbours whose normals differ more (cosine) do not count.
constexpr float kMinFacing = 0.8F;

std::array<float, 2 * kReach + 1> gauss() {
  std::array<float, 2 * kReach + 1> weights{};
  for (int d = -kReach; d <= kReach; ++d) {
    weights[static_cast<std::size_t>(d + kReach)] =
        std::exp(-static_cast<float>(d * d) / (2.0F * 2.7F * 2.7F));
  }
  return weights;
}

float smoothed_openness(std::span<const std::vector<Pixel>> rows, int x, int y, const Layer& own) {
  static const std::array<float, 2 * kReach + 1> weights = gauss();
  const int width = static_cast<int>(rows[static_cast<std::size_t>(y)].size());
  const int height = static_cast<int>(rows.size());
  float sum = 0.0F;
  float total = 0.0F;
  for (int v = std::max(0, y - kReach); v <= std::min(height - 1, y + kReach); ++v) {
    const std::vector<Pixel>& row = rows[static_cast<std::size_t>(v)];
    for (int u = std::max(0, x - kReach); u <= std::min(width - 1, x + kReach); ++u) {
      for (const Layer& other : row[static_cast<std::size_t>(u)].layers) {
        if (other.object != own.object) continue;
        const float facing = own.normal.dot(other.normal) - kMinFacing;
        if (facing <= 0.0F) continue;
        const float off = own.normal.dot(other.position - own.position) / kPlaneSpread;
        const float w = weights[static_cast<std::size_t>(u - x + kReach)] *
                        weights[static_cast<std::size_t>(v - y + kReach)] * other.weight * facing /
                        (1.0F + off * off);
        sum += w * other.openness;
        total += w;
      }
    }
  }
  return total > 0.0F ? sum / total : own.openness;
}

}  // namespace

Eigen::Vector3f smoothed_color(std::span<const std::vector<Pixel>> rows, int x, int y) {
  const Pixel& pixel = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
  Eigen::Vector3f color = pixel.lit;
  for (const Layer& layer : pixel.layers) {
    if (layer.object == Layer::kNone) continue;
    color += smoothed_openness(rows, x, y, layer) * layer.ambient;
  }
  return color;
}

}  // namespace mimicry::render
