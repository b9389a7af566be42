#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

enum class MeshFormat { obj, ply, stl, off, glb, gltf };

/// The format that a file name's ending stands for, in either case (.obj .ply .stl .off .glb
/// .gltf). Throws Error(unsupported) for any other ending.
MeshFormat mesh_format_of(std::string_view file_name);
/// Whether it ends in one of those.
bool is_mesh_name(std::string_view file_name);

/// What a reader may take, and whom it asks and tells.
struct MeshReadOptions {
  // Limits beyond which a file is refused before its content is held in memory.
  std::size_t max_vertices = 100'000'000;
  std::size_t max_faces = 200'000'000;
  /// What a glTF may unfold to by using meshes again and again: triangles and vertices, or 16 a
  /// byte of what was read where that is more. A file whose triangles are all its own has fewer
  /// than that; ten million of both take 360 MB, with
  /// texture coordinates and colours 240 MB more.
  std::size_t max_unfolded = 10'000'000;
  /// What the one who reads the messages can raise `max_unfolded` with; empty: nothing.
  std::string raises_unfolded = {};
  /// Is told, a sentence each, what was passed over or mended; may be empty.
  std::function<void(const std::string& sentence)> note = {};
  /// The content of a file that the mesh names beside it (the buffers of a glTF), by its decoded
  /// name relative to the mesh's folder; nullopt where there is none. Empty: nothing is beside it.
  std::function<std::optional<std::string>(const std::string& name)> companion = {};
};

/// The mesh that a file's bytes hold. `name` stands in the error messages only.
///
/// Faces count triangles: a polygon of n corners is cut into n - 2 triangles, in its place in the
/// file's order, and TriangleMesh::polygon() tells the source polygon's number. Convex ones are cut
/// into the fan (0, k, k + 1), others by ears (`io/polygon.h` beside the sources). Corners that
/// repeat the one before are dropped from a polygon of four and more; a face of fewer than three
/// different corners makes no triangle. A triangle is kept as it is.
/// - OBJ, PLY (text, binary of either byte order), OFF: vertices and faces in file order, unused
///   vertices kept.
/// - STL (text, binary): corners at the same position become one vertex, numbered in the order of
///   first appearance. -0 and 0 are the same position.
/// - GLB, glTF 2.0: all triangles, strips and fans of the default scene, nodes depth first, with
///   what moves them (docs/formats.md, "glTF"). Vertices stand in the order of the primitives, at
///   seams as often as the file has them; primitives of one mesh that name the same accessors share
///   them. Triangles of a strip that repeat a vertex are left out, they only join strips. The
///   name's ending does not tell GLB and glTF apart, the first bytes do.
/// Texture coordinates, colours and names of groups, materials and objects become the mesh's
/// attributes (docs/formats.md, "What meshes carry"); those that cannot be understood are left out.
/// docs/formats.md has what other programs' files may differ in. Text in UTF-8, with or without
/// its byte order mark.
///
/// The content is not judged (`nan` and `inf` are read as such, degenerate faces are kept):
/// validation reports it. Throws Error(invalid_input) with name, line or byte offset where the
/// file is cut short, not of its format, refers to a vertex that does not exist, or holds no
/// triangle; Error(io) where a file that it needs is not beside it; Error(unsupported) where it
/// needs what is not handled (unknown extensions, decoders that this build lacks, more than the
/// limits). Memory and time are O(size of the file), whatever its header claims; of glTF that uses
/// meshes again and again O(triangles), within `max_unfolded`; of a polygon of n corners that is
/// not convex O(n sqrt n).
TriangleMesh read_mesh(std::string_view bytes, MeshFormat format, std::string_view name,
                       const MeshReadOptions& options = {});

/// A file that is held in memory. The name may begin with folders, "model/cube.gltf".
struct NamedBytes {
  std::string_view name;
  std::string_view bytes;
};

/// The number of the mesh among files: of that name, or, where `name` is empty, the only one whose
/// name ends in a mesh format's. Throws Error(invalid_input) where there is none, or more.
std::size_t mesh_among(std::span<const NamedBytes> files, std::string_view name);

/// Reads files[mesh]. What it names beside it (the buffers of a glTF) is looked for among the
/// files: by its place relative to the mesh, else the only file of that name in whatever folder.
/// `options.companion` is asked last.
TriangleMesh read_mesh_files(std::span<const NamedBytes> files, std::size_t mesh,
                             const MeshReadOptions& options = {});

struct MeshWriteOptions {
  bool text = false;  ///< PLY and STL as text instead of binary; the other formats have one form
  /// GLB: bytes of a PNG, the base colour (sRGB) at the mesh's texture coordinates, which it must
  /// have; one material in place of the mesh's own. Empty: none. Other formats hold no image.
  std::string_view texture_png = {};
  /// OBJ: the name of a file beside it, as `write_mtl` makes, whose material all faces have.
  std::string_view material_file = {};
  /// Is told, a sentence each, which attributes the format does not hold; may be empty.
  std::function<void(const std::string& sentence)> note = {};
};

/// The .mtl file of an OBJ with one texture: `texture_file` is the image's name beside it.
std::string write_mtl(std::string_view texture_file);

/// The bytes of a file that holds the mesh's triangles; source polygons are not put together
/// again. OBJ, OFF and PLY keep every bit of the coordinates; STL and GLB hold single precision by
/// format, in either form. STL and GLB throw Error(invalid_input) for a coordinate that is not
/// finite in single precision; GLB for a mesh without faces; glTF throws Error(unsupported), write
/// GLB. O(#V + #F).
///
/// The mesh's attributes are written as far as the format holds them (docs/formats.md, "What meshes
/// carry"), and read back as they were, line breaks in names aside; a mesh without any gives the
/// bytes of its geometry alone.
std::string write_mesh(const TriangleMesh& mesh, MeshFormat format,
                       const MeshWriteOptions& options = {});

}  // namespace mimicry
