#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "render/renderer.h"

namespace mimicry::render {

/// Unit sphere of `rings` by 2 `rings` quads, poles on the y axis.
inline TriangleMesh ball(int rings, double radius = 1.0, const Vec3& center = Vec3::Zero()) {
  const int around = 2 * rings;
  std::vector<Vec3> p;
  std::vector<Face> f;
  for (int i = 0; i <= rings; ++i) {
    const double a = std::numbers::pi * i / rings;
    for (int j = 0; j < around; ++j) {
      const double b = 2.0 * std::numbers::pi * j / around;
      p.push_back(center + radius * Vec3(std::sin(a) * std::cos(b), std::cos(a),
                                         -std::sin(a) * std::sin(b)));
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const Index a = i * around + j;
      const Index b = i * around + (j + 1) % around;
      f.push_back({a, a + around, b + around});
      f.push_back({a, b + around, b});
    }
  }
  return {std::move(p), std::move(f)};
}

/// Square of side 2 in the plane z = 0, n by n quads, facing +z.
inline TriangleMesh plate(int n) {
  std::vector<Vec3> p;
  std::vector<Face> f;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) p.emplace_back(2.0 * j / n - 1.0, 2.0 * i / n - 1.0, 0.0);
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Index a = i * (n + 1) + j;
      f.push_back({a, a + 1, a + n + 2});
      f.push_back({a, a + n + 2, a + n + 1});
    }
  }
  return {std::move(p), std::move(f)};
}

inline CameraOptions from(double azimuth_deg, double elevation_deg, double aspect = 1.0) {
  CameraOptions options;
  options.azimuth_deg = azimuth_deg;
  options.elevation_deg = elevation_deg;
  options.aspect = aspect;
  return options;
}

inline RenderOptions small(int width, int height) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.samples = 8;
  options.ground = 0.0;
  options.threads = 2;
  return options;
}

inline bool is_background(const Image& image, int x, int y, const RenderOptions& options) {
  const Image fill(1, 1, options.background);
  return std::equal(fill.pixel(0, 0), fill.pixel(0, 0) + 3, image.pixel(x, y));
}

/// Mean of the three channels, 0..255.
inline double brightness(const Image& image, int x, int y) {
  const std::uint8_t* p = image.pixel(x, y);
  return (p[0] + p[1] + p[2]) / 3.0;
}

}  // namespace mimicry::render
