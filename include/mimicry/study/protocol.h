#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include <mimicry/base/types.h>

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

}  // namespace mimicry
