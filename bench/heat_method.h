#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry::bench {

/// Distances by the heat method (Crane, Weischedel and Wardetzky 2013), time step the square of the
/// mean edge length: a peer of ours to measure. One component, every vertex in a face.
class HeatMethod {
 public:
  explicit HeatMethod(const TriangleMesh& mesh) : mesh_(mesh) {
    const Index n = mesh.vertex_count();
    std::vector<Eigen::Triplet<double>> laplacian;
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(n);
    double edges = 0.0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const double area = 0.5 * mesh.area_vector(f).norm();
      for (int k = 0; k < 3; ++k) {
        const Index i = corner(f, k);
        const Index j = corner(f, (k + 1) % 3);
        const Vec3 a = mesh.position(i) - mesh.position(corner(f, (k + 2) % 3));
        const Vec3 b = mesh.position(j) - mesh.position(corner(f, (k + 2) % 3));
        const double cotangent = 0.5 * a.dot(b) / a.cross(b).norm();
        laplacian.insert(
            laplacian.end(),
            {{i, i, cotangent}, {j, j, cotangent}, {i, j, -cotangent}, {j, i, -cotangent}});
        areas[i] += area / 3.0;
        edges += (mesh.position(i) - mesh.position(j)).norm();
      }
    }
    const double h = edges / (3.0 * mesh.face_count());
    Eigen::SparseMatrix<double> stiffness(n, n);
    stiffness.setFromTriplets(laplacian.begin(), laplacian.end());
    Eigen::SparseMatrix<double> flow = h * h * stiffness;
    for (Index v = 0; v < n; ++v) {
      flow.coeffRef(v, v) += areas[v];
      stiffness.coeffRef(v, v) += 1e-9 * areas[v] / (h * h);  // constants are in its kernel
    }
    flow_.compute(flow);
    poisson_.compute(stiffness);
  }

  void distances(Index source, std::span<double> out) const {
    const Index n = mesh_.vertex_count();
    Eigen::VectorXd heat = Eigen::VectorXd::Zero(n);
    heat[source] = 1.0;
    heat = flow_.solve(heat).eval();
    Eigen::VectorXd divergence = Eigen::VectorXd::Zero(n);
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const Vec3 normal = mesh_.area_vector(f).normalized();
      Vec3 gradient = Vec3::Zero();
      for (int k = 0; k < 3; ++k)
        gradient += heat[corner(f, k)] *
                    normal.cross(mesh_.corner(f, (k + 2) % 3) - mesh_.corner(f, (k + 1) % 3));
      const double norm = gradient.norm();
      if (!(norm > 0.0)) continue;
      const Vec3 away = -gradient / norm;
      for (int k = 0; k < 3; ++k) {
        const Vec3 a = mesh_.corner(f, (k + 1) % 3) - mesh_.corner(f, k);
        const Vec3 b = mesh_.corner(f, (k + 2) % 3) - mesh_.corner(f, k);
        const Vec3 c = b - a;
        const double twice = a.cross(b).norm();
        divergence[corner(f, k)] +=
            0.5 * (b.dot(c) / twice * a.dot(away) - a.dot(c) / twice * b.dot(away));
      }
    }
    const Eigen::VectorXd d = poisson_.solve(-divergence);
    for (Index v = 0; v < n; ++v) out[static_cast<std::size_t>(v)] = d[v] - d[source];
  }

 private:
  Index corner(Index f, int k) const { return mesh_.face(f)[static_cast<std::size_t>(k)]; }

  const TriangleMesh& mesh_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> flow_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> poisson_;
};

}  // namespace mimicry::bench
