#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>

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

void check_faces(const TriangleMesh& mesh, const std::vector<bool>& valid, MeshReport& report) {
  std::vector<std::pair<Face, Index>> sorted;
  sorted.reserve(at(mesh.face_count()));
  for (Index f = 0; f < mesh.face_count(); ++f) {
    Face corners = mesh.face(f);
    const bool repeats = repeats_corner(corners);
    if (repeats) note(report.repeated_corners, f);
    const bool measurable =
        std::all_of(corners.begin(), corners.end(), [&valid](Index v) { return valid[at(v)]; });
    if (measurable) {
      const Vec3 a = mesh.corner(f, 1) - mesh.corner(f, 0);
      const Vec3 b = mesh.corner(f, 2) - mesh.corner(f, 0);
      const double longest = std::max({a.norm(), b.norm(), (b - a).norm()});
      bool degenerate = repeats || longest <= 1e-12 * report.diagonal;
      if (!degenerate) {
        // Divided first: faces of any size are judged alike and nothing under- or overflows.
        const double height = (a / longest).cross(b / longest).norm();
        degenerate = height <= 1e-10;
        report.area += 0.5 * height * longest * longest;
      }
      if (degenerate) note(report.degenerate_faces, f);
    } else if (repeats) {
      note(report.degenerate_faces, f);
    }
    std::sort(corners.begin(), corners.end());
    sorted.emplace_back(corners, f);
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1, original = 0; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[original].first) {
      original = i;
      continue;
    }
    DuplicateFinding& found = report.duplicate_faces;
    if (found.count++ == 0 || sorted[i].second < found.first) {
      found.first = sorted[i].second;
      found.first_copy_of = sorted[original].second;
    }
  }
}

}  // namespace

