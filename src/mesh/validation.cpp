#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <mimicry/mesh/validation.h>

#include "base/finite.h"
#include "mesh/findings.h"
#include "mesh/sets.h"

namespace mimicry {
namespace {

constexpr double kLargestCoordinate = 1e100;

bool is_valid(const Vec3& p) {
  return is_finite(p) && p.cwiseAbs().maxCoeff() <= kLargestCoordinate;
}

struct Side {
  Index low, high;  // ends of the edge, low < high
  Index h;          // half-edge 3 f + k
};

Index tail(const TriangleMesh& mesh, Index h) {
  return mesh.face(h / 3)[at(h % 3)];
}
Index head(const TriangleMesh& mesh, Index h) {
  return mesh.face(h / 3)[at((h + 1) % 3)];
}

// Edges are met in the order of their vertices; the example is the one with the lowest half-edge.
struct EdgeNote {
  Index count = 0;
  Index lowest = kNone;
  void operator()(Index h) {
    if (count++ == 0 || h < lowest) lowest = h;
  }
  EdgeFinding finding(const TriangleMesh& mesh) const {
    if (count == 0) return {};
    return {count, tail(mesh, lowest), head(mesh, lowest)};
  }
};

// What validate() knows so far; its steps in the order in which they are called.
class Validation {
 public:
  explicit Validation(const TriangleMesh& mesh)
      : mesh_(mesh),
        valid_(at(mesh.vertex_count())),
        fans_(3 * mesh.face_count()),
        directions_(mesh.face_count()),
        components_(mesh.vertex_count()) {
    report_.vertices = mesh.vertex_count();
    report_.faces = mesh.face_count();
  }

  void check_vertices();
  void check_faces();
  void join_at_edges();
  void number_components();
  void count_loops();
  void sum_up();
  MeshReport take() { return std::move(report_); }

 private:
  std::vector<Side> sorted_sides() const;
  void join_across(std::span<const Side> edge);
  void find_duplicates(std::vector<std::pair<Face, Index>>& faces);
  ComponentReport& component(Index v) {
    return report_.components[at(number_[at(components_.root(v))])];
  }

  const TriangleMesh& mesh_;
  MeshReport report_;
  std::vector<bool> valid_;  // a vertex
  // Corners (3 f + k) of one vertex that share an edge form its fans; faces keep the parity of
  // their direction; faces that share a vertex form components.
  Sets fans_, directions_, components_;
  std::vector<Index> one_sided_;  // faces where no choice of directions is consistent
  std::vector<Index> boundary_;   // half-edges
  std::vector<std::pair<Index, bool>> edge_ends_;  // a vertex of each edge; has 3 or more faces
  EdgeNote nonmanifold_, inconsistent_, open_;
  std::vector<Index> number_;  // of the component, at the root of its vertices
};

void Validation::check_vertices() {
  std::vector<bool> used(at(mesh_.vertex_count()), false);
  for (const Face& f : mesh_.faces())
    for (const Index v : f) used[at(v)] = true;
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    valid_[at(v)] = is_valid(mesh_.position(v));
    if (!used[at(v)])
      note(report_.isolated_vertices, v);
    else if (valid_[at(v)])
      report_.box.extend(mesh_.position(v));
    else
      note(report_.invalid_vertices, v);
  }
  if (!report_.box.isEmpty()) report_.diagonal = report_.box.diagonal().norm();
}

void Validation::check_faces() {
  std::vector<std::pair<Face, Index>> sorted;
  sorted.reserve(at(mesh_.face_count()));
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    Face corners = mesh_.face(f);
    const bool repeats = repeats_corner(corners);
    if (repeats) note(report_.repeated_corners, f);
    const bool measurable =
        std::all_of(corners.begin(), corners.end(), [this](Index v) { return valid_[at(v)]; });
    if (measurable) {
      const Vec3 a = mesh_.corner(f, 1) - mesh_.corner(f, 0);
      const Vec3 b = mesh_.corner(f, 2) - mesh_.corner(f, 0);
      const double longest = std::max({a.norm(), b.norm(), (b - a).norm()});
      bool degenerate = repeats || longest <= 1e-12 * report_.diagonal;
      if (!degenerate) {
        // Divided first: faces of any size are judged alike and nothing under- or overflows.
        const double height = (a / longest).cross(b / longest).norm();
        degenerate = height <= 1e-10;
        report_.area += 0.5 * height * longest * longest;
      }
      if (degenerate) note(report_.degenerate_faces, f);
    } else if (repeats) {
      note(report_.degenerate_faces, f);
    }
    std::sort(corners.begin(), corners.end());
    sorted.emplace_back(corners, f);
  }
  find_duplicates(sorted);
}

