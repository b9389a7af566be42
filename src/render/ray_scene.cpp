#include "render/ray_scene.h"

#include <limits>

#include "render/checks.h"

namespace mimicry::render {
namespace {

RTCRay make_ray(const Vec3f& origin, const Vec3f& direction, float near, float far) {
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = near;
  ray.tfar = far;
  ray.mask = ~0U;
  return ray;
}

bool occluded_in(RTCScene scene, const Vec3f& origin, const Vec3f& direction, float near,
                 float far) {
  RTCRay ray = make_ray(origin, direction, near, far);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
  return ray.tfar < 0.0F;
}

// One thread: pictures spread their own threads over tiles, and builds of this size are short.
// There is one for the program's life. Where the last one goes its scheduler starts threads that
// nobody needs, and ends the program if the system has none to give.
RTCDevice device() {
  static RTCDevice const kept = rtcNewDevice("threads=1,set_affinity=0");
  return kept;
}

/// Points nearer than this fraction of the radius make no visible difference, and joints between
/// them would be rounding noise.
constexpr float kMinStep = 0.02F;

/// Means of the directions of the segments on either side, unit or zero.
std::vector<Vec3f> tangents(const std::vector<Vec3f>& points) {
  std::vector<Vec3f> result(points.size(), Vec3f::Zero());
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3f along = (points[i + 1] - points[i]).normalized();
    result[i] += along;
    result[i + 1] += along;
  }
  for (Vec3f& t : result) t = t.norm() > 1e-3F ? t.normalized() : Vec3f::Zero();
  return result;
}

}  // namespace

RayScene::RayScene(const Scene& scene) {
  const Eigen::AlignedBox3d box = bounds(scene);
  center_ = 0.5 * (box.min() + box.max());
  const double diagonal = (box.max() - box.min()).norm();
  if (!positive(diagonal) || !std::isfinite(1.0 / diagonal)) {
    refuse("scene: all points coincide or are too far apart; its size must be a positive number");
  }
  scale_ = 1.0 / diagonal;
  up_ = scene.up.cast<float>();
  double lowest = kInfinity;
  for_each_point(scene, [&](const Vec3& p, double radius) {
    lowest = std::min(lowest, scene.up.dot(p - center_) - radius);
  });
  floor_ = static_cast<float>(lowest * scale_);

  if (!device()) throw Error(ErrorKind::unsupported, "Embree: the device cannot be made here");
  (void)rtcGetDeviceError(device());  // of a scene that was given up
  all_.reset(rtcNewScene(device()));
  surfaces_.reset(rtcNewScene(device()));
  tubes_.reset(rtcNewScene(device()));
  for (RTCScene s : {all_.get(), surfaces_.get(), tubes_.get()}) {
    rtcSetSceneBuildQuality(s, RTC_BUILD_QUALITY_HIGH);
    rtcSetSceneFlags(s, RTC_SCENE_FLAG_ROBUST);
  }
  surface_count_ = static_cast<std::uint32_t>(scene.surfaces.size());
  for (std::uint32_t s = 0; s < surface_count_; ++s) add(scene.surfaces[s], s);
  for (std::uint32_t t = 0; t < scene.tubes.size(); ++t) add(scene.tubes[t], surface_count_ + t);
  for (RTCScene s : {all_.get(), surfaces_.get(), tubes_.get()}) rtcCommitScene(s);
  if (const RTCError error = rtcGetDeviceError(device()); error != RTC_ERROR_NONE) {
    throw Error(ErrorKind::unsupported,
                "Embree: the scene cannot be built, error " + std::to_string(error));
  }
}

void RayScene::attach(RTCGeometry geometry, std::uint32_t id, RTCScene own) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(all_.get(), geometry, id);
  rtcAttachGeometryByID(own, geometry, id);
  rtcReleaseGeometry(geometry);
}

void RayScene::add(const Surface& surface, std::uint32_t number) {
  const TriangleMesh& mesh = *surface.mesh;
  if (mesh.face_count() == 0) return;
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), static_cast<std::size_t>(mesh.vertex_count())));
  auto* faces = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), static_cast<std::size_t>(mesh.face_count())));
  if (vertices == nullptr || faces == nullptr) throw std::bad_alloc();
  for (const Vec3& p : mesh.positions()) {
    // Only vertices without a face may be non-finite here; they are never read.
    const Vec3f q = finite(p) ? to_unit(p) : Vec3f::Zero();
    vertices = std::copy_n(q.data(), 3, vertices);
  }
  for (const Face& face : mesh.faces()) {
    for (const Index v : face) *faces++ = static_cast<unsigned>(v);
  }
  attach(geometry, number, surfaces_.get());
}

