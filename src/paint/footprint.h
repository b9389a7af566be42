#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <mimicry/paint/atlas.h>

namespace mimicry {

struct Dab {
  Vec2 place;
  double radius;
  float alpha;
};

// A piece of curve in the plane of a map, and how wide the brush is along it.
struct Capsule {
  Vec2 from, to;
  double from_radius, to_radius;
  double from_flow, to_flow;
};

// Of k: 1 up to `low`, 0 from `high` on. Where that is less than a texel wide it is a texel around
// the same middle.
struct Falloff {
  double low, scale;
  double low_square, high_square;

  Falloff(double radius, double hardness, double texel) {
    low = hardness * radius;
    double high = radius;
    if (high - low < texel) {
      const double middle = 0.5 * (low + high);
      low = middle - 0.5 * texel;
      high = middle + 0.5 * texel;
    }
    scale = high > low ? 1.0 / (high - low) : 0.0;
    low_square = low > 0.0 ? low * low : -1.0;
    high_square = high * high;
  }
  // By the square of the distance: most texels need no root.
  double at_square(double square) const {
    if (square <= low_square) return 1.0;
    if (square >= high_square) return 0.0;
    const double t = (std::sqrt(square) - low) * scale;
    return 1.0 - t * t * (3.0 - 2.0 * t);
  }
};

// Places of texels in the plane of a map: linear in the texel's numbers.
struct TexelPlaces {
  Vec2 origin, along_x, along_y;
  TexelPlaces(const TexelFrame& frame, const std::array<Vec2, 3>& corners) {
    const auto place = [&](const Vec3& bary) {
      return Vec2(bary[0] * corners[0] + bary[1] * corners[1] + bary[2] * corners[2]);
    };
    origin = place(frame.origin);
    along_x = place(frame.along_x);
    along_y = place(frame.along_y);
  }
};

// Calls visit(x, y, place) for the texels of a face within `reach` of `middle`.
template <class Visit>
void for_each_texel_within(const PaintAtlas& atlas, Index face, const TexelPlaces& places,
                           const Vec2& middle, double reach, Visit&& visit) {
  const double a = places.along_x.squaredNorm();
  atlas.for_each_run(face, [&](const TexelRun& run) {
    const Vec2 row = places.origin + run.y * places.along_y - middle;
    int begin = run.begin, end = run.end;
    if (a > 0.0 && std::isfinite(reach)) {
      // |row + x along_x| <= reach between the roots.
      const double b = row.dot(places.along_x) / a;
      const double root = b * b - (row.squaredNorm() - reach * reach) / a;
      if (root < 0.0) return;
      const double half = std::sqrt(root);
      begin =
          static_cast<int>(std::clamp(std::ceil(-b - half), double(run.begin), double(run.end)));
      end =
          static_cast<int>(std::clamp(std::floor(-b + half) + 1.0, double(begin), double(run.end)));
    }
    for (int x = begin; x < end; ++x)
      visit(x, run.y, Vec2(places.origin + run.y * places.along_y + x * places.along_x));
  });
}

}  // namespace mimicry
