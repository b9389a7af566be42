#pragma once

#include <span>

#include "render/renderer.h"

namespace mimicry::render {

/// One picture of options.width by options.height with a legend below: a swatch and a label for
/// each label among the tubes, in order of appearance; without labels no legend. The camera's
/// aspect follows from the picture.
Image picture(const Scene& scene, const CameraOptions& camera, const RenderOptions& options = {});

struct FigureOptions {
  int columns = 0;         ///< 0: chosen so that the figure is about 1.6 times as wide as high
  int gap = 8;             ///< pixels between panels, 0..1000
  bool one_camera = true;  ///< for all panels; false: each panel has its own
  /// Of one panel without its caption.
  RenderOptions panel = [] {
    RenderOptions options;
    options.width = 500;
    options.height = 420;
    return options;
  }();
};

/// Panels in a grid, row by row, each with its caption and colour swatch below, all seen by one
/// camera that is chosen for all of them together, or each by its own. Throws Error(invalid_input)
/// without panels, and as `render` does.
Image figure(std::span<const Scene> panels, const CameraOptions& camera,
             const FigureOptions& options = {});

}  // namespace mimicry::render
