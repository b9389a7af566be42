#include "phong/face_equation.h"

#include <algorithm>
#include <cmath>

namespace mimicry {
namespace {

// Barycentric coordinates this far below 0 are the rounding of a point on an edge, which both its
// triangles may find on the other's side.
constexpr double kInside = 1e-9;
// Coefficients must keep this part of their size away from 0 to exclude a solution: then there is
// none within kInside of the triangle either.
constexpr double kMargin = 1e-7;
constexpr double kResidual = 1e-12;  // of the model's size, for a solution
constexpr int kMostSteps = 16;
constexpr int kMostReturns = 6;  // into the triangle, of a step out of it
constexpr int kMostPieces = 128;
constexpr int kDeepest = 12;
constexpr int kSweeps = 10;
constexpr double kSettled = 1e-14;  // a change that rounding makes

constexpr std::size_t next(std::size_t i) {
  return i == 2 ? 0 : i + 1;
}

double cross(const Vec2& a, const Vec2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

// S vanishes on an ellipse around the triangle, through its corners. Away from it the parts of the
// edges in T(b) stay below about 5.
bool is_regular(const Vec3& b) {
  const double s = b[0] * b[1] + b[1] * b[2] + b[2] * b[0];
  const Vec3 size = b.cwiseAbs();
  return b.minCoeff() >= -0.3 && s > 0.2 * (size.sum() - size.maxCoeff());
}

// All vectors lie in one open half-plane, kMargin away from its edge. Mostly their mean shows it.
// Where it does not, the cone of those so far is widened by each that lies outside; a vector that
// cannot widen it to less than a half-turn ends it.
bool excludes_zero(const Vec2* c, std::size_t count) {
  double largest2 = c[0].squaredNorm();
  Vec2 sum = c[0];
  for (std::size_t i = 1; i < count; ++i) {
    largest2 = std::max(largest2, c[i].squaredNorm());
    sum += c[i];
  }
  const auto are_before = [&](const Vec2& axis) {
    double least = axis.dot(c[0]);
    for (std::size_t i = 1; i < count; ++i) least = std::min(least, axis.dot(c[i]));
    return least > 0.0 && least * least > kMargin * kMargin * largest2 * axis.squaredNorm();
  };
  if (are_before(sum)) return true;

  Vec2 right = c[0], left = c[0];
  for (std::size_t i = 1; i < count; ++i) {
    const double from_right = cross(right, c[i]), to_left = cross(c[i], left);
    if (from_right >= 0.0 && to_left >= 0.0) {
      if (right.dot(c[i]) < 0.0 && left.dot(c[i]) < 0.0) return false;
    } else if (to_left > 0.0) {
      right = c[i];
    } else if (from_right > 0.0) {
      left = c[i];
    } else {
      return false;
    }
  }
  const double right_length = right.norm(), left_length = left.norm();
  if (!(right_length > 0.0 && left_length > 0.0)) return false;
  const Vec2 axis = right / right_length + left / left_length;
  return axis.norm() > kMargin && are_before(axis);
}

inline Mat2 polar_factor(const Mat2& m) {
  // A 2 x 2 matrix is a scaled rotation plus a scaled reflection; the larger one wins.
  const double turn_cos = m(0, 0) + m(1, 1), turn_sin = m(1, 0) - m(0, 1);
  const double flip_cos = m(0, 0) - m(1, 1), flip_sin = m(1, 0) + m(0, 1);
  const double turn2 = turn_cos * turn_cos + turn_sin * turn_sin,
               flip2 = flip_cos * flip_cos + flip_sin * flip_sin;
  if (!(std::max(turn2, flip2) > 1e-300)) return Mat2::Identity();
  Mat2 result;
  if (turn2 >= flip2) {
    const double scale = 1.0 / std::sqrt(turn2), c = turn_cos * scale, s = turn_sin * scale;
    result << c, -s, s, c;
  } else {
    const double scale = 1.0 / std::sqrt(flip2), c = flip_cos * scale, s = flip_sin * scale;
    result << c, s, s, -c;
  }
  return result;
}

}  // namespace

Mat2 nearest_orthogonal(const Mat2& m) {
  return polar_factor(m);
}

FaceFrames::FaceFrames(const std::array<Mat2, 3>& from, const std::array<Mat2, 3>& to) {
  for (std::size_t k = 0; k < 6; ++k) {
    const Mat2& m = k < 3 ? from[k] : to[k - 3];
    first_column_[k] = m.col(0);
    if (m.determinant() < 0.0) reflections_ |= 1U << k;
  }
}

FaceFrames make_frames(const std::array<const Basis*, 3>& t) {
  // All that Procrustes needs of the pairs' sums s_e = R_e T_e + T_next are the products s_f s_e^T,
  // and those of T.
  std::array<std::array<Mat2, 3>, 3> product;  // T_i T_j^T
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = next(i);
    product[i][i].setIdentity();
    product[i][j].noalias() = t[i]->lazyProduct(t[j]->transpose());
    product[j][i] = product[i][j].transpose();
  }
  std::array<Mat2, 3> along;
  for (std::size_t e = 0; e < 3; ++e) along[e] = polar_factor(product[next(e)][e]);
  std::array<std::array<Mat2, 3>, 3> sums;  // s_f s_e^T
  for (std::size_t f = 0; f < 3; ++f)
    for (std::size_t e = f; e < 3; ++e) {
      const Mat2 from = along[f] * product[f][e] + product[next(f)][e];
      const Mat2 to = along[f] * product[f][next(e)] + product[next(f)][next(e)];
      sums[f][e] = from * along[e].transpose() + to;
      if (e != f) sums[e][f] = sums[f][e].transpose();
    }
  // The mean of all six is brought nearer to each pair in turn. The first pair starts it, so that
  // no pair begins on the wrong side of a reflection.
  std::array<Mat2, 3> turn, mean = sums[0];  // mean[e]: of all, times s_e^T
  for (std::size_t e = 0; e < 3; ++e) turn[e] = polar_factor(mean[e]);
  double last_change = 1.0;
  for (int sweep = 1; sweep < kSweeps; ++sweep) {
    double change = 0.0;
    for (std::size_t e = 0; e < 3; ++e)
      mean[e] = turn[0] * sums[0][e] + turn[1] * sums[1][e] + turn[2] * sums[2][e];
    for (std::size_t e = 0; e < 3; ++e) {
      const Mat2 better = polar_factor(mean[e]);
      change = std::max(change, (better - turn[e]).squaredNorm());
      turn[e] = better;
    }
    // Changes shrink by one factor, so that this is what the next one would be.
    if (change * change < kSettled * kSettled * last_change) break;
    last_change = change;
  }
  std::array<Mat2, 3> from;
  for (std::size_t e = 0; e < 3; ++e) from[e] = turn[e] * along[e];
  return {from, turn};
}

FaceEquation::FaceEquation(const FaceFrames& frames, const std::array<std::array<Vec2, 3>, 3>& u)
    : u_(u) {
  mixed_.fill(Vec2::Zero());
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = next(i), k = next(j);
    const Mat2 from = frames.from(i), to = frames.to(i);
    const Vec2 ii = from * u[i][i], ij = from * u[i][j], ik = from * u[i][k];
    const Vec2 ji = to * u[j][i], jj = to * u[j][j], jk = to * u[j][k];
    next_[i] = ii;
    previous_[j] = jj;
    square_[i] = ij + ji;
    mixed_[i] += ik + 0.5 * (ii + ji);
    mixed_[j] += jk + 0.5 * (ij + jj);
    mixed_[k] += 0.5 * (ik + jk);
  }
}

