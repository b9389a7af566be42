#include <cassert>
#include <cstring>
#include <utility>

#include <mimicry/embedding/embedding.h>

#include "phong/phong_surface.h"
#include "spatial/leaf_order.h"

namespace mimicry {
namespace {

// Mixes one word into the state: multiply and fold, after the finaliser of MurmurHash3.
std::uint64_t mix(std::uint64_t state, std::uint64_t word) {
  state ^= word * 0x9e3779b97f4a7c15U;
  state ^= state >> 32;
  state *= 0xff51afd7ed558ccdU;
  state ^= state >> 29;
  state *= 0xc4ceb9fe1a85ec53U;
  return state ^ state >> 32;
}

std::uint64_t word(double x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

}  // namespace

TriangleMesh mesh_of(const Embedding& e) {
  assert(e.mesh_vertex_count >= 0 && e.mesh_vertex_count <= e.vertex_count());
  TriangleMesh mesh({e.positions.begin(), e.positions.begin() + e.mesh_vertex_count}, e.faces);
  mesh.mark_connected();  // a surface is what is baked
  return mesh;
}

void sort_for_search(Embedding& e) {
  std::vector<Vec3> centres;
  centres.reserve(e.tets.size());
  for (const std::array<Index, 4>& t : e.tets) {
    Vec3 sum = Vec3::Zero();
    for (const Index v : t) sum += 0.25 * e.positions[static_cast<std::size_t>(v)];
    centres.push_back(sum);
  }
  std::vector<std::array<Index, 4>> sorted;
  sorted.reserve(e.tets.size());
  for (const Index tet : leaf_order<3>(centres, e.overlapping_tets))
    sorted.push_back(e.tets[static_cast<std::size_t>(tet)]);
  e.tets = std::move(sorted);
  e.face_order = face_order(e.faces, e.values, e.dimension);
}

std::uint64_t content_hash(const TriangleMesh& mesh) {
  std::uint64_t state = mix(static_cast<std::uint64_t>(mesh.vertex_count()),
                            static_cast<std::uint64_t>(mesh.face_count()));
  for (const Vec3& p : mesh.positions())
    for (int k = 0; k < 3; ++k) state = mix(state, word(p[k]));
  for (const Face& f : mesh.faces())
    for (const Index v : f) state = mix(state, static_cast<std::uint64_t>(v));
  return state;
}

}  // namespace mimicry
