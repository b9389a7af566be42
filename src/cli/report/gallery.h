#pragma once

#include <string>
#include <vector>

#include "cli/report/drawn_strokes.h"
#include "cli/report/summary.h"

namespace mimicry::cli {

struct GalleryOptions {
  int count = 3;                    ///< worst, and best, strokes of each method; 0: no pictures
  std::string measure = "D_ep_mm";  ///< small is good
  StrokeSources sources;
  int threads = 0;  ///< 0: as many as the machine has
};

struct GalleryPicture {
  const StudyRow* row = nullptr;
  double value = 0.0;
  bool best = false;
  std::string png;
};

struct Gallery {
  std::vector<GalleryPicture> pictures;  ///< method by method, the worst first, then the best
  std::vector<std::string> problems;     ///< strokes without a picture, and why
};

/// Pictures of the strokes that came out worst and best: the stroke in mid-air, the
/// curve on the shape and, under it, the target curve.
Gallery make_gallery(const StudyRows& rows, const Summary& summary, const GalleryOptions& options);

}  // namespace mimicry::cli
