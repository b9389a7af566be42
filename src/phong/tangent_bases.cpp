#include "phong/tangent_bases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "base/float_traps.h"

namespace mimicry {
namespace {

using Mat8 = Eigen::Matrix<double, kDimension, kDimension>;

// The sine between the tangents below which they are taken as parallel: their plane has lost all
// but 3 digits or more.
constexpr double kParallel = 1e-6;

// False where the two span no plane.
bool orthonormalise(const Vec8& s, const Vec8& t, Basis& basis) {
  const double s_length = s.norm(), t_length = t.norm();
  if (!(s_length > 1e-200 && t_length > 1e-200)) return false;
  const Vec8 first = s / s_length;
  Vec8 second = t / t_length;
  second -= first.dot(second) * first;
  const double sine = second.norm();
  if (!(sine > kParallel)) return false;
  second /= sine;
  second -= first.dot(second) * first;  // again: the first time may leave 1e-10
  basis.row(0) = first.transpose();
  basis.row(1) = second.normalized().transpose();
  return true;
}

// The ring in counter-clockwise order; false where the faces around v are not one fan.
bool ring_of(const HalfEdges& edges, Index v, std::vector<Index>& ring, bool& is_closed) {
  ring.clear();
  is_closed = true;
  const Index start = edges.outgoing(v);
  if (start < 0 || edges.is_nonmanifold_vertex(v)) return false;
  Index h = start, last = start;
  do {
    ring.push_back(edges.head(h));
    last = h;
    h = edges.ccw(h);
  } while (h >= 0 && h != start);
  if (h >= 0) return ring.size() >= 3;
  is_closed = false;
  ring.push_back(edges.tail(HalfEdges::previous(last)));
  return true;
}

// Cosine and sine of k n-ths of a turn, for each n that was asked for.
class Turns {
 public:
  const std::vector<Vec2>& of(std::size_t n) {
    if (n >= turns_.size()) turns_.resize(n + 1);
    std::vector<Vec2>& result = turns_[n];
    for (std::size_t k = result.size(); k < n; ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
      result.emplace_back(std::cos(angle), std::sin(angle));
    }
    return result;
  }

 private:
  std::vector<std::vector<Vec2>> turns_;
};

// Loop's limit tangents; the scale of each does not matter.
void loop_tangents(const Vec8& centre, std::span<const Index> ring, std::span<const Vec8> values,
                   bool is_closed, Turns& turns, Vec8& s, Vec8& t) {
  s.setZero();
  t.setZero();
  const std::size_t n = ring.size();
  const auto spoke = [&](std::size_t k) -> Vec8 { return values[at(ring[k])] - centre; };
  if (is_closed) {
    const std::vector<Vec2>& turn = turns.of(n);
    for (std::size_t k = 0; k < n; ++k) {
      s += turn[k][0] * spoke(k);
      t += turn[k][1] * spoke(k);
    }
    return;
  }
  s = spoke(0) - spoke(n - 1);
  if (n == 2) {
    t = spoke(0) + spoke(1);
  } else if (n == 3) {
    t = spoke(1);
  } else {
    const double theta = std::numbers::pi / static_cast<double>(n - 1);
    t = -std::sin(theta) * (spoke(0) + spoke(n - 1));
    for (std::size_t k = 1; k + 1 < n; ++k)
      t += (2.0 - 2.0 * std::cos(theta)) * std::sin(static_cast<double>(k) * theta) * spoke(k);
  }
}

// Twice the projector on the face's plane times its area.
Mat8 spread_of(const Face& f, std::span<const Vec8> values) {
  const Vec8& a = values[at(f[0])];
  Basis plane;
  const Vec8 ab = values[at(f[1])] - a, ac = values[at(f[2])] - a;
  if (!orthonormalise(ab, ac, plane)) return Mat8::Zero();
  const double area =
      std::abs(ab.norm() * (ac - plane.row(0).transpose() * plane.row(0).dot(ac)).norm());
  return area * plane.transpose() * plane;
}

}  // namespace

std::vector<Basis> tangent_bases(const HalfEdges& half_edges, std::span<const Face> faces,
                                 std::span<const Vec8> values) {
  std::vector<Basis> bases(values.size(), Basis::Identity());
  std::vector<Index> ring, doubtful;
  std::vector<Index> slot(values.size(), kNone);
  Turns turns;
  for (Index v = 0; v < static_cast<Index>(values.size()); ++v) {
    bool is_closed = true;
    if (ring_of(half_edges, v, ring, is_closed)) {
      Vec8 s, t;
      loop_tangents(values[at(v)], ring, values, is_closed, turns, s, t);
      if (orthonormalise(s, t, bases[at(v)])) continue;
    }
    slot[at(v)] = static_cast<Index>(doubtful.size());
    doubtful.push_back(v);
  }
  if (doubtful.empty()) return bases;

  std::vector<Mat8> spread(doubtful.size(), Mat8::Zero());
  for (const Face& f : faces)
    for (const Index v : f)
      if (slot[at(v)] >= 0) spread[at(slot[at(v)])] += spread_of(f, values);
  const FloatTrapMask mask;
  for (std::size_t i = 0; i < doubtful.size(); ++i) {
    const double size = spread[i].trace();
    if (!(size > 1e-200)) continue;
    const Eigen::SelfAdjointEigenSolver<Mat8> solver(spread[i] / size);
    bases[at(doubtful[i])] = solver.eigenvectors().rightCols<2>().transpose();
  }
  return bases;
}

}  // namespace mimicry
