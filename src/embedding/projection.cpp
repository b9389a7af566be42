#include "embedding/projection.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include <mimicry/base/error.h>

#include "base/finite.h"
#include "spatial/triangle.h"

namespace mimicry {
namespace {

constexpr double kLargest = 1e30;  // of coordinates: squares and products stay in range
// Sixfold volume over the cube of the size, below which coordinates are rounding. The
// shell's own are thicker (`make_shell`).
constexpr double kFlat = 1e-10;
// Barycentric coordinates nearer to 0 than this are those of a point on a face.
constexpr double kOnFace = 1e-9;

// Finite, and of at most kLargest: told from the bits, since comparing what is not finite may trap.
bool is_in_range(double x) {
  const double size = std::abs(x);
  std::uint64_t bits = 0, largest = 0;
  std::memcpy(&bits, &size, sizeof bits);
  std::memcpy(&largest, &kLargest, sizeof largest);
  return bits <= largest;
}

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorKind::invalid_input, "embedding: " + what + "; bake the target again");
}

// Before anything is built on it.
Embedding checked(Embedding e, const Target& target) {
  const TriangleMesh& mesh = target.mesh();
  if (e.mesh_vertex_count != mesh.vertex_count() || e.face_count() != mesh.face_count() ||
      e.mesh_hash != content_hash(mesh))
    refuse(e.mesh_vertex_count == mesh.vertex_count() && e.face_count() == mesh.face_count()
               ? "it is of another mesh than the target: as many vertices and faces, but in other "
                 "places or another order"
               : "it is of another mesh (" + std::to_string(e.mesh_vertex_count) + " vertices, " +
                     std::to_string(e.face_count()) + " faces) than the target (" +
                     std::to_string(mesh.vertex_count()) + " vertices, " +
                     std::to_string(mesh.face_count()) + " faces)");
  if (e.dimension < 1 || e.vertex_count() < e.mesh_vertex_count ||
      e.values.size() != e.positions.size() * static_cast<std::size_t>(e.dimension))
    refuse("its sizes contradict each other");
  const auto first_out_of_range = [](std::span<const double> numbers) {
    return static_cast<std::size_t>(
        std::find_if(numbers.begin(), numbers.end(), [](double x) { return !is_in_range(x); }) -
        numbers.begin());
  };
  const std::size_t coordinates = 3 * e.positions.size();
  const std::size_t bad_coordinate =
      coordinates == 0 ? 0 : first_out_of_range({e.positions[0].data(), coordinates});
  if (bad_coordinate < coordinates)
    refuse("vertex " + std::to_string(bad_coordinate / 3) +
           " of the shell is not finite or beyond 1e30");
  const std::size_t bad_value = first_out_of_range(e.values);
  if (bad_value < e.values.size())
    refuse("the value of vertex " +
           std::to_string(bad_value / static_cast<std::size_t>(e.dimension)) +
           " is not finite or beyond 1e30");
  if (e.overlapping_tets < 0 || static_cast<std::size_t>(e.overlapping_tets) > e.tets.size())
    refuse("its sizes contradict each other");
  const auto vertices = static_cast<std::uint32_t>(e.vertex_count());
  for (std::size_t t = 0; t < e.tets.size(); ++t) {
    std::uint32_t largest = 0;
    for (const Index v : e.tets[t]) largest = std::max(largest, static_cast<std::uint32_t>(v));
    if (largest >= vertices)
      refuse("tetrahedron " + std::to_string(t) + " refers to vertex " +
             std::to_string(static_cast<Index>(largest)) + ", which does not exist");
  }
  if (!e.face_order.empty()) {
    std::vector<bool> is_there(e.faces.size(), false);
    for (const Index f : e.face_order)
      if (f >= 0 && f < e.face_count()) is_there[at(f)] = true;
    if (e.face_order.size() != e.faces.size() ||
        std::find(is_there.begin(), is_there.end(), false) != is_there.end())
      refuse("its order of the faces is not one of all of them");
  }
  return e;
}

}  // namespace

Eigen::AlignedBox3d SmoothProjection::Tetrahedron::box() const {
  Eigen::AlignedBox3d result(corner(0));
  for (std::size_t k = 1; k < 4; ++k) result.extend(corner(k));
  return result;
}