FaceEquation::Value FaceEquation::evaluate(const Vec3& b) const {
  const double s = b[0] * b[1] + b[1] * b[2] + b[2] * b[0];
  const double product = b[0] * b[1] * b[2];
  Vec2 g = Vec2::Zero();
  std::array<Vec2, 3> dg;
  dg.fill(Vec2::Zero());
  Vec2 mixed = Vec2::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = next(i), k = next(j);
    const double bi = b[static_cast<int>(i)], bj = b[static_cast<int>(j)],
                 bk = b[static_cast<int>(k)];
    const double bi2 = bi * bi;
    const Vec2 cubic = bj * next_[i] + bk * previous_[i];
    g += bi2 * (bi * cubic + bj * bj * square_[i]);
    dg[i] += bi * (3.0 * bi * cubic + 2.0 * bj * bj * square_[i]) + product * mixed_[i];
    dg[j] += bi2 * (bi * next_[i] + 2.0 * bj * square_[i]);
    dg[k] += bi2 * bi * previous_[i];
    mixed += bi * mixed_[i];
  }
  g += product * mixed;
  dg[0] += b[1] * b[2] * mixed;
  dg[1] += b[2] * b[0] * mixed;
  dg[2] += b[0] * b[1] * mixed;
  // f = g / S; the derivative of S by b_i is the sum of the others.
  Value value;
  value.f = g / s;
  for (int c = 0; c < 2; ++c) {
    const Vec2 slope = dg[static_cast<std::size_t>(c + 1)] - dg[0];
    value.jacobian.col(c) = (slope - value.f * (b[0] - b[c + 1])) / s;
  }
  return value;
}

