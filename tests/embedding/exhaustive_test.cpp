// The fast search for smooth closest points beside its definition, the search over all faces.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/bake/bake.h>
#include <mimicry/base/parallel.h>
#include <mimicry/base/random.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/io/meshes.h>
#include <mimicry/mesh/shapes.h>

namespace mimicry {
namespace {

#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr std::size_t kPoints = 2000;
constexpr bool kIsFast = true;
#else
constexpr std::size_t kPoints = 100;  // a debug build takes its time
constexpr bool kIsFast = false;
#endif

// Points within the shell and a little beyond, all over the surface.
void expect_the_same(const std::string& name, const TriangleMesh& mesh, std::uint64_t seed) {
  BakeOptions options;
  options.samples = 60;  // of no matter to the search
  const Target target(mesh);
  const SmoothProjector projector(mimicry::bake(mesh, options, 2), target);
  Random random(seed);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const auto count = static_cast<std::uint32_t>(mesh.face_count());
    const double r = std::sqrt(random.uniform()), s = random.uniform();
    const SurfacePoint p{static_cast<Index>(random.below(count)),
                         Vec3(1.0 - r, r * (1.0 - s), r * s)};
    const Vec3 away = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    points.push_back(mesh.position(p) + random.uniform(0.0, 0.055) * target.diagonal() * away);
  }
  std::vector<char> differs(kPoints, 0);
  parallel_for(kPoints, 2, [&](std::size_t i) {
    const auto fast = projector.project(points[i]);
    const auto truth = projector.project_exhaustively(points[i]);
    differs[i] = fast->label != truth->label || fast->surface.face != truth->surface.face ||
                 fast->position != truth->position;
  });
  for (std::size_t i = 0; i < kPoints; ++i)
    EXPECT_FALSE(differs[i]) << name << ", seed " << seed << ", point " << i << " at "
                             << points[i].transpose();
}

class ExhaustiveOnShape : public testing::TestWithParam<std::size_t> {};

TEST_P(ExhaustiveOnShape, EqualsTheFastSearch) {
  const ShapeInfo& shape = builtin_shapes()[GetParam()];
  // Some 200 to 800 faces each.
  int resolution = 6;
  if (shape.name == "hand" || shape.name == "double-torus") resolution = 1;
  if (shape.name == "plate" || shape.name == "grid") resolution = 14;
  if (shape.name == "moebius") resolution = 40;
  if (shape.name == "cylinder") resolution = 3;
  if (shape.name == "torus") resolution = 9;
  expect_the_same(std::string(shape.name), make_shape(shape.name, {.resolution = resolution}),
                  101 + GetParam());
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, ExhaustiveOnShape,
                         testing::Range(std::size_t{0}, builtin_shapes().size()));

TEST(Exhaustive, EqualsTheFastSearchOnTheStudysShapes) {
  const std::filesystem::path folder = MIMICRY_STUDY_DATA;
  if (!std::filesystem::exists(folder / "trebol.obj"))
    GTEST_SKIP() << "no study data in " MIMICRY_STUDY_DATA;
  std::uint64_t seed = 200;
  for (const std::string name : {"trebol", "cube", "torus", "hand", "fertility", "bunny"}) {
    if (!kIsFast && name != "trebol") continue;
    std::ostringstream bytes;
    bytes << std::ifstream(folder / (name + ".obj"), std::ios::binary).rdbuf();
    expect_the_same("study " + name, read_mesh(bytes.str(), MeshFormat::obj, name), ++seed);
  }
}

}  // namespace
}  // namespace mimicry
