#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "spatial/triangle.h"
#include "technique/normal_foot.h"
#include "technique/pen_ray.h"
#include "technique/section_walk.h"
#include "technique/soft_anchor.h"

namespace mimicry {
namespace {

// In units of |r - q|, how far the hand has gone from the last point.
constexpr double kFarthestFoot = 1.2;    // |r - x|; more is another part of the surface
constexpr double kLongestStep = 2.5;     // |x - q|
constexpr double kSearchRadius = 1.5;    // of the faces around q
constexpr double kReach = 4.0;           // |t|: kFarthestFoot over kVisibleDot, the shortest |n|
constexpr double kNoMotion = 1e-15;      // of the diagonal: below it the hand rests
constexpr double kTolerance = 1e-9;      // of the diagonal: |r - x - t n|
constexpr int kLongestWalk = 64;         // faces
constexpr std::size_t kMostFaces = 256;  // of a search; the nearest in steps come first
constexpr std::size_t kSlots = 1024;     // a power of two, four for each face

// A set of faces in the order in which they came, of fixed capacity.
class FaceSet {
 public:
  FaceSet() { slots_.fill(kNone); }
  std::size_t size() const { return size_; }
  Index operator[](std::size_t i) const { return faces_[i]; }
  void insert(Index f) {
    if (size_ == kMostFaces) return;
    std::size_t slot = (static_cast<std::uint32_t>(f) * 2654435761U) % kSlots;
    for (; slots_[slot] != kNone; slot = (slot + 1) % kSlots)
      if (slots_[slot] == f) return;
    slots_[slot] = f;
    faces_[size_++] = f;
  }

 private:
  std::array<Index, kMostFaces> faces_;
  std::array<Index, kSlots> slots_;
  std::size_t size_ = 0;
};

struct Query {
  const Target& target;
  const SurfacePoint& q;
  const Vec3& position;  // q's
  const Vec3& r;
  double gap;  // |r - q|

  Triangle triangle(Index f) const {
    const TriangleMesh& mesh = target.mesh();
    return {mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)};
  }
  NormalFoot foot(Index f) const {
    const TriangleMesh& mesh = target.mesh();
    const Face& face = mesh.face(f);
    const auto normals = target.visible_normals();
    return normal_foot(
        {{mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)},
         {normals[static_cast<std::size_t>(face[0])], normals[static_cast<std::size_t>(face[1])],
          normals[static_cast<std::size_t>(face[2])]}},
        r, kReach * gap, kTolerance * target.diagonal());
  }
  bool accepts(Index f, const NormalFoot& foot) const {
    return foot.inside && foot.distance <= kFarthestFoot * gap &&
           (target.mesh().position({f, foot.bary}) - position).norm() <= kLongestStep * gap;
  }
};

// From q's face toward the foot, over the edge that it lies beyond the most.
std::optional<SurfacePoint> walk_to_foot(const Query& query) {
  const HalfEdges& half_edges = query.target.half_edges();
  Index f = query.q.face, before = kNone;
  for (int i = 0; i < kLongestWalk; ++i) {
    const NormalFoot foot = query.foot(f);
    if (!foot.found) return std::nullopt;
    if (foot.inside) {
      if (!query.accepts(f, foot)) return std::nullopt;
      return SurfacePoint{f, foot.bary};
    }
    int beyond;
    foot.bary.minCoeff(&beyond);
    const Index twin = half_edges.twin(3 * f + (beyond + 1) % 3);
    if (twin < 0 || HalfEdges::face(twin) == before) return std::nullopt;
    before = f;
    f = HalfEdges::face(twin);
  }
  return std::nullopt;
}

// The nearest foot in the faces that are connected to q's within the search radius.
std::optional<SurfacePoint> search_foot(const Query& query) {
  const HalfEdges& half_edges = query.target.half_edges();
  const double radius = kSearchRadius * query.gap, radius2 = radius * radius;
  double nearest = kFarthestFoot * query.gap;
  std::optional<SurfacePoint> best;
  FaceSet faces;
  faces.insert(query.q.face);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Index f = faces[i];
    const Triangle triangle = query.triangle(f);
    if (i > 0) {
      double distance2 = closest_point(triangle, query.position).distance2;
      // A face without area still connects.
      for (const Vec3& corner : {triangle.a, triangle.b, triangle.c})
        distance2 = std::min(distance2, (corner - query.position).squaredNorm());
      if (distance2 > radius2) continue;
    }
    for (Index h = 3 * f; h < 3 * f + 3; ++h)
      if (half_edges.has_twin(h)) faces.insert(HalfEdges::face(half_edges.twin(h)));
    if (is_farther(triangle, query.r, nearest * nearest)) continue;
    const NormalFoot foot = query.foot(f);
    if (!query.accepts(f, foot) || foot.distance > nearest) continue;
    if (best && foot.distance == nearest && f > best->face) continue;
    nearest = foot.distance;
    best = SurfacePoint{f, foot.bary};
  }
  return best;
}

Stepped<SoftAnchor> live_step(const Canvas& canvas, const SoftAnchor& memory, const Frame& frame,
                              const Vec3& r) {
  const Target& target = canvas.target;
  const SurfacePoint& q = memory.surface;
  const Vec3 way = r - memory.position;
  if (!(way.cwiseAbs().maxCoeff() <= kFarthestHand)) return miss(memory);
  const Query query{target, q, memory.position, r, way.norm()};
  if (!(query.gap > kNoMotion * target.diagonal()))
    return stepped({Answer::smooth, q, memory.position}, memory, frame);
  std::optional<SurfacePoint> x = walk_to_foot(query);
  if (!x) x = search_foot(query);
  if (x) return stepped({Answer::smooth, *x, target.position(*x)}, memory, frame);

  const Vec3 normal = interpolated_normal(target.mesh(), target.visible_normals(), q);
  const Vec3 motion = frame.controller.position - memory.pen;
  const Vec3 tangential = motion - motion.dot(normal) * normal;
  const SurfacePoint end = walk_section(target.surface(), q, tangential, normal, tangential.norm());
  return stepped({Answer::section, end, target.position(end)}, memory, frame);
}

}  // namespace

// The point x near the last one from which the interpolated normal passes through r: as smooth as
// the surface's normals, and found without a bake. Where there is none, the motion's tangential
// part is walked off along the surface, which it therefore never leaves.
Stepped<SoftAnchor> mimicry_live(const Canvas& canvas, const SoftAnchor& memory, const Frame& frame,
                                 const SoftAnchorOptions& options) {
  if (!memory.anchored) return spray(canvas, memory, frame, options);
  return step_in_parts(
      canvas, memory, frame, options, [&](const SoftAnchor& from, const Frame& to) {
        const Vec3 r = anchored_point(canvas, from, to, options);
        Stepped<SoftAnchor> step =
            without_jump(canvas, from, to, options, live_step(canvas, from, to, r));
        keep_rest(canvas, from, to, options, r, step);
        return step;
      });
}

}  // namespace mimicry
