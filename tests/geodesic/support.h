#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/base/random.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

#include "geodesic/site.h"

namespace mimicry::test {

/// A mesh of the study, nothing where the folder is absent. Vertices and faces are all that is
/// read.
inline std::optional<TriangleMesh> study_mesh(const std::string& name) {
  std::ifstream in(std::string(MIMICRY_STUDY_DATA) + "/" + name + ".obj");
  if (!in) return {};
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string key;
    fields >> key;
    if (key == "v") {
      Vec3 p;
      fields >> p[0] >> p[1] >> p[2];
      positions.push_back(p);
    } else if (key == "f") {
      std::vector<Index> polygon;
      std::string corner;
      while (fields >> corner) polygon.push_back(static_cast<Index>(std::stoi(corner)) - 1);
      for (std::size_t i = 2; i < polygon.size(); ++i)
        faces.push_back({polygon[0], polygon[i - 1], polygon[i]});
    }
  }
  return TriangleMesh(std::move(positions), std::move(faces));
}

/// Inside a face, or on an edge, or on a vertex: each one time in three.
inline SurfacePoint random_point(const TriangleMesh& mesh, Random& random) {
  SurfacePoint p;
  p.face = static_cast<Index>(random.below(static_cast<std::uint32_t>(mesh.face_count())));
  const auto k = static_cast<int>(random.below(3));
  switch (random.below(3)) {
    case 0:
      p.bary[k] = 1.0;
      break;
    case 1:
      p.bary[k] = random.uniform(0.01, 0.99);
      p.bary[(k + 1) % 3] = 1.0 - p.bary[k];
      break;
    default: {
      double a = random.uniform();
      double b = random.uniform();
      if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
      p.bary = Vec3(1.0 - a - b, a, b);
    }
  }
  return p;
}

inline double polyline_length(const TriangleMesh& mesh, const SurfacePoint& from,
                              const std::vector<Crossing>& crossings, const SurfacePoint& to) {
  double length = 0.0;
  Vec3 last = mesh.position(from);
  for (const Crossing& c : crossings) {
    const Vec3 next = position(mesh, c);
    length += (next - last).norm();
    last = next;
  }
  return length + (mesh.position(to) - last).norm();
}

inline double angle_between(const Vec3& a, const Vec3& b) {
  const double sine = a.cross(b).norm();
  const double cosine = a.dot(b);
  return sine == 0.0 && cosine == 0.0 ? 0.0 : std::atan2(sine, cosine);
}

/// Faces that a point lies in.
inline std::vector<Index> faces_at(const TriangleMesh& mesh, const HalfEdges& half_edges,
                                   const SurfacePoint& p) {
  const Site site = site_of(mesh, p);
  std::vector<Index> faces;
  if (site.kind == Site::Kind::vertex) {
    for (Index f = 0; f < mesh.face_count(); ++f)
      for (const Index v : mesh.face(f))
        if (v == site.index) faces.push_back(f);
  } else {
    faces.push_back(p.face);
    if (site.kind == Site::Kind::edge && half_edges.has_twin(site.index))
      faces.push_back(HalfEdges::face(half_edges.twin(site.index)));
  }
  return faces;
}

