#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/spatial/target.h>
#include <mimicry/stroke/stroke.h>
#include <mimicry/study/motion.h>

namespace mimicry {

/// A frame as the published study recorded it. All positions, lengths and directions are in the
/// model's own coordinates. Only frames that inked a point were recorded.
struct RecordedFrame {
  Vec3 point = Vec3::Zero();   ///< PT, the projected point
  Vec3 normal = Vec3::Zero();  ///< N, of the surface there
  SurfacePoint surface;        ///< TI (1-based in files, 0-based here) and B
  double pen_distance = 0.0;   ///< D, from the pen to the projected point
  double time_ms = 0.0;        ///< T, since the study began
  Vec3 head = Vec3::Zero();    ///< HP
  Vec3 pen = Vec3::Zero();     ///< PP
  Vec3 head_up = Vec3::UnitY();
  Vec3 head_forward = -Vec3::UnitZ();
  Vec3 pen_up = Vec3::UnitY();
  Vec3 pen_forward = -Vec3::UnitZ();
  Vec3 spray = -Vec3::UnitZ();  ///< SD, the nozzle's direction
};

/// What was drawn without a break.
struct RecordedPiece {
  std::vector<RecordedFrame> frames;
  std::string method;                                            ///< M (`method_number`)
  Eigen::Matrix4d model_to_world = Eigen::Matrix4d::Identity();  ///< uniform scale, metres
};

struct RecordedStroke {
  std::vector<RecordedPiece> pieces;
  std::optional<Simulation> simulated;  ///< Simulated; what the first piece says
  /// Why the file's stroke could not be read; empty where it could.
  std::string problem;
};

/// Number of frames, and of pieces that have any.
std::size_t frame_count(const RecordedStroke& stroke);
std::size_t piece_count(const RecordedStroke& stroke);

// Each of these throws Error(invalid_input) with the reason, the stroke's own problem included.

/// The word M of the stroke's pieces, which agree.
const std::string& method_of(const RecordedStroke& stroke);
/// Where the model stood, from the first piece. Its matrix must be a rotation with a uniform scale
/// (to 1e-3), and the others' the same.
Similarity placement_of(const RecordedStroke& stroke);
/// All frames, pieces joined; display coordinates. A number that is not finite is refused.
std::vector<MotionSample> motion_of(const RecordedStroke& stroke);
/// The stroke in the world. The trigger is 1; forward is made orthogonal to up.
Stroke stroke_of(const RecordedStroke& stroke);
/// The curve as recorded: the points at their faces and barycentrics, joined by shortest paths
/// within the pieces, with gaps between them; `frame` counts over all pieces. Refuses faces that
/// the mesh has not and points farther than a twentieth of the diagonal from where the mesh has
/// them: it is another mesh.
ProjectedCurve curve_of(const RecordedStroke& stroke, const Target& target);

/// A stroke and what a technique drew from it, as the study would have recorded it: the frames that
/// inked, a piece for each part between gaps. `stroke_of` and `curve_of` give it back to rounding.
/// method: the word M. nozzle: the spray direction in the controller's own axes.
RecordedStroke record(const Stroke& stroke, const ProjectedCurve& curve, std::string method,
                      const Vec3& nozzle = -Vec3::UnitZ());

}  // namespace mimicry
