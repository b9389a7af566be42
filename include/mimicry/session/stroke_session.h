#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/stroke/stroke.h>
#include <mimicry/technique/technique.h>

namespace mimicry {

/// What becomes of the curve at a frame whose point is undefined.
enum class MissPolicy : std::uint8_t {
  connect,  ///< the defined points on either side are joined (the paper)
  split,    ///< the curve is broken into parts (the study's software)
};

struct SessionOptions {
  TechniqueOptions technique = {};  ///< the defaults, or made for the technique
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
  rejected,  ///< not usable (`is_usable`), passed over
};

/// How many frames of a stroke had each status.
struct FrameCounts {
  std::array<Index, 4> by_status{};
  Index& operator[](FrameStatus s) { return by_status[static_cast<std::size_t>(s)]; }
  Index operator[](FrameStatus s) const { return by_status[static_cast<std::size_t>(s)]; }
};

/// How a stroke's points were found; misses are counted too.
struct AnswerCounts {
  std::array<Index, kAnswerCount> by_answer{};
  Index& operator[](Answer a) { return by_answer[static_cast<std::size_t>(a)]; }
  Index operator[](Answer a) const { return by_answer[static_cast<std::size_t>(a)]; }
};

class CurveBuilder;

/// Draws strokes on one target with one technique, frame by frame. The curve is in model space; a
/// point once inked never changes. Same frames, same bits. It keeps the target alive, and what was
/// prepared for it. Not thread-safe; sessions on the same target are independent of each other.
class StrokeSession {
 public:
  /// Throws Error(invalid_input) where the options are another technique's, the canvas has no
  /// target or not the bake that the technique needs. technique: outlives the session, as listed
  /// ones do.
  StrokeSession(const Canvas& canvas, const TechniqueInfo& technique,
                const SessionOptions& options = {});
  ~StrokeSession();
  StrokeSession(StrokeSession&&) noexcept;
  StrokeSession& operator=(StrokeSession&&) noexcept;

  /// Starts a stroke; the last one's curve is forgotten.
  void begin(const Similarity& model_to_world);
  /// frame: world. Throws what the technique throws: none of ours does. Within `expected_frames`
  /// nothing is allocated, but where the curve jumps across the object or crosses more than 16
  /// edges a frame. A frame after `end` and before the next `begin` is rejected.
  FrameStatus add(const Frame& frame);
  /// The same: where it inked, world; nothing where it did not (InkFunction of study/simulate.h).
  std::optional<Vec3> ink(const Frame& frame);
  /// Ends the stroke; the curve stays readable until the next `begin`.
  void end() { drawing_ = false; }

  const ProjectedCurve& curve() const;
  const FrameCounts& counts() const { return counts_; }
  const AnswerCounts& answers() const { return answers_; }
  const TechniqueInfo& technique() const { return *technique_; }

 private:
  FrameStatus judge(const Frame& frame);
  bool is_point(const TechniqueStep& step) const;

  Canvas canvas_;
  const TechniqueInfo* technique_;
  SessionOptions options_;
  Block own_options_;
  TechniqueMemory memory_;
  std::unique_ptr<CurveBuilder> builder_;
  Similarity model_to_world_;
  FrameCounts counts_;
  AnswerCounts answers_;
  Index frame_ = 0;
  double last_time_s_ = -kInfinity;
  Vec3 last_pen_ = Vec3::Zero();  // world, of the last inked frame
  bool drawing_ = false;
};

/// What became of a recorded stroke.
struct ProjectedStroke {
  ProjectedCurve curve;
  std::vector<FrameStatus> statuses;  ///< of each frame
  FrameCounts counts;
  AnswerCounts answers;
};

/// Draws a recorded stroke from first frame to last. Throws Error(invalid_input) where the stroke
/// is not usable.
ProjectedStroke project(const Canvas& canvas, const TechniqueInfo& technique, const Stroke& stroke,
                        const SessionOptions& options = {});

}  // namespace mimicry