MeshReport validate(const TriangleMesh& mesh) {
  MeshReport report;
  report.vertices = mesh.vertex_count();
  report.faces = mesh.face_count();

  std::vector<bool> valid(at(mesh.vertex_count())), used(at(mesh.vertex_count()), false);
  for (const Face& f : mesh.faces())
    for (const Index v : f) used[at(v)] = true;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    valid[at(v)] = is_valid(mesh.position(v));
    if (!used[at(v)])
      note(report.isolated_vertices, v);
    else if (valid[at(v)])
      report.box.extend(mesh.position(v));
    else
      note(report.invalid_vertices, v);
  }
  if (!report.box.isEmpty()) report.diagonal = report.box.diagonal().norm();
  check_faces(mesh, valid, report);

  std::vector<Side> sides;
  sides.reserve(at(mesh.face_count()) * 3);
  for (Index h = 0; h < 3 * mesh.face_count(); ++h) {
    if (repeats_corner(mesh.face(h / 3))) continue;
    const auto [low, high] = std::minmax({tail(mesh, h), head(mesh, h)});
    sides.push_back({low, high, h});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.h) < std::tie(b.low, b.high, b.h);
  });

  // Corners (3 f + k) of one vertex that share an edge form its fans; faces keep the parity of
  // their direction; faces that share a vertex form components.
  Sets fans(3 * mesh.face_count());
  Sets directions(mesh.face_count());
  Sets components(mesh.vertex_count());
  std::vector<Index> one_sided;  // faces where no choice of directions is consistent
  std::vector<Index> boundary;   // half-edges
  std::vector<std::pair<Index, bool>> edge_ends;  // a vertex of each edge; has 3 or more faces
  EdgeNote nonmanifold, inconsistent, open;
  double length_sum = 0;
  Index measured = 0;
  for (auto run = sides.begin(); run != sides.end();) {
    auto end = run + 1;
    while (end != sides.end() && end->low == run->low && end->high == run->high) ++end;
    const auto faces = end - run;
    const auto corner_at = [&mesh](Index h, Index v) {
      return tail(mesh, h) == v ? h : 3 * (h / 3) + (h + 1) % 3;
    };
    for (auto other = run + 1; other != end; ++other) {
      fans.join(corner_at(run->h, run->low), corner_at(other->h, run->low));
      fans.join(corner_at(run->h, run->high), corner_at(other->h, run->high));
    }
    components.join(run->low, run->high);
    edge_ends.emplace_back(run->low, faces > 2);
    if (faces == 1) {
      open(run->h);
      boundary.push_back(run->h);
    } else if (faces > 2) {
      nonmanifold(run->h);
    } else {
      const bool same = tail(mesh, run[0].h) == tail(mesh, run[1].h);
      if (same) inconsistent(run->h);
      if (!directions.join(run[0].h / 3, run[1].h / 3, same)) one_sided.push_back(run->h / 3);
    }
    if (valid[at(run->low)] && valid[at(run->high)]) {
      const double length = (mesh.position(run->low) - mesh.position(run->high)).norm();
      report.shortest_edge = measured == 0 ? length : std::min(report.shortest_edge, length);
      report.longest_edge = std::max(report.longest_edge, length);
      length_sum += length;
      ++measured;
    }
    run = end;
  }
  if (measured > 0) report.mean_edge = length_sum / measured;
  report.edges = static_cast<Index>(edge_ends.size());
  report.nonmanifold_edges = nonmanifold.finding(mesh);
  report.inconsistent_edges = inconsistent.finding(mesh);
  report.boundary.edges = open.finding(mesh);

  // Components by their first face.
  std::vector<Index> number(at(mesh.vertex_count()), kNone);
  const auto component = [&](Index v) -> ComponentReport& {
    return report.components[at(number[at(components.root(v))])];
  };
  std::vector<Index> fan_count(at(mesh.vertex_count()), 0);
  std::vector<bool> seen(at(mesh.vertex_count()), false);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (repeats_corner(mesh.face(f))) continue;
    Index& n = number[at(components.root(mesh.face(f)[0]))];
    if (n == kNone) {
      n = static_cast<Index>(report.components.size());
      ComponentReport& fresh = report.components.emplace_back();
      fresh.first_face = f;
      fresh.manifold = fresh.orientable = true;
    }
    ComponentReport& part = report.components[at(n)];
    ++part.faces;
    for (Index k = 0; k < 3; ++k) {
      const Index v = mesh.face(f)[at(k)];
      if (!seen[at(v)]) ++part.vertices;
      seen[at(v)] = true;
      if (fans.root(3 * f + k) == 3 * f + k) ++fan_count[at(v)];
    }
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (fan_count[at(v)] > 1) {
      note(report.nonmanifold_vertices, v);
      component(v).manifold = false;
    }
  for (const auto& [v, many] : edge_ends) {
    ++component(v).edges;
    if (many) component(v).manifold = false;
  }
  for (const Index f : one_sided) component(mesh.face(f)[0]).orientable = false;

  // Boundary edges that end in the same fan belong to the same loop.
  Sets loops(static_cast<Index>(boundary.size()));
  std::vector<Index> first_at_fan(at(3 * mesh.face_count()), kNone);
  for (Index i = 0; i < static_cast<Index>(boundary.size()); ++i) {
    const Index h = boundary[at(i)];
    for (const Index corner : {h, 3 * (h / 3) + (h + 1) % 3}) {
      Index& first = first_at_fan[at(fans.root(corner))];
      if (first == kNone)
        first = i;
      else
        loops.join(first, i);
    }
  }
  for (Index i = 0; i < static_cast<Index>(boundary.size()); ++i)
    if (loops.root(i) == i) {
      ++report.boundary.loops;
      ++component(tail(mesh, boundary[at(i)])).boundary_loops;
    }

  Index genus = 0;
  bool all_have_genus = !report.components.empty();
  for (ComponentReport& part : report.components) {
    part.euler = part.vertices - part.edges + part.faces;
    report.euler += part.euler;
    part.closed = part.manifold && part.boundary_loops == 0;
    if (part.manifold && part.orientable) part.genus = (2 - part.boundary_loops - part.euler) / 2;
    all_have_genus = all_have_genus && part.genus.has_value();
    genus += part.genus.value_or(0);
  }
  if (all_have_genus) report.genus = genus;

  if (report.is_closed() && report.invalid_vertices.count == 0) {
    // From the box's centre, so that a mesh far from the origin loses no digits.
    const Vec3 centre = report.box.center();
    double volume = 0;
    for (Index f = 0; f < mesh.face_count(); ++f)
      volume += (mesh.corner(f, 0) - centre)
                    .dot((mesh.corner(f, 1) - centre).cross(mesh.corner(f, 2) - centre));
    report.volume = volume / 6;
  }
  return report;
}

}  // namespace mimicry
