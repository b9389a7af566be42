#include "render/renderer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <thread>

#include <mimicry/base/parallel.h>

#include "render/checks.h"
#include "render/corner_normals.h"
#include "render/embree_scope.h"
#include "render/pixels.h"
#include "render/ray_scene.h"
#include "render/sampling.h"

namespace mimicry::render {
namespace {

// Lengths in the unit box (`RayScene`).
constexpr float kOcclusionReach = 0.35F;  // occluders farther than this do not darken
constexpr float kGroundReach = 0.22F;
constexpr float kLift = 2e-4F;  // start of secondary rays above the surface, clear of rounding

constexpr float kFilterRadius = 0.85F;  // of a pixel's samples, in pixels

constexpr std::uint32_t kTubeObject = 1U << 30;
constexpr std::uint32_t kGroundObject = 1U << 31;

float to_linear(double s) {
  return static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
}

Vec3f to_linear(const Color& c) {
  return {to_linear(c.r), to_linear(c.g), to_linear(c.b)};
}

std::uint8_t to_byte(float linear) {
  const float c = std::clamp(linear, 0.0F, 1.0F);
  const float s = c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255.0F * s));
}

void check(const Camera& camera) {
  if (!finite(camera.eye) || !finite(camera.right) || !finite(camera.up) ||
      !finite(camera.forward) || !positive(camera.tan_half_height)) {
    refuse("camera: position, axes and field of view must be finite");
  }
}

void check(const RenderOptions& options) {
  const auto require = [](double value, double low, double high, const char* name) {
    if (within(value, low, high)) return;
    refuse(std::string("picture: ") + name + " is " + std::to_string(value) + "; it must lie in " +
           std::to_string(low) + " to " + std::to_string(high));
  };
  require(options.width, 1, 16384, "the width");
  require(options.height, 1, 16384, "the height");
  require(options.samples, 1, 1024, "the number of samples");
  require(options.ao_samples, 0, 64, "the number of occlusion samples");
  require(options.threads, 0, kMostThreads, "the number of threads");
  require(options.ground, 0.0, 1.0, "the darkness of the ground");
  require(options.ghost, 0.0, 1.0, "the opacity of hidden tubes");
  require(options.crease_deg, 0.0, 180.0, "the crease angle");
}

class Renderer {
 public:
  Renderer(const Scene& scene, const Camera& camera, const RenderOptions& options)
      : scene_(scene), camera_(camera), options_(options), rays_(scene) {
    background_ = to_linear(options.background);
    eye_ = rays_.to_unit(camera.eye);
    key_ = (0.62 * -camera.forward + 0.62 * camera.up - 0.48 * camera.right)
               .normalized()
               .cast<float>();
    pixel_angle_ = static_cast<float>(2.0 * camera.tan_half_height / options.height);
    right_ = camera.right.cast<float>();
    up_ = camera.up.cast<float>();
    for (const Surface& s : scene.surfaces) {
      normals_.push_back(corner_normals(*s.mesh, options.crease_deg));
      surface_colors_.push_back(to_linear(s.color));
      iso_colors_.push_back(to_linear(s.iso_color));
    }
    for (const Tube& t : scene.tubes) {
      tube_colors_.push_back(to_linear(t.color));
      radii_.push_back(static_cast<float>(t.radius * rays_.scale()));
      widest_ = std::max(widest_, radii_.back());
    }
  }

  Pixel pixel(int x, int y) const;

 private:
  /// One point that a camera ray sees, ready to be lit.
  struct Point {
    std::uint32_t object = Layer::kNone;
    Vec3f position, normal, geometric;
    Vec3f lit = Vec3f::Zero(), ambient = Vec3f::Zero();
    Vec3f origin;  // of the occlusion rays
    float reach = kOcclusionReach;
  };

  Point see(const Vec3f& direction, float ground) const;
  void see_surface(const RayHit& hit, const Vec3f& direction, Point& p) const;
  void see_tube(const RayHit& hit, const Vec3f& direction, Point& p) const;
  void see_ground(const Vec3f& direction, float share, Point& p) const;
  float iso_line(const Surface& surface, std::size_t face, const Vec3f& bary,
                 const std::array<Vec3f, 3>& corners, const Vec3f& direction, float distance) const;
  bool escapes(const Point& p, const Vec3f& random) const;

