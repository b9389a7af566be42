#pragma once

#include <mimicry/base/parallel.h>
#include <mimicry/embedding/embedding.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// Raised whenever the same mesh and options give another embedding than before: kept bakes of an
/// earlier revision are made again.
inline constexpr int kRevision = 4;

/// Bakes a target for smooth closest points (Panozzo, Baran, Diamanti, Sorkine-Hornung, Weighted
/// Averages on Surfaces, 2013, section 4; Arora and Singh 2021, 3.2): a shell of tetrahedra around
/// it, samples and their geodesic distances, their embedding by multidimensional scaling, and the
/// other vertices by a least-squares mesh.
///
/// What is baked is the surface that `connect` makes of the mesh, the same that a `Target` of it
/// stands on. Any mesh with some area is baked: boundaries, several components, thin or doubled
/// sheets, needles, self-intersections, non-manifold edges. `quality` says what came of it; where
/// the mesh cannot be made to stand in the shell's tetrahedra the shell is a lattice. Throws
/// Error(invalid_input) for a mesh without area or with vertices that are not finite and for
/// options out of range (dimension 3 .. 8, samples 10 .. 20,000, offset 1e-3 .. 0.5, or so small
/// that the shell takes more than 400,000 cells and more than 8 a face),
/// Error(cancelled) when `progress` returns false.
///
/// Stages reported, in this order: shell, (lattice,) samples, distances, mds, ls-mesh, done. The
/// same bits whatever the number of threads. About 0.7 ms a vertex of the mesh and 20 kB; of
/// messy meshes, at the usual offset or a larger one, about 20 s and 0.5 ms a face on two threads
/// and 300 MB and 10 kB a face at the most: counts, not clocks, end what would grow beyond
/// (docs/quality-of-bakes.md has what was measured).
Embedding bake(const TriangleMesh& mesh, const BakeOptions& options = {}, int threads = 1,
               const ProgressCallback& progress = {});

}  // namespace mimicry
