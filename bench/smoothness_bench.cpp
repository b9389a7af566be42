// How smoothly a closed path beside a sphere and a torus is projected by smooth closest points and
// by plain ones, on meshes of three resolutions. Both have an analytic closest point, whose ratio
// |dq| / |dp| and total turning are what the projections should come close to. And by how much
// curves of projected points turn where they cross the meshes' edges. Then how far points slide
// along a surface that the query is moved straight off: shapes of ours, and the study's where they
// are present.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/bake/bake.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/mesh/shapes.h>

#include "edge_turns.h"
#include "normal_slide.h"
#include "study_mesh.h"

namespace {

using namespace mimicry;

constexpr int kSteps = 20000;

// 8 % of the diagonal of the sphere, 4 % of that of the torus from the surface.
Vec3 path(std::string_view shape, double t) {
  const double a = 2.0 * std::numbers::pi * t;
  if (shape == "sphere")
    return 1.1 * kSphereRadius * Vec3(std::cos(a), 0.6 * std::sin(a), 0.8 * std::sin(a));
  const double around = 0.7 + 0.5 * std::sin(3.0 * a), minor = kTorusMinorRadius + 0.1;
  const double ring = kTorusMajorRadius + minor * std::cos(around);
  return {ring * std::cos(a), ring * std::sin(a), minor * std::sin(around)};
}

struct Line {
  std::vector<double> off;  // |ratio / analytic ratio - 1| of each step
  double turning = 0.0;     // radians

  double quantile(double q) {
    std::sort(off.begin(), off.end());
    return off[static_cast<std::size_t>(q * static_cast<double>(off.size() - 1))];
  }
};

template <class Project>
Line measure(std::string_view shape, Project&& project) {
  Line line;
  Vec3 before_q = Vec3::Zero(), before_ideal = Vec3::Zero(), before_way = Vec3::Zero();
  for (int i = 0; i <= kSteps; ++i) {
    const Vec3 p = path(shape, static_cast<double>(i) / kSteps);
    const Vec3 q = project(p), ideal = *analytic_closest_point(shape, p);
    const Vec3 way = q - before_q;
    if (i > 0) line.off.push_back(std::abs(way.norm() / (ideal - before_ideal).norm() - 1.0));
    // Snap stands still on corners: only ways turn.
    if (i > 0 && way.norm() > 1e-12) {
      if (!before_way.isZero(0.0))
        line.turning += std::atan2(before_way.cross(way).norm(), before_way.dot(way));
      before_way = way;
    }
    before_q = q;
    before_ideal = ideal;
  }
  return line;
}

void print(std::string_view shape, Index faces, const char* label, Line line) {
  std::printf("%-8s %6d %-10s %8.3f %8.3f %8.3f %8.3f %10.2f\n", shape.data(), faces, label,
              line.quantile(0.5), line.quantile(0.9), line.quantile(0.99), line.quantile(1.0),
              line.turning);
}

void print_slides(const std::string& name, const TriangleMesh& mesh) {
  const Target target(mesh);
  const SmoothProjector projector(mimicry::bake(mesh, {}, 2), target);
  for (const double off : {0.002, 0.005, 0.01}) {
    const std::vector<double> slides = bench::normal_slides(projector, off, 4000, 1);
    const auto at = [&](double q) {
      return slides[static_cast<std::size_t>(q * static_cast<double>(slides.size() - 1))];
    };
    std::printf("%-16s %8.1f %8.3f %8.3f %8.3f\n", name.c_str(), 100.0 * off, at(0.5), at(0.9),
                at(0.99));
  }
}

}  // namespace

int main() {
  std::printf("%-8s %6s %-10s %8s %8s %8s %8s %10s\n", "shape", "faces", "", "median", "p90", "p99",
              "largest", "turning");
  for (const std::string_view shape : {"sphere", "torus"})
    for (const int resolution : {8, 16, 32}) {
      const TriangleMesh mesh = make_shape(shape, {.resolution = resolution});
      const Target target(mesh);
      const SmoothProjector projector(mimicry::bake(mesh, {}, 2), target);
      const Index faces = mesh.face_count();
      print(shape, faces, "smooth",
            measure(shape, [&](const Vec3& p) { return projector.project(p)->position; }));
      print(shape, faces, "snap",
            measure(shape, [&](const Vec3& p) { return target.closest_point(p)->position; }));
      print(shape, faces, "analytic",
            measure(shape, [&](const Vec3& p) { return *analytic_closest_point(shape, p); }));
    }
  std::printf("\nturns across edges, 99 %%, radians; bakes with 200 samples\n%-8s %6s %12s %8s\n",
              "shape", "faces", "in embedding", "in space");
  for (const std::string_view shape : {"sphere", "torus"})
    for (const int resolution : {8, 16, 32, 64}) {
      const TriangleMesh mesh = make_shape(shape, {.resolution = resolution});
      const Target target(mesh);
      const SmoothProjector projector(mimicry::bake(mesh, {.samples = 200}, 2), target);
      const bench::EdgeTurns turns = bench::edge_turns(projector);
      std::printf("%-8s %6d %12.4f %8.4f\n", shape.data(), mesh.face_count(), turns.in_embedding,
                  turns.in_space);
    }
  std::printf("\nslide over the way off the surface\n%-16s %8s %8s %8s %8s\n", "shape", "off, %",
              "median", "p90", "p99");
  for (const char* shape : {"sphere", "torus", "cube", "trefoil", "plate", "hand"})
    print_slides(shape, make_shape(shape));
  for (const char* shape : {"trebol", "cube", "torus", "hand", "fertility", "bunny"})
    if (const auto mesh = bench::study_mesh(shape))
      print_slides("study:" + std::string(shape), *mesh);
  return 0;
}
