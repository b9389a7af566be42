#pragma once

#include <array>
#include <memory>
#include <span>

#include <mimicry/mesh/attributes.h>
#include <mimicry/mesh/half_edges.h>

namespace mimicry {

/// Where a corner of a cut face lies in its parent.
struct CutCorner {
  Index vertex = kNone;  // of the cut mesh
  Vec3 bary = Vec3::Zero();
};

/// Attributes of a mesh whose faces were cut: #F corners and parents. Values at new corners are
/// interpolated; faces that share an edge without seam share values there.
std::shared_ptr<const MeshAttributes> cut_attributes(
    const MeshAttributes& of_target, const HalfEdges& half_edges, std::span<const Index> parents,
    std::span<const std::array<CutCorner, 3>> corners);

}  // namespace mimicry
