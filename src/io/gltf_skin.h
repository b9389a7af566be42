#pragma once

#include <vector>

#include "io/gltf_mesh.h"
#include "io/gltf_nodes.h"

namespace mimicry {

/// The matrices of a skin's joints: world from the joint's node times its inverse bind matrix.
std::vector<GltfTransform> joint_matrices(const GltfJson& gltf, GltfBuffers& buffers,
                                          const GltfNodes& nodes, std::size_t skin,
                                          const std::string& user);

/// The mean of the joints' matrices by a vertex's weights (glTF 2.0, 3.7.3.3); of weights that are
/// all 0 the first joint's. Throws Error where a joint that has weight does not exist.
GltfTransform skinned(const GltfJson& gltf, const GltfVertices& vertices, std::size_t v,
                      const std::vector<GltfTransform>& joints, const std::string& place);

}  // namespace mimicry
