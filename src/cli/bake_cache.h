#pragma once

#include <optional>
#include <string>

#include <mimicry/embedding/embedding.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry::cli {

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

  /// Throws Error(io) where something that is no folder or no plain file stands at its place.
  std::optional<embedding::Embedding> find(const TriangleMesh& mesh,
                                           const embedding::BakeOptions& options) const;
  /// Then the files used longest ago are removed until the folder holds at most 2 GB.
  void keep(const embedding::Embedding& embedding) const;

 private:
  explicit BakeCache(std::string folder) : folder_(std::move(folder)) {}
  std::string folder_;  // empty: none
};

}  // namespace mimicry::cli