// Faces with their corners in order.
void Validation::find_duplicates(std::vector<std::pair<Face, Index>>& faces) {
  std::sort(faces.begin(), faces.end());
  for (std::size_t i = 1, original = 0; i < faces.size(); ++i) {
    if (faces[i].first != faces[original].first) {
      original = i;
      continue;
    }
    DuplicateFinding& found = report_.duplicate_faces;
    if (found.count++ == 0 || faces[i].second < found.first) {
      found.first = faces[i].second;
      found.first_copy_of = faces[original].second;
    }
  }
}

std::vector<Side> Validation::sorted_sides() const {
  std::vector<Side> sides;
  sides.reserve(at(mesh_.face_count()) * 3);
  for (Index h = 0; h < 3 * mesh_.face_count(); ++h) {
    if (repeats_corner(mesh_.face(h / 3))) continue;
    const auto [low, high] = std::minmax({tail(mesh_, h), head(mesh_, h)});
    sides.push_back({low, high, h});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.h) < std::tie(b.low, b.high, b.h);
  });
  return sides;
}

// The sides of one edge, by their half-edges.
void Validation::join_across(std::span<const Side> edge) {
  const Side& first = edge.front();
  const auto corner_at = [this](Index h, Index v) {
    return tail(mesh_, h) == v ? h : 3 * (h / 3) + (h + 1) % 3;
  };
  for (const Side& other : edge.subspan(1)) {
    fans_.join(corner_at(first.h, first.low), corner_at(other.h, first.low));
    fans_.join(corner_at(first.h, first.high), corner_at(other.h, first.high));
  }
  components_.join(first.low, first.high);
  edge_ends_.emplace_back(first.low, edge.size() > 2);
  if (edge.size() == 1) {
    open_(first.h);
    boundary_.push_back(first.h);
  } else if (edge.size() > 2) {
    nonmanifold_(first.h);
  } else {
    const bool same = tail(mesh_, first.h) == tail(mesh_, edge[1].h);
    if (same) inconsistent_(first.h);
    if (!directions_.join(first.h / 3, edge[1].h / 3, same)) one_sided_.push_back(first.h / 3);
  }
}

void Validation::join_at_edges() {
  const std::vector<Side> sides = sorted_sides();
  double length_sum = 0;
  Index measured = 0;
  for (auto run = sides.begin(); run != sides.end();) {
    auto end = run + 1;
    while (end != sides.end() && end->low == run->low && end->high == run->high) ++end;
    join_across({&*run, static_cast<std::size_t>(end - run)});
    if (valid_[at(run->low)] && valid_[at(run->high)]) {
      const double length = (mesh_.position(run->low) - mesh_.position(run->high)).norm();
      report_.shortest_edge = measured == 0 ? length : std::min(report_.shortest_edge, length);
      report_.longest_edge = std::max(report_.longest_edge, length);
      length_sum += length;
      ++measured;
    }
    run = end;
  }
  if (measured > 0) report_.mean_edge = length_sum / measured;
  report_.edges = static_cast<Index>(edge_ends_.size());
  report_.nonmanifold_edges = nonmanifold_.finding(mesh_);
  report_.inconsistent_edges = inconsistent_.finding(mesh_);
  report_.boundary.edges = open_.finding(mesh_);
}

