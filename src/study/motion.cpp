#include <cmath>

#include <mimicry/study/measures.h>

namespace mimicry {
namespace {

// Up is kept, forward is made orthogonal to it.
void straighten(Vec3& forward, Vec3& up, const Vec3& own_forward, const Vec3& own_up) {
  const auto unit = [](const Vec3& v, const Vec3& otherwise) -> Vec3 {
    const double size = v.norm();
    return size > 1e-9 ? Vec3(v / size) : otherwise;
  };
  up = unit(up, own_up);
  forward = unit(forward - forward.dot(up) * up, own_forward);
}

double rotation_angle(const Vec3& forward, const Vec3& up, const Vec3& next_forward,
                      const Vec3& next_up) {
  Mat3 a, b;
  a << forward, up, forward.cross(up);
  b << next_forward, next_up, next_forward.cross(next_up);
  const Mat3 turn = b * a.transpose();
  const Vec3 axis(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  return std::atan2(axis.norm(), turn.trace() - 1.0);
}

}  // namespace

std::vector<MotionSample> motion_of(const Stroke& stroke) {
  std::vector<MotionSample> motion;
  motion.reserve(stroke.frames.size());
  const Similarity& placed = stroke.model_to_world;
  const auto display = [&](const Vec3& x) {
    return placed.inverse_direction(x - placed.translation);
  };
  for (const Frame& f : stroke.frames)
    motion.push_back({f.time_s, display(f.head.position),
                      placed.inverse_direction(f.head.forward()),
                      placed.inverse_direction(f.head.up()), display(f.controller.position),
                      placed.inverse_direction(f.controller.forward()),
                      placed.inverse_direction(f.controller.up())});
  return motion;
}

std::vector<MotionSample> filtered(std::span<const MotionSample> motion) {
  std::vector<MotionSample> kept;
  kept.reserve(motion.size());
  for (const MotionSample& sample : motion) {
    if (!kept.empty() && kept.back().time_s == sample.time_s) kept.pop_back();
    kept.push_back(sample);
  }
  std::vector<MotionSample> result(kept.size());
  std::size_t first = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const double now = kept[i].time_s;
    while (now - kept[first].time_s > kMotionCut_s) ++first;
    MotionSample sum{now,          Vec3::Zero(), Vec3::Zero(), Vec3::Zero(),
                     Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    double weights = 0.0;
    for (std::size_t j = first; j < kept.size() && kept[j].time_s - now <= kMotionCut_s; ++j) {
      const double t = (kept[j].time_s - now) / kMotionSigma_s;
      const double w = std::exp(-0.5 * t * t);
      weights += w;
      sum.head += w * kept[j].head;
      sum.head_forward += w * kept[j].head_forward;
      sum.head_up += w * kept[j].head_up;
      sum.pen += w * kept[j].pen;
      sum.pen_forward += w * kept[j].pen_forward;
      sum.pen_up += w * kept[j].pen_up;
    }
    sum.head /= weights;
    sum.pen /= weights;
    straighten(sum.head_forward, sum.head_up, kept[i].head_forward, kept[i].head_up);
    straighten(sum.pen_forward, sum.pen_up, kept[i].pen_forward, kept[i].pen_up);
    result[i] = sum;
  }
  return result;
}

MotionLengths motion_lengths(std::span<const MotionSample> motion) {
  MotionLengths lengths;
  for (std::size_t i = 1; i < motion.size(); ++i) {
    const MotionSample& a = motion[i - 1];
    const MotionSample& b = motion[i];
    lengths.head_m += (b.head - a.head).norm();
    lengths.pen_m += (b.pen - a.pen).norm();
    lengths.head_rad += rotation_angle(a.head_forward, a.head_up, b.head_forward, b.head_up);
    lengths.pen_rad += rotation_angle(a.pen_forward, a.pen_up, b.pen_forward, b.pen_up);
  }
  return lengths;
}

}  // namespace mimicry
