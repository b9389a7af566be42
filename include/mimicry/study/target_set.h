#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// What a target curve was sampled with (paper, appendix B).
struct TargetParameters {
  Index control_points = 6;  ///< n
  double k_g = 0.0;          ///< geodesic distance between controls, in diagonals
  double k_n_deg = 0.0;      ///< angle between the normals of consecutive controls
};

/// An intended curve of a study task.
struct TargetCurve {
  std::vector<SurfacePoint> points;
  std::vector<Index> keypoints;  ///< numbers of points, increasing; empty where unpublished
  std::optional<TargetParameters> parameters;
};

struct TargetShape {
  std::string name;
  double scale = 1.0;  ///< metres per mesh unit at which the shape was shown
  std::vector<TargetCurve> curves;
};

struct TargetSet {
  std::vector<TargetShape> shapes;

  /// nullptr for an unknown name.
  const TargetShape* find(std::string_view name) const {
    for (const TargetShape& shape : shapes)
      if (shape.name == name) return &shape;
    return nullptr;
  }
};

/// Throws Error(invalid_input), naming shape, curve and point, where a point names a face that the
/// mesh has not, or where a curve steps over more than a quarter of the mesh's diagonal: the mesh
/// is another one, or its faces stand in another order. O(vertices and points).
void require_fits(const TargetShape& shape, const TriangleMesh& mesh);

}  // namespace mimicry
