#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include <mimicry/curve/projected_curve.h>

namespace mimicry {

/// The first place where a curve meets itself on the surface: the nodes that begin the two segments
/// (lower first, of the lowest pair); none where it does not. Segments meet that cross or touch in
/// a face, at an edge or at a vertex; the joint of a closed curve does not count, nor what follows
/// directly upon each other. Sheets of a surface that lie close in space play no part.
/// O(nodes log nodes + pairs of segments that share a face).
std::optional<std::pair<std::size_t, std::size_t>> self_crossing(const RefinedCurve& curve,
                                                                 const TriangleMesh& mesh);

}  // namespace mimicry
