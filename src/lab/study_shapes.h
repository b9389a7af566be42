#pragma once

#include <string>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/types.h>
#include <mimicry/spatial/target.h>
#include <mimicry/study/targets.h>

namespace mimicry::lab {

struct StudyShapeOptions {
  std::string folder;              ///< of mesh files named as the shapes; empty: built-in shapes
  std::string targets;             ///< file of target curves
  std::vector<std::string> names;  ///< only these; empty: all
};

/// A shape of a study with its target curves.
struct StudyShape {
  Index number = kNone;  ///< the study's (study/recording.h); others count on from these
  const TargetShape* shape = nullptr;
};

/// The shapes of a file of target curves, with the meshes to load when they are needed.
class StudyShapes {
 public:
  /// Throws Error where the file cannot be read, or lacks one of the names.
  explicit StudyShapes(const StudyShapeOptions& options);
  StudyShapes(const StudyShapes&) = delete;  // the list refers into the set
  StudyShapes& operator=(const StudyShapes&) = delete;
  /// By their numbers.
  const std::vector<StudyShape>& list() const { return list_; }
  /// nullptr for one that is not in the list.
  const StudyShape* find(const std::string& name) const;
  /// Of a shape of the list or of the study; empty for another number.
  std::string name(Index number) const;
  /// Throws Error where the mesh cannot be had or is not the one of the curves.
  Target load(const StudyShape& shape, const Monitor& monitor = {}) const;

 private:
  std::string folder_;
  TargetSet set_;
  std::vector<StudyShape> list_;
};

/// The curve with keypoints: its own, or computed where it has none.
TargetCurve with_keypoints(TargetCurve curve, const Target& target, double metres_per_unit);

/// Upright, its middle 1.2 m above the floor.
Similarity placement(const Target& target, double metres_per_unit, bool z_up);

}  // namespace mimicry::lab
