#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

struct ShapeOptions {
  int resolution = 0;      ///< what it counts: ShapeInfo; 0: the shape's default
  std::uint64_t seed = 1;  ///< of the random shapes (noisy-cube)
  double noise = 0.1;      ///< noisy-cube: largest displacement as a fraction of the cube's edge
  bool two_sided = false;  ///< noisy-cube: displacements in [-noise, noise], not [0, noise]
};

/// A shape that is made in code: deterministic, y up, centred near the origin, about 2 units
/// large, counter-clockwise seen from outside.
struct ShapeInfo {
  std::string_view name;
  std::string_view description;  ///< one line
  std::string_view resolution;   ///< what `resolution` counts, and the number of faces
  int default_resolution;
  int least_resolution;
  int most_resolution;
  double metres_per_unit;  ///< display scale for drawing on it: objects of 0.3 to 0.6 m
  TriangleMesh (*make)(const ShapeOptions& options);  ///< takes a valid resolution, not 0
};

/// All of them, in a fixed order.
std::span<const ShapeInfo> builtin_shapes();

/// nullptr for an unknown name.
const ShapeInfo* find_shape(std::string_view name);

/// Throws Error(invalid_input) for an unknown name (the message lists the known ones), a resolution
/// out of the shape's range, and noise outside [0, 1]. O(#F log #F).
TriangleMesh make_shape(std::string_view name, const ShapeOptions& options = {});

/// At this resolution the torus has 86,400 faces, "the 86K-face mesh" of all measurements.
inline constexpr int kLargeTorusResolution = 120;

/// Sizes of the built-in shapes in their own units.
inline constexpr double kSphereRadius = 1.0;
inline constexpr double kTorusMajorRadius = 0.8;  ///< the ring lies around the z axis
inline constexpr double kTorusMinorRadius = 0.32;
inline constexpr double kCubeHalfSize = 0.8;
inline constexpr double kRoundedCubeRadius = 0.25;
inline constexpr double kCylinderRadius = 0.6;  ///< around the y axis
inline constexpr double kCylinderHalfHeight = 1.0;
inline constexpr double kPlateHalfWidth = 1.0;  ///< x
inline constexpr double kPlateHalfHeight = 0.75;
inline constexpr double kPlateHalfThickness = 0.02;  ///< z

/// The point closest to x on the ideal surface of sphere, torus, cube, rounded-cube, cylinder or
/// plate; nothing for other names. Of several closest points any one (on the medial axis). The mesh
/// has its vertices on the ideal surface; its faces leave it by at most `faceting_error`.
std::optional<Vec3> analytic_closest_point(std::string_view name, const Vec3& x);

/// An upper bound of the distance between the mesh at this resolution and the ideal surface, in
/// units of the shape: 0 for cube and plate; nothing where there is no analytic closest point.
std::optional<double> faceting_error(std::string_view name, int resolution);

/// Points of the ideal surfaces by their parameters, in radians: along the knot and around the
/// tube; along the strip, with w in [-0.3, 0.3] across it (w changes sign after a full turn).
Vec3 trefoil_point(double along, double around);
Vec3 moebius_point(double along, double w);
/// Centre line of a finger of the hand, t in [0, 1] from its root to the end of its cage (the
/// surface ends at about 0.95); finger 0: thumb, 1 to 4: index to little finger.
Vec3 hand_finger_axis(int finger, double t);

// The shapes with all their parameters. Resolutions are at least those of the registry.

/// Icosahedron with every edge cut into n, projected on the sphere: 20 n^2 faces, none of them
/// thin, no poles.
TriangleMesh make_sphere(int n, double radius = kSphereRadius);
/// around x across quads, each cut in two; around the z axis.
TriangleMesh make_torus(int around, int across, double major_radius = kTorusMajorRadius,
                        double minor_radius = kTorusMinorRadius);
/// Axis-aligned box with nx, ny, nz quads along its edges, each cut in two.
TriangleMesh make_box(int nx, int ny, int nz, const Vec3& half_size);
/// Cube with rounded edges and corners, 12 n^2 faces.
TriangleMesh make_rounded_cube(int n, double half_size = kCubeHalfSize,
                               double radius = kRoundedCubeRadius);
/// Closed cylinder around the y axis: 6 n segments around, caps of n rings.
TriangleMesh make_cylinder(int n, double radius = kCylinderRadius,
                           double half_height = kCylinderHalfHeight);
/// Tube around a trefoil knot, 10 n by n quads.
TriangleMesh make_trefoil(int n);
/// Palm, wrist and five thin fingers in one closed surface of genus 0: a box-modelled cage under
/// `levels` steps of Catmull-Clark subdivision.
TriangleMesh make_hand(int levels);
/// Genus 2, made the same way.
TriangleMesh make_double_torus(int levels);
/// Cube with n x n quads a side; each vertex is moved along its normal by a uniform random part of
/// [0, fraction] (two_sided: [-fraction, fraction]) of the cube's edge.
TriangleMesh make_noisy_cube(int n, double fraction, bool two_sided, std::uint64_t seed);
/// One-sided: no orientation of the faces is consistent. n x max(1, n / 8) quads.
TriangleMesh make_moebius_strip(int n);
/// Open square in the plane z = 0, facing +z, [-1, 1]^2, n x n quads.
TriangleMesh make_grid(int n);
/// Two components: spheres of radius 0.45 at x = -0.55 and x = 0.55.
TriangleMesh make_two_spheres(int n);

}  // namespace mimicry
