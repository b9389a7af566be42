#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/paint/atlas.h>

namespace mimicry {

/// What a brush needs of the exponential map: the faces that lie within a radius of a point along
/// the surface, and where their corners lie in the plane of the point. Only corners of such faces
/// are visited, however far they are, so that the work is bounded by what the brush touches, and
/// brushes much smaller than a face are exact: the centre's face is laid down as it is, its
/// neighbours are unfolded.
/// As in `DiscreteExponentialMap` corners are settled by their distance; where the way from the
/// centre leaves the face's edge beside it, faces are laid at the edge as they are.
/// Lengths are at least those of straight lines and at most those of ways along edges. A face whose
/// corners were reached by ways around an obstacle or around the object is laid in one direction.
/// No allocation after warm-up.
class NearMap {
 public:
  explicit NearMap(const PaintAtlas& atlas);

  /// Faces whose distance is within `radius` and a texel (model units, infinity: all that is
  /// connected). centre: a point of the mesh in a face that does not repeat a corner.
  /// O(faces log faces).
  void compute(const SurfacePoint& centre, double radius);

  /// In the order in which they were reached.
  std::span<const Index> faces() const { return faces_; }
  /// Of a face of `faces`: its corners in the plane.
  std::array<Vec2, 3> corners(Index face) const;
  /// Where a point lies; false where its face is not among them.
  bool place(const SurfacePoint& p, Vec2& result) const;

  /// A direction of space in the plane: its part there.
  Vec2 in_plane(const Vec3& v) const { return {v.dot(x_axis_), v.dot(y_axis_)}; }

  std::size_t memory_bytes() const;

 private:
  struct Entry {
    double key;
    Index vertex;
    bool operator<(const Entry& other) const {
      return key != other.key ? key > other.key : vertex > other.vertex;
    }
  };
  bool is_settled(Index v) const { return stamps_[at(v)] == stamp_ && settled_[at(v)]; }
  bool is_listed(Index f) const { return face_stamps_[at(f)] == stamp_; }
  void lay_centre(const SurfacePoint& centre);
  void settle(Index vertex);
  void list(Index face);
  void propose(Index h);
  void reach(Index vertex, const Vec2& place, double key, double bound);

  const PaintAtlas& atlas_;
  const TriangleMesh& mesh_;
  const HalfEdges& half_edges_;
  double radius_ = 0.0;
  Vec3 origin_ = Vec3::Zero();
  Vec3 x_axis_ = Vec3::UnitX(), y_axis_ = Vec3::UnitY();
  std::vector<Index> faces_, waiting_;
  std::vector<Entry> heap_;
  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> face_stamps_;  // #F: listed
  std::vector<std::uint32_t> stamps_;       // #V; the rest is valid where stamped
  std::vector<std::uint8_t> settled_;
  std::vector<double> keys_, bounds_;
  std::vector<Vec2> places_;
  std::vector<float> stretch_;  // a length that straight lines ask for, by that of the place
};

}  // namespace mimicry