bool SmoothProjection::Tetrahedron::barycentric(const Vec3& y, Eigen::Vector4d& bary) const {
  const Vec3 &a = corner(0), ab = corner(1) - a, ac = corner(2) - a, ad = corner(3) - a;
  const Vec3 ay = y - a, ac_ad = ac.cross(ad);
  const double volume = ab.dot(ac_ad);
  const double size2 = ab.squaredNorm() + ac.squaredNorm() + ad.squaredNorm();
  if (!(std::abs(volume) > kFlat * size2 * std::sqrt(size2))) return false;
  const Vec3 ab_ay = ab.cross(ay);
  const double b = ay.dot(ac_ad) / volume, c = ad.dot(ab_ay) / volume, d = -ac.dot(ab_ay) / volume;
  bary = {1.0 - b - c - d, b, c, d};
  return true;
}

// Squared distance to a point that is not inside, and the nearest point.
double SmoothProjection::Tetrahedron::nearest(const Vec3& y, Eigen::Vector4d& bary) const {
  double best = kInfinity;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::array<std::size_t, 3> side = {(k + 1) % 4, (k + 2) % 4, (k + 3) % 4};
    const TrianglePoint p = closest_point({corner(side[0]), corner(side[1]), corner(side[2])}, y);
    if (!(p.distance2 < best)) continue;
    best = p.distance2;
    bary.setZero();
    for (int i = 0; i < 3; ++i)
      bary[static_cast<Eigen::Index>(side[static_cast<std::size_t>(i)])] = p.bary[i];
  }
  return best;
}

SmoothProjection::SmoothProjection(Embedding embedding, const Target& target)
    : embedding_(checked(std::move(embedding), target)),
      target_(target),
      surface_(target.mesh(), target.half_edges(), embedding_.values, embedding_.dimension,
               embedding_.face_order) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : embedding_.positions) box.extend(p);
  shell_ = {box, static_cast<Index>(embedding_.tets.size()),
            [this](Index tet) { return tetrahedron(tet); }};
}

namespace {

// The best of the tetrahedra met so far, and those as good: where parts of the surface have a
// tetrahedron each in one place. Their coordinates are the same to the last bit.
struct Places {
  static constexpr std::size_t kMost = 8;
  std::array<ShellPoint, kMost> places;
  std::size_t count = 0;

  void start_over() { count = 0; }
  void add(const ShellPoint& p) {
    if (count == kMost) {
      if (p.tet > places[kMost - 1].tet) return;
      --count;
    }
    std::size_t i = count++;
    for (; i > 0 && places[i - 1].tet > p.tet; --i) places[i] = places[i - 1];
    places[i] = p;
  }
};

}  // namespace

ShellPoint SmoothProjection::locate(const Vec3& y, const ScpHint& hint) const {
  Places best;
  double depth = -kOnFace;
  bool is_in_flat = false;  // in the box of a flat one at least
  const auto consider = [&](Index tet) {
    Eigen::Vector4d bary;
    if (!tetrahedron(tet).barycentric(y, bary)) {
      is_in_flat = true;
      return false;
    }
    const double least = bary.minCoeff();
    if (!(least >= depth)) return false;
    if (least > depth) best.start_over();
    best.add({tet, bary});
    depth = least;
    return least > kOnFace && !overlaps(tet);  // then it is in no other
  };
  const bool is_hint = hint.tet >= 0 && hint.tet < shell_.size() && !overlaps(hint.tet);
  if (is_hint && !consider(hint.tet)) {
    best.start_over();
    depth = -kOnFace;
  }
  if (best.count == 0) shell_.containing(y, [&](Index tet, NoPack) { return consider(tet); });
  if (best.count == 0 && is_in_flat) {
    // The flat ones of the shell's rim bring in a sliver of the outside, no thicker than they are.
    const double touching = kOnFace * target_.diagonal();
    Eigen::Vector4d bary;
    const bool is_near = shell_.containing(y, [&](Index tet, NoPack) {
      const Tetrahedron t = tetrahedron(tet);
      return !t.barycentric(y, bary) && t.nearest(y, bary) <= touching * touching;
    });
    if (is_near) {
      double distance2 = kInfinity;
      shell_.nearest(y, kInfinity, [&](Index tet, NoPack, double bound2) {
        const Tetrahedron t = tetrahedron(tet);
        if (!t.barycentric(y, bary)) return bound2;
        const double d2 = t.nearest(y, bary);
        if (!(d2 <= distance2)) return bound2;
        if (d2 < distance2) best.start_over();
        best.add({tet, bary});
        distance2 = d2;
        return std::min(bound2, d2);
      });
    }
  }
  if (best.count == 0) return {};
  ShellPoint place = overlaps(best.places[best.count - 1].tet)
                         ? of_nearest_part(y, {best.places.data(), best.count}, hint.face)
                         : best.places[0];
  place.bary = place.bary.cwiseMax(0.0);
  place.bary /= place.bary.sum();
  return place;
}

