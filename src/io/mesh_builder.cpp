#include "io/mesh_builder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>

#include <mimicry/base/error.h>

namespace mimicry::io {

void MeshBuilder::fail_limit(const char* what, std::size_t limit) const {
  throw Error(ErrorKind::unsupported, std::string(name_) + ": more than " + std::to_string(limit) +
                                          " " + what +
                                          "; simplify the mesh or raise the reader's limits");
}

void MeshBuilder::reserve(std::size_t vertices, std::size_t faces) {
  positions_.reserve(std::min(vertices, options_.max_vertices));
  faces_.reserve(std::min(faces, options_.max_faces));
}

void MeshBuilder::add_polygon(std::span<const Index> corners) {
  assert(corners.size() >= 3);
  const std::size_t triangles = corners.size() - 2;
  if (triangles > options_.max_faces || faces_.size() > options_.max_faces - triangles)
    fail_limit("triangles", options_.max_faces);
  if (triangles > 1 && polygons_.empty()) {
    polygons_.resize(faces_.size());
    std::iota(polygons_.begin(), polygons_.end(), 0);
  }
  for (std::size_t k = 1; k <= triangles; ++k)
    faces_.push_back({corners[0], corners[k], corners[k + 1]});
  if (faces_.size() > polygon_count_ + 1)
    polygons_.resize(faces_.size(), static_cast<Index>(polygon_count_));
  ++polygon_count_;
}

void MeshBuilder::merge_identical_positions() {
  // Open addressing, at most half full; slots hold numbers of merged vertices.
  std::size_t size = 16;
  while (size < 2 * positions_.size()) size *= 2;
  std::vector<Index> slots(size, kNone);
  std::vector<Index> merged(positions_.size());
  std::size_t count = 0;
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    std::array<double, 3> key;
    std::array<std::uint64_t, 3> bits;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = positions_[v][static_cast<Eigen::Index>(k)];
      key[k] = x == 0.0 ? 0.0 : x;
    }
    std::memcpy(bits.data(), key.data(), sizeof(bits));
    std::uint64_t hash = 0;
    for (const std::uint64_t word : bits) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    std::size_t slot = hash & (size - 1);
    while (slots[slot] != kNone &&
           std::memcmp(positions_[static_cast<std::size_t>(slots[slot])].data(), key.data(),
                       sizeof(key)) != 0)
      slot = (slot + 1) & (size - 1);
    if (slots[slot] == kNone) {
      slots[slot] = static_cast<Index>(count);
      positions_[count++] = {key[0], key[1], key[2]};
    }
    merged[v] = slots[slot];
  }
  positions_.resize(count);
  for (Face& face : faces_)
    for (Index& v : face) v = merged[static_cast<std::size_t>(v)];
}

TriangleMesh MeshBuilder::finish() {
  return TriangleMesh(std::exchange(positions_, {}), std::exchange(faces_, {}),
                      std::exchange(polygons_, {}));
}

}  // namespace mimicry::io
