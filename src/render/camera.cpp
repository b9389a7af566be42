#include "render/camera.h"

#include <array>
#include <cmath>
#include <numbers>

#include "render/checks.h"
#include "render/embree_scope.h"
#include "render/ray_scene.h"

namespace mimicry::render {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Axes {
  Vec3 right, up, to_viewer;
};

Axes axes(const Vec3& up, double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kDegree;
  const double e = elevation_deg * kDegree;
  const Quat turn = Quat::FromTwoVectors(Vec3::UnitY(), up);
  Axes result;
  result.right = turn * Vec3(std::cos(a), 0.0, -std::sin(a));
  result.to_viewer = turn * Vec3(std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e));
  result.up = result.to_viewer.cross(result.right);
  return result;
}

void check(const CameraOptions& options) {
  const auto refuse_unless = [](bool good, const char* message) {
    if (!good) refuse(message);
  };
  refuse_unless(!options.azimuth_deg || std::isfinite(*options.azimuth_deg),
                "camera: the azimuth must be finite");
  refuse_unless(!options.elevation_deg || within(*options.elevation_deg, -90.0, 90.0),
                "camera: the elevation must lie in -90..90 degrees");
  refuse_unless(positive(options.zoom), "camera: the zoom must be positive and finite");
  refuse_unless(within(options.field_of_view_deg, 1.0, 120.0),
                "camera: the field of view must lie in 1..120 degrees");
  refuse_unless(within(options.margin, 0.0, 0.4), "camera: the margin must lie in 0..0.4");
  refuse_unless(within(options.aspect, 0.01, 100.0), "camera: the aspect must lie in 0.01..100");
}

struct Sample {
  Vec3f point;
  double weight;
};

/// At most about 240 points of all tubes that count, evenly by number.
std::vector<Sample> tube_samples(const Scene& scene, const RayScene& rays) {
  std::size_t total = 0;
  for (const Tube& tube : scene.tubes) {
    if (tube.camera_weight > 0.0) total += tube.points.size();
  }
  const std::size_t step = total / 240 + 1;
  std::vector<Sample> samples;
  for (const Tube& tube : scene.tubes) {
    if (!(tube.camera_weight > 0.0)) continue;
    for (std::size_t i = (tube.points.size() % step) / 2; i < tube.points.size(); i += step) {
      samples.push_back({rays.to_unit(tube.points[i]), tube.camera_weight});
    }
  }
  return samples;
}

struct Angles {
  double azimuth_deg, elevation_deg;
};

Angles choose_angles(const Scene& scene, const CameraOptions& options) {
  if (options.azimuth_deg && options.elevation_deg) {
    return {*options.azimuth_deg, *options.elevation_deg};
  }
  const EmbreeScope scope;
  const RayScene rays(scene);
  const std::vector<Sample> samples = tube_samples(scene, rays);
  if (samples.empty()) {
    return {options.azimuth_deg.value_or(30.0), options.elevation_deg.value_or(20.0)};
  }
  double total = 0.0;
  for (const Sample& s : samples) total += s.weight;

  constexpr int kAzimuths = 24;
  constexpr double kAzimuthStep = 360.0 / kAzimuths;
  constexpr std::array kElevations = {-25.0, -10.0, 5.0, 20.0, 35.0, 50.0, 65.0};
  constexpr int kRows = static_cast<int>(kElevations.size());
  // Where the ray starts ahead of the point: clear of rounding and of the curve's own faces.
  constexpr float kAhead = 1e-3F;
  const auto azimuth_at = [&](int a) { return options.azimuth_deg.value_or(a * kAzimuthStep); };
  const auto elevation_at = [&](int e) {
    return options.elevation_deg.value_or(kElevations[static_cast<std::size_t>(e)]);
  };

  std::array<std::array<double, kAzimuths>, kElevations.size()> seen{};
  for (int e = 0; e < kRows; ++e) {
    for (int a = 0; a < kAzimuths; ++a) {
      const Vec3f direction =
          axes(scene.up, azimuth_at(a), elevation_at(e)).to_viewer.cast<float>();
      double weight = 0.0;
      for (const Sample& s : samples) {
        if (!rays.occluded_by_surface(s.point, direction, kAhead, 4.0F)) weight += s.weight;
      }
      seen[static_cast<std::size_t>(e)][static_cast<std::size_t>(a)] = weight / total;
    }
  }

  // What is seen from the directions around a candidate counts as much as what is seen from
  // itself: the curve then faces the viewer instead of just showing at the rim.
  Angles best{0.0, 0.0};
  double best_score = -kInfinity;
  for (int e = 0; e < kRows; ++e) {
    for (int a = 0; a < kAzimuths; ++a) {
      double around = 0.0;
      double weights = 0.0;
      for (int de = -3; de <= 3; ++de) {
        if (e + de < 0 || e + de >= kRows) continue;
        for (int da = -3; da <= 3; ++da) {
          const double w = std::exp(-(de * de + da * da) / 6.0);
          around += w * seen[static_cast<std::size_t>(e + de)]
                            [static_cast<std::size_t>((a + da + kAzimuths) % kAzimuths)];
          weights += w;
        }
      }
      const double off = (elevation_at(e) - 20.0) / 60.0;
      const double score = 0.5 * seen[static_cast<std::size_t>(e)][static_cast<std::size_t>(a)] +
                           0.5 * around / weights - 0.2 * off * off -
                           (elevation_at(e) < 0.0 ? 0.1 : 0.0);
      // A margin far above rounding: ties go to the first candidate on every machine.
      if (score > best_score + 1e-9) {
        best_score = score;
        best = {azimuth_at(a), elevation_at(e)};
      }
    }
  }
  return best;
}

