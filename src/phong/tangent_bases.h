#pragma once

#include <span>
#include <vector>

#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// A position of the embedding, and two orthonormal rows that span a tangent plane in it. Spaces of
/// fewer dimensions are padded with zeros.
inline constexpr int kDimension = 8;
using Vec8 = Eigen::Matrix<double, kDimension, 1>;
using Basis = Eigen::Matrix<double, 2, kDimension>;

/// Tangent planes at the vertices (#V) of a mesh whose vertices stand at `values` (#V): the limit
/// tangents of Loop's subdivision, orthonormalised (Panozzo et al. 2013, section 4.2); Loop's
/// boundary masks on a boundary (Hoppe et al. 1994). Where a vertex has no ring, or the tangents
/// of its ring are parallel, the plane of the largest spread of its faces' planes, weighted by
/// area. O(#F).
std::vector<Basis> tangent_bases(const HalfEdges& half_edges, std::span<const Face> faces,
                                 std::span<const Vec8> values);

}  // namespace mimicry
