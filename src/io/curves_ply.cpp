#include <cstdint>
#include <limits>

#include <mimicry/base/error.h>
#include <mimicry/io/curves.h>

#include "io/binary.h"
#include "io/curve_tubes.h"
#include "io/mesh_writers.h"
#include "io/text.h"

namespace mimicry {
namespace {

std::string heading(const std::string& format, const CurveSet& set) {
  return "ply\nformat " + format + " 1.0\ncomment curves on " + one_line(set.target) + "\n";
}

constexpr const char* kPosition = "property double x\nproperty double y\nproperty double z\n";
constexpr const char* kColorAndCurve =
    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int curve\n";

}  // namespace

std::string write_curves_ply(const CurveSet& set, const TriangleMesh& mesh,
                             std::span<const std::array<unsigned char, 3>> colors, double radius) {
  std::string vertices, faces;
  std::size_t vertex_count = 0, face_count = 0;
  const std::vector<Vec3> normals = normals_for_lifts(set, mesh);
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    const TubeMesh tube = curve_tubes(set.curves[c], mesh, radius, normals);
    for (std::size_t v = 0; v < tube.normals.size(); ++v) {
      for (const double x : tube.mesh.positions()[v]) append_little_endian(vertices, x);
      for (const double n : tube.normals[v]) append_little_endian(vertices, static_cast<float>(n));
      for (const unsigned char channel : colors[c]) vertices += static_cast<char>(channel);
      append_little_endian(vertices, static_cast<std::int32_t>(c));
    }
    for (const Face& face : tube.mesh.faces()) {
      faces += '\3';
      for (const Index v : face)
        append_little_endian(faces, static_cast<std::int32_t>(vertex_count) + v);
    }
    vertex_count += tube.normals.size();
    face_count += tube.mesh.faces().size();
    if (vertex_count > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
      throw Error(ErrorKind::unsupported,
                  "curves: more vertices of tubes than PLY numbers; write fewer curves, or lines");
  }
  return heading("binary_little_endian", set) + "element vertex " + std::to_string(vertex_count) +
         "\n" + kPosition + "property float nx\nproperty float ny\nproperty float nz\n" +
         kColorAndCurve + "element face " + std::to_string(face_count) +
         "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces;
}

std::string write_curves_ply_lines(const CurveSet& set, const TriangleMesh& mesh,
                                   std::span<const std::array<unsigned char, 3>> colors) {
  std::string vertices, edges;
  std::size_t vertex_count = 0, edge_count = 0;
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    std::string tail;
    for (const unsigned char channel : colors[c]) tail += ' ' + std::to_string(channel);
    tail += ' ' + std::to_string(c) + '\n';
    for (const auto& part : polylines(set.curves[c].curve, mesh)) {
      for (std::size_t i = 0; i < part.size(); ++i) {
        append_triple(vertices, part[i]);
        vertices += tail;
        if (i > 0) {
          edges += std::to_string(vertex_count - 1) + ' ' + std::to_string(vertex_count) + '\n';
          ++edge_count;
        }
        ++vertex_count;
      }
    }
  }
  return heading("ascii", set) + "element vertex " + std::to_string(vertex_count) + "\n" +
         kPosition + kColorAndCurve + "element edge " + std::to_string(edge_count) +
         "\nproperty int vertex1\nproperty int vertex2\nend_header\n" + vertices + edges;
}

}  // namespace mimicry
