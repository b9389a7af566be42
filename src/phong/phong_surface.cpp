#include "phong/phong_surface.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <mimicry/base/error.h>

namespace mimicry {
namespace {

constexpr int kSteps = 6;
constexpr double kStanding = 1e-9;  // of the model's size: so near to a face y stands on it

// Squared distance of (s, t) from the triangle (0, 0), (along, 0), (across, height).
double triangle_distance2(double s, double t, double along, double across, double height) {
  const auto side = [](double px, double py, double dx, double dy) {
    // p relative to the side's start.
    const double length2 = dx * dx + dy * dy;
    const double h = length2 > 0.0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0.0;
    const double x = px - h * dx, y = py - h * dy;
    return x * x + y * y;
  };
  const double right_dx = across - along;
  const double below = t, right = right_dx * t - height * (s - along),
               left = height * s - across * t;
  if (below >= 0.0 && right >= 0.0 && left >= 0.0 && height > 0.0) return 0.0;
  double best = kInfinity;
  const bool is_line = !(height > 0.0);
  if (below < 0.0 || is_line) best = std::min(best, side(s, t, along, 0.0));
  if (right < 0.0 || is_line) best = std::min(best, side(s - along, t, right_dx, height));
  if (left < 0.0 || is_line) best = std::min(best, side(s, t, across, height));
  return best < kInfinity ? best : 0.0;
}

// The triangle's own plane, with coordinates that begin at the first corner along the first side.
double distance2_below(const Triangle8& triangle, const Vec8& y) {
  const Vec8 &x0 = *triangle.corners[0], a = *triangle.corners[1] - x0,
             b = *triangle.corners[2] - x0, v = y - x0;
  const double along2 = a.squaredNorm(), per_along2 = along2 > 0.0 ? 1.0 / along2 : 0.0;
  Vec8 up = b - per_along2 * a.dot(b) * a;
  up -= per_along2 * a.dot(up) * a;  // a thin triangle's leans by rounding
  const double along = std::sqrt(along2), height = up.norm(), v2 = v.squaredNorm();
  const double s = along * per_along2 * a.dot(v), t = height > 0.0 ? up.dot(v) / height : 0.0;
  const double above2 = v2 - s * s - t * t;
  const double distance2 = std::max(above2, 0.0) +
                           triangle_distance2(s, t, along, along * per_along2 * a.dot(b), height);
  return distance2 - 1e-13 * v2;  // more than all rounding
}

// Where y is on a face the equation holds whatever T is. Where T stands upright on the face, as
// beside the rim of a thin plate, rounding hides that from the solver.
void consider_standing(Index face, const Triangle8& triangle, const Vec8& y, double near2,
                       SurfacePoint& best, double& distance2) {
  const Vec8 &x0 = *triangle.corners[0], a = *triangle.corners[1] - x0,
             b = *triangle.corners[2] - x0, v = y - x0;
  const double along2 = a.squaredNorm(), per_along2 = along2 > 0.0 ? 1.0 / along2 : 0.0;
  const Vec8 up = b - per_along2 * a.dot(b) * a;
  const double height2 = up.squaredNorm();
  const double second = height2 > 0.0 ? up.dot(v) / height2 : 0.0;
  const double first = per_along2 * (a.dot(v) - second * a.dot(b));
  Vec3 bary = Vec3(1.0 - first - second, first, second).cwiseMax(0.0);
  bary /= bary.sum();
  const double d2 = (v - bary[1] * a - bary[2] * b).squaredNorm();
  if (d2 > near2 || d2 > distance2 || (d2 == distance2 && face > best.face)) return;
  best = {face, bary};
  distance2 = d2;
}

}  // namespace

std::vector<Index> face_order(std::span<const Face> faces, std::span<const double> values,
                              int dimension) {
  if (dimension < 1 || dimension > kDimension) return {};
  std::vector<Vec8> centres(faces.size(), Vec8::Zero());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const Index v : faces[f])
      centres[f].head(dimension) += Eigen::Map<const Eigen::VectorXd>(
          values.data() + at(v) * static_cast<std::size_t>(dimension), dimension);
  return leaf_order<kDimension>(centres);
}

PhongSurface::PhongSurface(const TriangleMesh& mesh, const HalfEdges& half_edges,
                           std::span<const double> values, int dimension,
                           std::span<const Index> order) {
  if (dimension < 1 || dimension > kDimension)
    throw Error(ErrorKind::unsupported, "embedding: dimension " + std::to_string(dimension) +
                                            " is not between 1 and 8; bake with 8 or fewer");
  const auto columns = static_cast<std::size_t>(dimension);
  values_.assign(at(mesh.vertex_count()), Vec8::Zero());
  Eigen::AlignedBox<double, kDimension> box;
  for (std::size_t v = 0; v < values_.size(); ++v) {
    for (std::size_t k = 0; k < columns; ++k)
      values_[v][static_cast<Eigen::Index>(k)] = values[v * columns + k];
    box.extend(values_[v]);
  }
  size_ = values_.empty() ? 0.0 : box.diagonal().norm();
  tangents_ = tangent_bases(half_edges, mesh.faces(), values_);

  faces_.reserve(at(mesh.face_count()));
  for (const Face& f : mesh.faces())
    faces_.push_back(
        {f, make_frames({&tangents_[at(f[0])], &tangents_[at(f[1])], &tangents_[at(f[2])]})});
  std::vector<Index> found;
  if (order.empty()) order = found = face_order(mesh.faces(), values, dimension);
  bvh_ = {box, mesh.face_count(), [&](Index f) { return triangle(f); }, order};
}

