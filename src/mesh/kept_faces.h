#pragma once

#include <vector>

#include <mimicry/mesh/connect.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// What becomes of each face of a mesh when it is made a surface; all #F.
struct KeptFaces {
  std::vector<bool> left_out;  ///< collapsed, or where another lies
  std::vector<bool> turned;    ///< its corners run the other way round
  std::vector<Index> part;     ///< of the faces that edges of two faces join, the lowest
};

/// Leaves out faces with two corners at one place and those that lie where earlier ones do, but for
/// walls between solids, and turns faces that run against their neighbours (`connect` has the
/// rules). place: #V, the lowest vertex at each one's place. Counts go into the report.
KeptFaces keep_faces(const TriangleMesh& mesh, const std::vector<Index>& place,
                     ConnectReport& report);

}  // namespace mimicry
