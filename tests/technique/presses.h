#pragma once

#include <vector>

#include <mimicry/base/random.h>
#include <mimicry/technique/technique.h>

namespace mimicry {

/// Presses at what is seen from eyes around the target: the point under the pointer and its ray.
struct Press {
  Vec3 eye, direction;
  RayHit hit;
};

inline std::vector<Press> presses(const Target& target, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Press> all;
  const Vec3 centre = target.bounding_box().center();
  while (static_cast<int>(all.size()) < count) {
    Vec3 out(random.normal(), random.normal(), random.normal());
    const Vec3 eye = centre + 2.0 * target.diagonal() * out.normalized();
    Vec3 aim = centre;
    for (int k = 0; k < 3; ++k)
      aim[k] += 0.5 * target.bounding_box().sizes()[k] * (2.0 * random.uniform() - 1.0);
    const Vec3 direction = (aim - eye).normalized();
    if (const auto hit = target.first_hit(eye, direction)) all.push_back({eye, direction, *hit});
  }
  return all;
}

inline Frame frame_of(const Press& press, const Vec3& pen, double time_s = 0.0) {
  Frame frame;
  frame.time_s = time_s;
  const Quat turn = Quat::FromTwoVectors(-Vec3::UnitZ(), press.direction);
  frame.head = {press.eye, turn};
  frame.controller = {pen, turn};
  return frame;
}

/// Of the techniques without a bake.
inline bool starts_at_the_pen(const TechniqueInfo& info) {
  return !info.needs_bake && info.name != "head-centric";
}

}  // namespace mimicry