std::optional<Vec3> FaceEquation::newton(Vec3 b, double size) const {
  int returns = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    const Value value = evaluate(b);
    const double det = value.jacobian.determinant();
    const double scale = value.jacobian.squaredNorm();
    if (!(std::abs(det) > 1e-13 * scale)) return std::nullopt;
    Vec2 move(-(value.jacobian(1, 1) * value.f[0] - value.jacobian(0, 1) * value.f[1]) / det,
              -(value.jacobian(0, 0) * value.f[1] - value.jacobian(1, 0) * value.f[0]) / det);
    const double length = std::max(std::abs(move[0]), std::abs(move[1]));
    if (length <= 1e-12) {
      // The step that is left is applied nowhere: it is far below kInside.
      if (!(b.minCoeff() >= -kInside &&
            value.f.squaredNorm() <= kResidual * kResidual * size * size))
        return std::nullopt;
      b = b.cwiseMax(0.0);
      return Vec3(b / b.sum());
    }
    if (length > 0.5) move *= 0.5 / length;
    const Vec3 way(-move[0] - move[1], move[0], move[1]);
    Vec3 to = b + way;
    if (!is_regular(to)) {
      // Past a corner, it may be, near which the solution lies: most of the way to the triangle's
      // boundary, from where the corner is seen more clearly.
      double part = 0.9;
      for (int k = 0; k < 3; ++k)
        if (way[k] < 0.0) part = std::min(part, -0.9 * b[k] / way[k]);
      if (!(part > 0.0) || ++returns > kMostReturns) return std::nullopt;
      to = b + part * way;
    }
    b = to;
    b[0] = 1.0 - b[1] - b[2];
  }
  return std::nullopt;
}

// The Jacobian differs over the piece from that in its middle by less than its own smallest
// singular value, which leaves room for one solution at most (mean value theorem). Told from six
// points, with a factor of 2 for what lies between them.
bool FaceEquation::is_nearly_linear(const std::array<Vec3, 3>& corners) const {
  const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  const Mat2 j = evaluate(middle).jacobian;
  const double det = j.determinant(), norm2 = j.squaredNorm();
  // |det| / |j| is not larger than the smallest singular value.
  const double most = 0.25 * det * det;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 near_corner = 0.7 * corners[i] + 0.3 * middle;
    if (!((evaluate(near_corner).jacobian - j).squaredNorm() * norm2 < most)) return false;
    const Vec3 on_side = 0.5 * (corners[i] + corners[next(i)]);
    if (!((evaluate(on_side).jacobian - j).squaredNorm() * norm2 < most)) return false;
  }
  return true;
}

