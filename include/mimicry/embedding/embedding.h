#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// How a bake was asked for.
struct BakeOptions {
  std::int32_t dimension = 8;   ///< of the embedding
  std::int32_t samples = 1000;  ///< at most
  double offset = 1.0 / 20.0;   ///< half the shell's thickness, as a fraction of the diagonal
};

/// How well it went.
struct BakeQuality {
  /// The shell is a cubic lattice, in which the mesh does not stand: points of the mesh project to
  /// themselves only roughly. So where pieces of edges or faces stayed missing; with none of them
  /// counted, where edges of the mesh cross too many of its faces, or too many tetrahedra were
  /// needed.
  bool is_lattice = false;
  /// A limit of the shell's refinement was hit (rounds, shortest edge, count), or of an iteration.
  bool hit_a_cap = false;
  std::int32_t shell_rounds = 0;  ///< of splitting edges and faces
  Index added_vertices = 0;       ///< on the mesh's edges and faces
  Index missing_edges = 0;        ///< pieces of edges that the shell lacks
  Index pierced_faces = 0;        ///< faces that an edge of the shell crosses
  Index crossing_faces = 0;       ///< faces that edges of the mesh itself cross; not all of many
  Index joined_vertices = 0;      ///< vertices that stand where another stands, and share its value
  std::int32_t samples = 0;
  /// sqrt(sum w (d - D)^2 / sum w D^2) over the pairs of samples, w = 1 / D^2.
  double stress = 0.0;
  /// Of |d / D - 1| over the pairs of samples: median, 90 %, 99 %, largest.
  std::array<double, 4> distortion = {};
  std::int32_t mds_iterations = 0;
  std::int32_t ls_mesh_iterations = 0;
  bool surface_first = false;  ///< the surface was solved first, as a start
  /// Percentage of dihedral angles, 6 per tetrahedron, measured in the embedding, that are below 5
  /// or above 175 degrees.
  double sliver_percent = 0.0;
};

/// A baked target: its mesh, a shell of tetrahedra around it, and a position in R^dimension for
/// each vertex of both. Plain data; nothing here is checked.
struct Embedding {
  std::int32_t dimension = 8;
  /// The first mesh_vertex_count vertices are those of the mesh, in its order.
  Index mesh_vertex_count = 0;
  std::uint64_t mesh_hash = 0;  ///< content_hash of the mesh
  double diagonal = 0.0;        ///< of the mesh's bounding box

  std::vector<Face> faces;  ///< #F by 3, of the mesh
  /// #F, the faces in the order in which they are searched fastest; or empty: then the order is
  /// found again with each `SmoothProjector`.
  std::vector<Index> face_order;
  std::vector<Vec3> positions;             ///< #V by 3, in the mesh's frame and units
  std::vector<std::array<Index, 4>> tets;  ///< #T by 4, positively oriented in `positions`
  /// The last so many tetrahedra may stand where others of them stand: between two parts of the
  /// surface that are close in space and far along the surface each part has its own.
  Index overlapping_tets = 0;
  /// #V by dimension, by rows, in the mesh's units; centred on the samples' mean, so that numbers
  /// are of the object's size wherever it stands.
  std::vector<double> values;

  BakeOptions options;
  BakeQuality quality;

  Index vertex_count() const { return static_cast<Index>(positions.size()); }
  Index face_count() const { return static_cast<Index>(faces.size()); }
};

/// The surface that was baked. Throws Error(invalid_input) where a face refers to a vertex that the
/// mesh does not have.
TriangleMesh mesh_of(const Embedding& embedding);

/// Puts the tetrahedra in the order in which a `SmoothProjector` searches them fastest, those that
/// overlap still behind the others, and finds that of the faces. Answers are the same in any order
/// but for ties. O(n log n).
void sort_for_search(Embedding& embedding);

/// A 64-bit hash of vertices and faces, bit by bit (a negative zero is another number): the same
/// on every machine. Not cryptographic.
std::uint64_t content_hash(const TriangleMesh& mesh);

}  // namespace mimicry
