#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "io/gltf_mesh.h"
#include "io/mesh_builder.h"

namespace mimicry {

/// Texture coordinates, colours and names of materials, which triangles can do without: what is
/// wrong with them is noted, and they are left out.
class GltfAttributes {
 public:
  GltfAttributes(const GltfJson& gltf, GltfBuffers& buffers, MeshBuilder& mesh)
      : gltf_(gltf), buffers_(buffers), mesh_(mesh) {}

  /// The numbers of the values of a primitive's first vertex, which those of the others follow;
  /// kNone where it has none.
  struct First {
    Index texcoord = kNone, color = kNone;
  };
  /// Adds the values where they are new. vertices: how many the primitive has.
  First add(const GltfPrimitive& primitive, std::size_t vertices);
  /// The faces that follow are of this primitive.
  void begin_material(const GltfPrimitive& primitive);
  /// The faces that follow are of this node, which may be null, with this mesh.
  void begin_object(const Json* node, const Json& mesh);

 private:
  using AddValue = std::function<Index(const GltfAccessor&, std::size_t)>;
  Index add(const GltfPrimitive& primitive, std::size_t vertices, const char* name,
            const std::optional<GltfAccessor>& decompressed, const AddValue& add_value);
  Index add_new(const GltfPrimitive& primitive, std::size_t vertices, const std::string& name,
                const std::optional<GltfAccessor>& decompressed, const AddValue& add_value);

  const GltfJson& gltf_;
  GltfBuffers& buffers_;
  MeshBuilder& mesh_;
  // Uses of a mesh share its values, and so do primitives that name the same accessor for as many
  // vertices.
  std::map<std::pair<const GltfPrimitive*, std::string>, Index> of_primitive_;
  std::set<const GltfPrimitive*> without_material_;  // that was told
  std::map<std::tuple<std::string, std::size_t, std::size_t>, Index> of_accessor_;
};

}  // namespace mimicry
