// Bakes of small messy meshes: each one is made or refused with an Error, has sound tetrahedra and
// finite values, and is no larger than its budget (docs/fuzzing.md). One that takes long, which
// with sanitizers is a hundred times as long as without, is cancelled.

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/mesh/connect.h>

#include "messy/messy_meshes.h"

namespace {

constexpr auto kPatience = std::chrono::milliseconds(300);

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mimicry;
  if (size < 2) return 0;
  // A thick shell has few tetrahedra: some bakes a second with sanitizers.
  const double offset = data[0] % 8 == 0 ? 0.05 : 0.15 + 0.05 * (data[0] % 8);
  const TriangleMesh mesh = messy::of_bytes(std::span(data + 1, size - 1));
  Embedding e;
  try {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    e = mimicry::bake(mesh, {.dimension = 8, .samples = 12, .offset = offset}, 1,
                      [end](const Progress&) { return std::chrono::steady_clock::now() < end; });
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::invalid_input || error.kind() == ErrorKind::cancelled);
    return 0;
  }
  require(e.mesh_vertex_count == connect(mesh).mesh.vertex_count());
  require(e.values.size() == e.positions.size() * 8);
  require(e.vertex_count() <= 90000 && e.tets.size() <= 400000 && !e.tets.empty());
  for (const double x : e.values) require(std::isfinite(x));
  for (const auto& t : e.tets) {
    for (const Index v : t) require(v >= 0 && v < e.vertex_count());
    const Vec3& a = e.positions[at(t[0])];
    require((e.positions[at(t[1])] - a)
                .cross(e.positions[at(t[2])] - a)
                .dot(e.positions[at(t[3])] - a) > 0.0);
  }
  return 0;
}
