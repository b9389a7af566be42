#include <algorithm>
#include <map>
#include <utility>

#include "io/creased_mesh.h"
#include "io/glb.h"
#include "io/mesh_writers.h"

namespace mimicry {
namespace {

// Each is a primitive in the JSON; files that change the material at every other face are not what
// materials are for.
constexpr std::size_t kMostRuns = 10'000;

/// A mesh whose vertices have one value each, as glTF asks: of a vertex where corners differ the
/// first value stays with it, and vertices for the others follow behind the mesh's own.
struct ByVertex {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  std::vector<Index> texcoord, color;  // of a vertex

  ByVertex(const TriangleMesh& mesh, const MeshAttributes& attributes)
      : positions(mesh.positions().begin(), mesh.positions().end()),
        faces(mesh.faces().begin(), mesh.faces().end()),
        texcoord(positions.size(), kNone),
        color(positions.size(), kNone) {
    std::vector<bool> seen(positions.size(), false);
    std::map<std::array<Index, 3>, Index> more;  // vertex, texcoord, colour
    for (std::size_t c = 0; c < 3 * faces.size(); ++c) {
      Index& v = faces[c / 3][c % 3];
      const Index t = attributes.texcoords.empty() ? kNone : attributes.texcoords.corners[c];
      const Index k = attributes.colors.empty() ? kNone : attributes.colors.corners[c];
      if (!seen[at(v)]) {
        seen[at(v)] = true;
        texcoord[at(v)] = t;
        color[at(v)] = k;
      }
      if (texcoord[at(v)] == t && color[at(v)] == k) continue;
      const auto [known, is_new] =
          more.try_emplace({v, t, k}, static_cast<Index>(positions.size()));
      if (is_new) {
        positions.push_back(positions[at(v)]);
        texcoord.push_back(t);
        color.push_back(k);
      }
      v = known->second;
    }
  }
};

template <std::size_t N>
std::vector<std::array<float, N>> values_of(const std::vector<Index>& numbers,
                                            const CornerValues<N>& values,
                                            const std::array<float, N>& missing) {
  std::vector<std::array<float, N>> result;
  if (values.empty()) return result;
  for (const Index n : numbers) result.push_back(n == kNone ? missing : values.values[at(n)]);
  return result;
}

template <std::size_t N>
bool lacks_some(const CornerValues<N>& values) {
  return std::find(values.corners.begin(), values.corners.end(), kNone) != values.corners.end();
}

// Of the vertices of `split`, which has the same faces: of corners that share one the first counts.
std::vector<Vec3> corner_normals(const TriangleMesh& mesh, const TriangleMesh& split) {
  const CreasedMesh creased = creased_mesh(mesh, kCrease_rad);
  std::vector<Vec3> normals(at(split.vertex_count()), Vec3::Zero());
  for (Index f = 0; f < split.face_count(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3& normal = normals[at(split.face(f)[k])];
      if (normal.isZero(0.0)) normal = creased.normals[at(creased.mesh.face(f)[k])];
    }
  for (Vec3& normal : normals)
    if (normal.isZero(0.0)) normal = Vec3::UnitZ();  // of no face: any, of length 1
  return normals;
}

std::size_t runs(const FaceLabels& labels) {
  std::size_t count = labels.empty() ? 0 : 1;
  for (std::size_t f = 1; f < labels.of_face.size(); ++f)
    count += labels.of_face[f] != labels.of_face[f - 1];
  return count;
}

}  // namespace

std::string write_glb(const TriangleMesh& mesh, std::string_view texture_png,
                      const WriteNote& note) {
  GlbPart part;
  part.mesh = &mesh;
  if (!mesh.attributes() || mesh.face_count() == 0) return write_glb_scene({&part, 1});
  const MeshAttributes& attributes = *mesh.attributes();

  if (lacks_some(attributes.texcoords))
    note("GLB needs texture coordinates at every corner; those without have 0, 1");
  if (lacks_some(attributes.colors))
    note("GLB needs a colour at every corner; those without are white");
  ByVertex split(mesh, attributes);
  const auto texcoords = values_of(split.texcoord, attributes.texcoords, {0.0f, 1.0f});
  const auto colors = values_of(split.color, attributes.colors, {1.0f, 1.0f, 1.0f, 1.0f});
  const TriangleMesh by_vertex(std::move(split.positions), std::move(split.faces));
  part.mesh = &by_vertex;
  part.texcoords = texcoords;
  part.vertex_colors = colors;

  std::vector<Vec3> normals;
  if (!texture_png.empty()) {
    part.texture_png = texture_png;
    part.normals = normals = corner_normals(mesh, by_vertex);
  }
  if (!attributes.groups.empty()) note("GLB has no groups of faces; their names are left out");
  if (!texture_png.empty() && !attributes.materials.empty())
    note("the GLB has one material, with the texture; names of materials are left out");
  else if (runs(attributes.materials) > kMostRuns)
    note("the material changes from face to face; materials are left out");
  else if (!attributes.materials.empty())
    part.materials = &attributes.materials;
  const FaceLabels& objects = attributes.objects;
  if (runs(objects) == 1)
    part.name = objects.names[at(objects.of_face[0])];
  else if (!objects.empty())
    note("GLB is written with one node; names of its several objects are left out");
  return write_glb_scene({&part, 1});
}

}  // namespace mimicry
