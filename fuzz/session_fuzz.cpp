// Strokes on small messy meshes with every technique: points are finite and on a face, and the
// curve is connected. Techniques that need a bake get one for every fourth mesh.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/session/stroke_session.h>

#include "messy/messy_meshes.h"

namespace {

using namespace mimicry;

void require(bool condition) {
  if (!condition) std::abort();
}

bool is_on(const TriangleMesh& mesh, const SurfacePoint& p) {
  return p.face >= 0 && p.face < mesh.face_count() && p.bary.minCoeff() >= 0.0 &&
         std::abs(p.bary.sum() - 1.0) < 1e-9;
}

// Every point is on a face, and a reader can go from each to the next by the piece between them.
void check_curve(const ProjectedCurve& curve, const Target& target) {
  require(curve.pieces.size() == (curve.points.empty() ? 0 : curve.points.size() - 1));
  const double size = target.diagonal();
  for (const CurvePoint& p : curve.points) {
    require(is_on(target.mesh(), p.surface));
    require(p.position.allFinite() && p.normal.allFinite());
    require((target.position(p.surface) - p.position).norm() <= 1e-6 * size);
  }
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    const Piece& piece = curve.pieces[i];
    require(std::isfinite(piece.length) && piece.length >= 0.0);
    require(piece.first_crossing + std::size_t{piece.crossing_count} <= curve.crossings.size());
    if (piece.kind == PieceKind::gap) continue;
    Vec3 last = curve.points[i].position;
    double length = 0.0;
    for (const Crossing& c : curve.piece_crossings(i)) {
      require(c.half_edge >= 0 && c.half_edge < 3 * target.mesh().face_count());
      require(c.t >= 0.0 && c.t <= 1.0);
      length += (position(target.mesh(), c) - last).norm();
      last = position(target.mesh(), c);
    }
    length += (curve.points[i + 1].position - last).norm();
    require(std::abs(length - piece.length) <= 1e-6 * size);
  }
}

// With sanitizers a bake may take a hundred times as long as without: such a one is cancelled.
ProgressCallback in_time() {
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
  return [end](const Progress&) { return std::chrono::steady_clock::now() < end; };
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 8) return 0;
  std::size_t next = 0;
  const auto byte = [&]() -> std::uint8_t { return next < size ? data[next++] : 0; };
  const bool with_bake = byte() % 4 == 0;
  const std::uint8_t placed = byte();
  const std::size_t for_mesh = std::min<std::size_t>(byte(), size - next);
  const TriangleMesh mesh = messy::of_bytes(std::span(data + next, for_mesh));
  next += for_mesh;

  std::optional<Target> target;
  std::optional<SmoothProjector> projector;
  try {
    target.emplace(mesh);
    if (with_bake)
      projector.emplace(mimicry::bake(target->mesh(), {.samples = 12, .offset = 0.4}, 1, in_time()),
                        *target);
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::invalid_input || error.kind() == ErrorKind::cancelled);
    return 0;
  }

  std::vector<Frame> frames;
  while (next < size && frames.size() < 24) {
    Frame frame;
    frame.time_s = 0.01 * static_cast<double>(frames.size());
    const auto coordinate = [&] { return byte() / 16.0 - 4.0; };
    for (int k = 0; k < 3; ++k) frame.controller.position[k] = coordinate();
    for (int k = 0; k < 3; ++k) frame.head.position[k] = coordinate();
    const Quat turn(byte() - 127.5, byte() - 127.5, byte() - 127.5, byte() - 127.5);
    frame.controller.orientation = frame.head.orientation = turn.normalized();
    frames.push_back(frame);
  }
  Similarity model_to_world;
  model_to_world.scale = std::pow(2.0, placed % 16 - 8);

  Canvas canvas;
  canvas.target = *target;
  if (projector) canvas.projector = *projector;
  for (const TechniqueInfo& technique : techniques()) {
    if (technique.needs_bake && !projector) continue;
    SessionOptions options;
    options.misses = placed & 16 ? MissPolicy::split : MissPolicy::connect;
    options.expected_frames = 32;
    StrokeSession session(canvas, technique, options);
    session.begin(model_to_world);
    for (const Frame& frame : frames) session.add(frame);
    session.end();
    check_curve(session.curve(), *target);
  }
  return 0;
}
