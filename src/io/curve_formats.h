#pragma once

#include <array>
#include <span>
#include <string>

#include <mimicry/io/curves.h>

namespace mimicry {

/// Every form in which a set of curves is written (mimicry/io/curves.h), by the numbers of the C
/// interface.
enum class CurveFormat {
  json,
  obj,
  csv,
  ply,  ///< tubes
  glb,  ///< tubes
  obj_polylines,
  ply_lines,
  glb_lines,
  packed,
};

inline constexpr int kCurveFormats = 9;

/// What the files with colours and tubes need; others do not look at it.
struct CurveLook {
  std::span<const std::array<unsigned char, 3>> colors;  ///< one per curve, sRGB
  double radius = 0.0;  ///< of tubes of curves without radii of their own, model units
};

/// Throws Error(invalid_input) where there are tubes without a radius above 0, and as the format's
/// own writer.
std::string write_curves(CurveFormat format, const CurveSet& set, const TriangleMesh& mesh,
                         const CurveLook& look);

}  // namespace mimicry
