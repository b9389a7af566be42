#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/io/meshes.h>
#include <mimicry/mesh/triangle_mesh.h>

#include "io/attribute_builder.h"

namespace mimicry {

/// Collects what a reader finds: holds the limits and cuts polygons into triangles.
class MeshBuilder {
 public:
  MeshBuilder(std::string_view name, const MeshReadOptions& options)
      : name_(name), options_(options) {}

  std::string_view name() const { return name_; }
  const MeshReadOptions& options() const { return options_; }
  std::size_t vertex_count() const { return positions_.size(); }
  std::size_t face_count() const { return faces_.size(); }
  std::size_t polygon_count() const { return polygon_count_; }

  void reserve(std::size_t vertices, std::size_t faces);
  Index add_vertex(const Vec3& position) {
    if (positions_.size() >= options_.max_vertices) fail_limit("vertices", options_.max_vertices);
    positions_.push_back(position);
    return static_cast<Index>(positions_.size() - 1);
  }
  /// A face of the file, which counts in any case. corners: not yet checked against the vertices.
  /// One of three is kept as it is; of a larger one, corners that repeat the one before are
  /// dropped. What then has fewer than three makes no triangle.
  void add_polygon(std::span<const Index> corners) { add_polygon(corners, {}, {}); }
  /// The same with the numbers of the corners' texture coordinates and colours, each as many as
  /// corners, kNone for none; or empty.
  void add_polygon(std::span<const Index> corners, std::span<const Index> texcoords,
                   std::span<const Index> colors);
  /// Makes one vertex of those at the same position (bit by bit, -0 taken for 0), in the order of
  /// first appearance.
  void merge_identical_positions();
  /// Tells the caller, who may not listen, what was passed over or mended.
  void note(const std::string& sentence) const {
    if (options_.note) options_.note(sentence);
  }
  /// Texture coordinates, colours and labels of the faces.
  AttributeBuilder& attributes() { return attributes_; }
  /// Forgets what was added.
  void clear();
  /// The vertices so far, and the triangles' corners, three by three.
  std::span<const Vec3> positions() const { return positions_; }
  std::span<const Face> faces() const { return faces_; }
  /// The mesh, its polygons cut well and notes given; the builder is empty afterwards.
  TriangleMesh finish();

 private:
  [[noreturn]] void fail_limit(const char* what, std::size_t limit) const;
  void add_large_polygon(std::span<const Index> corners, std::span<const Index> texcoords,
                         std::span<const Index> colors);
  void number_polygons();
  void cut_polygons();
  void tell_of_polygons(std::size_t crossing) const;

  std::string_view name_;
  MeshReadOptions options_;
  std::vector<Vec3> positions_;
  std::vector<Face> faces_;
  std::vector<Index> polygons_;            // empty as long as each polygon was a triangle
  std::vector<Index> kept_;                // of a polygon's corners
  std::vector<std::size_t> kept_corners_;  // which those are
  AttributeBuilder attributes_;
  std::size_t polygon_count_ = 0;
  std::size_t without_area_ = 0;  // faces of fewer than three corners
  std::size_t with_repeats_ = 0;  // faces of which corners were dropped
};

// One reader per format, each in its own source file.
void read_obj(std::string_view bytes, MeshBuilder& mesh);
void read_ply(std::string_view bytes, MeshBuilder& mesh);
void read_stl(std::string_view bytes, MeshBuilder& mesh);
void read_off(std::string_view bytes, MeshBuilder& mesh);
/// GLB or glTF, whichever the bytes are.
void read_gltf(std::string_view bytes, MeshBuilder& mesh);

}  // namespace mimicry
