#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>

#include "base/comma_list.h"

namespace mimicry {
namespace {

TriangleMesh plate(int n) {
  // Quads as square as the thickness allows.
  return make_box(n, std::max(1, n * 3 / 4), 1,
                  Vec3(kPlateHalfWidth, kPlateHalfHeight, kPlateHalfThickness));
}

using Options = ShapeOptions;

const ShapeInfo kShapes[] = {
    {"sphere", "sphere (subdivided icosahedron)", "parts of an icosahedron's edge, 20 n^2 faces",
     24, 1, 500, 0.2, [](const Options& o) { return make_sphere(o.resolution); }},
    {"torus", "torus around the z axis",
     "quads around the tube, 3 n along it: 6 n^2 faces (120: the 86,400-face mesh)", 40, 3, 900,
     0.2, [](const Options& o) { return make_torus(3 * o.resolution, o.resolution); }},
    {"cube", "cube with sharp edges", "quads along an edge, 12 n^2 faces", 16, 1, 600, 0.25,
     [](const Options& o) {
       return make_box(o.resolution, o.resolution, o.resolution, Vec3::Constant(kCubeHalfSize));
     }},
    {"rounded-cube", "cube with rounded edges and corners", "quads along an edge, 12 n^2 faces", 24,
     2, 600, 0.25, [](const Options& o) { return make_rounded_cube(o.resolution); }},
    {"cylinder", "closed cylinder around the y axis",
     "rings of a cap, 6 n segments around, about 52 n^2 faces", 12, 1, 300, 0.2,
     [](const Options& o) { return make_cylinder(o.resolution); }},
    {"trefoil", "tube around a trefoil knot", "quads around the tube, 10 n along it: 20 n^2 faces",
     20, 3, 500, 0.2, [](const Options& o) { return make_trefoil(o.resolution); }},
    {"plate", "thin closed plate that faces z, 2 x 1.5 x 0.04", "quads along x, about 3 n^2 faces",
     48, 1, 1200, 0.2, [](const Options& o) { return plate(o.resolution); }},
    {"hand", "palm with five thin fingers, genus 0", "subdivision steps, 4 times the faces each", 3,
     1, 6, 0.25, [](const Options& o) { return make_hand(o.resolution); }},
    {"double-torus", "two handles, genus 2", "subdivision steps, 4 times the faces each", 4, 1, 7,
     0.2, [](const Options& o) { return make_double_torus(o.resolution); }},
    {"noisy-cube", "cube with vertices moved at random along their normals",
     "quads along an edge, 12 n^2 faces", 16, 1, 600, 0.25,
     [](const Options& o) { return make_noisy_cube(o.resolution, o.noise, o.two_sided, o.seed); }},
    {"moebius", "Moebius strip: one-sided, with boundary", "quads along the strip", 96, 4, 2000,
     0.25, [](const Options& o) { return make_moebius_strip(o.resolution); }},
    {"grid", "open square that faces z: with boundary", "quads along an edge, 2 n^2 faces", 48, 1,
     1500, 0.2, [](const Options& o) { return make_grid(o.resolution); }},
    {"two-spheres", "two spheres side by side: two components",
     "parts of an icosahedron's edge, 40 n^2 faces", 12, 1, 350, 0.25,
     [](const Options& o) { return make_two_spheres(o.resolution); }},
};

// The surface point of a solid box closest to x.
Vec3 closest_on_box(const Vec3& x, const Vec3& half_size) {
  Vec3 clamped = x.cwiseMax(-half_size).cwiseMin(half_size);
  if (clamped != x) return clamped;
  int axis = 0;
  (half_size - x.cwiseAbs()).minCoeff(&axis);
  clamped[axis] = x[axis] < 0 ? -half_size[axis] : half_size[axis];
  return clamped;
}

Vec3 direction_or(const Vec3& v, const Vec3& otherwise) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : otherwise;
}

}  // namespace

std::span<const ShapeInfo> builtin_shapes() {
  return kShapes;
}

const ShapeInfo* find_shape(std::string_view name) {
  for (const ShapeInfo& shape : kShapes)
    if (shape.name == name) return &shape;
  return nullptr;
}

