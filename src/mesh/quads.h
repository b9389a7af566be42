#pragma once

#include <array>
#include <map>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

using Quad = std::array<Index, 4>;
using LatticePoint = std::array<int, 3>;

/// A closed mesh of quads, while shapes are built.
struct QuadMesh {
  std::vector<Vec3> positions;
  std::vector<Quad> quads;
};

/// Numbers lattice points in the order of their first mention.
class LatticeIndex {
 public:
  Index operator()(const LatticePoint& p) {
    const auto [it, is_new] = numbers_.try_emplace(p, static_cast<Index>(points_.size()));
    if (is_new) points_.push_back(p);
    return it->second;
  }
  const std::vector<LatticePoint>& points() const { return points_; }

 private:
  std::map<LatticePoint, Index> numbers_;
  std::vector<LatticePoint> points_;
};

/// Cuts each quad along its shorter diagonal; on (almost) equal ones from corner 0 to corner 2.
TriangleMesh triangulate(QuadMesh mesh);

/// One step of Catmull-Clark subdivision (Catmull and Clark 1978) of a closed manifold quad mesh.
QuadMesh catmull_clark(const QuadMesh& mesh);

}  // namespace mimicry
