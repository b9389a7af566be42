#include "capi/handles.h"

#include <cmath>

#include "geodesic/site.h"

namespace mimicry::capi {
namespace {

thread_local std::string last_error;

Quat quaternion(const double* q) {
  return {q[3], q[0], q[1], q[2]};
}

void put(double* to, const Quat& q) {
  for (int k = 0; k < 4; ++k) to[k] = q.coeffs()[k];
}

}  // namespace

mimicry_status fail(mimicry_status status, const char* message) noexcept {
  try {
    last_error = message;
  } catch (...) {
    last_error.clear();
  }
  return status;
}

ProgressCallback to_callback(mimicry_progress progress, void* user) {
  if (!progress) return {};
  return [progress, user](const Progress& p) {
    return progress(user, std::string(p.stage).c_str(), p.fraction) != 0;
  };
}

Similarity to_similarity(const mimicry_similarity* similarity) {
  require(similarity, "model_to_world");
  Stroke placed;
  placed.id = "model_to_world";
  placed.model_to_world = {quaternion(similarity->rotation), vec3(similarity->translation),
                           similarity->scale};
  require_usable(placed);
  return placed.model_to_world;
}

mimicry_similarity from_similarity(const Similarity& similarity) {
  mimicry_similarity s{};
  put(s.rotation, similarity.rotation);
  capi::put(s.translation, similarity.translation);
  s.scale = similarity.scale;
  return s;
}

Frame to_frame(const mimicry_frame& frame) {
  Frame f;
  f.time_s = frame.time_s;
  f.head = {vec3(frame.head_position), quaternion(frame.head_orientation)};
  f.controller = {vec3(frame.controller_position), quaternion(frame.controller_orientation)};
  f.trigger = frame.trigger;
  if (!(frame.pressure < 0.0)) f.pressure = frame.pressure;
  return f;
}

mimicry_frame from_frame(const Frame& frame) {
  mimicry_frame f{};
  f.time_s = frame.time_s;
  capi::put(f.head_position, frame.head.position);
  put(f.head_orientation, frame.head.orientation);
  capi::put(f.controller_position, frame.controller.position);
  put(f.controller_orientation, frame.controller.orientation);
  f.trigger = frame.trigger;
  f.pressure = frame.pressure.value_or(-1.0);
  return f;
}

mimicry_surface_point from_point(const Target& target, const SurfacePoint& p, const Vec3& position,
                                 double distance) {
  mimicry_surface_point out{};
  put(out.position, position);
  put(out.normal, target.normal(p));
  put(out.barycentric, source_point(target.mesh(), p).bary);
  out.distance = distance;
  out.face = p.face;
  return out;
}

SurfacePoint to_point(const Target& target, const mimicry_surface_point& point,
                      const std::string& what) {
  const SurfacePoint p{point.face, vec3(point.barycentric)};
  check_surface_point(target.mesh(), p, what);
  if (repeats_corner(target.mesh().face(p.face)))
    throw Error(ErrorKind::invalid_input,
                what + ": face " + std::to_string(p.face) +
                    " was left out of the surface (mimicry_target_notes); choose another face");
  return source_point(target.mesh(), normalised(p));
}

std::vector<SurfacePoint> to_points(const Target& target, const mimicry_surface_point* points,
                                    std::size_t count, const char* what) {
  if (count > 0) require(points, what);
  std::vector<SurfacePoint> result;
  result.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(to_point(target, points[i], std::string(what) + ' ' + std::to_string(i)));
  return result;
}

Stroke to_stroke(const mimicry_similarity* model_to_world, const mimicry_frame* frames,
                 std::size_t count) {
  if (count > 0) require(frames, "frames");
  Stroke stroke;
  stroke.model_to_world = to_similarity(model_to_world);
  stroke.frames.reserve(count);
  for (std::size_t i = 0; i < count; ++i) stroke.frames.push_back(to_frame(frames[i]));
  require_usable(stroke);
  return stroke;
}

void require_positive(double value, const char* what) {
  if (!std::isfinite(value) || value <= 0.0)
    throw Error(ErrorKind::invalid_input,
                std::string(what) + " is " + std::to_string(value) + "; give a number above 0");
}

}  // namespace mimicry::capi

const char* mimicry_last_error(void) {
  return mimicry::capi::last_error.c_str();
}

int32_t mimicry_abi_version(void) {
  return MIMICRY_ABI_VERSION;
}

const uint8_t* mimicry_bytes_data(const mimicry_bytes* bytes) {
  return bytes ? reinterpret_cast<const uint8_t*>(bytes->content.data()) : nullptr;
}
size_t mimicry_bytes_size(const mimicry_bytes* bytes) {
  return bytes ? bytes->content.size() : 0;
}
void mimicry_bytes_destroy(mimicry_bytes* bytes) {
  delete bytes;
}
