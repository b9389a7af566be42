#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/io/strokes.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/spatial/target.h>
#include <mimicry/study/recording.h>
#include <mimicry/study/targets.h>

#include "lab/study_rows.h"

namespace mimicry::lab {

/// Where the strokes of a table of rows are.
struct StrokeSources {
  std::string recordings;  ///< folder of the participants' folders, or of the strokes files
  /// Where those of these names are; others are in `recordings`. An empty path: there are several.
  std::map<std::string, std::string> files;
  std::string shapes;   ///< folder of the meshes; empty: built-in shapes
  std::string mesh;     ///< what all strokes were drawn on; empty: the rows' shapes
  std::string targets;  ///< file of target curves; empty: not known
  MissPolicy misses = MissPolicy::connect;  ///< of strokes that are drawn again
};

/// Fills in what `sources` does not say from the replay.json that `replay_strokes` leaves beside
/// its rows: strokes, meshes, target curves and what became of misses. Paths that lead nowhere any
/// more are tried as they lay relative to the folder. Without a replay.json nothing changes; throws
/// Error(invalid_input) where it is none of replay's.
void add_replay_sources(const std::string& folder, StrokeSources& sources);

/// A stroke of the table: the pen's way, what came of it, and what was meant, which may be empty.
struct DrawnStroke {
  Stroke stroke;
  ProjectedCurve curve;
  std::vector<Vec3> intended;  ///< model coordinates
  const Target* target = nullptr;
};

/// Finds the strokes of rows: as they were recorded (rows of `measure`), or drawn again with the
/// row's technique, which gives the same curve (rows of `replay`). Files, shapes and bakes are had
/// when they are first needed, and kept.
class DrawnStrokes {
 public:
  /// threads: of bakes; 0: as many as the machine has.
  explicit DrawnStrokes(const StrokeSources& sources, const Monitor& monitor = {}, int threads = 0);
  /// Throws Error saying what is not there. The target lives as long as this.
  DrawnStroke find(const StudyRow& row);

 private:
  struct Shape {
    std::unique_ptr<Target> target;
    std::optional<Canvas> plain, baked;
  };
  Shape& shape(const std::string& name);
  std::string path_of(const StudyRow& row) const;
  DrawnStroke recorded(const StudyRow& row);
  DrawnStroke replayed(const StudyRow& row);
  const RecordedStroke& recording(const StudyRow& row);
  const Stroke& stroke_of_file(const StudyRow& row);
  std::vector<Vec3> target_curve(const StudyRow& row, const TriangleMesh& mesh) const;

  StrokeSources sources_;
  Monitor monitor_;
  int threads_;
  std::optional<TargetSet> targets_;
  std::map<std::string, Shape> shapes_;
  std::map<std::string, std::vector<RecordedStroke>> recordings_;
  std::map<std::string, StrokesFile> files_;
};

}  // namespace mimicry::lab
