#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <mimicry/base/parallel.h>
#include <mimicry/mesh/triangle_mesh.h>

#include "bake/delaunay.h"

namespace mimicry {

/// Values of vertices, one row each.
using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Vertex `vertex` has the value sum_k weights[k] value(corners[k]); corners are not tied
/// themselves, weights sum to 1.
struct Tie {
  Index vertex = kNone;
  std::array<Index, 3> corners = {kNone, kNone, kNone};
  Vec3 weights = Vec3::Zero();
};

/// A wish that sum_k weights[k] value(vertices[k]) be row `row` of the wished values.
struct SoftConstraint {
  std::array<Index, 4> vertices = {kNone, kNone, kNone, kNone};
  Eigen::Vector4d weights = Eigen::Vector4d::Zero();
  double strength = 1.0;  ///< its square multiplies the squared error
  Index row = 0;
};

struct LsMeshInput {
  std::span<const Vec3> positions = {};  ///< #V by 3; sizes near 1
  std::span<const Tet> tets = {};        ///< either these, positively oriented but for flat ones,
  std::span<const Face> faces = {};      ///< or these
  std::span<const Tie> ties = {};        ///< each vertex at most once
  std::span<const Index> fixed = {};     ///< vertices with known values, not tied
  const Values* fixed_values = nullptr;  ///< #fixed by dimension
  std::span<const SoftConstraint> soft = {};
  const Values* soft_values = nullptr;  ///< rows by dimension
  const Values* start = nullptr;        ///< #V by dimension; zero where absent
};

struct LsMeshOptions {
  double tolerance = 1e-6;  ///< 1e-4 is visibly too loose
  int most_iterations = 150;
};

struct LsMeshResult {
  Values values;  ///< #V by dimension; fixed and tied vertices have what they must
  int iterations = 0;
  bool converged = true;
};

/// Less volume than 1e-2 of the cube of its longest edge (a regular one has 0.118), or inverted.
/// Such tetrahedra have very large cotangents, whose squares would set the condition of the whole
/// system: with a limit of 1e-3 conjugate gradients take five times as many iterations.
bool is_flat(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Least-squares mesh (Sorkine and Cohen-Or 2004): minimises x^T L M^-1 L x, L the cotangent
/// Laplacian and M the lumped mass of the tetrahedra (of the triangles), with some vertices fixed
/// and others tied. In flat tetrahedra, which have no mass here, x has the gradient of those across
/// their faces; a vertex of flat tetrahedra only is drawn to the mean of its neighbours. The same
/// bits whatever the number of threads. About 70 neighbours a vertex: 1 kB a vertex and 2
/// microseconds a vertex and iteration.
LsMeshResult ls_mesh(const LsMeshInput& input, const LsMeshOptions& options, Executor& executor,
                     const ProgressCallback& progress = {});

}  // namespace mimicry
