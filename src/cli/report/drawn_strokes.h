#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/io/strokes.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/spatial/target.h>
#include <mimicry/study/recording.h>
#include <mimicry/study/target_set.h>

#include "cli/canvas.h"
#include "cli/report/study_rows.h"

namespace mimicry::cli {

/// Where the strokes of a table of rows are.
struct StrokeSources {
  std::string recordings;  ///< folder of the participants' folders, or of the strokes files
  /// Where those of these names are; others are in `recordings`. An empty path: there are several.
  std::map<std::string, std::string> files;
  std::string shapes;   ///< folder of the meshes; empty: built-in shapes
  std::string mesh;     ///< what all strokes were drawn on; empty: the rows' shapes
  std::string targets;  ///< file of target curves; empty: not known
  session::MissPolicy misses = session::MissPolicy::connect;  ///< of strokes that are drawn again
};

/// A stroke of the table: the pen's way, what came of it, and what was meant, which may be empty.
struct DrawnStroke {
  stroke::Stroke stroke;
  curve::ProjectedCurve curve;
  std::vector<Vec3> intended;  ///< model coordinates
  const spatial::Target* target = nullptr;
};

/// Finds the strokes of rows: as they were recorded (rows of `measure`), or drawn again with the
/// row's technique, which gives the same curve (rows of `replay`). Files, shapes and bakes are had
/// when they are first needed, and kept.
class DrawnStrokes {
 public:
  explicit DrawnStrokes(const StrokeSources& sources);
  /// Throws Error saying what is not there. The target lives as long as this.
  DrawnStroke find(const StudyRow& row);

 private:
  struct Shape {
    std::unique_ptr<spatial::Target> target;
    std::unique_ptr<PreparedCanvas> plain, baked;
  };
  Shape& shape(const std::string& name);
  std::string path_of(const StudyRow& row) const;
  DrawnStroke recorded(const StudyRow& row);
  DrawnStroke replayed(const StudyRow& row);
  const study::RecordedStroke& recording(const StudyRow& row, const std::string& file);
  const stroke::Stroke& stroke_of_file(const StudyRow& row);
  std::vector<Vec3> target_curve(const StudyRow& row, const TriangleMesh& mesh) const;

  StrokeSources sources_;
  std::optional<study::TargetSet> targets_;
  std::map<std::string, Shape> shapes_;
  std::map<std::string, std::vector<study::RecordedStroke>> recordings_;
  std::map<std::string, io::StrokesFile> files_;
};

}  // namespace mimicry::cli
