#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include <mimicry/base/parallel.h>
#include <mimicry/mesh/triangle_mesh.h>

#include "geodesic/fast_marching.h"

namespace mimicry {

/// Farthest-point sampling (Gonzalez 1985) under approximate geodesic distance: the first is the
/// vertex farthest from the box's centre, each further one the vertex farthest from all before;
/// ties go to the lowest number. A component without a sample is infinitely far, so each gets one
/// before any gets its second. Vertices without faces are never chosen. Returns at most `count`
/// vertices in the order of choice, fewer where there are not that many places apart.
std::vector<Index> farthest_points(const TriangleMesh& mesh, const FastMarching& distances,
                                   Index count, const ProgressCallback& progress = {});

/// Distances between the samples, n by n, symmetric (the mean of both directions), zero on the
/// diagonal, mesh units. Between components, where no way leads over the surface, it is the
/// straight distance: the shortest way of one who may leave the surface anywhere. One march for
/// each sample; #V doubles of scratch a thread.
Eigen::MatrixXd sample_distances(const TriangleMesh& mesh, const FastMarching& distances,
                                 std::span<const Index> samples, Executor& executor,
                                 const ProgressCallback& progress = {});

}  // namespace mimicry