  const Scene& scene_;
  const Camera& camera_;
  const RenderOptions& options_;
  RayScene rays_;
  Vec3f background_, eye_, key_, right_, up_;
  float pixel_angle_ = 0.0F;
  float widest_ = 0.0F;
  std::vector<std::vector<std::array<Vec3f, 3>>> normals_;  // per surface
  std::vector<Vec3f> surface_colors_, iso_colors_, tube_colors_;
  std::vector<float> radii_;
};

/// Coverage of the iso line nearest to a point, 0..1: lines keep their width in pixels whatever
/// the slant, and fade where they would run into each other.
float Renderer::iso_line(const Surface& surface, std::size_t face, const Vec3f& bary,
                         const std::array<Vec3f, 3>& corners, const Vec3f& direction,
                         float distance) const {
  const Face& f = surface.mesh->faces()[face];
  const auto value = [&](int k) {
    return surface.iso_values[static_cast<std::size_t>(f[static_cast<std::size_t>(k)])];
  };
  const double s =
      (bary[0] * value(0) + bary[1] * value(1) + bary[2] * value(2)) / surface.iso_spacing;
  const auto d1 = static_cast<float>((value(1) - value(0)) / surface.iso_spacing);
  const auto d2 = static_cast<float>((value(2) - value(0)) / surface.iso_spacing);
  const Vec3f e1 = corners[1] - corners[0];
  const Vec3f e2 = corners[2] - corners[0];
  const Vec3f n = e1.cross(e2);
  const float nn = n.squaredNorm();
  if (!(nn > 0.0F)) return 0.0F;
  const Vec3f gradient = (d1 * e2.cross(n) + d2 * n.cross(e1)) / nn;
  // How much the value changes from this pixel to the next along the face, right and up.
  const float slant = direction.dot(n);
  if (std::abs(slant) < 1e-6F * std::sqrt(nn)) return 0.0F;
  const float step = distance * pixel_angle_;
  const auto change = [&](const Vec3f& axis) {
    return gradient.dot(step * (axis - direction * (axis.dot(n) / slant)));
  };
  const float per_pixel = std::hypot(change(right_), change(up_));
  if (!(per_pixel > 1e-9F)) return 0.0F;
  const auto off = static_cast<float>(std::abs(s - std::round(s)));
  const float half_width = std::max(0.5F, 0.00075F * static_cast<float>(options_.height));
  const float crowding = 1.0F / (per_pixel * 2.0F * half_width);  // line distance / line width
  if (off > half_width * per_pixel) return 0.0F;
  return std::clamp((crowding - 1.5F) / 2.0F, 0.0F, 1.0F);
}

void Renderer::see_surface(const RayHit& hit, const Vec3f& direction, Point& p) const {
  const std::size_t s = hit.object;
  const std::size_t f = hit.primitive;
  const Surface& surface = scene_.surfaces[s];
  const Vec3f bary(1.0F - hit.u - hit.v, hit.u, hit.v);
  std::array<Vec3f, 3> corners;
  for (int k = 0; k < 3; ++k) {
    corners[static_cast<std::size_t>(k)] =
        rays_.to_unit(surface.mesh->corner(static_cast<Index>(f), k));
  }
  p.object = static_cast<std::uint32_t>(s);
  p.geometric = hit.normal.normalized();
  const auto& normals = normals_[s][f];
  const Vec3f mean = bary[0] * normals[0] + bary[1] * normals[1] + bary[2] * normals[2];
  p.normal = mean.norm() > 1e-3F ? mean.normalized() : p.geometric;
  // Both sides of a face are drawn; normals turn to the side that is seen.
  float side = 1.0F;
  if (p.geometric.dot(p.normal) < 0.0F) p.geometric = -p.geometric;
  if (p.geometric.dot(direction) > 0.0F) {
    side = -1.0F;
    p.geometric = -p.geometric;
    p.normal = -p.normal;
  }
  p.position = bary[0] * corners[0] + bary[1] * corners[1] + bary[2] * corners[2];
  // Occlusion rays start where the smooth surface that the normals speak of would be: flat faces
  // then cast no shadow on themselves (Hanika, Hacking the Shadow Terminator, 2021).
  Vec3f rounded = Vec3f::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f n = side * normals[k];
    const float below = (p.position - corners[k]).dot(n);
    if (below < 0.0F) rounded -= bary[static_cast<Eigen::Index>(k)] * below * n;
  }
  p.origin = p.position + rounded + kLift * p.geometric;

  Vec3f albedo = surface_colors_[s];
  if (!surface.iso_values.empty()) {
    const float line = iso_line(surface, f, bary, corners, direction, hit.distance);
    albedo += line * (iso_colors_[s] - albedo);
  }
  if (options_.ghost > 0.0 && !scene_.tubes.empty()) {
    // The buried half of a tube that lies on the surface is no hidden tube.
    const RayHit behind = rays_.first_tube(eye_, direction, hit.distance + 3.0F * widest_);
    if (behind.kind == RayHit::Kind::tube) {
      albedo += static_cast<float>(options_.ghost) * (tube_colors_[behind.object] - albedo);
    }
  }
  const float key = std::max(0.0F, 0.25F + 0.75F * p.normal.dot(key_));
  const float sky = 0.50F * (0.88F + 0.12F * p.normal.dot(rays_.up()));
  p.lit = albedo * (0.24F * key);
  p.ambient = albedo * (sky + 0.42F * key);
}

