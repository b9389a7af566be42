#include "mesh/quads.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace mimicry {

TriangleMesh triangulate(QuadMesh mesh) {
  std::vector<Face> faces;
  faces.reserve(mesh.quads.size() * 2);
  const auto at = [&mesh](Index v) { return mesh.positions[static_cast<std::size_t>(v)]; };
  for (const Quad& q : mesh.quads) {
    const double first = (at(q[0]) - at(q[2])).squaredNorm();
    const double second = (at(q[1]) - at(q[3])).squaredNorm();
    // The margin keeps rounding from choosing between equal diagonals.
    if (first <= second * (1 + 1e-9)) {
      faces.push_back({q[0], q[1], q[2]});
      faces.push_back({q[0], q[2], q[3]});
    } else {
      faces.push_back({q[0], q[1], q[3]});
      faces.push_back({q[1], q[2], q[3]});
    }
  }
  return {std::move(mesh.positions), std::move(faces)};
}

QuadMesh catmull_clark(const QuadMesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  const auto at = [&mesh](Index v) -> const Vec3& {
    return mesh.positions[static_cast<std::size_t>(v)];
  };

  // Vertices of the new mesh: the old ones, then the face points, then the edge points.
  QuadMesh fine;
  fine.positions.assign(vertices, Vec3::Zero());
  std::vector<Vec3> face_points;
  for (const Quad& q : mesh.quads)
    face_points.push_back((at(q[0]) + at(q[1]) + at(q[2]) + at(q[3])) / 4);
  fine.positions.insert(fine.positions.end(), face_points.begin(), face_points.end());

  std::map<std::pair<Index, Index>, Index> edge_numbers;
  std::vector<Vec3> edge_sums;
  std::vector<std::pair<Index, Index>> edges;
  const auto edge_number = [&](Index a, Index b) -> std::size_t {
    const std::pair<Index, Index> key = std::minmax(a, b);
    const auto [it, is_new] = edge_numbers.try_emplace(key, static_cast<Index>(edges.size()));
    if (is_new) {
      edges.push_back(key);
      edge_sums.push_back(at(a) + at(b));
    }
    return static_cast<std::size_t>(it->second);
  };
  std::vector<Vec3> face_sums(vertices, Vec3::Zero());
  std::vector<int> valence(vertices, 0);
  for (std::size_t f = 0; f < mesh.quads.size(); ++f)
    for (std::size_t k = 0; k < 4; ++k) {
      const Index a = mesh.quads[f][k];
      edge_sums[edge_number(a, mesh.quads[f][(k + 1) % 4])] += face_points[f];
      face_sums[static_cast<std::size_t>(a)] += face_points[f];
      ++valence[static_cast<std::size_t>(a)];
    }

  std::vector<Vec3> middle_sums(vertices, Vec3::Zero());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Vec3 middle = (at(edges[e].first) + at(edges[e].second)) / 2;
    middle_sums[static_cast<std::size_t>(edges[e].first)] += middle;
    middle_sums[static_cast<std::size_t>(edges[e].second)] += middle;
    fine.positions.push_back(edge_sums[e] / 4);
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    const double n = valence[v];
    fine.positions[v] =
        (face_sums[v] / n + 2 * middle_sums[v] / n + (n - 3) * mesh.positions[v]) / n;
  }

  const auto first_face = static_cast<Index>(vertices);
  const auto first_edge = static_cast<Index>(vertices + mesh.quads.size());
  for (std::size_t f = 0; f < mesh.quads.size(); ++f)
    for (std::size_t k = 0; k < 4; ++k) {
      const Quad& q = mesh.quads[f];
      fine.quads.push_back({q[k],
                            first_edge + static_cast<Index>(edge_number(q[k], q[(k + 1) % 4])),
                            first_face + static_cast<Index>(f),
                            first_edge + static_cast<Index>(edge_number(q[(k + 3) % 4], q[k]))});
    }
  return fine;
}

}  // namespace mimicry
