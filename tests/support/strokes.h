#pragma once

#include <cmath>

#include <mimicry/stroke/stroke.h>

namespace mimicry::test {

/// A hand that waves in front of a model of radius 1 at the origin (model units): all frames point
/// at it, the head looks from behind the hand. `placed` puts model and stroke into the world.
inline Stroke waving_stroke(int frames, double rate_hz = 90.0, const Similarity& placed = {}) {
  Stroke stroke;
  stroke.id = "wave";
  stroke.model_to_world = placed;
  for (int i = 0; i < frames; ++i) {
    const double t = i / rate_hz;
    const Vec3 tip(0.5 * std::sin(1.1 * t), 0.4 * std::sin(1.7 * t + 0.3),
                   1.15 + 0.05 * std::cos(2.3 * t));
    const Quat turned(Eigen::AngleAxisd(0.2 * std::sin(0.9 * t), Vec3::UnitY()));
    const Vec3 eye(0.05, 0.3, 1.0);  // from the tip
    Frame frame;
    frame.time_s = t;
    frame.controller = {placed.point(tip), placed.rotation * turned};
    frame.head = {placed.point(tip + eye),
                  placed.rotation * Quat::FromTwoVectors(-Vec3::UnitZ(), -eye)};
    stroke.frames.push_back(frame);
  }
  return stroke;
}

}  // namespace mimicry::test
