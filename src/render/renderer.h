#pragma once

#include "render/camera.h"
#include "render/image.h"
#include "render/scene.h"

namespace mimicry::render {

struct RenderOptions {
  int width = 1000;    ///< 1..16384 pixels
  int height = 800;    ///< 1..16384 pixels
  int samples = 16;    ///< camera rays per pixel, 1..1024
  int ao_samples = 1;  ///< occlusion rays per camera ray that hits, 0..64; 0 leaves occlusion out
  int threads = 0;     ///< 0: as many as the machine has
  Color background{0.972, 0.972, 0.968};
  double ground = 0.35;      ///< darkness of the contact shadow below the scene, 0..1; 0: none
  double ghost = 0.15;       ///< opacity of tubes behind a surface, 0..1; 0: hidden
  double crease_deg = 40.0;  ///< faces that meet at more than this keep a sharp edge, 0..180
};

/// The picture: soft ambient occlusion and a light over the viewer's shoulder. The same input gives
/// the same pixels whatever the number of threads. Throws Error(invalid_input) on an empty scene,
/// a value that is not finite, a radius or iso spacing that is not positive, or options out of
/// range. About 30 rays per covered pixel with the default options.
Image render(const Scene& scene, const Camera& camera, const RenderOptions& options = {});

}  // namespace mimicry::render
