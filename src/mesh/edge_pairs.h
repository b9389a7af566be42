#pragma once

#include <span>
#include <utility>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// A half-edge of an edge that several faces share; `forward` tells its direction among them.
struct EdgeSide {
  Index h;
  bool forward;
};

/// More faces than this at an edge are not paired.
inline constexpr std::size_t kMostPaired = 64;

/// Which of the faces at one edge are neighbours, as pairs (forward, backward). Where the faces
/// bound solids that touch there, each solid's two are. Elsewhere as many as can be, such that the
/// angles through the surface's back differ least from straight (sum of squares; of equal sums the
/// smaller angles); a face that lies on another's back at no angle counts as a full turn away.
/// turned: #F, faces whose corners run the other way round. O(n^3) for n sides.
std::vector<std::pair<Index, Index>> pair_sides(const TriangleMesh& mesh,
                                                const std::vector<bool>& turned,
                                                std::span<const EdgeSide> sides);

/// Whether two faces that share an edge lie on each other.
bool is_fold(const TriangleMesh& mesh, const std::vector<bool>& turned, Index a, Index b);

}  // namespace mimicry
