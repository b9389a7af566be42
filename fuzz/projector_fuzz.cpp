// Smooth closest points: any shell and any values around an octahedron, any queries.

#include <cmath>
#include <cstdint>
#include <cstring>

#include <mimicry/base/error.h>
#include <mimicry/embedding/smooth_projector.h>

namespace {

using namespace mimicry;

class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), end_(data + size) {}
  bool is_empty() const { return data_ == end_; }
  std::uint8_t byte() { return is_empty() ? 0 : *data_++; }
  // Mostly small numbers on a coarse grid, which coincide often; now and then any bits.
  double number() {
    const std::uint8_t first = byte();
    if (first != 255) return (first - 127) / 32.0;
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    double x = 0.0;
    std::memcpy(&x, &bits, sizeof x);
    return x;
  }

 private:
  const std::uint8_t *data_, *end_;
};

bool is_same(const SmoothPoint& a, const SmoothPoint& b) {
  return a.surface.face == b.surface.face && a.position == b.position && a.label == b.label;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const TriangleMesh mesh(
      {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}});
  const Target target(mesh);
  Embedding e;
  e.dimension = 1 + input.byte() % 9;
  e.mesh_vertex_count = mesh.vertex_count();
  e.faces.assign(mesh.faces().begin(), mesh.faces().end());
  e.mesh_hash = content_hash(mesh);
  e.diagonal = target.diagonal();
  e.positions.assign(mesh.positions().begin(), mesh.positions().end());
  for (int more = input.byte() % 16; more > 0; --more) {
    const double x = input.number(), y = input.number(), z = input.number();
    e.positions.emplace_back(x, y, z);
  }
  for (int tets = input.byte() % 32; tets > 0; --tets) {
    std::array<Index, 4> t;
    for (Index& v : t) v = static_cast<Index>(input.byte() % e.positions.size());
    e.tets.push_back(t);
  }
  const auto dimension = static_cast<std::size_t>(e.dimension);
  for (std::size_t v = 0; v < e.positions.size(); ++v)
    for (std::size_t k = 0; k < dimension; ++k)
      e.values.push_back(input.number() + (k < 3 ? 2.0 * e.positions[v][Eigen::Index(k)] : 0.0));
  try {
    const SmoothProjector projector(std::move(e), target);
    ScpHint hint;
    for (int i = 0; i < 16 && !input.is_empty(); ++i) {
      const double x = input.number(), y = input.number(), z = input.number();
      const Vec3 query(x, y, z);
      const auto cold = projector.project(query, {.replace_failed = i % 2 == 1});
      if (cold.has_value() != (std::isfinite(x) && std::isfinite(y) && std::isfinite(z) &&
                               query.cwiseAbs().maxCoeff() <= 1e60))
        __builtin_trap();
      if (!cold) continue;
      const Vec3& b = cold->surface.bary;
      if (cold->surface.face < 0 || cold->surface.face >= mesh.face_count() ||
          !(b.minCoeff() >= 0.0) || !(std::abs(b.sum() - 1.0) < 1e-9))
        __builtin_trap();
      const auto warm = projector.project(query, {.replace_failed = i % 2 == 1}, &hint);
      if (!is_same(*cold, *warm)) __builtin_trap();
    }
  } catch (const Error&) {
  }
  return 0;
}
