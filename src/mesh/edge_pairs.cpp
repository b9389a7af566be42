#include "mesh/edge_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Core>

#include <mimicry/mesh/surface.h>

namespace mimicry {
namespace {

constexpr double kNoAngle = 1e-9;  // radians: rounding of coincident faces

using Pairs = std::vector<std::pair<Index, Index>>;

// A face at an edge, seen along it.
struct Wing {
  Vec3 inward = Vec3::Zero();  // unit, from the edge into the face; zero for a face without area
  Vec3 back = Vec3::Zero();    // unit, against the face's normal
  bool has_area() const { return !inward.isZero(0.0); }
};

Wing wing_of(const TriangleMesh& mesh, Index h, bool turned) {
  const Index f = h / 3;
  const int k = static_cast<int>(h % 3);
  Vec3 n = face_normal(mesh, f);
  Vec3 along = mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k);
  const double largest = along.cwiseAbs().maxCoeff();
  if (n.isZero(0.0) || !(largest > 0.0) || !std::isfinite(largest)) return {};
  along /= largest;  // squares neither vanish nor overflow
  const Vec3 inward = n.cross(along).normalized();
  if (turned) n = -n;
  return {inward, -n};
}

// From one face through its back to another: above 0 and at most a full turn.
double angle_through_back(const Wing& from, const Wing& to) {
  double angle = std::atan2(to.inward.dot(from.back), to.inward.dot(from.inward));
  if (angle < 0.0) angle += kTau;
  return angle < kNoAngle ? kTau : angle;
}

double cost(const Wing& from, const Wing& to) {
  constexpr double kSmallerFirst = 1e-6;  // below any difference that a shape could mean
  if (!from.has_area() || !to.has_area()) return kTau * kTau;
  const double angle = angle_through_back(from, to);
  const double bend = angle - std::numbers::pi;
  return bend * bend + kSmallerFirst * angle;
}

// The assignment of each row to a column of its own with the least sum; rows <= columns. Shortest
// augmenting paths (Jonker and Volgenant 1987) with potentials; rows are entered one by one.
std::vector<Index> assign(const Eigen::MatrixXd& costs) {
  const Eigen::Index rows = costs.rows(), columns = costs.cols();
  // Row and column 0 stand for "none yet".
  std::vector<double> u(static_cast<std::size_t>(rows) + 1, 0.0);
  std::vector<double> v(static_cast<std::size_t>(columns) + 1, 0.0);
  std::vector<Eigen::Index> row_of(static_cast<std::size_t>(columns) + 1, 0);
  std::vector<Eigen::Index> way(static_cast<std::size_t>(columns) + 1, 0);
  const auto n = [](Eigen::Index i) { return static_cast<std::size_t>(i); };
  for (Eigen::Index entering = 1; entering <= rows; ++entering) {
    row_of[0] = entering;
    Eigen::Index column = 0;
    std::vector<double> least(n(columns) + 1, kInfinity);
    std::vector<bool> done(n(columns) + 1, false);
    do {
      done[n(column)] = true;
      const Eigen::Index row = row_of[n(column)];
      double step = kInfinity;
      Eigen::Index next = 0;
      for (Eigen::Index c = 1; c <= columns; ++c) {
        if (done[n(c)]) continue;
        const double reduced = costs(row - 1, c - 1) - u[n(row)] - v[n(c)];
        if (reduced < least[n(c)]) least[n(c)] = reduced, way[n(c)] = column;
        if (least[n(c)] < step) step = least[n(c)], next = c;
      }
      for (Eigen::Index c = 0; c <= columns; ++c) {
        if (done[n(c)]) {
          u[n(row_of[n(c)])] += step;
          v[n(c)] -= step;
        } else {
          least[n(c)] -= step;
        }
      }
      column = next;
    } while (row_of[n(column)] != 0);
    while (column != 0) {
      const Eigen::Index before = way[n(column)];
      row_of[n(column)] = row_of[n(before)];
      column = before;
    }
  }
  std::vector<Index> column_of(n(rows), kNone);
  for (Eigen::Index c = 1; c <= columns; ++c)
    if (row_of[n(c)] > 0) column_of[n(row_of[n(c)] - 1)] = static_cast<Index>(c - 1);
  return column_of;
}

struct Spoke {
  double angle;  // counter-clockwise around the forward direction, from the first one
  bool forward;  // the solid that it bounds lies clockwise of it
  Index h;
};

// Each solid's two faces, where the edge's surroundings are solids and gaps in turn. Faces of two
// solids may coincide, with no gap between them; a solid without thickness is none.
std::optional<Pairs> solids(std::vector<Spoke> spokes) {
  std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.h < b.h;
  });
  const std::size_t n = spokes.size();
  // Where two coincide the solid that ends there comes first.
  for (std::size_t i = 0; i + 1 < n; ++i)
    if (!spokes[i].forward && spokes[i + 1].forward &&
        spokes[i + 1].angle - spokes[i].angle < kNoAngle)
      std::swap(spokes[i], spokes[i + 1]);
  Pairs pairs;
  for (std::size_t i = 0; i < n; ++i) {
    const Spoke &here = spokes[i], &next = spokes[(i + 1) % n];
    if (here.forward == next.forward) return std::nullopt;
    if (here.forward) continue;
    const double angle = next.angle - here.angle + (i + 1 == n ? kTau : 0.0);
    if (angle < kNoAngle) return std::nullopt;
    pairs.emplace_back(next.h, here.h);
  }
  return pairs;
}

