#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include <mimicry/base/parallel.h>
#include <mimicry/embedding/embedding.h>
#include <mimicry/mesh/triangle_mesh.h>
#include <mimicry/spatial/target.h>
#include <mimicry/technique/technique.h>

namespace mimicry {

/// How a caller follows long work and ends it. Every member may be empty. Each may be called from
/// any thread of the work, and by several at once; what it throws ends the work.
struct Monitor {
  /// A sentence for people: what was mended, taken from elsewhere or left out.
  std::function<void(const std::string& sentence)> note;
  /// work: "baking", "replaying"; fraction: of it, in [0, 1].
  std::function<void(std::string_view work, double fraction)> progress;
  /// True ends the work with Error(cancelled).
  std::function<bool()> cancelled;

  void tell(const std::string& sentence) const;
  /// Throws Error(cancelled) where the work is to end.
  void check() const;
  /// Reports `done` of `total`, at most all of it, and does as `check`. Where `total` is 0 it is
  /// not known, and `progress` hears nothing.
  void report(std::string_view work, std::size_t done, std::size_t total) const;
};

struct NamedMesh {
  std::string name;  ///< the file's name without folders, or the shape's
  TriangleMesh mesh;
  /// At which it is shown: the shape's own; of a file the diagonal is 0.6 m.
  double metres_per_unit = 1.0;
};

/// The mesh of a file (.obj .ply .stl .off .glb .gltf; .mimicry: the mesh that was baked) or a
/// built-in shape (shape:NAME[:RESOLUTION]). The monitor hears what the reader mended. Throws Error
/// where the file or shape cannot be had.
NamedMesh load_mesh(const std::string& spec, const Monitor& monitor = {});

/// A target of the mesh. The monitor hears what was mended to make it. Throws Error as `Target`
/// does, naming the mesh.
Target make_target(const NamedMesh& named, const TargetOptions& options = {},
                   const Monitor& monitor = {});

/// `load_mesh` and `make_target` in one call.
Target load_target(const std::string& spec, const Monitor& monitor = {});

/// How a bake that is needed is had.
struct BakeSettings {
  BakeOptions options;
  int threads = 0;        ///< 0: as many as the machine has
  bool use_cache = true;  ///< look for an earlier bake, and keep a new one
};

struct Baked {
  Embedding embedding;
  bool was_kept = false;  ///< from an earlier bake
};

/// The bake of a mesh: an earlier one of the same mesh and options, or a new one, which is kept in
/// the user's cache (MIMICRY_CACHE, else XDG_CACHE_HOME/mimicry or ~/.cache/mimicry, 2 GB at most).
/// The monitor hears of a new one as "baking", and where it cannot be kept; `stages` hears of its
/// stages. Throws Error(cancelled) where the monitor ends it, and leaves nothing behind. A new bake
/// takes as long as `bake`, an earlier one as long as reading its file.
Baked bake_mesh(const TriangleMesh& mesh, const BakeSettings& settings = {},
                const Monitor& monitor = {}, const ProgressCallback& stages = {});

/// Reads a .mimicry file. Throws Error, which begins with the file's name, where it is not a sound
/// one.
Embedding load_embedding(const std::string& file);

/// What the given techniques draw on: the target and, where one of them needs it, its bake: from
/// `embedding_file`, or as `bake_mesh` has it where that is empty. Throws Error as these do, and
/// Error(invalid_input) where the file is of another mesh.
Canvas make_canvas(const Target& target, std::span<const TechniqueInfo* const> techniques,
                   const Monitor& monitor = {}, const std::string& embedding_file = {},
                   const BakeSettings& settings = {});

/// What one technique draws on, from the mesh's file or shape: `load_mesh`, `make_target` and
/// `make_canvas` in one call.
Canvas load_canvas(const std::string& spec, const TechniqueInfo& technique,
                   const Monitor& monitor = {});

}  // namespace mimicry