/// How far the path is from straight, radians: over an edge the angle that the unfolded path turns
/// by, at a vertex what the smaller side lacks of pi (a side with a boundary lacks nothing). Points
/// closer together than 1e-6 of the path are passed over: their directions are rounding. Infinite
/// where neighbours do not share a face.
inline double largest_turn(const TriangleMesh& mesh, const HalfEdges& half_edges,
                           const SurfacePoint& from, const std::vector<Crossing>& crossings,
                           const SurfacePoint& to) {
  std::vector<SurfacePoint> points = {from};
  for (const Crossing& c : crossings) points.push_back(surface_point(c));
  points.push_back(to);
  const double least = 1e-6 * polyline_length(mesh, from, crossings, to);
  double worst = 0.0;
  const auto shared_face = [&](const SurfacePoint& a, const SurfacePoint& b) {
    const auto fa = faces_at(mesh, half_edges, a);
    const auto fb = faces_at(mesh, half_edges, b);
    for (const Index f : fa)
      if (std::find(fb.begin(), fb.end(), f) != fb.end()) return f;
    return kNone;
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if (shared_face(points[i], points[i + 1]) == kNone)
      return std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec3 at = mesh.position(points[i]);
    const Vec3 back = mesh.position(points[i - 1]) - at;
    const Vec3 ahead = mesh.position(points[i + 1]) - at;
    if (back.norm() < least || ahead.norm() < least) continue;
    const Site site = site_of(mesh, points[i]);
    if (site.kind == Site::Kind::edge) {
      const Vec3 along =
          mesh.position(half_edges.head(site.index)) - mesh.position(half_edges.tail(site.index));
      worst = std::max(worst, std::abs(angle_between(along, back) + angle_between(along, ahead) -
                                       std::numbers::pi));
    } else if (site.kind == Site::Kind::vertex) {
      if (half_edges.is_nonmanifold_vertex(site.index)) continue;
      const Index face_back = shared_face(points[i - 1], points[i]);
      const Index face_ahead = shared_face(points[i], points[i + 1]);
      double angle = 0.0;
      double angle_back = 0.0;
      double angle_ahead = 0.0;
      Index h = half_edges.outgoing(site.index);
      const Index first = h;
      do {
        const Index f = HalfEdges::face(h);
        const Vec3 edge = mesh.position(half_edges.head(h)) - at;
        if (f == face_back) angle_back = angle + angle_between(edge, back);
        if (f == face_ahead) angle_ahead = angle + angle_between(edge, ahead);
        angle += angle_between(edge, mesh.position(half_edges.tail(HalfEdges::previous(h))) - at);
        h = half_edges.ccw(h);
      } while (h >= 0 && h != first);
      const double between = std::abs(angle_ahead - angle_back);
      worst = std::max(worst, std::numbers::pi - between);
      if (!half_edges.is_boundary_vertex(site.index))
        worst = std::max(worst, std::numbers::pi - (angle - between));
    }
  }
  return worst;
}

/// Distances from above: Dijkstra's algorithm on a graph with `count` points on each edge (ends
/// included), all joined within each face. Knows nothing of windows.
class GraphOracle {
 public:
  GraphOracle(const TriangleMesh& mesh, const HalfEdges& half_edges, int count)
      : mesh_(mesh), half_edges_(half_edges), count_(count) {
    const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v) nodes_.push_back(mesh.position(v));
    first_.assign(static_cast<std::size_t>(half_edges.count()), 0);
    for (Index h = 0; h < half_edges.count(); ++h) {
      if (half_edges.edge(h) != h) continue;
      first_[static_cast<std::size_t>(h)] = nodes_.size();
      for (int i = 1; i + 1 < count; ++i)
        nodes_.push_back(position(mesh, Crossing{h, double(i) / (count - 1)}));
    }
    faces_of_.resize(nodes_.size());
    face_nodes_.resize(static_cast<std::size_t>(mesh.face_count()));
    for (Index f = 0; f < mesh.face_count(); ++f) {
      auto& list = face_nodes_[static_cast<std::size_t>(f)];
      for (int k = 0; k < 3; ++k) {
        list.push_back(static_cast<std::size_t>(mesh.face(f)[static_cast<std::size_t>(k)]));
        const std::size_t start = first_[static_cast<std::size_t>(half_edges.edge(3 * f + k))];
        for (int i = 1; i + 1 < count; ++i) list.push_back(start + static_cast<std::size_t>(i) - 1);
      }
      for (const std::size_t n : list) faces_of_[n].push_back(f);
    }
    distances_.resize(vertices);
  }

  void compute(const SurfacePoint& source) {
    distances_.assign(nodes_.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto reach = [&](std::size_t n, double d) {
      if (!(d < distances_[n])) return;
      distances_[n] = d;
      queue.push({d, n});
    };
    const Vec3 p = mesh_.position(source);
    for (const Index f : faces_at(mesh_, half_edges_, source))
      for (const std::size_t n : face_nodes_[static_cast<std::size_t>(f)])
        reach(n, (nodes_[n] - p).norm());
    while (!queue.empty()) {
      const auto [d, n] = queue.top();
      queue.pop();
      if (d > distances_[n]) continue;
      for (const Index f : faces_of_[n])
        for (const std::size_t m : face_nodes_[static_cast<std::size_t>(f)])
          reach(m, d + (nodes_[m] - nodes_[n]).norm());
    }
  }

  double distance(Index vertex) const { return distances_[static_cast<std::size_t>(vertex)]; }
  /// Moving a crossing to the nearest graph point lengthens both its segments by half a spacing at
  /// most.
  double bound(const std::vector<Crossing>& crossings) const {
    double sum = 0.0;
    for (const Crossing& c : crossings)
      if (c.t > 0.0)
        sum += (mesh_.position(half_edges_.head(c.half_edge)) -
                mesh_.position(half_edges_.tail(c.half_edge)))
                   .norm() /
               (count_ - 1);
    return sum;
  }

 private:
  const TriangleMesh& mesh_;
  const HalfEdges& half_edges_;
  int count_;
  std::vector<Vec3> nodes_;
  std::vector<std::size_t> first_;
  std::vector<std::vector<Index>> faces_of_;
  std::vector<std::vector<std::size_t>> face_nodes_;
  std::vector<double> distances_;
};