double PhongSurface::first_side(Index face) const {
  const Triangle8 t = triangle(face);
  return (*t.corners[1] - *t.corners[0]).norm();
}

Vec8 PhongSurface::position(const SurfacePoint& p) const {
  const Face& f = faces_[at(p.face)].corners;
  return p.bary[0] * value(f[0]) + p.bary[1] * value(f[1]) + p.bary[2] * value(f[2]);
}

Basis PhongSurface::tangent_plane(const SurfacePoint& p) const {
  const Record& face = faces_[at(p.face)];
  const Vec3& b = p.bary;
  const double s = b[0] * b[1] + b[1] * b[2] + b[2] * b[0];
  Basis result = Basis::Zero();
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t j = (e + 1) % 3, k = (e + 2) % 3;
    const double bi = b[static_cast<int>(e)], bj = b[static_cast<int>(j)],
                 bk = b[static_cast<int>(k)];
    const double weight = s > 1e-14 ? bi * bj / s : (bi > 0.5 ? 1.0 : 0.0);
    result += weight * ((bi + 0.5 * bk) * face.frames.from(e) * tangents_[at(face.corners[e])] +
                        (bj + 0.5 * bk) * face.frames.to(e) * tangents_[at(face.corners[j])]);
  }
  return result;
}

FaceEquation PhongSurface::equation(Index face, const Vec8& y) const {
  const Record& record = faces_[at(face)];
  std::array<std::array<Vec2, 3>, 3> u;
  for (std::size_t l = 0; l < 3; ++l) {
    const Vec8 v = y - value(record.corners[l]);
    for (std::size_t i = 0; i < 3; ++i) u[i][l] = tangents_[at(record.corners[i])] * v;
  }
  return {record.frames, u};
}

void PhongSurface::consider(Index face, const Vec8& y, SurfacePoint& best,
                            double& distance2) const {
  if (repeats_corner(faces_[at(face)].corners)) return;  // no part of the surface
  const FaceEquation::Solutions solutions = equation(face, y).solve(size_);
  for (std::size_t i = 0; i < solutions.count; ++i) {
    const SurfacePoint p = {face, solutions.b[i]};
    const double d2 = (y - position(p)).squaredNorm();
    if (d2 < distance2 || (d2 == distance2 && (best.face == kNone || face < best.face))) {
      best = p;
      distance2 = d2;
    }
  }
}

std::optional<PhongPoint> PhongSurface::project(const Vec8& y, Index hint) const {
  SurfacePoint best;
  double distance2 = kInfinity;
  // All solutions within the bound, which shrinks to the nearest.
  const auto search = [&](double within2) {
    bvh_.nearest(y, within2, [&](Index face, NoPack, double bound2) {
      if (face == best.face) return bound2;
      consider(face, y, best, distance2);
      return std::min(bound2, distance2);
    });
  };
  double nearest2 = kInfinity, side = 0.0;
  if (hint >= 0 && hint < face_count()) {
    consider(hint, y, best, distance2);
    if (best.face == kNone) {
      nearest2 = distance2_below(triangle(hint), y);
      side = first_side(hint);
    }
  }
  if (best.face == kNone) {
    // The face nearest to y need not have a solution, and until one is known nothing bounds the
    // search: it goes out by steps.
    bvh_.nearest(y, nearest2, [&](Index face, NoPack, double bound2) {
      const double d2 = distance2_below(triangle(face), y);
      if (d2 < nearest2) {
        nearest2 = d2;
        side = first_side(face);
      }
      return std::min(bound2, std::max(d2, 0.0));
    });
    double within = 1.2 * std::sqrt(std::max(nearest2, 0.0)) + 0.5 * side;
    for (int step = 0; best.face == kNone && step < kSteps; ++step, within *= 2.0)
      search(step + 1 < kSteps ? within * within : kInfinity);
  }
  // The one that is known may lie beyond the bound under which it was found.
  if (best.face != kNone) search(distance2);
  const double near2 = kStanding * kStanding * size_ * size_;
  if (distance2 > near2)
    bvh_.nearest(y, near2, [&](Index face, NoPack, double bound2) {
      if (!repeats_corner(faces_[at(face)].corners))
        consider_standing(face, triangle(face), y, near2, best, distance2);
      return bound2;
    });
  if (best.face == kNone) return std::nullopt;
  return PhongPoint{best, std::sqrt(distance2)};
}

std::optional<PhongPoint> PhongSurface::project_exhaustively(const Vec8& y) const {
  SurfacePoint best;
  double distance2 = kInfinity;
  for (Index face = 0; face < face_count(); ++face) consider(face, y, best, distance2);
  const double near2 = kStanding * kStanding * size_ * size_;
  if (distance2 > near2)
    for (Index face = 0; face < face_count(); ++face)
      if (!repeats_corner(faces_[at(face)].corners))
        consider_standing(face, triangle(face), y, near2, best, distance2);
  if (best.face == kNone) return std::nullopt;
  return PhongPoint{best, std::sqrt(distance2)};
}

std::size_t PhongSurface::memory_bytes() const {
  return values_.capacity() * sizeof(Vec8) + tangents_.capacity() * sizeof(Basis) +
         faces_.capacity() * sizeof(Record) + bvh_.memory_bytes();
}

}  // namespace mimicry
