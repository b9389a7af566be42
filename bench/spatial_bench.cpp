// Closest points and first hits beside Embree's, same queries, same process, one thread; the build,
// the refit and the memory of a target. A row's counter `bytes_a_face` is measured.

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <mimicry/mesh/shapes.h>
#include <mimicry/spatial/target.h>

#include "spatial/bvh.h"
#include "spatial/triangle.h"
#include "study_mesh.h"

namespace {

using mimicry::Face;
using mimicry::Index;
using mimicry::kInfinity;
using mimicry::kNone;
using mimicry::Target;
using mimicry::TriangleMesh;
using mimicry::Vec3;

constexpr int kQueries = 4096;

// Embree's scene with our vertices in its floats, and the queries as floats.
class Embree {
 public:
  Embree(const TriangleMesh& mesh, RTCSceneFlags flags) : device_(rtcNewDevice("threads=1")) {
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, flags);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                          RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                          mesh.positions().size()));
    for (const Vec3& p : mesh.positions()) {
      for (int k = 0; k < 3; ++k) *v++ = static_cast<float>(p[k]);
      vertices_.push_back(p.cast<float>());
    }
    auto* f = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                             RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                             mesh.faces().size()));
    for (const Face& face : mesh.faces()) {
      for (const Index i : face) *f++ = static_cast<unsigned>(i);
      faces_.push_back(face);
    }
    rtcSetGeometryPointQueryFunction(geometry, &closest_triangle);
    rtcSetGeometryUserData(geometry, this);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~Embree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  float closest(const Vec3& y, Index& face) const {
    RTCPointQuery query = {static_cast<float>(y[0]), static_cast<float>(y[1]),
                           static_cast<float>(y[2]), 0.0F, static_cast<float>(kInfinity)};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    Best best{this, kNone, static_cast<float>(kInfinity)};
    rtcPointQuery(scene_, &query, &context, nullptr, &best);
    face = best.face;
    return best.distance;
  }

  float first_hit(const Vec3& origin, const Vec3& direction) const {
    RTCRayHit ray{};
    ray.ray = {static_cast<float>(origin[0]),
               static_cast<float>(origin[1]),
               static_cast<float>(origin[2]),
               0.0F,
               static_cast<float>(direction[0]),
               static_cast<float>(direction[1]),
               static_cast<float>(direction[2]),
               0.0F,
               static_cast<float>(kInfinity),
               0xFFFFFFFFU,
               0,
               0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &ray);
    return ray.ray.tfar;
  }

 private:
  struct Best {
    const Embree* self;
    Index face;
    float distance;
  };

  // The usual region test (Ericson, Real-Time Collision Detection, 5.1.5), in floats.
  static bool closest_triangle(RTCPointQueryFunctionArguments* arguments) {
    auto& best = *static_cast<Best*>(arguments->userPtr);
    const Face& face = best.self->faces_[arguments->primID];
    const auto corner = [&](std::size_t k) -> const Eigen::Vector3f& {
      return best.self->vertices_[static_cast<std::size_t>(face[k])];
    };
    const Eigen::Vector3f p(arguments->query->x, arguments->query->y, arguments->query->z);
    const float d = (closest(p, corner(0), corner(1), corner(2)) - p).norm();
    if (!(d < arguments->query->radius)) return false;
    arguments->query->radius = d;
    best.face = static_cast<Index>(arguments->primID);
    best.distance = d;
    return true;
  }
  static Eigen::Vector3f closest(const Eigen::Vector3f& p, const Eigen::Vector3f& a,
                                 const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
    const Eigen::Vector3f ab = b - a, ac = c - a, ap = p - a;
    const float d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.0F && d2 <= 0.0F) return a;
    const Eigen::Vector3f bp = p - b;
    const float d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.0F && d4 <= d3) return b;
    const Eigen::Vector3f cp = p - c;
    const float d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.0F && d5 <= d6) return c;
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F) return a + d1 / (d1 - d3) * ab;
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F) return a + d2 / (d2 - d6) * ac;
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.0F && d4 - d3 >= 0.0F && d5 - d6 >= 0.0F)
      return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
    const float denominator = 1.0F / (va + vb + vc);
    return a + vb * denominator * ab + vc * denominator * ac;
  }

  RTCDevice device_;
  RTCScene scene_;
  std::vector<Eigen::Vector3f> vertices_;
  std::vector<Face> faces_;
};

struct Query {
  Vec3 point;
  Vec3 direction;  // roughly toward the surface
};

struct Scene {
  std::string name;
  Target target;
  Embree embree;
  Embree robust;  // watertight rays, as ours are
  std::vector<Query> near, far, stroke;

  Scene(std::string n, const TriangleMesh& mesh)
      : name(std::move(n)),
        target(mesh),
        embree(mesh, RTC_SCENE_FLAG_NONE),
        robust(mesh, RTC_SCENE_FLAG_ROBUST),
        near(scattered(0.01)),
        far(scattered(0.1)) {
    // A pen that follows the surface: 1/4000 of the diagonal a frame, 2 % above it.
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    Vec3 p = near[0].point, heading(1, 0, 0);
    for (int i = 0; i < kQueries; ++i) {
      heading = (heading + 0.1 * Vec3(normal(random), normal(random), normal(random))).normalized();
      p += target.diagonal() / 4000.0 * heading;
      const auto c = target.closest_point(p);
      const Vec3 n0 = target.normal(c->surface);
      p = c->position + 0.02 * target.diagonal() * n0;
      stroke.push_back({p, -n0});
    }
  }

