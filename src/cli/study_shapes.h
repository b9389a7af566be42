#pragma once

#include <string>
#include <vector>

#include <mimicry/base/similarity.h>
#include <mimicry/spatial/target.h>
#include <mimicry/study/target_set.h>

#include "cli/mesh_input.h"

namespace CLI {
class App;
}

namespace mimicry::cli {

struct StudyShapeOptions {
  std::string folder;              ///< of mesh files named as the shapes; empty: built-in shapes
  std::string targets;             ///< file of target curves
  std::vector<std::string> names;  ///< only these; empty: all
};

/// Adds --shapes, --targets and --only.
void add_study_shape_options(CLI::App& command, StudyShapeOptions& options);

/// A shape of a study with its target curves.
struct StudyShape {
  Index number = kNone;  ///< the study's (study/protocol.h); others count on from these
  const study::TargetShape* shape = nullptr;
};

/// The shapes of a file of target curves, with the meshes to load when they are needed.
class StudyShapes {
 public:
  explicit StudyShapes(const StudyShapeOptions& options);
  StudyShapes(const StudyShapes&) = delete;  // the list refers into the set
  StudyShapes& operator=(const StudyShapes&) = delete;
  /// By their numbers.
  const std::vector<StudyShape>& list() const { return list_; }
  /// nullptr, or empty, for one that is not in the list.
  const StudyShape* find(const std::string& name) const;
  std::string name(Index number) const;
  /// Throws Error where the mesh cannot be had or is not the one of the curves.
  spatial::Target load(const StudyShape& shape) const;

 private:
  std::string folder_;
  study::TargetSet set_;
  std::vector<StudyShape> list_;
};

/// What load_mesh takes for the shape of this name: a file of the folder (by its own name, or with
/// the ending of a mesh), or a built-in shape where there is no folder. Throws Error(io).
std::string mesh_spec(const std::string& folder, const std::string& shape);

/// Upright, its middle 1.2 m above the floor.
Similarity placement(const spatial::Target& target, double metres_per_unit, bool z_up);

}  // namespace mimicry::cli
