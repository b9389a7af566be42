// A participant's folder and target curves, measured as `mimicry measure` does: the texts of the
// sequence, the recording and the targets, one after another with a zero between them.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/io/study.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/spatial/target.h>
#include <mimicry/study/measures.h>
#include <mimicry/study/recording.h>
#include <mimicry/study/targets.h>

namespace {

using namespace mimicry;

std::string_view take(std::string_view& rest) {
  const std::string_view part = rest.substr(0, rest.find('\0'));
  rest.remove_prefix(std::min(rest.size(), part.size() + 1));
  return part;
}

void measure(const Target& target, const TargetShape& shape, Index curve_number,
             const RecordedStroke& stroke) {
  (void)method_of(stroke);
  const std::vector<MotionSample> motion = motion_of(stroke);
  const ProjectedCurve curve = curve_of(stroke, target);
  TargetCurve wanted = shape.curves[at(curve_number) % shape.curves.size()];
  if (wanted.keypoints.empty())
    wanted.keypoints = keypoints(target.surface(), wanted.points, shape.scale);
  const IntendedCurve intended = intended_curve(target.mesh(), wanted, placement_of(stroke).scale);
  for (const bool join : {true, false}) {
    const Measures m = measure(target.surface(), intended, curve, motion, {.join_pieces = join});
    // Sums of lengths and angles; NaN where the stroke leaves one undefined.
    for (const double sum : {m.d_ep_m, m.d_sym_m, m.k_e_rad_per_m, m.k_g_rad_per_m, m.f_g_rad_per_m,
                             m.t_h, m.t_c, m.frechet_m, m.l_x_m})
      if (sum < 0.0) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Target target(make_box(1, 1, 1, Vec3::Ones()));
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  const std::string_view sequence_text = take(rest), recording = take(rest);
  try {
    const StudySequence sequence = read_study_sequence(sequence_text, "sequence");
    const TargetSet set = read_targets(rest, "targets");
    if (set.shapes.empty() || set.shapes[0].curves.empty()) return 0;
    require_fits(set.shapes[0], target.mesh());
    const std::vector<RecordedStroke> strokes = read_recording(recording, "recording");
    for (const Index shape : sequence.shapes)
      for (const Index method : sequence.methods) {
        const std::vector<Trial> trials = sequence.trials(method, shape);
        for (std::size_t i = 0; i < std::min(strokes.size(), trials.size()); ++i) try {
            measure(target, set.shapes[0], trials[i].curve, strokes[i]);
          } catch (const Error&) {
          }
      }
  } catch (const Error&) {
  }
  return 0;
}
