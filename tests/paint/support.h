#pragma once

#include <cmath>
#include <vector>

#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/surface.h>
#include <mimicry/paint/atlas.h>

namespace mimicry::test {

/// A built-in shape as a surface.
inline Surface shape_surface(const char* name, int resolution) {
  ShapeOptions options;
  options.resolution = resolution;
  return Surface(make_shape(name, options));
}

/// A bilinear sample of numbers at texels, at a place in texels.
template <class At>
double bilinear(const PaintAtlas& atlas, const Vec2& place, At&& at_texel) {
  const int x = std::min(static_cast<int>(std::floor(place.x())), atlas.size() - 2);
  const int y = std::min(static_cast<int>(std::floor(place.y())), atlas.size() - 2);
  const double a = place.x() - x, b = place.y() - y;
  double sum = 0.0;
  const double weights[4] = {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
  for (int i = 0; i < 4; ++i)
    if (weights[i] > 1e-9) sum += weights[i] * at_texel(x + i % 2, y + i / 2);
  return sum;
}

}  // namespace mimicry::test
