#include "io/tube_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <mimicry/base/error.h>

namespace mimicry {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRoundedBend = kPi / 12.0;  // 1 - cos of half of it is 0.9 %
constexpr double kMinStep = 1e-6;            // of the radius

/// Right-handed: `along` runs with the curve, `side` and along x side span the ring.
struct TubeFrame {
  Vec3 along;
  Vec3 side;
};

struct Knot {
  Vec3 position;
  double radius;
  double slope = 0.0;  // of the radius over arc length
};

struct Ring {
  Knot knot;
  TubeFrame frame;
  double at;  // arc length
};

bool finite(const Vec3& p) {
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

void check_radius(double radius) {
  if (!std::isfinite(radius) || radius <= 0.0)
    throw Error(ErrorKind::invalid_input, "tube: the radius must be positive and finite");
}

void check(std::span<const Vec3> points, const TubeOptions& options) {
  if (options.radii.empty()) check_radius(options.radius);
  for (const double radius : options.radii) check_radius(radius);
  if (!options.radii.empty() && options.radii.size() != points.size())
    throw Error(ErrorKind::invalid_input, "tube: " + std::to_string(options.radii.size()) +
                                              " radii for " + std::to_string(points.size()) +
                                              " points; give one for each");
  if (options.sides < 3 || options.sides > 1024) {
    throw Error(ErrorKind::invalid_input, "tube: " + std::to_string(options.sides) +
                                              " sides; the number must lie in 3..1024");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!finite(points[i])) {
      throw Error(ErrorKind::invalid_input,
                  "tube: point " + std::to_string(i) + " is not finite; leave misses out");
    }
  }
}

double largest_radius(const TubeOptions& options) {
  return options.radii.empty() ? options.radius
                               : *std::max_element(options.radii.begin(), options.radii.end());
}

double distance(const Knot& a, const Knot& b) {
  return (a.position - b.position).stableNorm();
}

std::vector<Knot> distinct(std::span<const Vec3> points, const TubeOptions& options,
                           double min_step) {
  std::vector<Knot> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept.empty() || (points[i] - kept.back().position).stableNorm() > min_step)
      kept.push_back({points[i], options.radii.empty() ? options.radius : options.radii[i]});
  return kept;
}

// Central differences; one-sided at the ends of an open tube.
void set_slopes(std::vector<Knot>& knots, bool closed) {
  const std::size_t count = knots.size();
  for (std::size_t i = 0; i < count && count > 1; ++i) {
    const Knot& before = i > 0 ? knots[i - 1] : closed ? knots.back() : knots[i];
    const Knot& after = i + 1 < count ? knots[i + 1] : closed ? knots.front() : knots[i];
    knots[i].slope =
        (after.radius - before.radius) / (distance(before, knots[i]) + distance(knots[i], after));
  }
}

/// The least turn that takes one direction to another; half a turn around `side` for a reversal.
struct Turn {
  Vec3 axis;
  double angle;
};

Turn turn_between(const TubeFrame& from, const Vec3& along) {
  const Vec3 cross = from.along.cross(along);
  const double angle = std::atan2(cross.norm(), from.along.dot(along));
  // Below this the axis is rounding noise; a reversal takes one that is square to the curve.
  if (cross.norm() < 1e-12) return {from.side, angle > 1.0 ? kPi : 0.0};
  return {cross.normalized(), angle};
}

TubeFrame turned(const TubeFrame& frame, const Turn& turn, double share) {
  const Eigen::AngleAxisd rotation(share * turn.angle, turn.axis);
  TubeFrame result;
  result.along = (rotation * frame.along).normalized();
  const Vec3 side = rotation * frame.side;
  result.side = (side - side.dot(result.along) * result.along).normalized();
  return result;
}

/// The rings of a joint, and the frame that leaves it.
TubeFrame add_joint(const Knot& knot, double at, const TubeFrame& before, const Vec3& along,
                    std::vector<Ring>& rings) {
  const Turn turn = turn_between(before, along);
  if (turn.angle <= kRoundedBend) {
    rings.push_back({knot, turned(before, turn, 0.5), at});
  } else {
    const int steps = static_cast<int>(std::ceil(turn.angle / kRoundedBend));
    for (int i = 0; i <= steps; ++i) {
      rings.push_back({knot, turned(before, turn, static_cast<double>(i) / steps), at});
    }
  }
  TubeFrame after = turned(before, turn, 1.0);
  after.along = along;  // no drift
  after.side = (after.side - after.side.dot(along) * along).normalized();
  return after;
}

/// Turns the rings of a closed tube about the curve, growing with arc length, so that the last
/// frame meets the first.
void spread_twist(std::vector<Ring>& rings, const TubeFrame& first, const TubeFrame& last,
                  double length) {
  const double twist =
      std::atan2(first.along.dot(last.side.cross(first.side)), last.side.dot(first.side));
  for (Ring& ring : rings) {
    ring.frame.side =
        Eigen::AngleAxisd(twist * ring.at / length, ring.frame.along) * ring.frame.side;
  }
}

class TubeBuilder {
 public:
  explicit TubeBuilder(int sides) : sides_(sides) {}

