#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <mimicry/base/similarity.h>
#include <mimicry/curve/curve_builder.h>
#include <mimicry/stroke/stroke.h>
#include <mimicry/technique/technique.h>

namespace mimicry::session {

/// What becomes of the curve at a frame whose point is undefined.
enum class MissPolicy : std::uint8_t {
  connect,  ///< the defined points on either side are joined (the paper)
  split,    ///< the curve is broken into parts (the study's software)
};

struct SessionOptions {
  technique::Options technique;
  MissPolicy misses = MissPolicy::connect;
  /// A frame whose pen is nearer than this to the last inked frame's is passed over. World metres.
  double minimum_motion_m = 0.0;
  /// Points that the curve has room for from the start.
  std::size_t expected_frames = 8192;
};

enum class FrameStatus : std::uint8_t {
  inked,     ///< a point was added to the curve
  missed,    ///< the point is undefined; of an anchored technique that waits for its first hit too
  still,     ///< passed over: less motion than the minimum
  rejected,  ///< not usable (`stroke::is_usable`), passed over
};

/// How many frames of a stroke had each status.
struct FrameCounts {
  std::array<Index, 4> by_status{};
  Index& operator[](FrameStatus s) { return by_status[static_cast<std::size_t>(s)]; }
  Index operator[](FrameStatus s) const { return by_status[static_cast<std::size_t>(s)]; }
};

/// How a stroke's points were found; misses are counted too.
struct AnswerCounts {
  std::array<Index, technique::kAnswerCount> by_answer{};
  Index& operator[](technique::Answer a) { return by_answer[static_cast<std::size_t>(a)]; }
  Index operator[](technique::Answer a) const { return by_answer[static_cast<std::size_t>(a)]; }
};

/// Draws strokes on one target with one technique, frame by frame. The curve is in model space; a
/// point once inked never changes. Same frames, same bits. Refers to the canvas, which must outlive
/// it. Not thread-safe; sessions on the same target are independent of each other.
class StrokeSession {
 public:
  StrokeSession(const technique::Canvas& canvas, const technique::TechniqueInfo& technique,
                const SessionOptions& options = {});

  /// Starts a stroke; the last one's curve is forgotten.
  void begin(const Similarity& model_to_world);
  /// frame: world. Never throws. Within `expected_frames` nothing is allocated, but where the curve
  /// jumps across the object or crosses more than 16 edges a frame. A frame after `end` and before
  /// the next `begin` is rejected.
  FrameStatus add(const stroke::Frame& frame);
  /// Ends the stroke; the curve stays readable until the next `begin`.
  void end() { drawing_ = false; }

  const curve::ProjectedCurve& curve() const { return builder_.curve(); }
  const FrameCounts& counts() const { return counts_; }
  const AnswerCounts& answers() const { return answers_; }
  const technique::TechniqueInfo& technique() const { return *technique_; }

 private:
  FrameStatus judge(const stroke::Frame& frame);

  technique::Canvas canvas_;
  const technique::TechniqueInfo* technique_;
  SessionOptions options_;
  curve::CurveBuilder builder_;
  technique::Memory memory_;
  Similarity model_to_world_;
  FrameCounts counts_;
  AnswerCounts answers_;
  Index frame_ = 0;
  double last_time_s_ = -kInfinity;
  Vec3 last_pen_ = Vec3::Zero();  // world, of the last inked frame
  bool drawing_ = false;
};

/// A recorded stroke from first frame to last. Throws where the stroke is not usable.
curve::ProjectedCurve project(const technique::Canvas& canvas,
                              const technique::TechniqueInfo& technique,
                              const stroke::Stroke& stroke, const SessionOptions& options = {});

}  // namespace mimicry::session