// Around the forward direction of the first side.
std::optional<Pairs> solids(std::span<const EdgeSide> sides, const std::vector<Wing>& wings) {
  const auto has_area = [](const Wing& wing) { return wing.has_area(); };
  if (!std::all_of(wings.begin(), wings.end(), has_area)) return std::nullopt;
  const Vec3 x = wings[0].inward, y = sides[0].forward ? Vec3(-wings[0].back) : wings[0].back;
  std::vector<Spoke> spokes;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    double angle = std::atan2(wings[i].inward.dot(y), wings[i].inward.dot(x));
    // What coincides with the first one is there, whatever rounding says.
    if (angle < -kNoAngle) angle += kTau;
    spokes.push_back({std::max(angle, 0.0), sides[i].forward, sides[i].h});
  }
  return solids(std::move(spokes));
}

Pairs straightest(std::span<const EdgeSide> sides, const std::vector<Wing>& wings) {
  std::vector<std::size_t> rows, columns;
  for (std::size_t i = 0; i < sides.size(); ++i) (sides[i].forward ? rows : columns).push_back(i);
  const bool across = rows.size() > columns.size();
  if (across) std::swap(rows, columns);
  Eigen::MatrixXd costs(static_cast<Eigen::Index>(rows.size()),
                        static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j)
      costs(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          across ? cost(wings[columns[j]], wings[rows[i]])
                 : cost(wings[rows[i]], wings[columns[j]]);
  const std::vector<Index> column_of = assign(costs);
  Pairs pairs;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Index row = sides[rows[i]].h, column = sides[columns[at(column_of[i])]].h;
    pairs.emplace_back(across ? column : row, across ? row : column);
  }
  return pairs;
}

}  // namespace

bool is_fold(const TriangleMesh& mesh, const std::vector<bool>& turned, Index a, Index b) {
  const Wing from = wing_of(mesh, a, turned[at(a / 3)]), to = wing_of(mesh, b, turned[at(b / 3)]);
  if (!from.has_area() || !to.has_area()) return false;
  const double angle = angle_through_back(from, to);
  return angle > kTau - kNoAngle;
}

Pairs pair_sides(const TriangleMesh& mesh, const std::vector<bool>& turned,
                 std::span<const EdgeSide> sides) {
  const auto forward = static_cast<std::size_t>(
      std::count_if(sides.begin(), sides.end(), [](const EdgeSide& side) { return side.forward; }));
  const std::size_t backward = sides.size() - forward;
  if (forward == 0 || backward == 0 || sides.size() > kMostPaired) return {};
  if (sides.size() == 2) {
    const std::size_t first = sides[0].forward ? 0 : 1;
    return {{sides[first].h, sides[1 - first].h}};
  }
  std::vector<Wing> wings;
  for (const EdgeSide& side : sides) wings.push_back(wing_of(mesh, side.h, turned[at(side.h / 3)]));
  if (forward == backward)
    if (const auto found = solids(sides, wings)) return *found;
  return straightest(sides, wings);
}

}  // namespace mimicry