  /// latitude: of a ring of an end's half ball; 0 on the tube itself.
  void add_ring(const Knot& knot, const TubeFrame& frame, double latitude) {
    const Vec3 other = frame.along.cross(frame.side);
    for (int k = 0; k < sides_; ++k) {
      const double a = 2.0 * kPi * k / sides_;
      const Vec3 out = std::cos(a) * frame.side + std::sin(a) * other;
      const Vec3 direction =
          (std::cos(latitude) * out + std::sin(latitude) * frame.along).normalized();
      positions_.push_back(knot.position + knot.radius * direction);
      // A cone's normals lean against its growth.
      normals_.push_back(latitude == 0.0 ? (direction - knot.slope * frame.along).normalized()
                                         : direction);
    }
  }

  void add_pole(const Knot& knot, const Vec3& direction) {
    positions_.push_back(knot.position + knot.radius * direction);
    normals_.push_back(direction);
  }

  /// Faces between the rings that start at vertices a and b, b further along the curve.
  void join(Index a, Index b) {
    for (int k = 0; k < sides_; ++k) {
      const int next = (k + 1) % sides_;
      faces_.push_back({a + k, a + next, b + next});
      faces_.push_back({a + k, b + next, b + k});
    }
  }

  void fan_before(Index pole, Index ring) {
    for (int k = 0; k < sides_; ++k) faces_.push_back({pole, ring + (k + 1) % sides_, ring + k});
  }

  void fan_after(Index ring, Index pole) {
    for (int k = 0; k < sides_; ++k) faces_.push_back({ring + k, ring + (k + 1) % sides_, pole});
  }

  Index next_vertex() const { return static_cast<Index>(positions_.size()); }

  TubeMesh take() {
    return {TriangleMesh(std::move(positions_), std::move(faces_)), std::move(normals_)};
  }

 private:
  int sides_;
  std::vector<Vec3> positions_, normals_;
  std::vector<Face> faces_;
};

}  // namespace

TubeMesh tube_mesh(std::span<const Vec3> points, const TubeOptions& options) {
  check(points, options);
  if (points.empty()) return {};
  const double min_step = kMinStep * largest_radius(options);
  std::vector<Knot> kept = distinct(points, options, min_step);
  bool closed = options.closed && kept.size() > 2;
  if (closed && distance(kept.front(), kept.back()) <= min_step) {
    kept.pop_back();
    closed = kept.size() > 2;
  }
  set_slopes(kept, closed);

  const std::size_t count = kept.size();
  std::vector<Vec3> along;  // of the segment that leaves each point
  for (std::size_t i = 0; i + 1 < count || (closed && i < count); ++i) {
    along.push_back((kept[(i + 1) % count].position - kept[i].position).stableNormalized());
  }
  if (along.empty()) along.push_back(Vec3::UnitY());

  const TubeFrame first{along.front(), along.front().unitOrthogonal()};
  std::vector<Ring> rings;
  if (!closed) rings.push_back({kept.front(), first, 0.0});
  TubeFrame frame = first;
  double at = 0.0;
  for (std::size_t i = 1; i < along.size() + (closed ? 1 : 0); ++i) {
    at += distance(kept[i % count], kept[i - 1]);
    frame = add_joint(kept[i % count], at, frame, along[i % count], rings);
  }
  if (closed) {
    spread_twist(rings, first, frame, at);
  } else if (count > 1) {
    rings.push_back({kept.back(), frame, at});
  }

  const int cap_rings = closed ? 0 : std::max(2, options.sides / 4) - 1;
  const auto vertices = (rings.size() + 2 * static_cast<std::size_t>(cap_rings)) *
                            static_cast<std::size_t>(options.sides) +
                        2;
  if (vertices > static_cast<std::size_t>(std::numeric_limits<Index>::max() / 6)) {
    throw Error(ErrorKind::unsupported,
                "tube: " + std::to_string(vertices) + " vertices; take fewer points or sides");
  }

  TubeBuilder builder(options.sides);
  const Knot head = rings.front().knot;
  const Knot tail = rings.back().knot;
  const TubeFrame head_frame = rings.front().frame;
  const TubeFrame tail_frame = rings.back().frame;
  if (!closed) builder.add_pole(head, -head_frame.along);
  const Index start = builder.next_vertex();
  const auto latitude = [&](int i) { return 0.5 * kPi * i / (cap_rings + 1); };
  for (int i = cap_rings; i >= 1; --i) builder.add_ring(head, head_frame, -latitude(i));
  for (const Ring& ring : rings) builder.add_ring(ring.knot, ring.frame, 0.0);
  for (int i = 1; i <= cap_rings; ++i) builder.add_ring(tail, tail_frame, latitude(i));
  const Index end = builder.next_vertex();
  for (Index a = start; a + options.sides < end; a += options.sides) {
    builder.join(a, a + options.sides);
  }
  if (closed) {
    builder.join(end - options.sides, start);
  } else {
    builder.add_pole(tail, tail_frame.along);
    builder.fan_before(start - 1, start);
    builder.fan_after(end - options.sides, end);
  }
  return builder.take();
}

}  // namespace mimicry
