#pragma once

#include <vector>

#include <mimicry/segment/segment.h>

#include "segment/curve_network.h"

namespace mimicry {

/// The surface of a cut network: surface, parents, barycentrics, first_child, seam_edges, seams and
/// crossings of the result. Throws as `segment` does for too many crossings.
Segmentation assemble(const Surface& target, const CurveNetwork& network,
                      const SegmentOptions& options);

}  // namespace mimicry
