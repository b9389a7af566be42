#include <cmath>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/study/recording.h>

#include "base/finite.h"
#include "curve/curve_builder.h"

namespace mimicry {
namespace {

constexpr double kRounding = 1e-3;        // of barycentrics and matrices in single precision
constexpr double kFarthest = 1.0 / 20.0;  // parts of the diagonal

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorKind::invalid_input, why);
}

void require_readable(const RecordedStroke& stroke) {
  if (!stroke.problem.empty()) refuse(stroke.problem);
  if (frame_count(stroke) == 0) refuse("the stroke is empty: it has no recorded points");
}

const RecordedPiece& first_piece(const RecordedStroke& stroke) {
  require_readable(stroke);
  for (const RecordedPiece& piece : stroke.pieces)
    if (!piece.frames.empty()) return piece;
  refuse("the stroke is empty");
}

template <class Visit>
void for_each_frame(const RecordedStroke& stroke, Visit&& visit) {
  std::size_t number = 0;
  for (const RecordedPiece& piece : stroke.pieces)
    for (const RecordedFrame& frame : piece.frames) visit(frame, number++);
}

Similarity similarity(const Eigen::Matrix4d& matrix) {
  for (Eigen::Index i = 0; i < 16; ++i)
    if (!std::isfinite(matrix.data()[i])) refuse("ModelMatrix has a number that is not finite");
  const Mat3 linear = matrix.topLeftCorner<3, 3>();
  const double scale = std::cbrt(linear.determinant());
  if (!(scale > 0.0))
    refuse("ModelMatrix mirrors the model or has no volume; it must be a rotation and a scale");
  const Mat3 rotation = linear / scale;
  if ((rotation * rotation.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff() > kRounding)
    refuse("ModelMatrix is not a rotation with a uniform scale");
  return {Quat(rotation).normalized(), matrix.topRightCorner<3, 1>(), scale};
}

// A pose that points along -z and has +y up.
Quat orientation(const Vec3& forward, const Vec3& up, std::size_t frame) {
  const Vec3 right = forward.cross(up);
  if (!(right.norm() > 1e-6) || !(up.norm() > 1e-6))
    refuse("frame " + std::to_string(frame) + ": forward and up do not span a pose");
  Mat3 axes;
  axes.col(0) = right.normalized();
  axes.col(1) = up.normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return Quat(axes).normalized();
}

SurfacePoint surface_point(const RecordedFrame& frame, const TriangleMesh& mesh,
                           std::size_t number) {
  const std::string where = "frame " + std::to_string(number) + ": ";
  SurfacePoint p = frame.surface;
  if (p.face < 0 || p.face >= mesh.face_count())
    refuse(where + "lies on face " + std::to_string(p.face) + ", but the mesh has " +
           std::to_string(mesh.vertex_count()) + " vertices and " +
           std::to_string(mesh.face_count()) + " faces; it is not the mesh that was drawn on");
  if (!is_finite(p.bary) || p.bary.minCoeff() < -kRounding ||
      std::abs(p.bary.sum() - 1.0) > kRounding)
    refuse(where + "B is not three barycentric coordinates");
  p.bary = p.bary.cwiseMax(0.0);
  // What sums to 1 up to rounding stays as it is.
  if (std::abs(p.bary.sum() - 1.0) > 1e-12) p.bary /= p.bary.sum();
  return p;
}

}  // namespace

std::size_t frame_count(const RecordedStroke& stroke) {
  std::size_t count = 0;
  for (const RecordedPiece& piece : stroke.pieces) count += piece.frames.size();
  return count;
}

std::size_t piece_count(const RecordedStroke& stroke) {
  std::size_t count = 0;
  for (const RecordedPiece& piece : stroke.pieces) count += piece.frames.empty() ? 0 : 1;
  return count;
}

const std::string& method_of(const RecordedStroke& stroke) {
  const RecordedPiece& first = first_piece(stroke);
  for (const RecordedPiece& piece : stroke.pieces)
    if (!piece.frames.empty() && piece.method != first.method)
      refuse("its pieces name different methods: '" + first.method + "' and '" + piece.method +
             "'");
  return first.method;
}