  // Points at random on the surface, moved off it to either side by at most `share` of the
  // diagonal.
  std::vector<Query> scattered(double share) const {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> normal;
    const TriangleMesh& mesh = target.mesh();
    std::vector<Query> queries;
    for (int i = 0; i < kQueries; ++i) {
      mimicry::SurfacePoint s;
      s.face = static_cast<Index>(random() % static_cast<std::uint64_t>(mesh.face_count()));
      double u = unit(random), v = unit(random);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      s.bary = Vec3(1.0 - u - v, u, v);
      const Vec3 n = target.normal(s);
      const double height = (2.0 * unit(random) - 1.0) * share * target.diagonal();
      const Vec3 wobble = 0.2 * Vec3(normal(random), normal(random), normal(random));
      queries.push_back({target.position(s) + height * n,
                         ((height > 0.0 ? -1.0 : 1.0) * n + wobble).normalized()});
    }
    return queries;
  }
};

template <class Function>
void run(benchmark::State& state, const std::vector<Query>& queries, Function&& function) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(function(queries[i]));
    i = i + 1 == queries.size() ? 0 : i + 1;
  }
}

void add(const std::shared_ptr<Scene>& s) {
  const auto name = [&](const std::string& what, const std::string& where, const std::string& who) {
    return what + "/" + s->name + "/" + where + "/" + who;
  };
  const struct {
    const char* name;
    const std::vector<Query>* queries;
  } kinds[] = {{"within_1%", &s->near}, {"within_10%", &s->far}, {"stroke", &s->stroke}};
  for (const auto& kind : kinds) {
    const auto* queries = kind.queries;
    benchmark::RegisterBenchmark(
        name("closest", kind.name, "mimicry").c_str(), [=](benchmark::State& state) {
          run(state, *queries, [&](const Query& q) { return s->target.closest_point(q.point); });
        });
    if (queries == &s->stroke)
      benchmark::RegisterBenchmark(
          name("closest", kind.name, "mimicry_with_hint").c_str(), [=](benchmark::State& state) {
            Index hint = kNone;
            run(state, *queries, [&](const Query& q) {
              const auto p = s->target.closest_point(q.point, kInfinity, hint);
              hint = p->surface.face;
              return p;
            });
          });
    benchmark::RegisterBenchmark(
        name("closest", kind.name, "embree").c_str(), [=](benchmark::State& state) {
          Index face = kNone;
          run(state, *queries, [&](const Query& q) { return s->embree.closest(q.point, face); });
        });
    benchmark::RegisterBenchmark(
        name("ray", kind.name, "mimicry").c_str(), [=](benchmark::State& state) {
          run(state, *queries,
              [&](const Query& q) { return s->target.first_hit(q.point, q.direction); });
        });
    benchmark::RegisterBenchmark(
        name("ray", kind.name, "embree").c_str(), [=](benchmark::State& state) {
          run(state, *queries,
              [&](const Query& q) { return s->embree.first_hit(q.point, q.direction); });
        });
    benchmark::RegisterBenchmark(
        name("ray", kind.name, "embree_robust").c_str(), [=](benchmark::State& state) {
          run(state, *queries,
              [&](const Query& q) { return s->robust.first_hit(q.point, q.direction); });
        });
  }
  benchmark::RegisterBenchmark(("build_hierarchy/" + s->name).c_str(), [=](benchmark::State&
                                                                               state) {
    const TriangleMesh& mesh = s->target.mesh();
    for (auto _ : state) {
      const mimicry::Bvh<3, mimicry::Triangle> bvh(
          mesh.face_count(), [&](Index f) -> mimicry::Triangle {
            return {mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)};
          });
      benchmark::DoNotOptimize(bvh.size());
    }
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("build_target/" + s->name).c_str(), [=](benchmark::State& state) {
    for (auto _ : state) {
      const Target target(s->target.mesh());
      benchmark::DoNotOptimize(target.diagonal());
    }
    state.counters["bytes_a_face"] = static_cast<double>(s->target.memory_bytes()) /
                                     static_cast<double>(s->target.mesh().face_count());
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("update_positions/" + s->name).c_str(),
                               [=](benchmark::State& state) {
                                 Target target(s->target.mesh());
                                 for (auto _ : state)
                                   target.update_positions(s->target.mesh().positions());
                               })
      ->Unit(benchmark::kMillisecond);
}

// The two answers must be of the same question: distances agree to the peer's float accuracy.
bool agrees(const Scene& s) {
  int differ = 0;
  for (const auto* queries : {&s.near, &s.far})
    for (const Query& q : *queries) {
      Index face = kNone;
      const double tolerance = 1e-5 * s.target.diagonal();
      const double ours = s.target.closest_point(q.point)->distance;
      const auto hit = s.target.first_hit(q.point, q.direction);
      const double theirs = static_cast<double>(s.embree.first_hit(q.point, q.direction));
      if (std::abs(ours - static_cast<double>(s.embree.closest(q.point, face))) > tolerance)
        ++differ;
      // A ray along an edge's rim may pass on either side of it.
      if (hit.has_value() != std::isfinite(theirs) ||
          (hit && std::abs(hit->distance - theirs) > 100.0 * tolerance))
        ++differ;
    }
  if (differ > 0)
    std::fprintf(stderr, "%s: %d answers differ from the peer's\n", s.name.c_str(), differ);
  return differ < kQueries / 100;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::vector<std::shared_ptr<Scene>> scenes;
  scenes.push_back(std::make_shared<Scene>(
      "torus_86400", mimicry::make_torus(360, mimicry::kLargeTorusResolution)));
  if (const auto bunny = mimicry::bench::study_mesh("bunny")) {
    scenes.push_back(std::make_shared<Scene>("bunny", *bunny));
  } else {
    std::fprintf(stderr, "no " MIMICRY_STUDY_DATA "/bunny.obj: the bunny is left out\n");
  }
  for (const auto& s : scenes) {
    if (!agrees(*s)) return 1;
    add(s);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