void Renderer::see_tube(const RayHit& hit, const Vec3f& direction, Point& p) const {
  p.object = kTubeObject + hit.object;
  p.normal = rays_.tube_normal(hit);
  if (p.normal.dot(direction) > 0.0F) p.normal = -p.normal;
  p.geometric = p.normal;
  p.position = eye_ + hit.distance * direction;
  p.origin = p.position + (kLift + 0.05F * radii_[hit.object]) * p.normal;
  const Vec3f& albedo = tube_colors_[hit.object];
  const float key = std::max(0.0F, 0.3F + 0.7F * p.normal.dot(key_));
  const Vec3f half = (key_ - direction.normalized()).normalized();
  const float gloss = 0.12F * std::pow(std::max(0.0F, p.normal.dot(half)), 30.0F);
  p.lit = albedo * (0.30F + 0.45F * key) + Vec3f::Constant(gloss);
  p.ambient = albedo * 0.35F;
}

void Renderer::see_ground(const Vec3f& direction, float share, Point& p) const {
  const Vec3f& up = rays_.up();
  const float height = eye_.dot(up) - rays_.floor();
  const float fall = direction.dot(up);
  if (options_.ground <= 0.0 || share <= 0.0F || height <= 0.0F || fall >= -1e-6F) return;
  const Vec3f at = eye_ - (height / fall) * direction;
  // Beyond reach of everything that stands in the unit box.
  if ((at - rays_.floor() * up).norm() > 0.5F + kGroundReach) return;
  p.object = kGroundObject;
  p.position = at;
  p.normal = p.geometric = up;
  p.origin = at + kLift * p.normal;
  p.reach = kGroundReach;
  const float dark = share * static_cast<float>(options_.ground);
  p.lit = background_ * (1.0F - dark);
  p.ambient = background_ * dark;
}

Renderer::Point Renderer::see(const Vec3f& direction, float ground) const {
  Point p;
  const RayHit hit = rays_.first_hit(eye_, direction);
  if (hit.kind == RayHit::Kind::surface) {
    see_surface(hit, direction, p);
  } else if (hit.kind == RayHit::Kind::tube) {
    see_tube(hit, direction, p);
  } else {
    see_ground(direction, ground, p);
  }
  if (p.object == Layer::kNone) p.lit = background_;
  return p;
}

/// Whether an occlusion ray gets away. Its length is random so that the weight of an occluder
/// falls with the square of its distance to nothing at `reach`.
bool Renderer::escapes(const Point& p, const Vec3f& random) const {
  Vec3f direction = cosine_direction(p.normal, random[0], random[1]);
  const float under = direction.dot(p.geometric);
  if (under < 0.0F) direction -= 2.0F * under * p.geometric;
  const float far = p.reach * std::sqrt(random[2]);
  // Tubes are signs, not things: they darken the ground alone.
  return p.object == kGroundObject ? !rays_.occluded(p.origin, direction, kLift, far)
                                   : !rays_.occluded_by_surface(p.origin, direction, kLift, far);
}

/// The layer for an object; null where both are taken by others.
Layer* layer_for(Pixel& pixel, std::uint32_t object) {
  for (Layer& layer : pixel.layers) {
    if (layer.object == Layer::kNone) layer.object = object;
    if (layer.object == object) return &layer;
  }
  return nullptr;
}

