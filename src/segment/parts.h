#pragma once

#include <span>
#include <vector>

#include <mimicry/segment/segment.h>

namespace mimicry {

/// Fills labels, parts and `separated` of a cut surface.
void find_parts(Segmentation& cut);

/// One number for each fan of faces around a vertex that no blocked half-edge parts: the vertices
/// of the surface as cut open along them. blocked: 3 #F, the same for twins. Returns 3 #F numbers,
/// in the order of first corners.
std::vector<Index> fan_numbers(const HalfEdges& half_edges, const std::vector<bool>& blocked);

}  // namespace mimicry
