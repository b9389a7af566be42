#pragma once

#include <memory>
#include <vector>

#include <embree3/rtcore.h>

#include "render/scene.h"

namespace mimicry::render {

using Vec3f = Eigen::Vector3f;

/// What a ray meets. `normal` is the geometric one, not normalised, pointing to either side.
struct RayHit {
  enum class Kind { nothing, surface, tube };
  Kind kind = Kind::nothing;
  std::uint32_t object = 0;     ///< number of the surface or tube
  std::uint32_t primitive = 0;  ///< face or segment
  float distance = 0.0F;        ///< in lengths of the ray's direction
  float u = 0.0F, v = 0.0F;     ///< barycentric coordinates of corners 1 and 2; along the tube: u
  Vec3f normal = Vec3f::Zero();
};

/// The scene in Embree, moved and scaled into a box of diagonal 1 around the origin: single
/// precision then serves meshes of any size anywhere. Queries are thread-safe; make it, query it
/// and end it inside an `EmbreeScope`.
class RayScene {
 public:
  /// The scene must have passed `check` and outlive this.
  explicit RayScene(const Scene& scene);

  Vec3f to_unit(const Vec3& p) const { return ((p - center_) * scale_).cast<float>(); }
  double scale() const { return scale_; }
  const Vec3f& up() const { return up_; }
  /// Height of the lowest point along `up`, in the unit box.
  float floor() const { return floor_; }
  /// Unit normal of a tube where a ray hit it, smooth across the joints of its segments.
  Vec3f tube_normal(const RayHit& hit) const;

  RayHit first_hit(const Vec3f& origin, const Vec3f& direction, float near = 0.0F) const;
  /// The first tube within `far`, whatever surfaces lie before it; nothing's kind on a miss.
  RayHit first_tube(const Vec3f& origin, const Vec3f& direction, float near) const;
  bool occluded(const Vec3f& origin, const Vec3f& direction, float near, float far) const;
  /// The same against surfaces alone.
  bool occluded_by_surface(const Vec3f& origin, const Vec3f& direction, float near,
                           float far) const;

 private:
  struct Release {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  using Geometry = std::unique_ptr<RTCSceneTy, Release>;

  void add(const Surface& surface, std::uint32_t number);
  void add(const Tube& tube, std::uint32_t number);
  void attach(RTCGeometry geometry, std::uint32_t id, RTCScene own);
  RayHit query(RTCScene scene, const Vec3f& origin, const Vec3f& direction, float near) const;

  Vec3 center_;
  double scale_ = 1.0;
  Vec3f up_ = Vec3f::UnitY();
  float floor_ = 0.0F;
  std::uint32_t surface_count_ = 0;
  std::vector<std::vector<Vec3f>> tangents_;  // per tube, per point that is kept
  Geometry all_, surfaces_, tubes_;
};

}  // namespace mimicry::render
