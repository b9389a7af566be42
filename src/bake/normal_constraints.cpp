#include "bake/normal_constraints.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/surface.h>

#include "bake/flat_tets.h"
#include "phong/phong_surface.h"

namespace mimicry {
namespace {

// The strength of a constraint, over the square root of a tetrahedron's size: derivatives are then
// weighed against second differences as these are, whatever the size. More makes tangential motion
// less even, less leaves more of the slide.
constexpr double kStrength = 5.0;

// Where the shell's vertices stand on the surface.
class OnSurface {
 public:
  OnSurface(const TriangleMesh& mesh, const Shell& shell)
      : mesh_vertices_(mesh.vertex_count()), shell_(shell), tie_(shell.positions.size(), kNone) {
    for (std::size_t k = 0; k < shell.ties.size(); ++k)
      tie_[at(shell.ties[k].vertex)] = static_cast<Index>(k);
    for (Index f = 0; f < mesh.face_count(); ++f) faces_.emplace_back(sorted(mesh.face(f)), f);
    std::sort(faces_.begin(), faces_.end());
  }

  bool has(Index v) const { return v < mesh_vertices_ || tie_[at(v)] != kNone; }

  /// The middle of a face of the shell that is a face of the surface or part of one.
  std::optional<SurfacePoint> middle(const std::array<Index, 3>& corners,
                                     const TriangleMesh& mesh) const {
    std::array<Index, 3> face{};
    std::size_t count = 0;
    std::array<double, 3> weights{};
    const auto add = [&](Index v, double weight) {
      std::size_t i = 0;
      while (i < count && face[i] != v) ++i;
      if (i == 3) return false;
      if (i == count) face[count++] = v;
      weights[i] += weight / 3.0;
      return true;
    };
    for (const Index v : corners) {
      if (v < mesh_vertices_) {
        if (!add(v, 1.0)) return std::nullopt;
        continue;
      }
      const Tie& tie = shell_.ties[at(tie_[at(v)])];
      for (std::size_t k = 0; k < 3; ++k) {
        const double weight = tie.weights[static_cast<Eigen::Index>(k)];
        if (tie.corners[k] != kNone && weight != 0.0 && !add(tie.corners[k], weight))
          return std::nullopt;
      }
    }
    if (count < 3) return std::nullopt;
    const std::array<Index, 3> key = sorted(face);
    const auto found = std::lower_bound(faces_.begin(), faces_.end(), std::pair(key, kNone));
    if (found == faces_.end() || found->first != key) return std::nullopt;
    SurfacePoint p{found->second, Vec3::Zero()};
    const Face& f = mesh.face(p.face);
    for (std::size_t i = 0; i < 3; ++i)
      p.bary[std::find(f.begin(), f.end(), face[i]) - f.begin()] = weights[i];
    return p;
  }

 private:
  static std::array<Index, 3> sorted(std::array<Index, 3> corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
  }

  Index mesh_vertices_;
  const Shell& shell_;
  std::vector<Index> tie_;  // by vertex
  std::vector<std::pair<std::array<Index, 3>, Index>> faces_;
};

}  // namespace

NormalConstraints normal_constraints(const TriangleMesh& mesh, const Shell& shell,
                                     const Values& values) {
  const Eigen::Index dimension = values.cols();
  assert(!shell.is_lattice && dimension <= kDimension);
  const Values of_mesh = values.topRows(mesh.vertex_count());
  const PhongSurface surface(mesh, HalfEdges(mesh),
                             {of_mesh.data(), static_cast<std::size_t>(of_mesh.size())},
                             static_cast<int>(dimension));
  const std::vector<Vec3> normals = angle_weighted_normals(mesh);
  const OnSurface on_surface(mesh, shell);

  NormalConstraints result;
  std::vector<double> rows;
  for (const Tet& t : shell.tets) {
    std::optional<std::array<Vec3, 4>> area;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::array<Index, 3> corners = {t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
      if (!on_surface.has(corners[0]) || !on_surface.has(corners[1]) || !on_surface.has(corners[2]))
        continue;
      const auto middle = on_surface.middle(corners, mesh);
      if (!middle) continue;
      const auto position = [&](std::size_t i) -> const Vec3& { return shell.positions[at(t[i])]; };
      if (is_flat(position(0), position(1), position(2), position(3))) continue;
      const Vec3 normal = interpolated_normal(mesh, normals, *middle);

      if (!area) area = area_vectors(shell.positions, t);
      const double volume6 = (*area)[3].dot(position(3) - position(0));
      SoftConstraint constraint;
      Vec8 along = Vec8::Zero();  // the derivative along the normal
      for (std::size_t j = 0; j < 4; ++j) {
        const double weight = (*area)[j].dot(normal) / volume6;
        constraint.vertices[j] = t[j];
        constraint.weights[static_cast<Eigen::Index>(j)] = weight;
        along.head(dimension) += weight * values.row(t[j]).transpose();
      }
      // Rows of an interpolated basis are not quite orthonormal.
      const Basis basis = surface.tangent_plane(*middle);
      const Vec8 first = basis.row(0).normalized();
      Vec8 second = basis.row(1);
      second -= first.dot(second) * first;
      second.normalize();
      along -= first.dot(along) * first + second.dot(along) * second;
      constraint.strength = kStrength * std::sqrt(std::cbrt(volume6));
      constraint.row = static_cast<Index>(result.constraints.size());
      result.constraints.push_back(constraint);
      rows.insert(rows.end(), along.data(), along.data() + dimension);
    }
  }
  result.values = Eigen::Map<const Values>(
      rows.data(), static_cast<Eigen::Index>(result.constraints.size()), dimension);
  return result;
}

}  // namespace mimicry
