#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <mimicry/assets/canvas.h>

#include "lab/measured_rows.h"

namespace mimicry::lab {

struct RecordedStudyOptions {
  std::vector<std::string> participants;  ///< folders in the published study's format
  std::string shapes;                     ///< folder of the shapes' meshes
  std::string targets;                    ///< file of target curves
  /// False: K_E, K_g and F_g are sums over the pieces, and what joins them does not count.
  bool join_pieces = true;
  int threads = 0;  ///< 0: as many as the machine has
};

struct RecordedStudy {
  /// In the order of the participants, their methods, their shapes and their strokes.
  std::vector<MeasuredRow> rows;
  std::size_t failed_filters = 0;        ///< of these: short, noisy or inverted
  std::vector<RejectedStroke> rejected;  ///< what could not be measured
};

/// Measures the recorded curves as they are. The monitor hears of files that hold the strokes of
/// another method than their name says. Throws Error where the target curves cannot be read.
/// About 1 ms a stroke.
RecordedStudy measure_recordings(const RecordedStudyOptions& options, const Monitor& monitor = {});

}  // namespace mimicry::lab