TriangleMesh make_shape(std::string_view name, const ShapeOptions& options) {
  const ShapeInfo* shape = find_shape(name);
  const std::string thing = "shape " + std::string(name) + ": ";
  if (shape == nullptr)
    throw Error(ErrorKind::invalid_input,
                thing + "unknown; known are " +
                    comma_list(kShapes, [](const ShapeInfo& s) { return s.name; }));
  ShapeOptions valid = options;
  if (valid.resolution == 0) valid.resolution = shape->default_resolution;
  if (valid.resolution < shape->least_resolution || valid.resolution > shape->most_resolution)
    throw Error(ErrorKind::invalid_input, thing + "resolution " + std::to_string(valid.resolution) +
                                              " is not within " +
                                              std::to_string(shape->least_resolution) + " to " +
                                              std::to_string(shape->most_resolution) + " (" +
                                              std::string(shape->resolution) + ")");
  if (!std::isfinite(valid.noise) || valid.noise < 0 || valid.noise > 1)
    throw Error(ErrorKind::invalid_input,
                thing + "noise " + std::to_string(valid.noise) +
                    " is not within 0 to 1 (a fraction of the cube's edge)");
  return shape->make(valid);
}

std::optional<Vec3> analytic_closest_point(std::string_view name, const Vec3& x) {
  if (name == "sphere") return kSphereRadius * direction_or(x, Vec3::UnitX());
  if (name == "torus") {
    const Vec3 core = kTorusMajorRadius * direction_or(Vec3(x[0], x[1], 0), Vec3::UnitX());
    return core + kTorusMinorRadius * direction_or(x - core, Vec3::UnitZ());
  }
  if (name == "cube") return closest_on_box(x, Vec3::Constant(kCubeHalfSize));
  if (name == "plate")
    return closest_on_box(x, Vec3(kPlateHalfWidth, kPlateHalfHeight, kPlateHalfThickness));
  if (name == "rounded-cube") {
    const Vec3 inner = Vec3::Constant(kCubeHalfSize - kRoundedCubeRadius);
    const Vec3 core = x.cwiseMax(-inner).cwiseMin(inner);
    if (core == x) return closest_on_box(x, Vec3::Constant(kCubeHalfSize));
    return core + kRoundedCubeRadius * (x - core).normalized();
  }
  if (name == "cylinder") {
    // In the half-plane of x and the axis the solid is a rectangle.
    const Vec3 out = direction_or(Vec3(x[0], 0, x[2]), Vec3::UnitX());
    double r = std::hypot(x[0], x[2]), y = x[1];
    const bool inside = r <= kCylinderRadius && std::abs(y) <= kCylinderHalfHeight;
    if (!inside) {
      r = std::min(r, kCylinderRadius);
      y = std::clamp(y, -kCylinderHalfHeight, kCylinderHalfHeight);
    } else if (kCylinderRadius - r <= kCylinderHalfHeight - std::abs(y)) {
      r = kCylinderRadius;
    } else {
      y = y < 0 ? -kCylinderHalfHeight : kCylinderHalfHeight;
    }
    return r * out + Vec3(0, y, 0);
  }
  return std::nullopt;
}

std::optional<double> faceting_error(std::string_view name, int resolution) {
  const double n = resolution;
  const double pi = std::numbers::pi;
  const auto sagitta = [](double radius, double half_angle) {
    return radius * (1 - std::cos(half_angle));
  };
  if (name == "cube" || name == "plate") return 0.0;
  if (name == "sphere") {
    // A flat icosahedron's edge (1.0515 R) is stretched by at most 1 / 0.7558 from the flat face to
    // the sphere; an acute triangle with edges <= h has a circumradius <= h / sqrt(3).
    const double circumradius = std::min(1.0, 1.3912 / n / std::sqrt(3.0));
    return kSphereRadius * (1 - std::sqrt(1 - circumradius * circumradius));
  }
  if (name == "torus")
    return sagitta(kTorusMajorRadius + kTorusMinorRadius, pi / (3 * n)) +
           sagitta(kTorusMinorRadius, pi / n);
  if (name == "cylinder") return sagitta(kCylinderRadius, pi / (6 * n));
  if (name == "rounded-cube") {
    // A step of the flat grid turns the normal by at most step / radius in each direction.
    const double half_step = kCubeHalfSize / n / kRoundedCubeRadius;
    return half_step > 1 ? kRoundedCubeRadius : 2 * sagitta(kRoundedCubeRadius, half_step);
  }
  return std::nullopt;
}

}  // namespace mimicry