FaceEquation::Solutions FaceEquation::solve(double size) const {
  Solutions solutions;
  // At a corner f depends on the direction; what it depends on must vanish.
  for (std::size_t i = 0; i < 3; ++i)
    if (u_[i][i].squaredNorm() <= 1e-26 * size * size)
      solutions.b[solutions.count++] = Vec3::Unit(static_cast<int>(i));
  if (solutions.count > 0) return solutions;
  std::array<Vec2, 12> c;
  for (std::size_t i = 0; i < 3; ++i) {
    c[i] = 0.25 * next_[i];
    c[3 + i] = 0.25 * previous_[i];
    c[6 + i] = square_[i] / 6.0;
    c[9 + i] = mixed_[i] / 12.0;
  }
  if (excludes_zero(c.data(), c.size())) return solutions;
  const std::array<Vec3, 3> corners = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  if (!is_nearly_linear(corners)) {
    search_pieces(size, solutions);
  } else if (const auto b = newton(Vec3::Constant(1.0 / 3.0), size)) {
    solutions.b[solutions.count++] = *b;
    return solutions;
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (const auto start = beside_corner(i))
      if (const auto b = newton(*start, size)) solutions.add(*b);
  return solutions;
}

// Where a solution near corner i must be. From afar Newton's method passes it, and beyond a corner
// f has no meaning; beside the corner T(b) is T_i, turned, and f nearly linear.
std::optional<Vec3> FaceEquation::beside_corner(std::size_t i) const {
  const std::size_t j = next(i), k = next(j);
  const Vec2 to_j = u_[i][i] - u_[i][j], to_k = u_[i][i] - u_[i][k];
  const double det = cross(to_j, to_k);
  Vec3 b = Vec3::Zero();
  b[static_cast<int>(j)] = cross(u_[i][i], to_k);
  b[static_cast<int>(k)] = cross(to_j, u_[i][i]);
  if (det < 0.0) b = -b;
  constexpr double kBeside = 0.3, kOutside = 2.0, kInward = 0.05;
  const double far = b.maxCoeff();
  if (!(far <= kBeside * std::abs(det) && b.minCoeff() >= -kOutside * far && far > 0.0))
    return std::nullopt;
  b[static_cast<int>(j)] = std::max(b[static_cast<int>(j)], kInward * far);
  b[static_cast<int>(k)] = std::max(b[static_cast<int>(k)], kInward * far);
  b /= std::abs(det);
  b[static_cast<int>(i)] = 1.0 - b[static_cast<int>(j)] - b[static_cast<int>(k)];
  return b;
}

void FaceEquation::Solutions::add(const Vec3& solution) {
  for (std::size_t i = 0; i < count; ++i)
    if ((b[i] - solution).squaredNorm() < kInside * kInside) return;
  if (count < kMost) b[count++] = solution;
}

namespace {

// Bernstein coefficients of a quartic on a triangle: (i, j, k), i + j + k = 4.
constexpr std::size_t place(std::size_t j, std::size_t k) {
  return (j + k) * (j + k + 1) / 2 + k;
}
using Quartic = std::array<Vec2, 15>;

}  // namespace

struct FaceEquation::Piece {
  Quartic c;
  std::array<Vec3, 3> corners;
  int depth;

  // Halves across the side of the first two corners; the next cut is across the oldest side.
  std::array<Piece, 2> halves() const {
    const Vec3 middle = 0.5 * (corners[0] + corners[1]);
    std::array<Piece, 2> result;
    result[0].corners = {corners[2], corners[0], middle};
    result[1].corners = {corners[1], corners[2], middle};
    Quartic level = c;  // after r steps: coefficients with i + j + k = 4 - r
    for (std::size_t r = 0;; ++r) {
      const std::size_t n = 4 - r;
      for (std::size_t k = 0; k <= n; ++k) {
        // First half: corner 0 (n - k times), middle (r), corner 2 (k).
        result[0].c[place(n - k, r)] = level[place(0, k)];
        // Second half: corner 1 (n - k times), corner 2 (k), middle (r).
        result[1].c[place(k, r)] = level[place(n - k, k)];
      }
      if (r == 4) break;
      Quartic lower = level;
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j + k < n; ++j)
          lower[place(j, k)] = 0.5 * (level[place(j, k)] + level[place(j + 1, k)]);
      level = lower;
    }
    for (Piece& p : result) p.depth = depth + 1;
    return result;
  }

  // At the corners of the whole triangle S f is 0, which says nothing.
  bool excludes_solution() const {
    Quartic used;
    std::size_t count = 0;
    constexpr std::array<std::size_t, 3> kCorners = {place(0, 0), place(4, 0), place(0, 4)};
    for (std::size_t i = 0; i < c.size(); ++i) {
      const auto corner = static_cast<std::size_t>(std::find(kCorners.begin(), kCorners.end(), i) -
                                                   kCorners.begin());
      if (corner < 3 && corners[corner].maxCoeff() == 1.0) continue;
      used[count++] = c[i];
    }
    return excludes_zero(used.data(), count);
  }
};

void FaceEquation::search_pieces(double size, Solutions& solutions) const {
  Piece whole;
  whole.c.fill(Vec2::Zero());
  whole.corners = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  whole.depth = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = next(i), k = next(j);
    const auto set = [&](std::size_t pi, std::size_t pj, std::size_t pk, const Vec2& value) {
      std::array<std::size_t, 3> power{};
      power[i] = pi;
      power[j] = pj;
      power[k] = pk;
      whole.c[place(power[1], power[2])] = value;
    };
    set(3, 1, 0, 0.25 * next_[i]);
    set(3, 0, 1, 0.25 * previous_[i]);
    set(2, 2, 0, square_[i] / 6.0);
    set(2, 1, 1, mixed_[i] / 12.0);
  }

  // Depth first; one branch waits at each level.
  std::array<Piece, kDeepest + 2> stack;
  std::size_t top = 0;
  stack[top++] = whole;
  for (int pieces = 0; top > 0 && pieces < kMostPieces; ++pieces) {
    const Piece piece = stack[--top];
    if (piece.depth > 0 && piece.excludes_solution()) continue;
    const bool is_last = piece.depth == kDeepest;
    if (is_last || (piece.depth > 0 && is_nearly_linear(piece.corners))) {
      const Vec3 middle = (piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3.0;
      if (const auto b = newton(middle, size)) solutions.add(*b);
      continue;
    }
    const std::array<Piece, 2> halves = piece.halves();
    stack[top++] = halves[1];
    stack[top++] = halves[0];
  }
}

}  // namespace mimicry