// Components by their first face.
void Validation::number_components() {
  number_.assign(at(mesh_.vertex_count()), kNone);
  std::vector<Index> fan_count(at(mesh_.vertex_count()), 0);
  std::vector<bool> seen(at(mesh_.vertex_count()), false);
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    if (repeats_corner(mesh_.face(f))) continue;
    Index& n = number_[at(components_.root(mesh_.face(f)[0]))];
    if (n == kNone) {
      n = static_cast<Index>(report_.components.size());
      ComponentReport& fresh = report_.components.emplace_back();
      fresh.first_face = f;
      fresh.manifold = fresh.orientable = true;
    }
    ComponentReport& part = report_.components[at(n)];
    ++part.faces;
    for (Index k = 0; k < 3; ++k) {
      const Index v = mesh_.face(f)[at(k)];
      if (!seen[at(v)]) ++part.vertices;
      seen[at(v)] = true;
      if (fans_.root(3 * f + k) == 3 * f + k) ++fan_count[at(v)];
    }
  }
  for (Index v = 0; v < mesh_.vertex_count(); ++v)
    if (fan_count[at(v)] > 1) {
      note(report_.nonmanifold_vertices, v);
      component(v).manifold = false;
    }
  for (const auto& [v, many] : edge_ends_) {
    ++component(v).edges;
    if (many) component(v).manifold = false;
  }
  for (const Index f : one_sided_) component(mesh_.face(f)[0]).orientable = false;
}

// Boundary edges that end in the same fan belong to the same loop.
void Validation::count_loops() {
  Sets loops(static_cast<Index>(boundary_.size()));
  std::vector<Index> first_at_fan(at(3 * mesh_.face_count()), kNone);
  for (Index i = 0; i < static_cast<Index>(boundary_.size()); ++i) {
    const Index h = boundary_[at(i)];
    for (const Index corner : {h, 3 * (h / 3) + (h + 1) % 3}) {
      Index& first = first_at_fan[at(fans_.root(corner))];
      if (first == kNone)
        first = i;
      else
        loops.join(first, i);
    }
  }
  for (Index i = 0; i < static_cast<Index>(boundary_.size()); ++i)
    if (loops.root(i) == i) {
      ++report_.boundary.loops;
      ++component(tail(mesh_, boundary_[at(i)])).boundary_loops;
    }
}

void Validation::sum_up() {
  Index genus = 0;
  bool all_have_genus = !report_.components.empty();
  for (ComponentReport& part : report_.components) {
    part.euler = part.vertices - part.edges + part.faces;
    report_.euler += part.euler;
    part.closed = part.manifold && part.boundary_loops == 0;
    if (part.manifold && part.orientable) part.genus = (2 - part.boundary_loops - part.euler) / 2;
    all_have_genus = all_have_genus && part.genus.has_value();
    genus += part.genus.value_or(0);
  }
  if (all_have_genus) report_.genus = genus;

  if (report_.is_closed() && report_.invalid_vertices.count == 0) {
    // From the box's centre, so that a mesh far from the origin loses no digits.
    const Vec3 centre = report_.box.center();
    double volume = 0;
    for (Index f = 0; f < mesh_.face_count(); ++f)
      volume += (mesh_.corner(f, 0) - centre)
                    .dot((mesh_.corner(f, 1) - centre).cross(mesh_.corner(f, 2) - centre));
    report_.volume = volume / 6;
  }
}

}  // namespace

MeshReport validate(const TriangleMesh& mesh) {
  Validation validation(mesh);
  validation.check_vertices();
  validation.check_faces();
  validation.join_at_edges();
  validation.number_components();
  validation.count_loops();
  validation.sum_up();
  return validation.take();
}

}  // namespace mimicry
