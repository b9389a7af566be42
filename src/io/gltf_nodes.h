#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <mimicry/base/types.h>

#include "io/gltf_json.h"

namespace mimicry {

using GltfTransform = Eigen::Transform<double, 3, Eigen::AffineCompact>;

/// Of a translation, rotation (x, y, z, w; of any length but 0) and scale.
GltfTransform gltf_transform(const Vec3& translation, const Eigen::Vector4d& rotation,
                             const Vec3& scale);

/// The nodes of a file: trees, whose transforms go from the root down.
class GltfNodes {
 public:
  /// Throws Error where nodes form a ring or one has two parents.
  explicit GltfNodes(const GltfJson& gltf);

  const Json& node(std::size_t n) const { return (*nodes_)[n]; }
  /// World from node.
  const GltfTransform& world(std::size_t n) const { return world_[n]; }
  /// The nodes with a mesh that are shown, depth first: those of the default scene; where it has
  /// none, all of the file, with a note.
  std::vector<std::size_t> shown() const;

 private:
  void find_parents();
  void place_all();
  GltfTransform local(std::size_t n) const;
  std::vector<std::size_t> scene_roots() const;
  std::vector<std::size_t> with_mesh(const std::vector<std::size_t>& roots) const;

  const GltfJson& gltf_;
  const Json* nodes_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::size_t> parents_;  // kNoParent: a root
  std::vector<std::size_t> order_;    // parents before children
  std::vector<GltfTransform> world_;
};

}  // namespace mimicry