Similarity placement_of(const RecordedStroke& stroke) {
  const RecordedPiece& first = first_piece(stroke);
  const Similarity placed = similarity(first.model_to_world);
  for (const RecordedPiece& piece : stroke.pieces)
    if (!piece.frames.empty() && piece.model_to_world != first.model_to_world) {
      const double scale = similarity(piece.model_to_world).scale;
      if (std::abs(scale - placed.scale) > kRounding * placed.scale)
        refuse("its pieces were drawn at different scales");
    }
  return placed;
}

std::vector<MotionSample> motion_of(const RecordedStroke& stroke) {
  const double scale = placement_of(stroke).scale;
  std::vector<MotionSample> motion;
  motion.reserve(frame_count(stroke));
  for_each_frame(stroke, [&](const RecordedFrame& f, std::size_t number) {
    const std::string where = "frame " + std::to_string(number) + ": ";
    if (!std::isfinite(f.time_ms)) refuse(where + "the time T is not a number");
    if (!is_finite(f.head) || !is_finite(f.pen) || !is_finite(f.head_forward) ||
        !is_finite(f.head_up) || !is_finite(f.pen_forward) || !is_finite(f.pen_up))
      refuse(where + "a pose has a number that is not finite");
    motion.push_back({1e-3 * f.time_ms, scale * f.head, f.head_forward, f.head_up, scale * f.pen,
                      f.pen_forward, f.pen_up});
  });
  return motion;
}

Stroke stroke_of(const RecordedStroke& stroke) {
  Stroke result;
  result.simulated = stroke.simulated;
  result.model_to_world = placement_of(stroke);
  const Similarity& placed = result.model_to_world;
  motion_of(stroke);  // refuses what is not finite
  for_each_frame(stroke, [&](const RecordedFrame& f, std::size_t number) {
    Frame frame;
    frame.time_s = 1e-3 * f.time_ms;
    frame.head = {placed.point(f.head),
                  placed.rotation * orientation(f.head_forward, f.head_up, number)};
    frame.controller = {placed.point(f.pen),
                        placed.rotation * orientation(f.pen_forward, f.pen_up, number)};
    result.frames.push_back(frame);
  });
  return result;
}

ProjectedCurve curve_of(const RecordedStroke& stroke, const Target& target) {
  require_readable(stroke);
  CurveBuilder builder(target.surface());
  std::size_t number = 0;
  for (const RecordedPiece& piece : stroke.pieces) {
    if (!piece.frames.empty()) builder.break_here();
    for (const RecordedFrame& f : piece.frames) {
      const SurfacePoint p = surface_point(f, target.mesh(), number);
      const Vec3 position = target.position(p);
      if (!is_finite(f.point) || (position - f.point).norm() > kFarthest * target.diagonal())
        refuse("frame " + std::to_string(number) +
               ": PT is far from the place of TI and B on the mesh, which has " +
               std::to_string(target.mesh().vertex_count()) + " vertices and " +
               std::to_string(target.mesh().face_count()) +
               " faces; it is not the mesh that was drawn on");
      builder.append(
          {p, position, f.normal, static_cast<Index>(number), 1e-3 * f.time_ms, f.pen_distance});
      ++number;
    }
  }
  return builder.curve();
}

RecordedStroke record(const Stroke& stroke, const ProjectedCurve& curve, std::string method,
                      const Vec3& nozzle) {
  const Similarity& placed = stroke.model_to_world;
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = placed.scale * placed.rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = placed.translation;
  RecordedStroke result;
  result.simulated = stroke.simulated;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (i == 0 || curve.pieces[i - 1].kind == PieceKind::gap)
      result.pieces.push_back({{}, method, matrix});
    const CurvePoint& q = curve.points[i];
    const Frame f = to_model(stroke.frames.at(static_cast<std::size_t>(q.frame)), placed);
    RecordedFrame r;
    r.point = q.position;
    r.normal = q.normal;
    r.surface = q.surface;
    r.pen_distance = q.pen_distance;
    r.time_ms = 1e3 * f.time_s;
    r.head = f.head.position;
    r.pen = f.controller.position;
    r.head_up = f.head.up();
    r.head_forward = f.head.forward();
    r.pen_up = f.controller.up();
    r.pen_forward = f.controller.forward();
    r.spray = f.controller.orientation * nozzle.normalized();
    result.pieces.back().frames.push_back(r);
  }
  return result;
}

}  // namespace mimicry