/// The eye on the line of sight from which everything just fits the frame: for each side of the
/// frame, x - eye_x <= tan (depth - eye_depth) for all points, which is linear in the eye.
class Fit {
 public:
  Fit(const Axes& frame, const Vec3& center, double tan_x, double tan_y)
      : axes_(frame), center_(center), tan_x_(tan_x), tan_y_(tan_y) {}

  void add(const Vec3& p, double radius) {
    const Vec3 q = p - center_;
    const double x = axes_.right.dot(q);
    const double y = axes_.up.dot(q);
    const double depth = -axes_.to_viewer.dot(q);
    // A ball touches a frame plane where its centre is radius * sqrt(1 + tan^2) inside.
    const double rx = radius * std::sqrt(1.0 + tan_x_ * tan_x_);
    const double ry = radius * std::sqrt(1.0 + tan_y_ * tan_y_);
    right_ = std::max(right_, x + rx - tan_x_ * depth);
    left_ = std::max(left_, -x + rx - tan_x_ * depth);
    top_ = std::max(top_, y + ry - tan_y_ * depth);
    bottom_ = std::max(bottom_, -y + ry - tan_y_ * depth);
    nearest_ = std::min(nearest_, depth - radius);
  }

  Vec3 eye(double size) const {
    const double depth = std::min({-(right_ + left_) / (2.0 * tan_x_),
                                   -(top_ + bottom_) / (2.0 * tan_y_), nearest_ - 0.05 * size});
    return center_ + 0.5 * (right_ - left_) * axes_.right + 0.5 * (top_ - bottom_) * axes_.up -
           depth * axes_.to_viewer;
  }

 private:
  Axes axes_;
  Vec3 center_;
  double tan_x_, tan_y_;
  double right_ = -kInfinity, left_ = -kInfinity, top_ = -kInfinity, bottom_ = -kInfinity;
  double nearest_ = kInfinity;
};

}  // namespace

Vec3 Camera::direction(double x, double y, int width, int height) const {
  const double unit = 2.0 * tan_half_height / height;
  return forward + (x - 0.5 * width) * unit * right - (y - 0.5 * height) * unit * up;
}

Vec2 Camera::project(const Vec3& point, int width, int height) const {
  const Vec3 q = point - eye;
  const double per_unit = height / (2.0 * tan_half_height * forward.dot(q));
  return {0.5 * width + right.dot(q) * per_unit, 0.5 * height - up.dot(q) * per_unit};
}

Camera choose_camera(const Scene& scene, const CameraOptions& options) {
  check(scene);
  check(options);
  const Angles angles = choose_angles(scene, options);
  const Axes frame = axes(scene.up, angles.azimuth_deg, angles.elevation_deg);
  const double tan_half = std::tan(0.5 * options.field_of_view_deg * kDegree);
  const double inner = 1.0 - 2.0 * options.margin;
  const Eigen::AlignedBox3d box = bounds(scene);
  Fit fit(frame, box.center(), tan_half * options.aspect * inner, tan_half * inner);
  for_each_point(scene, [&](const Vec3& p, double radius) { fit.add(p, radius); });
  Camera camera;
  camera.eye = fit.eye(box.diagonal().norm());
  camera.right = frame.right;
  camera.up = frame.up;
  camera.forward = -frame.to_viewer;
  camera.tan_half_height = tan_half / options.zoom;
  return camera;
}

}  // namespace mimicry::render
