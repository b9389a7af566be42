#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/study/targets.h>

namespace mimicry {
namespace {

// A path near the surface, u in [0, 1], in the shape's units.
struct Guide {
  const char* name;
  bool closed;
  std::function<Vec3(double)> path;
};

// Straight pieces with a speed that is the same everywhere.
std::function<Vec3(double)> polyline(std::vector<Vec3> corners) {
  std::vector<double> length = {0};
  for (std::size_t i = 1; i < corners.size(); ++i)
    length.push_back(length.back() + (corners[i] - corners[i - 1]).norm());
  return [corners = std::move(corners), length = std::move(length)](double u) -> Vec3 {
    const double s = u * length.back();
    std::size_t i = 1;
    while (i + 1 < corners.size() && length[i] < s) ++i;
    const double t = (s - length[i - 1]) / (length[i] - length[i - 1]);
    return corners[i - 1] + t * (corners[i] - corners[i - 1]);
  };
}

std::vector<Guide> sphere_guides(double r = kSphereRadius, const Vec3& centre = Vec3::Zero()) {
  const auto at = [r, centre](double longitude, double latitude) -> Vec3 {
    return centre + r * Vec3(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                             std::cos(latitude) * std::cos(longitude));
  };
  return {{"closed", true,
           [=](double u) -> Vec3 {
             const double a = 0.6, t = kTau * u;
             return centre +
                    r * Vec3(std::sin(a) * std::cos(t), std::sin(a) * std::sin(t), std::cos(a));
           }},
          {"winding", false,
           [=](double u) { return at(-1.1 + 2.2 * u, 0.45 * std::sin(1.5 * kTau * u)); }},
          // Over the pole, as no place of a sphere is more curved than another.
          {"across", false, [=](double u) { return at(0.5, -0.6 + 2.6 * u); }}};
}

std::vector<Guide> torus_guides() {
  const auto at = [](double around, double across) -> Vec3 {
    const double ring = kTorusMajorRadius + kTorusMinorRadius * std::cos(across);
    return {ring * std::cos(around), ring * std::sin(around), kTorusMinorRadius * std::sin(across)};
  };
  return {
      {"closed", true,
       [=](double u) { return at(kTau * u, kTau / 4 + 0.5 * std::sin(3 * kTau * u)); }},
      {"winding", false, [=](double u) { return at(0.4 + 2.4 * u, 1.2 + 2 * kTau * u); }},
      {"across", false, [=](double u) { return at(0.8 + 0.3 * u, 0.25 * kTau + 0.6 * kTau * u); }}};
}

std::vector<Guide> cube_guides() {
  const double a = kCubeHalfSize;
  return {{"closed", true,
           [=](double u) { return Vec3(0.5 * std::cos(kTau * u), 0.5 * std::sin(kTau * u), a); }},
          {"winding", false,
           [=](double u) {
             // From the front over the right edge.
             const double s = -0.7 * a + 2.4 * a * u;
             const double y = 0.4 * std::sin(1.5 * kTau * u);
             return s <= a ? Vec3(s, y, a) : Vec3(a, y, 2 * a - s);
           }},
          {"across", false,
           polyline({Vec3(-0.3, -0.5, a), Vec3(0.2, a, a), Vec3(a, a, 0.1), Vec3(a, -0.4, -0.2)})}};
}

std::vector<Guide> plate_guides() {
  const double z = kPlateHalfThickness, x = kPlateHalfWidth;
  return {{"closed", true,
           [=](double u) { return Vec3(0.5 * std::cos(kTau * u), 0.5 * std::sin(kTau * u), z); }},
          {"winding", false,
           [=](double u) { return Vec3(-0.8 + 1.6 * u, 0.4 * std::sin(1.5 * kTau * u), z); }},
          {"across", false,
           polyline({Vec3(0.1, 0.3, z), Vec3(x, 0.1, z), Vec3(x, 0.1, -z), Vec3(0.2, -0.4, -z)})}};
}

std::vector<Guide> cylinder_guides() {
  const double r = kCylinderRadius, h = kCylinderHalfHeight;
  const auto side = [r](double angle, double y) {
    return Vec3(r * std::sin(angle), y, r * std::cos(angle));
  };
  std::vector<Vec3> across = {Vec3(-0.25, h, -0.1)};
  for (int i = 0; i <= 64; ++i) across.push_back(side(0.2 + 0.8 * i / 64, h - 2 * h * i / 64));
  across.push_back(Vec3(0.1, -h, 0));
  return {{"closed", true, [=](double u) { return side(kTau * u, 0.35 * std::sin(kTau * u)); }},
          {"winding", false, [=](double u) { return side(-1 + 1.5 * kTau * u, -0.7 + 1.4 * u); }},
          {"across", false, polyline(std::move(across))}};
}

std::vector<Guide> trefoil_guides() {
  return {
      {"closed", true,
       [](double u) { return trefoil_point(0.4 + 0.12 * std::sin(2 * kTau * u), kTau * u); }},
      {"winding", false, [](double u) { return trefoil_point(0.9 + 1.1 * u, 1.75 * kTau * u); }},
      // The bend is tightest where the parameter is 1.4514.
      {"across", false, [](double u) {
         return trefoil_point(1.05 + 0.8 * u, kTau / 2 + 0.6 * std::sin(kTau * u));
       }}};
}

std::vector<Guide> hand_guides() {
  constexpr double kFinger = 0.092;  // radius of a finger at its root
  const auto around_finger = [](int finger, double t, double angle, double radius) -> Vec3 {
    const Vec3 axis =
        (hand_finger_axis(finger, t + 1e-4) - hand_finger_axis(finger, t)).normalized();
    const Vec3 right = axis.cross(Vec3::UnitZ()).normalized();
    const Vec3 front = right.cross(axis);
    return hand_finger_axis(finger, t) +
           radius * (1 - 0.25 * t) * (std::sin(angle) * right + std::cos(angle) * front);
  };
  return {{"closed", true,
           [](double u) {
             // Around the palm, above the thumb.
             return Vec3(0.11 + 0.56 * std::cos(kTau * u), -0.16 + 0.05 * std::sin(kTau * u),
                         0.14 * std::sin(kTau * u));
           }},
          {"winding", false,
           [=](double u) { return around_finger(1, 0.2 + 0.6 * u, 2 * kTau * u, kFinger); }},
          {"across", false, [=](double u) -> Vec3 {
             // Up the front of the middle finger, over its tip, down its back.
             constexpr double kTip = 0.85;
             if (u < 0.4) return around_finger(2, 0.2 + (kTip - 0.2) * u / 0.4, 0, kFinger);
             if (u > 0.6)
               return around_finger(2, kTip - (kTip - 0.2) * (u - 0.6) / 0.4, kTau / 2, kFinger);
             const double angle = kTau / 2 * (u - 0.4) / 0.2;
             const Vec3 axis =
                 (hand_finger_axis(2, kTip + 1e-4) - hand_finger_axis(2, kTip)).normalized();
             const Vec3 front = axis.cross(Vec3::UnitZ()).normalized().cross(axis);
             return hand_finger_axis(2, kTip) +
                    kFinger * (1 - 0.25 * kTip) *
                        (std::cos(angle) * front + 2 * std::sin(angle) * axis);
           }}};
}

std::vector<Guide> double_torus_guides() {
  return {{"closed", true,
           [](double u) {
             return Vec3(-0.44 + 0.4 * std::cos(kTau * u), 0.4 * std::sin(kTau * u), 0.25);
           }},
          {"winding", false,
           [](double u) {
             const double x = -0.9 + 1.8 * u;
             return Vec3(x, 0.42 * std::sin(kTau * x / 1.76), 0.25);
           }},
          // Through a hole and around the bar beside it.
          {"across", false, [](double u) {
             const double angle = kTau * (0.2 + 0.8 * u);
             return Vec3(-0.88 + 0.24 * std::cos(angle), -0.1 + 0.2 * u, 0.24 * std::sin(angle));
           }}};
}

std::vector<Guide> moebius_guides() {
  return {
      {"closed", true,
       [](double u) {
         return moebius_point(1.2 + 0.4 * std::cos(kTau * u), 0.18 * std::sin(kTau * u));
       }},
      {"winding", false,
       [](double u) { return moebius_point(0.3 + 3.2 * u, 0.2 * std::sin(1.5 * kTau * u)); }},
      {"across", false, [](double u) { return moebius_point(-1.2 + 2.4 * u, -0.2 + 0.4 * u); }}};
}

std::vector<Guide> grid_guides() {
  return {
      {"closed", true,
       [](double u) { return Vec3(0.6 * std::cos(kTau * u), 0.6 * std::sin(kTau * u), 0); }},
      {"winding", false,
       [](double u) { return Vec3(-0.8 + 1.6 * u, 0.5 * std::sin(1.5 * kTau * u), 0); }},
      {"across", false, polyline({Vec3(-0.8, -0.7, 0), Vec3(0.2, 0.3, 0), Vec3(0.5, -0.6, 0)})}};
}

std::vector<Guide> guides(std::string_view shape) {
  if (shape == "sphere") return sphere_guides();
  if (shape == "torus") return torus_guides();
  if (shape == "cube" || shape == "rounded-cube" || shape == "noisy-cube") return cube_guides();
  if (shape == "cylinder") return cylinder_guides();
  if (shape == "trefoil") return trefoil_guides();
  if (shape == "plate") return plate_guides();
  if (shape == "hand") return hand_guides();
  if (shape == "double-torus") return double_torus_guides();
  if (shape == "moebius") return moebius_guides();
  if (shape == "grid") return grid_guides();
  if (shape == "two-spheres") return sphere_guides(0.45, Vec3(-0.55, 0, 0));
  throw Error(ErrorKind::invalid_input,
              "intended curves: no built-in shape is called '" + std::string(shape) + "'");
}

Intention mapped(const Guide& guide, const Target& target) {
  // Much denser than the result, so that the result can be chosen by length on the surface.
  constexpr int kSamples = 2048;
  const double spacing = 0.005 * target.diagonal();
  Intention curve{guide.name, guide.closed, {}};
  Vec3 previous = Vec3::Zero();
  SurfacePoint last;
  double travelled = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const Vec3 x = guide.path(static_cast<double>(i) / kSamples);
    const auto closest = target.closest_point(x, kInfinity, last.face);
    if (!closest) continue;
    last = closest->surface;
    if (!curve.points.empty()) travelled += (closest->position - previous).norm();
    previous = closest->position;
    if (curve.points.empty() || travelled >= spacing) {
      curve.points.push_back(last);
      travelled = 0;
    }
  }
  if (guide.closed) last = curve.points.front();
  // The end replaces a point that is closer to it than half a step.
  if (travelled < 0.5 * spacing && curve.points.size() > 1)
    curve.points.back() = last;
  else
    curve.points.push_back(last);
  return curve;
}

}  // namespace

std::vector<Intention> intended_curves(std::string_view shape, const Target& target) {
  std::vector<Intention> curves;
  const std::vector<Guide> paths = guides(shape);
  if (shape == "noisy-cube") {
    // Same faces as the plain cube of this resolution: closest points on spikes would jump.
    const int n = static_cast<int>(std::lround(std::sqrt(target.mesh().face_count() / 12.0)));
    if (n < 1 || 12 * n * n != target.mesh().face_count())
      throw Error(ErrorKind::invalid_input,
                  "intended curves: noisy-cube: the target has " +
                      std::to_string(target.mesh().face_count()) +
                      " faces, not 12 n^2; pass the mesh that make_shape gave");
    const Target cube(make_box(n, n, n, Vec3::Constant(kCubeHalfSize)));
    for (const Guide& guide : paths) curves.push_back(mapped(guide, cube));
    return curves;
  }
  for (const Guide& guide : paths) curves.push_back(mapped(guide, target));
  return curves;
}

}  // namespace mimicry
