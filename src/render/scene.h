#pragma once

#include <string>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

#include "render/image.h"

namespace mimicry::render {

/// A polyline drawn as a round tube: a stroke or a curve. One point makes a ball, none nothing.
struct Tube {
  std::vector<Vec3> points;  ///< #P, in the mesh's units
  double radius = 0.0;       ///< > 0, in the mesh's units
  Color color;
  std::string label;  ///< UTF-8, for the legend; tubes of one label share an entry
  /// How much the tube counts when the camera is chosen; 0 leaves it out.
  double camera_weight = 1.0;
};

/// A mesh with its colour, and lines of equal value of a scalar field where one is given.
struct Surface {
  const TriangleMesh* mesh = nullptr;  ///< not owned; outlives the scene
  Color color{0.80, 0.80, 0.815};
  std::vector<double> iso_values;  ///< empty, or #V finite values (distances, say)
  double iso_spacing = 0.0;        ///< > 0 where iso_values are given: lines at its multiples
  Color iso_color{0.32, 0.34, 0.40};
};

/// What one picture shows.
struct Scene {
  std::vector<Surface> surfaces;
  std::vector<Tube> tubes;
  Vec3 up = Vec3::UnitY();  ///< unit: against gravity
  std::string caption;      ///< UTF-8, used by figures
  Color caption_color;      ///< the swatch before the caption
  bool caption_swatch = false;
};

}  // namespace mimicry::render
