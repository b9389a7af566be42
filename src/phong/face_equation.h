#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "phong/tangent_bases.h"

namespace mimicry {

using Mat2 = Eigen::Matrix2d;

/// What one triangle's share of the tangent field needs. Edge e runs from corner e to corner
/// (e + 1) % 3.
class FaceFrames {
 public:
  FaceFrames() = default;
  FaceFrames(const std::array<Mat2, 3>& from, const std::array<Mat2, 3>& to);

  /// E_ij R_ij and E_ij of each edge, orthogonal: the tangent plane of the whole triangle is
  /// T(b) = sum over edges (b_i b_j / S) [(b_i + b_k / 2) from(e) T_i + (b_j + b_k / 2) to(e) T_j].
  Mat2 from(std::size_t e) const { return matrix(e); }
  Mat2 to(std::size_t e) const { return matrix(3 + e); }

 private:
  // The second column is the first one turned, to the left or, where the flag is set, to the right.
  Mat2 matrix(std::size_t k) const {
    const Vec2& first = first_column_[k];
    const double side = reflections_ >> k & 1U ? -1.0 : 1.0;
    Mat2 result;
    result << first[0], -side * first[1], first[1], side * first[0];
    return result;
  }

  std::array<Vec2, 6> first_column_;
  std::uint32_t reflections_ = 0;
};

/// The orthogonal matrix closest to m, reflections allowed: its polar factor. The identity for 0.
/// Entries up to 1e150; below 1e-150 they are 0.
Mat2 nearest_orthogonal(const Mat2& m);

/// From the tangent planes of the corners: R_ij by polar factors, the three E_ij by alternating
/// Procrustes.
FaceFrames make_frames(const std::array<const Basis*, 3>& t);

/// The equation of a query y on one triangle: f(b) = T(b) (y - x(b)) = 0, with the analytic
/// Jacobian. S f is a quartic in b: its Bernstein coefficients tell, for most triangles without
/// evaluating anything, that there is no solution inside.
class FaceEquation {
 public:
  /// u[i][l] = T_i (y - x_l).
  FaceEquation(const FaceFrames& frames, const std::array<std::array<Vec2, 3>, 3>& u);

  /// By (b1, b2), with b0 = 1 - b1 - b2; not at a corner.
  struct Value {
    Vec2 f;
    Mat2 jacobian;
  };
  Value evaluate(const Vec3& b) const;

  /// Solutions in the triangle; those a hair outside are drawn in. More than one come up where T(b)
  /// nearly stands on the triangle, or y lies beyond the centre of curvature.
  struct Solutions {
    static constexpr std::size_t kMost = 6;
    std::array<Vec3, kMost> b;
    std::size_t count = 0;

    void add(const Vec3& solution);  // once
  };
  /// size: of the whole model in the embedding, which residuals are measured against. Newton's
  /// method from the centroid serves where the Jacobian hardly changes over the triangle;
  /// elsewhere the triangle is cut until the coefficients exclude a solution or that holds.
  Solutions solve(double size) const;

 private:
  struct Piece;
  std::optional<Vec3> newton(Vec3 b, double size) const;
  bool is_nearly_linear(const std::array<Vec3, 3>& corners) const;
  void search_pieces(double size, Solutions& solutions) const;

  std::optional<Vec3> beside_corner(std::size_t i) const;

  std::array<std::array<Vec2, 3>, 3> u_;
  // Monomials of S f: b_i^3 b_{i+1}, b_i^3 b_{i+2}, b_i^2 b_{i+1}^2, b_i^2 b_{i+1} b_{i+2}.
  std::array<Vec2, 3> next_, previous_, square_, mixed_;
};

}  // namespace mimicry