/// Exact distances on a small convex polyhedron by laying out every sequence of different faces and
/// drawing the straight line: a shortest path there visits a face once and no vertex.
class UnfoldingOracle {
 public:
  explicit UnfoldingOracle(const TriangleMesh& mesh) : mesh_(mesh), half_edges_(mesh) {}

  double distance(const Vec3& from, const Vec3& to) {
    best_ = std::numeric_limits<double>::infinity();
    from_ = from;
    to_ = to;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (!contains(f, from)) continue;
      if (contains(f, to)) return (from - to).norm();
      const Vec3 x = (mesh_.corner(f, 1) - mesh_.corner(f, 0)).normalized();
      const Vec3 y = mesh_.area_vector(f).normalized().cross(x);
      const auto flat = [&](const Vec3& p) -> Vec2 {
        return {x.dot(p - mesh_.corner(f, 0)), y.dot(p - mesh_.corner(f, 0))};
      };
      used_.assign(static_cast<std::size_t>(mesh_.face_count()), false);
      used_[static_cast<std::size_t>(f)] = true;
      source_ = flat(from);
      for (int k = 0; k < 3; ++k)
        cross(3 * f + k, flat(mesh_.corner(f, k)), flat(mesh_.corner(f, (k + 1) % 3)));
    }
    return best_;
  }

 private:
  bool contains(Index f, const Vec3& p) const {
    const Vec3 n = mesh_.area_vector(f);
    for (int k = 0; k < 3; ++k) {
      const Vec3 edge = mesh_.corner(f, (k + 1) % 3) - mesh_.corner(f, k);
      if (edge.cross(p - mesh_.corner(f, k)).dot(n) < -1e-12 * n.squaredNorm()) return false;
    }
    return std::abs((p - mesh_.corner(f, 0)).dot(n)) < 1e-12 * n.norm();
  }

  static double turn(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

  // Over the edge from a to b, laid out; the face behind lies to its right. The edges crossed so
  // far stand in portals_.
  void cross(Index h, const Vec2& a, const Vec2& b) {
    const Index twin = half_edges_.twin(h);
    if (twin < 0 || used_[static_cast<std::size_t>(HalfEdges::face(twin))]) return;
    const Index f = HalfEdges::face(twin);
    const Vec3& a3 = mesh_.position(half_edges_.tail(h));
    const Vec3 along = (mesh_.position(half_edges_.head(h)) - a3).normalized();
    const Vec2 e = (b - a).normalized();
    const auto lay = [&](const Vec3& p) -> Vec2 {
      const double x = along.dot(p - a3);
      const double y = (p - a3 - x * along).norm();
      return a + x * e - y * Vec2(-e.y(), e.x());
    };
    portals_.push_back({a, b});
    used_[static_cast<std::size_t>(f)] = true;
    if (contains(f, to_)) {
      const Vec2 t = lay(to_);
      bool inside = true;
      for (const auto& [tail, head] : portals_) {
        constexpr double kRounding = 1e-12;
        inside = inside && turn(t - source_, head - source_) > -kRounding &&
                 turn(t - source_, tail - source_) < kRounding;
      }
      if (inside) best_ = std::min(best_, (t - source_).norm());
    }
    const Vec2 apex = lay(mesh_.position(half_edges_.tail(HalfEdges::previous(twin))));
    cross(HalfEdges::next(twin), a, apex);
    cross(HalfEdges::previous(twin), apex, b);
    used_[static_cast<std::size_t>(f)] = false;
    portals_.pop_back();
  }

  const TriangleMesh& mesh_;
  HalfEdges half_edges_;
  std::vector<bool> used_;
  std::vector<std::pair<Vec2, Vec2>> portals_;
  Vec2 source_;
  Vec3 from_;
  Vec3 to_;
  double best_ = 0.0;
};