Pixel Renderer::pixel(int x, int y) const {
  const Sequence jitter;  // one pattern for all pixels: edges come out straight
  const Sequence light(x, y);
  // The shadow on the ground fades toward the border, where it would end abruptly.
  const int border = std::min({x, options_.width - 1 - x, y, options_.height - 1 - y});
  const float inside =
      std::min(1.0F, static_cast<float>(border) / (0.12F * static_cast<float>(options_.height)));
  const float ground = inside * inside * (3.0F - 2.0F * inside);

  Pixel pixel;
  std::uint32_t light_index = 0;
  int taken = 0;
  while (taken < options_.samples) {
    const Vec3f at = jitter(static_cast<std::uint32_t>(taken));
    const double at_x = x + 0.5 + static_cast<double>(kFilterRadius * tent(at[0]));
    const double at_y = y + 0.5 + static_cast<double>(kFilterRadius * tent(at[1]));
    const Vec3f direction =
        camera_.direction(at_x, at_y, options_.width, options_.height).cast<float>();
    const Point p = see(direction, ground);
    ++taken;
    pixel.lit += p.lit;
    if (p.object != Layer::kNone) {
      int open = 0;
      for (int k = 0; k < options_.ao_samples; ++k)
        open += escapes(p, light(light_index++)) ? 1 : 0;
      const float openness = options_.ao_samples > 0 ? static_cast<float>(open) /
                                                           static_cast<float>(options_.ao_samples)
                                                     : 1.0F;
      if (Layer* layer = layer_for(pixel, p.object)) {
        layer->weight += 1.0F;
        layer->openness += openness;
        layer->ambient += p.ambient;
        layer->normal += p.normal;
        layer->position += p.position;
      } else {
        pixel.lit += openness * p.ambient;
      }
    }
    // Where the first samples see nothing at all, the rest will not either.
    if (taken == 4 && pixel.layers[0].object == Layer::kNone) break;
  }
  const float share = 1.0F / static_cast<float>(taken);
  pixel.lit *= share;
  for (Layer& layer : pixel.layers) {
    if (layer.object == Layer::kNone) continue;
    layer.ambient *= share;
    layer.openness /= layer.weight;
    layer.position /= layer.weight;
    const float length = layer.normal.norm();
    if (length > 0.0F) layer.normal /= length;
  }
  return pixel;
}

/// Runs body(i) for i in first..end-1, each inside an `EmbreeScope`.
template <typename Body>
void for_each(Executor& executor, int first, int end, const Body& body) {
  const auto count = static_cast<std::size_t>(std::max(0, end - first));
  executor.for_chunks(count, 1, [&](std::size_t i, std::size_t, int) {
    const EmbreeScope scope;
    body(first + static_cast<int>(i));
  });
}

}  // namespace

Image render(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  check(scene);
  check(camera);
  check(options);
  const int hardware = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  Executor executor(options.threads > 0 ? options.threads : hardware);
  const int width = options.width;
  const int height = options.height;

  const EmbreeScope scope;
  const Renderer renderer(scene, camera, options);
  // Bands of rows, so that only some are held at a time: a pixel is 20 times its colour.
  std::vector<std::vector<Pixel>> rows(static_cast<std::size_t>(height));
  Image image(width, height, options.background);
  constexpr int kBand = 128;
  int colored = 0;
  for (int band = 0; band < height; band += kBand) {
    const int band_end = std::min(height, band + kBand);
    for_each(executor, band, band_end, [&](int y) {
      std::vector<Pixel>& row = rows[static_cast<std::size_t>(y)];
      row.resize(static_cast<std::size_t>(width));
      for (int x = 0; x < width; ++x) row[static_cast<std::size_t>(x)] = renderer.pixel(x, y);
    });
    const int ready = band_end == height ? height : band_end - kSmoothingReach;
    for_each(executor, colored, ready, [&](int y) {
      for (int x = 0; x < width; ++x) {
        const Vec3f color = smoothed_color(rows, x, y);
        assert(color.allFinite());
        std::uint8_t* out = image.pixel(x, y);
        for (int c = 0; c < 3; ++c) out[c] = to_byte(color[c]);
      }
    });
    for (int y = std::max(0, colored - kSmoothingReach); y < ready - kSmoothingReach; ++y) {
      std::vector<Pixel>().swap(rows[static_cast<std::size_t>(y)]);
    }
    colored = ready;
  }
  return image;
}

}  // namespace mimicry::render
