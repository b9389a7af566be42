#pragma once

#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/base/parallel.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/io/curves.h>
#include <mimicry/mimicry.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/spatial/target.h>

struct mimicry_bytes {
  std::string content;
};

struct mimicry_mesh {
  std::string name;  // for messages, may be empty
  mimicry::TriangleMesh mesh;
  double metres_per_unit = 1.0;
};

// What a target shows of itself, by the vertices of the caller's mesh.
struct mimicry_target_view {
  std::string notes;
  std::vector<int32_t> surface_sources, surface_vertices;
  std::vector<mimicry::Vec3> normals;
};

struct mimicry_target {
  std::shared_ptr<const mimicry::spatial::Target> target;
  std::shared_ptr<const mimicry_target_view> view;
  std::shared_ptr<const mimicry::embedding::SmoothProjector> projector;  // may be null
};

struct mimicry_session {
  mimicry_target canvas;
  const mimicry::technique::TechniqueInfo* technique = nullptr;
  mimicry::session::SessionOptions options;
  bool options_changed = false;
  std::unique_ptr<mimicry::session::StrokeSession> session;
  mimicry::Similarity model_to_world;
  std::vector<mimicry_ink> ink;
};

struct mimicry_curve {
  std::shared_ptr<const mimicry::spatial::Target> target;
  mimicry::io::CurveRecord record;
  std::vector<mimicry_ink> ink;
};

namespace mimicry::capi {

/// Keeps the message of an error for `mimicry_last_error` of this thread.
mimicry_status fail(mimicry_status status, const char* message) noexcept;

/// Runs a body and turns what it throws into a status.
template <class Body>
mimicry_status guarded(Body&& body) noexcept {
  try {
    body();
    return MIMICRY_OK;
  } catch (const Error& error) {
    switch (error.kind()) {
      case ErrorKind::invalid_input:
        return fail(MIMICRY_INVALID_INPUT, error.what());
      case ErrorKind::io:
        return fail(MIMICRY_IO, error.what());
      case ErrorKind::unsupported:
        return fail(MIMICRY_UNSUPPORTED, error.what());
      case ErrorKind::cancelled:
        return fail(MIMICRY_CANCELLED, error.what());
    }
    return fail(MIMICRY_FAILED, error.what());
  } catch (const std::bad_alloc&) {
    return fail(MIMICRY_OUT_OF_MEMORY,
                "there is not enough memory; use a smaller mesh or close something else");
  } catch (const std::length_error&) {
    return fail(MIMICRY_OUT_OF_MEMORY, "more than memory can hold; use a smaller mesh");
  } catch (const std::exception& error) {
    return fail(MIMICRY_FAILED, error.what());
  } catch (...) {
    return fail(MIMICRY_FAILED, "an unknown fault");
  }
}

/// The same for functions that make an object: *out is null until the body has returned it.
template <class Object, class Body>
mimicry_status made(Object** out, Body&& body) noexcept {
  if (!out) return fail(MIMICRY_INVALID_INPUT, "out is NULL; pass where the handle goes");
  *out = nullptr;
  return guarded([&] { *out = new Object(body()); });
}

template <class T>
void require(const T* pointer, const char* what) {
  if (!pointer) throw Error(ErrorKind::invalid_input, std::string(what) + " is NULL");
}

/// A text argument; null is an error.
inline std::string_view text(const char* argument, const char* what) {
  require(argument, what);
  return argument;
}

/// A file's content; null is fine for none.
inline std::string_view content(const void* data, std::size_t size) {
  if (size > 0) require(data, "data");
  return {static_cast<const char*>(data), size};
}

/// A caller's progress callback, which may be null.
ProgressCallback to_callback(mimicry_progress progress, void* user);

/// Throws where it is not finite, no unit rotation, or the scale is not positive.
Similarity to_similarity(const mimicry_similarity* similarity);
mimicry_similarity from_similarity(const Similarity& similarity);
stroke::Frame to_frame(const mimicry_frame& frame);
mimicry_frame from_frame(const stroke::Frame& frame);

inline Vec3 vec3(const double* x) {
  return {x[0], x[1], x[2]};
}
inline void put(double* to, const Vec3& x) {
  for (int k = 0; k < 3; ++k) to[k] = x[k];
}

/// Appends the vertices of a curve's point and of the piece that leads to it.
void append_ink(std::vector<mimicry_ink>& ink, const curve::ProjectedCurve& curve,
                std::size_t point, const spatial::Target& target);
/// A curve with its ink.
mimicry_curve make_curve(std::shared_ptr<const spatial::Target> target, io::CurveRecord record);

}  // namespace mimicry::capi
