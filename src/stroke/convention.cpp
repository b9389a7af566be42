#include <array>

#include <mimicry/stroke/stroke.h>

namespace mimicry {
namespace {

Mat3 rows(const Vec3& x, const Vec3& y, const Vec3& z) {
  Mat3 m;
  m.row(0) = x.transpose();
  m.row(1) = y.transpose();
  m.row(2) = z.transpose();
  return m;
}

std::array<CoordinateConvention, 4> make_conventions() {
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  const Mat3 same = Mat3::Identity();
  const Mat3 mirror_z = rows(x, y, -z);
  const Mat3 unreal = rows(y, z, -x);
  const Mat3 half_turn = rows(-x, y, -z);
  return {{{"openxr", same, same, 1.0},
           {"unity", mirror_z, mirror_z, 1.0},
           {"unreal", unreal, unreal, 0.01},
           {"paper", same, half_turn, 1.0}}};
}

// R' = world R device^T, as quaternions: with world == device the vector part is permuted and
// flipped (once more by a mirror's determinant) and nothing rounds, so that recordings come back
// unchanged.
Quat change_axes(const Quat& q, const Mat3& world, const Mat3& device) {
  Quat changed;
  changed.w() = q.w();
  changed.vec() = world.determinant() * (world * q.vec());
  if (world != device) changed = changed * Quat(Mat3(world * device.transpose()));
  return changed;
}

}  // namespace

Quat CoordinateConvention::orientation_in(const Quat& q) const {
  return change_axes(q, world_axes, device_axes);
}

Quat CoordinateConvention::orientation_out(const Quat& q) const {
  return change_axes(q, world_axes.transpose(), device_axes.transpose());
}

Frame CoordinateConvention::frame_in(const Frame& other) const {
  Frame frame = other;
  for (Pose Frame::*pose : {&Frame::head, &Frame::controller})
    frame.*pose = {position_in((other.*pose).position), orientation_in((other.*pose).orientation)};
  return frame;
}

Frame CoordinateConvention::frame_out(const Frame& internal) const {
  Frame frame = internal;
  for (Pose Frame::*pose : {&Frame::head, &Frame::controller})
    frame.*pose = {position_out((internal.*pose).position),
                   orientation_out((internal.*pose).orientation)};
  return frame;
}

Similarity CoordinateConvention::placement_in(const Similarity& other) const {
  return {change_axes(other.rotation, world_axes, world_axes), position_in(other.translation),
          metres_per_unit * other.scale};
}

Similarity CoordinateConvention::placement_out(const Similarity& internal) const {
  return {change_axes(internal.rotation, world_axes.transpose(), world_axes.transpose()),
          position_out(internal.translation), internal.scale / metres_per_unit};
}

std::span<const CoordinateConvention> conventions() {
  static const std::array<CoordinateConvention, 4> list = make_conventions();
  return list;
}

const CoordinateConvention* find_convention(std::string_view name) {
  for (const CoordinateConvention& c : conventions())
    if (c.name == name) return &c;
  return nullptr;
}

}  // namespace mimicry
