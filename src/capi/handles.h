#pragma once

#include <atomic>
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
  std::string name;  // of the mesh
  std::string notes;
  std::vector<int32_t> surface_sources, surface_vertices;
  std::vector<mimicry::Vec3> normals;  // empty: the target's own
  std::uint64_t moves = 0;             // of its vertices
  std::atomic<bool> is_baked = false;  // by some handle: its vertices stay
};

struct mimicry_target {
  std::shared_ptr<mimicry::Target> target;
  std::shared_ptr<mimicry_target_view> view;
  std::shared_ptr<const mimicry::SmoothProjector> projector;  // may be null
};

struct mimicry_strokes {
  std::vector<mimicry::Stroke> strokes;
  std::vector<std::string> left_out;  // when it was read

  const mimicry::Stroke& at(std::size_t number) const {
    if (number >= strokes.size())
      throw mimicry::Error(
          mimicry::ErrorKind::invalid_input,
          "stroke " + std::to_string(number) + " of " + std::to_string(strokes.size()));
    return strokes[number];
  }
};

struct mimicry_session {
  mimicry_target canvas;
  const mimicry::TechniqueInfo* technique = nullptr;
  mimicry::SessionOptions options;
  bool options_changed = false;
  std::unique_ptr<mimicry::StrokeSession> session;
  mimicry::Similarity model_to_world;
  std::vector<mimicry_ink> ink;
};

struct mimicry_curve {
  std::shared_ptr<const mimicry::Target> target;
  mimicry::CurveRecord record;
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
Frame to_frame(const mimicry_frame& frame);
mimicry_frame from_frame(const Frame& frame);

inline Vec3 vec3(const double* x) {
  return {x[0], x[1], x[2]};
}
inline void put(double* to, const Vec3& x) {
  for (int k = 0; k < 3; ++k) to[k] = x[k];
}

/// A point of the surface in the caller's words, its barycentrics of the mesh's own corners.
mimicry_surface_point from_point(const Target& target, const SurfacePoint& p, const Vec3& position,
                                 double distance);
/// The same of what a query found or did not find.
template <class Found>
mimicry_surface_point from_found(const Target& target, const Found& found) {
  if (found) return from_point(target, found->surface, found->position, found->distance);
  mimicry_surface_point none{};
  none.face = kNone;
  return none;
}
/// A caller's point on the surface. Throws Error(invalid_input) naming `what` for one that is not.
SurfacePoint to_point(const Target& target, const mimicry_surface_point& point,
                      const std::string& what);
/// Several; `what` and the number stand in messages.
std::vector<SurfacePoint> to_points(const Target& target, const mimicry_surface_point* points,
                                    std::size_t count, const char* what);
/// A recorded stroke, whose frames must be usable.
Stroke to_stroke(const mimicry_similarity* model_to_world, const mimicry_frame* frames,
                 std::size_t count);
/// Throws Error(invalid_input) where it is not above 0 and finite; `what` names it.
void require_positive(double value, const char* what);

/// What a technique looks at.
inline Canvas canvas_of(const mimicry_target& target) {
  return {*target.target, 1.0, target.projector ? *target.projector : SmoothProjector()};
}
/// The technique of this name. Throws Error(invalid_input) where there is none, or where it needs a
/// bake that the target has not.
const TechniqueInfo& usable_technique(const mimicry_target& target, const char* name);

/// Appends the vertices of a curve's point and of the piece that leads to it.
void append_ink(std::vector<mimicry_ink>& ink, const ProjectedCurve& curve, std::size_t point,
                const Target& target);
/// A curve with its ink.
mimicry_curve make_curve(std::shared_ptr<const Target> target, CurveRecord record);

}  // namespace mimicry::capi
