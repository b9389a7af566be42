// Read with a JSON library alone. tinygltf was weighed: it loads every buffer and image that a file
// names, refuses the file where one is missing, does not look whether accessors lie within their
// buffers, and knows nothing of skins, instances, meshopt and the limits here; what it would spare
// is the look-up of members. It is the independent reader of the tests.

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>

#include "io/glb_chunks.h"
#include "io/gltf_attributes.h"
#include "io/gltf_mesh.h"
#include "io/gltf_nodes.h"
#include "io/gltf_skin.h"
#include "io/mesh_builder.h"
#include "io/text.h"

namespace mimicry {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

/// A mesh at a place.
struct Use {
  std::size_t mesh;
  const Json* node;  // null: the mesh alone
  GltfTransform world;
  std::string place;  // for messages
};

/// One copy of a node's mesh after another.
class Instances {
 public:
  Instances(const GltfJson& gltf, GltfBuffers& buffers, const Use& use) {
    const Json* extension = use.node ? GltfJson::extension(*use.node, kInstancing) : nullptr;
    const Json* attributes = extension ? GltfJson::find(*extension, "attributes") : nullptr;
    if (!attributes) return;
    std::optional<std::size_t> count;
    const auto attribute = [&](const char* name, const char* type,
                               std::optional<GltfAccessor>& out) {
      if (!GltfJson::find(*attributes, name)) return;
      out.emplace(gltf, buffers, gltf.whole(*attributes, name, use.place), type,
                  use.place + " instances' " + name);
      if (count && *count != out->count())
        gltf.fail(use.place, "its instances' attributes differ in number; export the file again");
      count = out->count();
    };
    attribute("TRANSLATION", "VEC3", translation_);
    attribute("ROTATION", "VEC4", rotation_);
    attribute("SCALE", "VEC3", scale_);
    count_ = count.value_or(1);
  }

  std::size_t count() const { return count_; }
  GltfTransform at(std::size_t i) const {
    Eigen::Vector4d rotation = Eigen::Vector4d::UnitW();
    if (rotation_)
      for (std::size_t k = 0; k < 4; ++k)
        rotation[static_cast<Eigen::Index>(k)] = rotation_->at(i, k);
    if (!(rotation.norm() > 0.0)) rotation = Eigen::Vector4d::UnitW();
    return gltf_transform(translation_ ? translation_->vec3(i) : Vec3(0, 0, 0), rotation,
                          scale_ ? scale_->vec3(i) : Vec3(1, 1, 1));
  }

 private:
  std::optional<GltfAccessor> translation_, rotation_, scale_;
  std::size_t count_ = 1;
};

/// How much a file asks for; counted in floating point, where nothing overflows.
struct Amounts {
  double triangles = 0;
  double vertices = 0;
  double steps = 0;  // all that is read for them
};

std::string whole_text(double count) {
  return count < 9e15 ? std::to_string(static_cast<long long>(count)) : format_double(count);
}

class GltfReader {
 public:
  GltfReader(MeshBuilder& mesh, const GltfJson& gltf, std::optional<std::string_view> binary,
             std::size_t file_size)
      : mesh_(mesh),
        gltf_(gltf),
        buffers_(gltf, binary, file_size, mesh.options()),
        nodes_(gltf),
        attributes_(gltf, buffers_, mesh) {}

  void read() {
    const std::vector<Use> uses = find_uses();
    Amounts total;
    for (const Use& use : uses) count(use, total);
    check_limits(total);
    mesh_.reserve(static_cast<std::size_t>(total.vertices),
                  static_cast<std::size_t>(total.triangles));
    for (const Use& use : uses) place(use);
  }

 private:
  std::vector<Use> find_uses() const {
    std::vector<Use> out;
    for (const std::size_t n : nodes_.shown()) {
      const std::string place = "node " + std::to_string(n);
      const Json& node = nodes_.node(n);
      out.push_back({gltf_.whole(node, "mesh", place), &node, nodes_.world(n), place});
      gltf_.item("meshes", out.back().mesh, place);
    }
    const std::size_t meshes = gltf_.array("meshes").size();
    if (!out.empty() || meshes == 0) return out;
    gltf_.note("no node shows a mesh; all meshes of the file were read");
    for (std::size_t m = 0; m < meshes; ++m)
      out.push_back({m, nullptr, GltfTransform::Identity(), "mesh " + std::to_string(m)});
    return out;
  }

