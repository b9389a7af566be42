#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <mimicry/base/types.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/spatial/target.h>
#include <mimicry/stroke/stroke.h>
#include <mimicry/study/measures.h>

namespace mimicry {

/// The study's shapes by their numbers. The first is a tutorial and no part of the analysis.
inline constexpr std::array<std::string_view, 6> kStudyShapes = {"torus", "cube", "trebol",
                                                                 "bunny", "hand", "fertility"};
inline constexpr Index kTutorialShape = 0;

/// The study's methods by their numbers: spraycan, mimicry. Further numbers are a study's own.
enum StudyMethod : Index { kSpraycan = 0, kMimicry = 1 };

/// The word that recordings name a method with: "Spray", "AnchorPhong"; empty for other numbers.
std::string_view method_word(Index method);
/// The study's method that is this technique; kNone where none is.
Index method_of_technique(std::string_view technique);
/// kNone for another word.
Index method_number(std::string_view word);

enum class TaskKind {
  tracing,     ///< the curve is shown while it is drawn
  re_creating  ///< only its keypoints are
};

/// "tracing", "re-creating".
std::string_view task_name(TaskKind task);

/// What a stroke of the study was asked to be.
struct Trial {
  Index curve = kNone;  ///< number of the shape's target curve
  TaskKind task = TaskKind::tracing;
  bool repeat = false;  ///< the same curve came earlier in the same task
};

/// The order in which a participant did things.
struct StudySequence {
  std::vector<Index> methods;
  std::vector<Index> shapes;
  /// The target curves in the order drawn, repeats included. One list for each entry of `shapes`,
  /// the same for every method; or methods.size() * shapes.size() lists, the first method's first.
  std::vector<std::vector<Index>> strokes;

  /// What the strokes of this method on this shape were asked to be, in the order drawn: the first
  /// half is traced, the second re-created. Empty where the sequence does not have the pair.
  std::vector<Trial> trials(Index method, Index shape) const;
};

/// The curves of one method and shape with repeats: the first of each half comes again at the end
/// of its half. Already so (the study: 12 strokes, the 6th and 12th repeat the 1st and 7th):
/// unchanged; all different and an even number (10): repeats are added; else empty.
std::vector<Index> with_repeats(std::span<const Index> curves);

/// The polyline that a technique draws from a stroke; any frame, metres.
using ProjectFunction = std::function<std::vector<Vec3>(const Stroke&)>;

/// The stroke with every n-th frame, from the first on, and the last one. n >= 1.
Stroke thinned(const Stroke& stroke, int n);

/// How much a technique's curve depends on the frame rate, metres: the largest mean corresponding
/// distance of corresponding points between the curve of the stroke as it is and those of
/// the stroke thinned by each of `divisors` (>= 2). A recording at 90 Hz thus stands for 45 and 30
/// Hz; frames between the recorded ones would have to be invented. Curves without points do not
/// count; NaN where none is left. A projection for each divisor and one more.
double frame_rate_dependence_m(const Stroke& stroke, const ProjectFunction& project,
                               std::span<const int> divisors);

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

/// Without an alignment that would depend on the compiler's flags.
using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;

/// What was drawn without a break.
struct RecordedPiece {
  std::vector<RecordedFrame> frames;
  std::string method;                            ///< M (`method_number`)
  Matrix4 model_to_world = Matrix4::Identity();  ///< uniform scale, metres
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
