#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/gltf_accessor.h"
#include "io/gltf_draco.h"

namespace mimicry {

/// Vertices as the file has them, before node, skin and morph weights. Primitives of a mesh that
/// name the same accessors share them.
struct GltfVertices {
  GltfAccessor positions;
  std::vector<std::optional<GltfAccessor>> targets;  // displacements, of each morph target
  struct Influence {
    GltfAccessor joints;  // four of the skin's
    GltfAccessor weights;
  };
  std::vector<Influence> influences;
};

/// How far a morph target moves the vertices.
struct GltfMorph {
  std::size_t target;
  double weight;
};
/// Those of a list of weights that are not 0.
std::vector<GltfMorph> morphs_of(const std::vector<double>& weights);

struct GltfPrimitive {
  std::string place;         // for messages
  int mode = 4;              // triangles, strip or fan
  std::size_t vertices = 0;  // which of the mesh's
  std::size_t corners = 0;
  std::optional<GltfAccessor> indices;  // none: the vertices in order
  const Json* json = nullptr;
  std::vector<std::string> lost;                  // attributes whose compressed form cannot be read
  std::optional<GltfAccessor> texcoords, colors;  // decompressed ones; others stand in the JSON

  std::size_t triangles() const;
};

/// The triangles of a glTF mesh. Compressed ones are counted at first and decoded on demand.
class GltfMesh {
 public:
  GltfMesh(const GltfJson& gltf, GltfBuffers& buffers, std::size_t index);

  const std::vector<GltfVertices>& vertices() const { return vertices_; }
  const std::vector<GltfPrimitive>& primitives() const { return primitives_; }
  /// The default weights of the morph targets that are not 0.
  const std::vector<GltfMorph>& morphs() const { return morphs_; }
  /// Of one copy, in floating point, where nothing overflows.
  double triangle_count() const { return triangles_; }
  double vertex_count() const { return vertex_count_; }
  double influence_count() const { return influences_; }

  /// Makes the compressed primitives ready; again does nothing.
  void decode();

 private:
  struct Compressed {
    const Json* json;
    std::size_t primitive;
    std::string_view bytes;
  };
  using Attributes = std::map<std::string, GltfAccessor>;
  void add_primitive(const Json& primitive, const std::string& place);
  void add_compressed(const Json& primitive, const Json& extension, GltfPrimitive out);
  std::size_t shared_vertices(const Json& primitive, const std::string& place);
  /// decompressed: attributes that are not in the file as they are.
  GltfVertices read_vertices(const Json& primitive, const Attributes& decompressed,
                             const std::string& place) const;
  void decode(const Compressed& compressed);
  /// The values must outlive what is returned.
  GltfAccessor decompressed(const GltfPrimitive& primitive, const std::string& name,
                            const DracoAttribute& values, std::size_t points) const;
  /// Texture coordinates or colours; a note where they cannot be used.
  void keep_attribute(GltfPrimitive& primitive, const std::string& name,
                      const DracoAttribute& values, std::size_t points) const;

  const GltfJson& gltf_;
  GltfBuffers& buffers_;
  std::vector<GltfVertices> vertices_;
  std::map<Json, std::size_t> known_vertices_;  // by the accessors that they are of
  std::vector<GltfPrimitive> primitives_;
  std::vector<GltfMorph> morphs_;
  double triangles_ = 0.0;
  double vertex_count_ = 0.0;
  double influences_ = 0.0;
  std::vector<Compressed> compressed_;
  std::vector<std::unique_ptr<const DracoMesh>> decoded_;
};

}  // namespace mimicry
