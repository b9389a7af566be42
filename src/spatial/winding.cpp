#include "spatial/winding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "spatial/pseudonormal.h"

namespace mimicry {
namespace {

constexpr Index kMostInLeaf = 8;
constexpr double kFullAngle = 4.0 * std::numbers::pi;

std::size_t at_index(Index i) {
  return static_cast<std::size_t>(i);
}

// Van Oosterom and Strackee 1983; corners relative to the eye.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double top = a.dot(b.cross(c));
  const double bottom = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2.0 * std::atan2(top, bottom);
}

}  // namespace

WindingNumber::WindingNumber(const TriangleMesh& mesh, const WindingOptions& options)
    : accuracy2_(options.accuracy * options.accuracy) {
  std::vector<Index> order(at_index(mesh.face_count()));
  std::iota(order.begin(), order.end(), 0);
  if (!order.empty()) build(0, mesh.face_count(), order, mesh);
  faces_.reserve(order.size());
  for (const Index f : order)
    faces_.push_back({mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)});
}

Index WindingNumber::build(Index begin, Index end, std::vector<Index>& order,
                           const TriangleMesh& mesh) {
  const auto number = static_cast<Index>(nodes_.size());
  nodes_.emplace_back();
  const auto centroid = [&](Index f) -> Vec3 {
    return (mesh.corner(f, 0) + mesh.corner(f, 1) + mesh.corner(f, 2)) / 3.0;
  };
  Eigen::AlignedBox3d box;
  Vec3 weighted = Vec3::Zero();
  double area = 0.0;
  Node node;
  node.normal.setZero();
  node.first.setZero();
  for (Index i = begin; i < end; ++i) {
    const Index f = order[at_index(i)];
    const Vec3 vector = 0.5 * mesh.area_vector(f), middle = centroid(f);
    box.extend(middle);
    weighted += vector.norm() * middle;
    area += vector.norm();
    node.normal += vector;
  }
  node.centre = area > 0.0 ? Vec3(weighted / area) : box.center();
  double radius2 = 0.0;
  for (Index i = begin; i < end; ++i) {
    const Index f = order[at_index(i)];
    node.first += (centroid(f) - node.centre) * (0.5 * mesh.area_vector(f)).transpose();
    for (int k = 0; k < 3; ++k)
      radius2 = std::max(radius2, (mesh.corner(f, k) - node.centre).squaredNorm());
  }
  node.radius2 = radius2 * accuracy2_;
  node.begin = begin;
  node.end = end;
  node.right = kNone;
  if (end - begin > kMostInLeaf) {
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                     [&](Index f, Index g) {
                       const double a = centroid(f)[axis], b = centroid(g)[axis];
                       return a != b ? a < b : f < g;
                     });
    build(begin, middle, order, mesh);
    node.right = build(middle, end, order, mesh);
  }
  nodes_[at_index(number)] = node;
  return number;
}

double WindingNumber::at(const Vec3& y) const {
  if (nodes_.empty()) return 0.0;
  double angle = 0.0;
  std::array<Index, 64> stack;  // halves of halves: no deeper than 32
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Index number = stack[--top];
    const Node& node = nodes_[at_index(number)];
    const Vec3 r = node.centre - y;
    const double r2 = r.squaredNorm();
    if (r2 > node.radius2) {
      const double r3 = r2 * std::sqrt(r2);
      angle += (r.dot(node.normal) + node.first.trace() - 3.0 * r.dot(node.first * r) / r2) / r3;
    } else if (node.right == kNone) {
      for (Index i = node.begin; i < node.end; ++i) {
        const Corners& f = faces_[at_index(i)];
        angle += solid_angle(f.a - y, f.b - y, f.c - y);
      }
    } else {
      stack[top++] = node.right;
      stack[top++] = number + 1;
    }
  }
  return angle / kFullAngle;
}

double WindingNumber::at_exhaustively(const Vec3& y) const {
  double angle = 0.0;
  for (const Corners& f : faces_) angle += solid_angle(f.a - y, f.b - y, f.c - y);
  return angle / kFullAngle;
}

std::optional<SignedDistance> signed_distance(const Target& target, const WindingNumber& winding,
                                              const Vec3& y, Index hint) {
  const auto closest = target.closest_point(y, kInfinity, hint);
  if (!closest) return std::nullopt;
  const double sign = winding.at(y) > 0.5 ? -1.0 : 1.0;
  SignedDistance result{sign * closest->distance, Vec3::Zero(), closest->surface};
  if (closest->distance > kOnSurface * target.diagonal())
    result.gradient = (y - closest->position) / result.distance;
  else
    result.gradient = pseudonormal(target, closest->surface);
  return result;
}

}  // namespace mimicry
