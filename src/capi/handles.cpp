#include "capi/handles.h"

#include <cmath>

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
  stroke::Stroke placed;
  placed.id = "model_to_world";
  placed.model_to_world = {quaternion(similarity->rotation), vec3(similarity->translation),
                           similarity->scale};
  stroke::require_usable(placed);
  return placed.model_to_world;
}

mimicry_similarity from_similarity(const Similarity& similarity) {
  mimicry_similarity s{};
  put(s.rotation, similarity.rotation);
  capi::put(s.translation, similarity.translation);
  s.scale = similarity.scale;
  return s;
}

stroke::Frame to_frame(const mimicry_frame& frame) {
  stroke::Frame f;
  f.time_s = frame.time_s;
  f.head = {vec3(frame.head_position), quaternion(frame.head_orientation)};
  f.controller = {vec3(frame.controller_position), quaternion(frame.controller_orientation)};
  f.trigger = frame.trigger;
  if (!(frame.pressure < 0.0)) f.pressure = frame.pressure;
  return f;
}

mimicry_frame from_frame(const stroke::Frame& frame) {
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
