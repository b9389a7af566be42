#pragma once

#include <optional>

#include "render/scene.h"

namespace mimicry::render {

/// A pinhole camera in the scene's units: `right`, `up`, `forward` are orthonormal.
struct Camera {
  Vec3 eye = Vec3::Zero();
  Vec3 right = Vec3::UnitX();
  Vec3 up = Vec3::UnitY();
  Vec3 forward = -Vec3::UnitZ();
  double tan_half_height = 0.2;  ///< tangent of half the vertical field of view

  /// Direction through pixel coordinates (x, y), not normalised: its component along `forward`
  /// is 1. Pixel centres have coordinates ending in .5, y runs down.
  Vec3 direction(double x, double y, int width, int height) const;
  /// Pixel coordinates of a point in front of the eye.
  Vec2 project(const Vec3& point, int width, int height) const;
};

struct CameraOptions {
  /// Where the viewer stands, in degrees: with y up, azimuth 0 on the +z side, turning toward +x;
  /// elevation above the horizon, -90..90 (any other up is reached from y by the shortest turn).
  /// Chosen automatically where absent.
  std::optional<double> azimuth_deg;
  std::optional<double> elevation_deg;
  double zoom = 1.0;                ///< > 0; 2 shows the middle twice as large
  double field_of_view_deg = 24.0;  ///< vertical, before zooming, 1..120
  double margin = 0.05;             ///< free border on each side, of the picture's size, 0..0.4
  double aspect = 1.25;             ///< width / height of the picture
};

/// The camera that shows all surfaces and tubes as large as fits. An absent angle is chosen so that
/// as many points as possible of the tubes are seen, from directions around it too, with a mild
/// preference for an elevation of 20 degrees; without tubes 30 and 20 degrees. Deterministic.
/// Throws Error(invalid_input) on an empty scene, values that are not finite, or options out of
/// range.
Camera choose_camera(const Scene& scene, const CameraOptions& options = {});

}  // namespace mimicry::render
