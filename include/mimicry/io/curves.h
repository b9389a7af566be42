#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// The version of `mimicry-curves` that is written and read (docs/formats.md).
inline constexpr int kCurvesVersion = 1;

/// A curve and where it came from.
struct CurveRecord {
  std::string stroke;                                  ///< the stroke's id
  std::string technique;                               ///< the technique's name
  std::map<std::string, std::vector<double>> options;  ///< the technique's, by name
  Similarity model_to_world;
  ProjectedCurve curve;
  /// Of its tube in GLB and PLY files, model units: one for each point, > 0; or empty. Other files
  /// do not keep it.
  std::vector<double> radii = {};
  /// Of the same tube: how far it is raised along the surface's normal, model units.
  double lift = 0.0;
};

/// The radii along `polylines`, crossings included: linear in arc length between points.
/// Throws Error(invalid_input) where there is not one for each point.
std::vector<std::vector<double>> polyline_radii(const CurveRecord& record,
                                                const TriangleMesh& mesh);

/// All curves that were drawn on one target. Positions are in model units.
struct CurveSet {
  std::string target;  ///< name of the mesh
  std::vector<CurveRecord> curves;
};

/// `mimicry-curves`: every point (face, barycentrics, position, normal, frame, time, pen distance)
/// and every piece with its edge crossings. Reads back to the same bits.
std::string write_curves_json(const CurveSet& set, const TriangleMesh& mesh);

/// Reads what `write_curves_json` wrote, for the same mesh. Throws Error naming the file and the
/// curve: malformed text, unknown format or version, face or half-edge beyond the mesh, vertex and
/// face counts other than the mesh's.
CurveSet read_curves_json(std::string_view bytes, std::string_view name, const TriangleMesh& mesh);

/// The same as raw numbers, for keeping a drawing from one day to the next: written and read
/// twenty times faster in a browser, and of no use to other programs. Reads back to the same bits.
std::string write_curves_packed(const CurveSet& set, const TriangleMesh& mesh);
bool is_packed_curves(std::string_view bytes);

/// Reads what `write_curves_packed` wrote, for the same mesh. Throws Error naming the file as
/// `read_curves_json` does. O(bytes).
CurveSet read_curves_packed(std::string_view bytes, std::string_view name,
                            const TriangleMesh& mesh);

/// How an OBJ file says that points are joined.
enum class ObjLines {
  segments,  ///< an `l` with two vertices for each segment
  polylines  ///< one `l` with all vertices of a part; importers exist that take its ends alone
};

/// One `o` a curve, named stroke and technique; all crossings are vertices.
std::string write_curves_obj(const CurveSet& set, const TriangleMesh& mesh,
                             ObjLines lines = ObjLines::segments);

/// One row a point, crossings included (columns in docs/formats.md), part and row in drawing order.
std::string write_curves_csv(const CurveSet& set, const TriangleMesh& mesh);

/// A GLB scene: the target, and each curve as a round tube of its colour (one node a curve, named
/// stroke and technique; parts between gaps are separate tubes). Model units. The target has
/// normals: its faces stay, and its vertices are split where faces meet at more than 38 degrees.
/// colors: one per curve, sRGB, 0 to 255. radius: > 0, model units; of curves without radii of
/// their own.
std::string write_curves_glb(const CurveSet& set, const TriangleMesh& mesh,
                             std::span<const std::array<unsigned char, 3>> colors, double radius);

/// The same with line strips (primitives of mode 3) in place of tubes: the curves' own points,
/// which viewers show one pixel wide. Parts of a single point are left out.
std::string write_curves_glb_lines(const CurveSet& set, const TriangleMesh& mesh,
                                   std::span<const std::array<unsigned char, 3>> colors);

/// Binary PLY with the tubes of all curves, `vertex` (x, y, z, nx, ny, nz, red, green, blue, curve)
/// and `face` (vertex_indices) elements. colors: one per curve, 0 to 255. radius: > 0, model
/// units; of curves without radii of their own. Throws Error(unsupported) where there are more
/// vertices than an Index counts.
std::string write_curves_ply(const CurveSet& set, const TriangleMesh& mesh,
                             std::span<const std::array<unsigned char, 3>> colors, double radius);

/// Ascii PLY with the curves' own points: `vertex` (x, y, z, red, green, blue, curve) and `edge`
/// (vertex1, vertex2) elements. Many readers know no edges (docs/formats.md).
std::string write_curves_ply_lines(const CurveSet& set, const TriangleMesh& mesh,
                                   std::span<const std::array<unsigned char, 3>> colors);

}  // namespace mimicry
