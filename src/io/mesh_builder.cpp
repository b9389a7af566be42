#include "io/mesh_builder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>

#include <mimicry/base/error.h>

#include "io/polygon.h"

namespace mimicry {

void MeshBuilder::fail_limit(const char* what, std::size_t limit) const {
  throw Error(ErrorKind::unsupported, std::string(name_) + ": more than " + std::to_string(limit) +
                                          " " + what + "; simplify the mesh");
}

void MeshBuilder::reserve(std::size_t vertices, std::size_t faces) {
  positions_.reserve(std::min(vertices, options_.max_vertices));
  faces_.reserve(std::min(faces, options_.max_faces));
}

void MeshBuilder::number_polygons() {
  if (!polygons_.empty() || polygon_count_ != faces_.size()) return;
  polygons_.resize(faces_.size());
  std::iota(polygons_.begin(), polygons_.end(), 0);
}

void MeshBuilder::add_polygon(std::span<const Index> corners, std::span<const Index> texcoords,
                              std::span<const Index> colors) {
  if (corners.size() != 3) return add_large_polygon(corners, texcoords, colors);
  if (faces_.size() >= options_.max_faces) fail_limit("triangles", options_.max_faces);
  if (!polygons_.empty() || faces_.size() != polygon_count_)
    polygons_.resize(faces_.size() + 1, static_cast<Index>(polygon_count_));
  if (!texcoords.empty())
    attributes_.texcoords.set_face(faces_.size(), {texcoords[0], texcoords[1], texcoords[2]});
  if (!colors.empty())
    attributes_.colors.set_face(faces_.size(), {colors[0], colors[1], colors[2]});
  faces_.push_back({corners[0], corners[1], corners[2]});
  ++polygon_count_;
}

void MeshBuilder::add_large_polygon(std::span<const Index> corners,
                                    std::span<const Index> texcoords,
                                    std::span<const Index> colors) {
  kept_.clear();
  kept_corners_.clear();
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (kept_.empty() || corners[k] != kept_.back()) {
      kept_.push_back(corners[k]);
      kept_corners_.push_back(k);
    }
  while (kept_.size() > 1 && kept_.back() == kept_.front()) {
    kept_.pop_back();
    kept_corners_.pop_back();
  }
  number_polygons();
  const bool is_line = std::all_of(kept_.begin(), kept_.end(),
                                   [&](Index c) { return c == kept_[0] || c == kept_[1]; });
  if (is_line) {
    ++without_area_;
    ++polygon_count_;
    return;
  }
  if (kept_.size() < corners.size()) ++with_repeats_;
  const std::size_t triangles = kept_.size() - 2;
  if (triangles > options_.max_faces || faces_.size() > options_.max_faces - triangles)
    fail_limit("triangles", options_.max_faces);
  for (std::size_t k = 1; k <= triangles; ++k) {
    const std::size_t c[3] = {kept_corners_[0], kept_corners_[k], kept_corners_[k + 1]};
    if (!texcoords.empty())
      attributes_.texcoords.set_face(faces_.size(),
                                     {texcoords[c[0]], texcoords[c[1]], texcoords[c[2]]});
    if (!colors.empty())
      attributes_.colors.set_face(faces_.size(), {colors[c[0]], colors[c[1]], colors[c[2]]});
    faces_.push_back({kept_[0], kept_[k], kept_[k + 1]});
  }
  polygons_.resize(faces_.size(), static_cast<Index>(polygon_count_));
  ++polygon_count_;
}

// A fan's triangles still tell the polygon's corners; only here are all positions known.
void MeshBuilder::cut_polygons() {
  EarCutter cutter;
  std::vector<Face> ears;
  std::vector<Vec3> own;  // the polygon's positions, so that ears tell its corners
  std::vector<Index> numbers;
  std::size_t crossing = 0;
  for (std::size_t first = 0; first < polygons_.size();) {
    std::size_t end = first + 1;
    while (end < polygons_.size() && polygons_[end] == polygons_[first]) ++end;
    if (end > first + 1) {
      kept_.assign({faces_[first][0], faces_[first][1]});
      bool whole = true;  // all vertices are there
      for (std::size_t f = first; f < end; ++f) kept_.push_back(faces_[f][2]);
      for (const Index v : kept_) whole = whole && at(v) < positions_.size();
      if (whole && !fan_covers(kept_, positions_)) {
        own.clear();
        for (const Index v : kept_) own.push_back(positions_[at(v)]);
        numbers.resize(kept_.size());
        std::iota(numbers.begin(), numbers.end(), Index{0});
        if (!cutter.cut(numbers, own, ears)) ++crossing;
        attributes_.cut(first, end, ears);
        for (std::size_t f = first; f < end; ++f)
          for (std::size_t k = 0; k < 3; ++k) faces_[f][k] = kept_[at(ears[f - first][k])];
      }
    }
    first = end;
  }
  tell_of_polygons(crossing);
}

void MeshBuilder::tell_of_polygons(std::size_t crossing) const {
  const auto tell = [&](std::size_t count, const char* one, const char* several) {
    if (count > 0) note(std::to_string(count) + (count == 1 ? one : several));
  };
  tell(without_area_, " face has fewer than three different corners and is left out",
       " faces have fewer than three different corners and are left out");
  tell(with_repeats_, " polygon repeats a corner, which is taken once",
       " polygons repeat corners, which are taken once");
  tell(crossing, " polygon crosses itself; some of its triangles overlap",
       " polygons cross themselves; some of their triangles overlap");
}

void MeshBuilder::clear() {
  positions_.clear();
  faces_.clear();
  polygons_.clear();
  attributes_.clear();
  polygon_count_ = without_area_ = with_repeats_ = 0;
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
  cut_polygons();
  TriangleMesh mesh(std::exchange(positions_, {}), std::exchange(faces_, {}),
                    std::exchange(polygons_, {}));
  mesh.set_attributes(attributes_.finish(mesh.faces()));
  return mesh;
}

}  // namespace mimicry
