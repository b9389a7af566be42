#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

#include <mimicry/mesh/shapes.h>

#include "mesh/quads.h"

namespace mimicry {
namespace {

// The outside of a set of unit cells.
template <class Position>
QuadMesh cage(const std::set<LatticePoint>& cells, Position position) {
  LatticeIndex index;
  QuadMesh mesh;
  for (const LatticePoint& cell : cells)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        LatticePoint beside = cell;
        beside[axis] += side == 1 ? 1 : -1;
        if (cells.contains(beside)) continue;
        const auto at = [&](int du, int dv) {
          LatticePoint p = cell;
          p[axis] += side;
          p[(axis + 1) % 3] += du;
          p[(axis + 2) % 3] += dv;
          return index(p);
        };
        if (side == 1)
          mesh.quads.push_back({at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
        else
          mesh.quads.push_back({at(0, 0), at(0, 1), at(1, 1), at(1, 0)});
      }
  for (const LatticePoint& p : index.points()) mesh.positions.push_back(position(p));
  return mesh;
}

TriangleMesh subdivided(QuadMesh mesh, int levels) {
  for (int i = 0; i < levels; ++i) mesh = catmull_clark(mesh);
  return triangulate(std::move(mesh));
}

// Hand, in units of a finger's width. Columns 0, 2, 4, 6 carry fingers, 1, 3, 5 are the gaps.
constexpr int kPalmTop = 3;
constexpr int kFingerSegments = 4;
constexpr int kThumbSegments = 3;
constexpr double kColumns[8] = {0, 1, 1.5, 2.5, 3, 4, 4.5, 5.5};
constexpr double kRows[5] = {-1.4, 0, 1.4, 2.8, 4};  // from the wrist's end up to the fingers

// A point of a finger's cage: t along it, then across and through it in its own widths.
Vec3 finger_position(int finger, double t, double across, double through) {
  constexpr double kLengths[5] = {3.4, 4.0, 4.7, 4.3, 3.3};
  constexpr double kFan[5] = {-0.82, -0.16, -0.04, 0.07, 0.2};  // radians off +y, towards +x
  const double root_x = finger == 0 ? 0.0 : kColumns[2 * finger - 2] + 0.5;
  const double root_y = finger == 0 ? 0.7 : kRows[4];
  const double curl = finger == 0 ? 0.5 * t : 0.9 * t * t;
  const double taper = 1 - 0.25 * t;
  const double along = t * kLengths[finger];
  const double s = std::sin(kFan[finger]), c = std::cos(kFan[finger]);
  return 0.2 * Vec3(root_x + along * s + across * taper * c - 2.2,
                    root_y + along * c - across * taper * s - 3.5, through * taper + curl);
}

Vec3 hand_position(const LatticePoint& p) {
  const double through = p[2] - 0.5;
  if (p[0] < 0)
    return finger_position(0, static_cast<double>(-p[0]) / kThumbSegments, 1.2 * (p[1] - 0.5),
                           through);
  if (p[1] > kPalmTop)
    return finger_position(p[0] / 2 + 1, static_cast<double>(p[1] - kPalmTop) / kFingerSegments,
                           p[0] % 2 - 0.5, through);
  return 0.2 * Vec3(kColumns[p[0]] - 2.2, kRows[p[1] + 1] - 3.5, through);
}

}  // namespace

Vec3 hand_finger_axis(int finger, double t) {
  return finger_position(finger, t, 0, 0);
}

TriangleMesh make_hand(int levels) {
  std::set<LatticePoint> cells;
  for (int row = 0; row < kPalmTop; ++row)
    for (int column = 0; column < 7; ++column) cells.insert({column, row, 0});
  for (int column = 1; column < 6; ++column) cells.insert({column, -1, 0});
  for (int finger = 0; finger < 4; ++finger)
    for (int i = 0; i < kFingerSegments; ++i) cells.insert({2 * finger, kPalmTop + i, 0});
  for (int i = 1; i <= kThumbSegments; ++i) cells.insert({-i, 0, 0});
  return subdivided(cage(cells, hand_position), levels);
}

TriangleMesh make_double_torus(int levels) {
  std::set<LatticePoint> cells;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 5; ++i)
      if (j != 1 || i % 2 == 0) cells.insert({i, j, 0});
  return subdivided(cage(cells,
                         [](const LatticePoint& p) {
                           return Vec3(0.44 * (p[0] - 2.5), 0.44 * (p[1] - 1.5),
                                       0.44 * (p[2] - 0.5));
                         }),
                    levels);
}

}  // namespace mimicry
