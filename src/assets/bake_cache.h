#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <mimicry/embedding/embedding.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// Bakes that were made before, as .mimicry files in one folder, found by the mesh's content and
/// the bake's options. Nothing depends on it: a file that is damaged, of another version or of
/// another mesh is as good as none, and where the folder cannot be written bakes are just not kept.
/// A pipe or a device at its place is an error.
/// Several programs may use one folder at once: files are written beside and renamed.
class BakeCache {
 public:
  /// In MIMICRY_CACHE (empty: no cache), else in XDG_CACHE_HOME/mimicry, else in
  /// HOME/.cache/mimicry.
  static BakeCache of_user();
  /// Keeps nothing and finds nothing.
  BakeCache() = default;
  explicit BakeCache(std::string folder, std::uintmax_t most_bytes = 2'000'000'000)
      : folder_(std::move(folder)), most_bytes_(most_bytes) {}

  /// Throws Error(io) where something that is no folder or no plain file stands at its place.
  std::optional<Embedding> find(const TriangleMesh& mesh, const BakeOptions& options) const;
  /// Then the files used longest ago are removed until the folder holds no more than it may (2 GB).
  /// Throws Error(io) where the bake cannot be kept.
  void keep(const Embedding& embedding) const;

 private:
  std::string folder_;  // empty: none
  std::uintmax_t most_bytes_ = 0;
};

}  // namespace mimicry