/// A surface of straight lines from a tip: 2 n directions, `rings` rings of radius 1 / rings to 1;
/// flat but for the tip. Directions go up and down by `lift` radians in turn (all up: `zigzag`
/// false), so that the total angle can be below or above 2 pi.
struct Cone {
  TriangleMesh mesh;
  double sector;  ///< angle between neighbouring directions
  int directions;
  int rings;
  Index vertex(int direction, int ring) const {
    return ring == 0 ? 0 : 1 + (ring - 1) * directions + direction;
  }
  /// By unrolling: through the tip where the angle is pi or more.
  double distance(int direction_a, int ring_a, int direction_b, int ring_b) const {
    const int apart = std::abs(direction_a - direction_b);
    const double angle = sector * std::min(apart, directions - apart);
    const double a = double(ring_a) / rings;
    const double b = double(ring_b) / rings;
    if (angle >= std::numbers::pi) return a + b;
    return std::sqrt(std::max(0.0, a * a + b * b - 2 * a * b * std::cos(angle)));
  }
};

inline Cone make_cone(int half_directions, int rings, double lift, bool zigzag) {
  const int n = 2 * half_directions;
  std::vector<Vec3> positions = {Vec3::Zero()};
  std::vector<Vec3> directions;
  for (int i = 0; i < n; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / n;
    const double up = zigzag && i % 2 == 1 ? -lift : lift;
    directions.emplace_back(std::cos(turn) * std::cos(up), std::sin(turn) * std::cos(up),
                            std::sin(up));
  }
  for (int r = 1; r <= rings; ++r)
    for (const Vec3& d : directions) positions.push_back(d * (double(r) / rings));
  std::vector<Face> faces;
  const auto at = [n](int i, int r) { return static_cast<Index>(1 + (r - 1) * n + i % n); };
  for (int i = 0; i < n; ++i) {
    faces.push_back({0, at(i, 1), at(i + 1, 1)});
    for (int r = 1; r < rings; ++r) {
      faces.push_back({at(i, r), at(i, r + 1), at(i + 1, r + 1)});
      faces.push_back({at(i, r), at(i + 1, r + 1), at(i + 1, r)});
    }
  }
  return {TriangleMesh(positions, faces), angle_between(directions[0], directions[1]), n, rings};
}

/// A small mesh made to break things: grids and boxes whose vertices are moved, flattened onto
/// lines, squeezed to needles or put on top of each other, with holes.
inline TriangleMesh nasty_mesh(Random& random) {
  const int nx = 2 + static_cast<int>(random.below(4));
  const int ny = 2 + static_cast<int>(random.below(4));
  const bool tube = random.below(3) == 0;
  std::vector<Vec3> positions;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i < (tube ? nx + 1 : nx + 1); ++i) {
      if (tube) {
        const double a = 2.0 * std::numbers::pi * i / (nx + 1);
        positions.emplace_back(std::cos(a), std::sin(a), double(j));
      } else {
        positions.emplace_back(double(i), double(j), 0.0);
      }
    }
  std::vector<Face> faces;
  const int width = nx + 1;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < (tube ? width : nx); ++i) {
      const Index a = j * width + i;
      const Index b = j * width + (i + 1) % width;
      const Index c = b + width;
      const Index d = a + width;
      if (random.below(2) == 0) {
        faces.push_back({a, b, c});
        faces.push_back({a, c, d});
      } else {
        faces.push_back({a, b, d});
        faces.push_back({b, c, d});
      }
    }
  const auto kind = random.below(7);
  if (kind == 1 || kind == 6)  // noise of 20 %
    for (Vec3& p : positions)
      p += Vec3(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2)) *
           (kind == 6 ? 4.0 : 1.0);
  if (kind == 2)  // needles
    for (Vec3& p : positions) p.x() *= 1e-5;
  if (kind == 3)  // a step at right angles, the rest coplanar
    for (Vec3& p : positions)
      if (p.x() > 1.0) p = Vec3(1.0, p.y(), p.z() + p.x() - 1.0);
  if (kind == 4) {  // vertices on top of each other, or nearly
    const auto n = static_cast<std::uint32_t>(positions.size());
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(random.below(n));
      const double off = random.below(2) == 0 ? 0.0 : 1e-9;
      positions[(i + 1) % n] = positions[i] + Vec3::Constant(off);
    }
  }
  if (kind == 5)  // vertices moved onto the line between their neighbours: faces without area
    for (int k = 0; k < 3; ++k) {
      const Face& f = faces[random.below(static_cast<std::uint32_t>(faces.size()))];
      positions[static_cast<std::size_t>(f[0])] = 0.5 * (positions[static_cast<std::size_t>(f[1])] +
                                                         positions[static_cast<std::size_t>(f[2])]);
    }
  if (random.below(3) == 0) {  // holes
    const auto first = random.below(static_cast<std::uint32_t>(faces.size()));
    faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return {positions, faces};
}

}  // namespace mimicry::test
