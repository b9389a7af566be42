#pragma once

#include <optional>
#include <vector>

#include <mimicry/spatial/target.h>

namespace mimicry {

struct WindingOptions {
  /// A cluster of faces is seen as dipoles from farther than this times its radius.
  double accuracy = 3.0;
};

/// Generalised winding numbers by a hierarchy of dipoles with their first
/// moments: Barill, Dickson, Schmidt,
/// Levin, Jacobson, Fast Winding Numbers for Soups and Clouds, 2018. Works on any triangles:
/// about 1 inside, 0 outside, between them near openings. Immutable; queries are const, allocate
/// nothing, and give the same bits every time.
class WindingNumber {
 public:
  /// O(#F log #F), about 120 bytes a face.
  explicit WindingNumber(const TriangleMesh& mesh, const WindingOptions& options = {});

  /// y: finite, below 1e60. On a face anything between its two sides' values. O(log #F). Error
  /// below 0.05 at the default accuracy, about 0.01 in the mean, which is plenty for a sign; it
  /// falls with the square of the accuracy.
  double at(const Vec3& y) const;
  /// The sum of all solid angles: the definition.
  double at_exhaustively(const Vec3& y) const;

 private:
  struct Node {
    Vec3 centre;       // of area
    double radius2;    // of the farthest corner, squared, times the accuracy squared
    Vec3 normal;       // sum of area vectors
    Mat3 first;        // sum of (centroid - centre) area^T
    Index begin, end;  // faces_
    Index right;       // child; the left one comes next. kNone: a leaf
  };
  struct Corners {
    Vec3 a, b, c;
  };
  Index build(Index begin, Index end, std::vector<Index>& order, const TriangleMesh& mesh);

  double accuracy2_;
  std::vector<Node> nodes_;
  std::vector<Corners> faces_;  // by leaf
};

/// The signed distance to a surface: negative inside, where the winding number is above a half (of
/// meshes that face outward).
struct SignedDistance {
  double distance;
  Vec3 gradient;  ///< unit; see distance_gradient
  SurfacePoint closest;
};

/// nullopt where y has no closest point. Surfaces with boundary are sealed by the winding number's
/// half. hint: as in Target::closest_point.
std::optional<SignedDistance> signed_distance(const Target& target, const WindingNumber& winding,
                                              const Vec3& y, Index hint = kNone);

}  // namespace mimicry