  GltfMesh& mesh_of(const Use& use) {
    const auto known = meshes_.find(use.mesh);
    if (known != meshes_.end()) return known->second;
    return meshes_.try_emplace(use.mesh, gltf_, buffers_, use.mesh).first->second;
  }

  /// `own` holds the node's where it has some.
  const std::vector<GltfMorph>& morphs(const Use& use, const GltfMesh& mesh,
                                       std::vector<GltfMorph>& own) const {
    const auto weights = use.node ? gltf_.numbers(*use.node, "weights", use.place) : std::nullopt;
    if (!weights) return mesh.morphs();
    own = morphs_of(*weights);
    return own;
  }

  const std::vector<GltfTransform>* skin_of(const Use& use) {
    if (!use.node || !GltfJson::find(*use.node, "skin")) return nullptr;
    const std::size_t skin = gltf_.whole(*use.node, "skin", use.place);
    const auto known = skins_.find(skin);
    if (known != skins_.end()) return &known->second;
    return &(skins_[skin] = joint_matrices(gltf_, buffers_, nodes_, skin, use.place));
  }

  /// Instances of a node; a skin has none, as it leaves the node's place out.
  Instances instances_of(const Use& use) {
    Instances instances(gltf_, buffers_, use);
    if (instances.count() == 1 || !skin_of(use)) return instances;
    Use once = use;
    once.node = nullptr;
    return Instances(gltf_, buffers_, once);
  }

  void count(const Use& use, Amounts& total) {
    const GltfMesh& mesh = mesh_of(use);
    const double copies = static_cast<double>(instances_of(use).count());
    std::vector<GltfMorph> own;
    const double readings = 1.0 + static_cast<double>(morphs(use, mesh, own).size());
    total.triangles += copies * mesh.triangle_count();
    total.vertices += copies * mesh.vertex_count();
    total.steps += copies * (1.0 + static_cast<double>(mesh.primitives().size()) +
                             mesh.vertex_count() * readings);
    if (skin_of(use)) total.steps += copies * mesh.influence_count();
  }

  void check_limits(const Amounts& total) const {
    const MeshReadOptions& options = mesh_.options();
    const double unfolded = buffers_.allowance();
    const auto check = [&](double asked, double limit, const char* what, const std::string& of,
                           const std::string& raised_with) {
      if (asked <= limit) return;
      gltf_.fail("",
                 "unfolds to " + whole_text(asked) + " " + what + ", more than the " +
                     whole_text(limit) + of + "; export it with fewer instances" + raised_with,
                 ErrorKind::unsupported);
    };
    const double numbered = std::numeric_limits<Index>::max();
    const std::string small =
        " that a file of " + std::to_string(buffers_.read_bytes()) + " bytes may";
    const std::string raised = buffers_.raised_with();
    check(total.triangles, unfolded, "triangles", small, raised);
    check(total.vertices, unfolded, "vertices", small, raised);
    check(total.steps, unfolded, "readings of vertices", small, raised);
    check(total.triangles, std::min(numbered / 3, static_cast<double>(options.max_faces)),
          "triangles", " that are read", "");
    check(total.vertices, std::min(numbered, static_cast<double>(options.max_vertices)), "vertices",
          " that are read", "");
  }

  void place(const Use& use) {
    GltfMesh& mesh = mesh_of(use);
    mesh.decode();
    const Instances instances = instances_of(use);
    std::vector<GltfMorph> own;
    const std::vector<GltfMorph>& moved = morphs(use, mesh, own);
    const std::vector<GltfTransform>* skin = skin_of(use);
    attributes_.begin_object(use.node, gltf_.item("meshes", use.mesh, use.place));
    for (std::size_t i = 0; i < instances.count(); ++i) {
      const GltfTransform world = use.world * instances.at(i);
      // First vertex and mirroring of what primitives share, once it is there.
      std::vector<std::optional<std::pair<Index, bool>>> there(mesh.vertices().size());
      for (const GltfPrimitive& primitive : mesh.primitives()) {
        auto& shared = there[primitive.vertices];
        if (!shared) {
          const auto first = static_cast<Index>(mesh_.vertex_count());
          const GltfVertices& vertices = mesh.vertices()[primitive.vertices];
          const bool mirrored = add_vertices(vertices, moved, skin, world, primitive.place);
          shared = {first, mirrored};
        }
        attributes_.begin_material(primitive);
        add_triangles(primitive, mesh.vertices()[primitive.vertices].positions.count(),
                      shared->first, shared->second);
      }
    }
  }

