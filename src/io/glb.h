#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// One node of a GLB scene: a mesh or lines.
struct GlbPart {
  std::string name;
  const TriangleMesh* mesh = nullptr;
  std::span<const Vec3> normals;               ///< #V unit normals, or empty
  std::optional<std::array<double, 3>> color;  ///< linear, 0 to 1; without one no material
  std::span<const std::vector<Vec3>> lines;    ///< polylines; those of a single point do not count
  std::span<const std::array<float, 2>> texcoords =
      {};  ///< #V, v up as in MeshAttributes, or empty
  std::span<const std::array<float, 4>> vertex_colors = {};  ///< #V, linear, or empty
  const FaceLabels* materials = nullptr;  ///< a primitive for each run of faces of one material
  std::string_view texture_png = {};      ///< base colour by `texcoords`, for all faces
};

/// A binary glTF 2.0 file with a node for each part that has faces or lines. Of objects far from
/// their origin, where single precision would show, the nodes carry the offset. Throws as
/// `write_mesh` does.
std::string write_glb_scene(std::span<const GlbPart> parts);

}  // namespace mimicry
