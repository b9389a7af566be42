#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/study/measures.h>

#include "lab/measured_rows.h"
#include "lab/replay.h"
#include "lab/replay_source.h"
#include "lab/study_shapes.h"

namespace mimicry::lab {

struct ReplayRows {
  std::string csv, json_lines;
  std::size_t rows = 0, rejected = 0;
  std::vector<std::string> reasons;  ///< of what was rejected, with its place
};

/// Draws the strokes of a job with every technique and measures the curves. Thread-safe; equal jobs
/// give equal bytes. Loads each shape once, when it is first needed. `strokes` and `out` of
/// the options are not its business; `threads` are those of bakes.
class Replayer {
 public:
  Replayer(const ReplayOptions& options, const Monitor& monitor);
  ~Replayer();
  ReplayRows run(const ReplayJob& job) const;

 private:
  struct Shape;
  const Shape& shape(const std::string& name) const;
  void replay_stroke(const Stroke& stroke, const Shape& shape, const IntendedCurve& intended,
                     const MeasuredRow& unmeasured, ReplayRows& rows) const;
  void replay_text(const ReplayJob& job, ReplayRows& rows) const;
  void replay_recording(const ReplayJob& job, ReplayRows& rows) const;
  void replay_recorded(const RecordedStroke& recorded, const Trial& trial, const Shape& shape,
                       const MeasuredRow& row, ReplayRows& rows) const;
  void reject(MeasuredRow row, const std::string& reason, ReplayRows& rows) const;

  ReplayOptions options_;
  Monitor monitor_;
  std::optional<StudyShapes> study_;
  mutable std::mutex lock_;
  mutable std::map<std::string, std::unique_ptr<Shape>> loaded_;
};

}  // namespace mimicry::lab