  /// Returns whether they are mirrored, which turns the triangles' sides.
  bool add_vertices(const GltfVertices& vertices, const std::vector<GltfMorph>& morphs,
                    const std::vector<GltfTransform>* skin, const GltfTransform& world,
                    const std::string& place) {
    if (skin && vertices.influences.empty()) {
      gltf_.note(place + " has a skin and no joints and weights; placed by its node");
      skin = nullptr;
    }
    std::size_t mirrored = 0;
    for (std::size_t v = 0; v < vertices.positions.count(); ++v) {
      Vec3 position = vertices.positions.vec3(v);
      for (const auto& [target, weight] : morphs)
        if (target < vertices.targets.size() && vertices.targets[target])
          position += weight * vertices.targets[target]->vec3(v);
      if (skin) {
        const GltfTransform blended = skinned(gltf_, vertices, v, *skin, place);
        if (blended.linear().determinant() < 0.0) ++mirrored;
        mesh_.add_vertex(blended * position);
      } else {
        mesh_.add_vertex(world * position);
      }
    }
    return skin ? mirrored > vertices.positions.count() / 2 : world.linear().determinant() < 0.0;
  }

  void add_triangles(const GltfPrimitive& primitive, std::size_t vertex_count, Index first,
                     bool mirrored) {
    const auto corner = [&](std::size_t k) {
      const double index = primitive.indices ? primitive.indices->at(k, 0) : static_cast<double>(k);
      if (!(index >= 0.0 && index < static_cast<double>(vertex_count)))
        gltf_.fail(primitive.place, "index " + std::to_string(k) + " refers to vertex " +
                                        format_double(index) + ", but there are " +
                                        std::to_string(vertex_count) + "; export the file again");
      return first + static_cast<Index>(index);
    };
    const GltfAttributes::First values = attributes_.add(primitive, vertex_count);
    std::array<Index, 3> texcoords, colors;
    const auto numbers = [&](const std::array<Index, 3>& corners, Index first_value,
                             std::array<Index, 3>& out) -> std::span<const Index> {
      if (first_value == kNone) return {};
      for (std::size_t c = 0; c < 3; ++c) out[c] = first_value + (corners[c] - first);
      return out;
    };
    const auto add = [&](Index i, Index j, Index k) {
      if (mirrored) std::swap(j, k);
      const std::array corners = {i, j, k};
      mesh_.add_polygon(corners, numbers(corners, values.texcoord, texcoords),
                        numbers(corners, values.color, colors));
    };
    for (std::size_t t = 0; t < primitive.triangles(); ++t) {
      if (primitive.mode == 4) {
        add(corner(3 * t), corner(3 * t + 1), corner(3 * t + 2));
      } else if (primitive.mode == 6) {
        add(corner(0), corner(t + 1), corner(t + 2));
      } else {
        const Index a = corner(t);
        const Index b = corner(t + 1);
        const Index c = corner(t + 2);
        if (a == b || b == c || a == c) continue;  // joins two strips
        if (t % 2 == 0)
          add(a, b, c);
        else
          add(a, c, b);
      }
    }
  }

  MeshBuilder& mesh_;
  const GltfJson& gltf_;
  GltfBuffers buffers_;
  GltfNodes nodes_;
  GltfAttributes attributes_;
  std::map<std::size_t, GltfMesh> meshes_;
  std::map<std::size_t, std::vector<GltfTransform>> skins_;
};

}  // namespace

void read_gltf(std::string_view bytes, MeshBuilder& mesh) {
  const auto& note = mesh.options().note;
  const GlbChunks chunks =
      is_glb(bytes) ? split_glb(bytes, mesh.name(), note) : GlbChunks{bytes, std::nullopt};
  const GltfJson gltf(chunks.json, mesh.name(), note);
  GltfReader(mesh, gltf, chunks.binary, bytes.size()).read();
}

}  // namespace mimicry
