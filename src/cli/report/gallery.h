#pragma once

#include <string>
#include <vector>

#include "lab/drawn_strokes.h"
#include "lab/report_data.h"

namespace mimicry::cli {

struct GalleryOptions {
  int count = 3;                    ///< worst, and best, strokes of each method; 0: no pictures
  std::string measure = "D_ep_mm";  ///< small is good
  lab::StrokeSources sources;
  int threads = 0;  ///< 0: as many as the machine has
};

struct GalleryPicture {
  lab::StrokePick pick;
  std::string png;
};

struct Gallery {
  std::vector<GalleryPicture> pictures;  ///< method by method, the worst first, then the best
  std::vector<std::string> problems;     ///< strokes without a picture, and why
};

/// "#d55e00".
std::string method_color(const std::string& method);

/// Pictures of the strokes that came out worst and best: the stroke in mid-air, the
/// curve on the shape and, under it, the target curve.
Gallery make_gallery(const lab::StudyRows& rows, const lab::Summary& summary,
                     const GalleryOptions& options);

}  // namespace mimicry::cli
