#pragma once

#include <optional>
#include <string>

#include <mimicry/segment/segment.h>

namespace mimicry {

struct EndedCurve {
  ProjectedCurve curve;
  std::string note;  // what was done; empty: nothing
};

/// An open curve with its ends closed, trimmed or led to a boundary (`CloseCurves`).
EndedCurve with_ends(const ProjectedCurve& curve, const Surface& surface, CloseCurves close);

/// The same curve along edges of the surface (`CutMethod::vertices`).
ProjectedCurve along_vertices(const ProjectedCurve& curve, const Surface& surface);

}  // namespace mimicry