void RayScene::add(const Tube& tube, std::uint32_t number) {
  if (tube.points.empty()) {
    tangents_.emplace_back();
    return;
  }
  // Where tubes coincide the first is seen, not a random mix: each is a little thinner than the one
  // before.
  const double thinner = 1.0 - 0.004 * std::min(25U, number - surface_count_);
  const auto radius = static_cast<float>(tube.radius * scale_ * thinner);
  std::vector<Vec3f> points;
  for (const Vec3& p : tube.points) {
    const Vec3f q = to_unit(p);
    if (points.empty() || (q - points.back()).norm() > kMinStep * radius) points.push_back(q);
  }
  const bool ball = points.size() == 1;
  tangents_.push_back(tangents(points));
  RTCGeometry geometry = rtcNewGeometry(
      device(), ball ? RTC_GEOMETRY_TYPE_SPHERE_POINT : RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), points.size()));
  if (vertices == nullptr) throw std::bad_alloc();
  for (const Vec3f& p : points) {
    vertices = std::copy_n(p.data(), 3, vertices);
    *vertices++ = radius;
  }
  if (!ball) {
    const std::size_t segments = points.size() - 1;
    auto* starts = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), segments));
    auto* flags = static_cast<unsigned char*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, 1, segments));
    if (starts == nullptr || flags == nullptr) throw std::bad_alloc();
    for (std::size_t i = 0; i < segments; ++i) {
      starts[i] = static_cast<unsigned>(i);
      flags[i] = static_cast<unsigned char>((i > 0 ? RTC_CURVE_FLAG_NEIGHBOR_LEFT : 0) |
                                            (i + 1 < segments ? RTC_CURVE_FLAG_NEIGHBOR_RIGHT : 0));
    }
  }
  attach(geometry, number, tubes_.get());
}

Vec3f RayScene::tube_normal(const RayHit& hit) const {
  const Vec3f normal = hit.normal.normalized();
  const std::vector<Vec3f>& along = tangents_[hit.object];
  if (hit.primitive + 1 >= along.size()) return normal;
  const Vec3f t = (1.0F - hit.u) * along[hit.primitive] + hit.u * along[hit.primitive + 1];
  const float length = t.norm();
  if (length < 0.5F) return normal;
  const float share = normal.dot(t) / length;
  // Caps and the outside of sharp bends keep their own normal.
  if (std::abs(share) > 0.5F) return normal;
  return (normal - (share / length) * t).normalized();
}

RayHit RayScene::query(RTCScene scene, const Vec3f& origin, const Vec3f& direction,
                       float near) const {
  RTCRayHit ray{};
  ray.ray = make_ray(origin, direction, near, std::numeric_limits<float>::infinity());
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
  RayHit hit;
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  const bool tube = ray.hit.geomID >= surface_count_;
  hit.kind = tube ? RayHit::Kind::tube : RayHit::Kind::surface;
  hit.object = tube ? ray.hit.geomID - surface_count_ : ray.hit.geomID;
  hit.primitive = ray.hit.primID;
  hit.distance = ray.ray.tfar;
  hit.u = ray.hit.u;
  hit.v = ray.hit.v;
  hit.normal = Vec3f(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
  return hit;
}

RayHit RayScene::first_hit(const Vec3f& origin, const Vec3f& direction, float near) const {
  return query(all_.get(), origin, direction, near);
}

RayHit RayScene::first_tube(const Vec3f& origin, const Vec3f& direction, float near) const {
  return query(tubes_.get(), origin, direction, near);
}

bool RayScene::occluded(const Vec3f& origin, const Vec3f& direction, float near, float far) const {
  return occluded_in(all_.get(), origin, direction, near, far);
}

bool RayScene::occluded_by_surface(const Vec3f& origin, const Vec3f& direction, float near,
                                   float far) const {
  return occluded_in(surfaces_.get(), origin, direction, near, far);
}

}  // namespace mimicry::render
