#pragma once

#include <array>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry::render {

/// Unit normals of the three corners of every face, #F by 3: at each corner the angle-weighted mean
/// over the faces around the vertex whose normals lie within crease_deg of the face's own, so that
/// round parts shade smoothly and sharp edges stay sharp. The face's own normal where the mean
/// vanishes; +y for a face without area. O(sum of squared vertex degrees).
std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(const TriangleMesh& mesh,
                                                           double crease_deg);

}  // namespace mimicry::render