// Tells the parts by their places in the embedding.
ShellPoint SmoothProjection::of_nearest_part(const Vec3& y, std::span<const ShellPoint> places,
                                             Index face_hint) const {
  if (places.size() == 1) return places[0];
  const auto closest = target_.closest_point(y, kInfinity, face_hint);
  assert(closest);
  const Vec8 on_surface = surface_.position(closest->surface);
  const ShellPoint* best = nullptr;
  double distance2 = kInfinity;
  for (const ShellPoint& p : places) {
    const double d2 = (lift(p) - on_surface).squaredNorm();
    if (!(d2 < distance2)) continue;
    distance2 = d2;
    best = &p;
  }
  return best ? *best : places[0];
}

Vec8 SmoothProjection::lift(const ShellPoint& p) const {
  assert(p.tet >= 0 && p.tet < shell_.size());
  Vec8 result = Vec8::Zero();
  const auto columns = static_cast<std::size_t>(embedding_.dimension);
  for (std::size_t k = 0; k < 4; ++k) {
    const double* value = embedding_.values.data() + columns * at(embedding_.tets[at(p.tet)][k]);
    const double weight = p.bary[static_cast<Eigen::Index>(k)];
    for (std::size_t i = 0; i < columns; ++i)
      result[static_cast<Eigen::Index>(i)] += weight * value[i];
  }
  return result;
}

template <class Project>
SmoothPoint SmoothProjection::resolve(const Vec3& y, const ScpOptions& options, ScpHint& hint,
                                      Project&& project) const {
  const ShellPoint place = locate(y, hint);
  hint.tet = place.tet;
  SmoothPoint result;
  if (place.tet == kNone) {
    result.label = ScpLabel::outside_shell;
  } else if (const auto found = project(lift(place))) {
    result.surface = found->surface;
    result.position = target_.position(found->surface);
    if (!options.replace_failed) {
      hint.face = result.surface.face;
      return result;
    }
    result.label = ScpLabel::replaced;
  } else {
    result.label = ScpLabel::no_phong_solution;
  }
  const auto closest = target_.closest_point(y, kInfinity, hint.face);
  assert(closest);
  if (result.label == ScpLabel::replaced &&
      (y - result.position).norm() <= closest->distance + target_.diagonal() / 20.0) {
    result.label = ScpLabel::smooth;
  } else {
    result.surface = closest->surface;
    result.position = closest->position;
  }
  hint.face = result.surface.face;
  return result;
}

std::optional<SmoothPoint> SmoothProjection::project(const Vec3& y, const ScpOptions& options,
                                                     ScpHint* hint) const {
  if (!is_finite(y) || y.cwiseAbs().maxCoeff() > 1e60) return std::nullopt;
  ScpHint none;
  ScpHint& start = hint ? *hint : none;
  return resolve(y, options, start,
                 [&](const Vec8& lifted) { return surface_.project(lifted, start.face); });
}

std::optional<SmoothPoint> SmoothProjection::project_exhaustively(const Vec3& y,
                                                                  const ScpOptions& options) const {
  if (!is_finite(y) || y.cwiseAbs().maxCoeff() > 1e60) return std::nullopt;
  ScpHint hint;
  return resolve(y, options, hint,
                 [&](const Vec8& lifted) { return surface_.project_exhaustively(lifted); });
}

SmoothPoint SmoothProjection::weighted_average(std::span<const SurfacePoint> points,
                                               std::span<const double> weights,
                                               Index face_hint) const {
  assert(!points.empty() && points.size() == weights.size());
  Vec8 sum = Vec8::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) sum += weights[i] * surface_.position(points[i]);
  SmoothPoint result;
  if (const auto found = surface_.project(sum, face_hint)) {
    result.surface = found->surface;
    result.position = target_.position(found->surface);
    return result;
  }
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) mean += weights[i] * target_.position(points[i]);
  const auto closest = target_.closest_point(mean, kInfinity, face_hint);
  assert(closest);
  return {closest->surface, closest->position, ScpLabel::no_phong_solution};
}

std::size_t SmoothProjection::memory_bytes() const {
  return embedding_.positions.capacity() * sizeof(Vec3) +
         embedding_.tets.capacity() * sizeof(embedding_.tets[0]) +
         embedding_.values.capacity() * sizeof(double) + surface_.memory_bytes() +
         shell_.memory_bytes();
}

}  // namespace mimicry
