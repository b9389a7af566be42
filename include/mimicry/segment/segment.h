#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

enum class CutMethod {
  exact,    ///< along the curves: whatever they cross becomes a vertex
  vertices  ///< along edges of the target: the curves' points are moved to the nearest corners of
            ///< their faces, which shortest ways over edges join. No vertex is made
};

/// What is done with the ends of an open curve without gaps and chords.
enum class CloseCurves {
  /// Where its first and last 15 % (of its length) cross it is trimmed there; else ends within 25 %
  /// of each other (on the surface) are joined by the shortest path; else an end within 10 % of a
  /// boundary is led to it; else it stays a slit.
  automatic,
  always,  ///< trimmed, or joined however far the ends are apart
  never    ///< cut as drawn
};

struct SegmentOptions {
  CutMethod method = CutMethod::exact;
  CloseCurves close = CloseCurves::automatic;
  /// Barycentric coordinates below this are 0: curves that pass so close to a vertex or an edge run
  /// through it, and places of curves so close to each other are one. 1e-7 to 0.1.
  double snap = 1e-4;
  /// More places than this where segments of curves cross inside a face are refused.
  std::size_t most_crossings = 1'000'000;
};

/// Faces that no curve parts from each other. It is seen as cut open along all curves: a vertex
/// where it touches itself counts once for each fan of its faces.
struct SurfacePart {
  Index first_parent = kNone;  ///< lowest face of the target that it has a piece of
  Index faces = 0;
  double area = 0.0;        ///< squared model units
  double area_share = 0.0;  ///< of the whole surface
  Index euler = 0;          ///< vertices - edges + faces
  Index boundary_loops = 0;
};

/// A surface cut along curves: still one surface, closed and manifold where the target was, with a
/// vertex wherever a curve crosses an edge, another curve or itself. Vertices of the target keep
/// their numbers, new ones follow; faces stand in the order of their parents.
struct Segmentation {
  Surface surface;             ///< attributes interpolated
  std::vector<Index> labels;   ///< #F; the part, numbered by lowest parent face
  std::vector<Index> parents;  ///< #F; the face of the target; never decreases
  /// #F; each corner in the parent's barycentric coordinates. They are exact: those of a parent's
  /// pieces tile it without gap or overlap.
  std::vector<std::array<Vec3, 3>> barycentrics;
  std::vector<Index> first_child;  ///< #F of the target + 1; children of f: [f, f + 1)
  std::vector<bool> seam_edges;    ///< 3 #F; a curve runs along the half-edge (and its twin)
  /// What became of each curve, in order: chains of edges of `surface`, a point at each vertex.
  /// Gaps stay gaps.
  std::vector<ProjectedCurve> seams;
  std::vector<SurfacePart> parts;
  /// There are more parts than the target has components.
  bool separated = false;
  std::size_t crossings = 0;       ///< new vertices where curves cross inside faces
  std::vector<std::string> notes;  ///< what is worth knowing, a sentence each
};

/// Cuts a surface exactly along curves drawn on it: the arrangement of all of them. Places are
/// snapped as `options.snap` says, then put on a grid of 2^-30 of the face, on which everything is
/// decided exactly: no piece of a face has an area of zero or less on it. Equal curves in any order
/// or direction give the same surface, bit by bit. Open curves are closed as `options.close` says;
/// gaps and chords part a curve. What was done is in the notes.
/// Throws Error(invalid_input) for a curve without points, of a single point, of another mesh,
/// with numbers that are not finite, through edges that are not manifold or faces
/// that share all corners, for options out of range
/// and for too many crossings. O(#F + n log n), n places and crossings of the curves; within a face
/// of many pieces up to their square.
Segmentation segment(const Surface& target, std::span<const ProjectedCurve> curves,
                     const SegmentOptions& options = {});

/// The part to the left or right of the first curve that cuts, at its beginning. Throws
/// Error(invalid_input) where no curve cuts, or nothing lies on that side. O(faces at a vertex).
Index left_part(const Segmentation& cut);
Index right_part(const Segmentation& cut);
/// The part of the smallest area; of equal ones the first. O(parts).
Index smallest_part(const Segmentation& cut);
/// The part that most of a face of the target belongs to. Throws Error(invalid_input) for a face
/// that there is not, or that is no part of the surface. O(children).
Index part_of_face(const Segmentation& cut, Index target_face);

/// The same point on the target, and on the cut surface. O(1), and O(children of the face).
SurfacePoint target_point(const Segmentation& cut, const SurfacePoint& p);
SurfacePoint cut_point(const Segmentation& cut, const SurfacePoint& p);

/// A part, or all of them (label kNone), as a mesh of its own with the faces in their order, and
/// attributes. It is a manifold: vertices where a part touches itself exist once for each fan, and
/// with `cut_open` all that lies along curves, so that the surface opens there (for unfolding, and
/// the seams of a texture atlas). Throws Error(invalid_input) for a part that there is not. O(#F).
TriangleMesh part_mesh(const Segmentation& cut, Index label, bool cut_open = false);

/// Six times the volume's share of a mesh: sum of the determinants of its faces' corners, divided
/// by six; the enclosed volume where it is closed. O(#F).
double signed_volume(const TriangleMesh& mesh);

}  // namespace mimicry
