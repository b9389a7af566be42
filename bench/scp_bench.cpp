// Smooth closest points beside their exhaustive definition, in one process on one thread:
//   scp_bench [MESH.obj | SHAPE[:RESOLUTION]] ... [--compare N] [--samples N]
// For each mesh: a bake, then 40 strokes of 200 points that walk over the surface at 0, 1 and 4 %
// of the diagonal from it in steps of 0.2 %, each point after the last (warm) and again without a
// hint (cold). A point's time is the least of three, which leaves out what the machine does
// besides; the clock's own 20 to 30 ns are in it. Then N random points in the shell by both
// searches, which must agree bit for bit.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <mimicry/bake/bake.h>
#include <mimicry/base/random.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/io/meshes.h>
#include <mimicry/mesh/shapes.h>

#include "files/file.h"

namespace {

using namespace mimicry;
using Clock = std::chrono::steady_clock;

double microseconds(Clock::duration d) {
  return std::chrono::duration<double, std::micro>(d).count();
}

template <class Query>
double least_us(Query&& query) {
  double least = kInfinity;
  for (int pass = 0; pass < 3; ++pass) {
    const auto start = Clock::now();
    query();
    least = std::min(least, microseconds(Clock::now() - start));
  }
  return least;
}

void print_quantiles(const char* label, std::vector<double> us) {
  std::sort(us.begin(), us.end());
  const auto at = [&](double q) { return us[static_cast<std::size_t>(q * double(us.size() - 1))]; };
  std::printf("  %-28s median %8.2f  p90 %8.2f  p99 %8.2f  largest %8.2f us\n", label, at(0.5),
              at(0.9), at(0.99), us.back());
}

TriangleMesh mesh_of(const std::string& name) {
  if (name.find('/') != std::string::npos) return read_mesh(read_file(name), MeshFormat::obj, name);
  const std::size_t colon = name.find(':');
  ShapeOptions options;
  if (colon != std::string::npos) options.resolution = std::atoi(name.c_str() + colon + 1);
  return make_shape(name.substr(0, colon), options);
}

Vec3 random_vector(Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

struct Timed {
  const Target& target;
  const SmoothProjector& projector;

  SurfacePoint random_point(Random& random) const {
    const auto count = static_cast<std::uint32_t>(target.mesh().face_count());
    return {static_cast<Index>(random.below(count)), Vec3::Constant(1.0 / 3.0)};
  }

  void strokes(double offset) const {
    Random random(1);
    const double diagonal = target.diagonal();
    std::vector<double> warm, cold;
    int fallbacks = 0, jumps = 0, shared = 0;
    double worst = 0.0;
    for (int s = 0; s < 40; ++s) {
      SurfacePoint at = random_point(random);
      Vec3 x = target.position(at), direction = random_vector(random);
      Vec3 before_y = Vec3::Zero(), before_q = Vec3::Zero(), before_snap = Vec3::Zero();
      ScpHint hint;
      for (int i = 0; i < 200; ++i) {
        const Vec3 normal = target.normal(at);
        direction -= direction.dot(normal) * normal;
        direction.normalize();
        const auto next =
            target.closest_point(x + 0.002 * diagonal * direction, kInfinity, at.face);
        at = next->surface;
        x = next->position;
        const Vec3 y = x + (s % 2 ? offset : -offset) * diagonal * target.normal(at) +
                       2e-4 * diagonal * random_vector(random);
        SmoothPoint q;
        ScpHint after = hint;
        warm.push_back(least_us([&] {
          after = hint;
          q = *projector.project(y, {}, &after);
        }));
        hint = after;
        cold.push_back(least_us([&] { projector.project(y); }));
        if (q.label != ScpLabel::smooth) ++fallbacks;
        const Vec3 snap = target.closest_point(y)->position;
        if (i > 0) {
          const double way = (y - before_y).norm(), ratio = (q.position - before_q).norm() / way;
          worst = std::max(worst, ratio);
          if (ratio > 5.0) ++jumps;
          if (ratio > 5.0 && (snap - before_snap).norm() > 5.0 * way) ++shared;
        }
        before_y = y;
        before_q = q.position;
        before_snap = snap;
      }
    }
    std::printf(
        "  at %.0f %%: %zu points, %d not smooth, largest |dq|/|dp| %.1f, above 5: %d, where "
        "closest "
        "points jump too: %d\n",
        100.0 * offset, warm.size(), fallbacks, worst, jumps, shared);
    print_quantiles("warm", std::move(warm));
    print_quantiles("cold", std::move(cold));
  }

  void exhaustive() const {
    Random random(2);
    std::vector<double> us;
    for (int i = 0; i < 20; ++i) {
      const Vec3 y =
          target.position(random_point(random)) + 0.01 * target.diagonal() * random_vector(random);
      us.push_back(least_us([&] { projector.project_exhaustively(y); }));
    }
    print_quantiles("exhaustive at 1 %", std::move(us));
  }

  void compare(int count) const {
    Random random(3);
    int different = 0;
    for (int i = 0; i < count; ++i) {
      const Vec3 y = target.position(random_point(random)) + random.uniform(0.0, 0.05) *
                                                                 target.diagonal() *
                                                                 random_vector(random).normalized();
      const auto a = projector.project(y), b = projector.project_exhaustively(y);
      if (a->label != b->label || a->position != b->position || a->surface.face != b->surface.face)
        ++different;
    }
    std::printf("  %d random points: %d differ from the exhaustive search\n", count, different);
  }
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names;
  int count = 2000;
  BakeOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--compare" && i + 1 < argc)
      count = std::atoi(argv[++i]);
    else if (word == "--samples" && i + 1 < argc)
      options.samples = std::atoi(argv[++i]);
    else
      names.push_back(word);
  }
  if (names.empty()) names = {"sphere", "torus", "hand"};
  for (const std::string& name : names) {
    const Target target(mesh_of(name));
    const auto start = Clock::now();
    Embedding baked = mimicry::bake(target.mesh(), options, 2);
    const auto end = Clock::now();
    const SmoothProjector projector(std::move(baked), target);
    std::printf("%s: %d faces, %zu tetrahedra, bake %.1f s, set-up %.2f s, %.0f MB%s\n",
                name.c_str(), target.mesh().face_count(), projector.embedding().tets.size(),
                1e-6 * microseconds(end - start), 1e-6 * microseconds(Clock::now() - end),
                1e-6 * double(projector.memory_bytes()),
                projector.embedding().quality.is_lattice ? ", lattice" : "");
    const Timed timed{target, projector};
    for (const double offset : {0.0, 0.01, 0.04}) timed.strokes(offset);
    timed.exhaustive();
    timed.compare(count);
  }
  return 0;
}
