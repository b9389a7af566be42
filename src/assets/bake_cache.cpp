#include "assets/bake_cache.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/io/embedding_file.h>

#include "files/environment.h"
#include "files/file.h"
#include "files/names.h"

namespace mimicry {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".mimicry";

// Also of what is written beside and was left by a program that was killed.
bool is_ours(const fs::path& file) {
  return file.filename().string().find(kEnding) != std::string::npos;
}

std::string name_of_bake(std::uint64_t mesh_hash, const BakeOptions& o) {
  std::uint64_t offset = 0;
  std::memcpy(&offset, &o.offset, sizeof offset);
  char name[160];
  std::snprintf(name, sizeof name, "%016llx-%d-%d-%016llx-r%d-v%u%s",
                static_cast<unsigned long long>(mesh_hash), o.dimension, o.samples,
                static_cast<unsigned long long>(offset), kRevision, kEmbeddingFileVersion, kEnding);
  return name;
}

// Before a bake that may take minutes: what stands at the cache's place can be one.
void require_place(const fs::path& file) {
  std::error_code none;
  const fs::path folder = file.parent_path();
  const auto refuse = [](const fs::path& path, const char* what) {
    throw Error(ErrorKind::io, to_text(path) + ": is " + what +
                                   " where bakes are kept; remove it, set MIMICRY_CACHE to another "
                                   "folder or empty, or pass --no-cache");
  };
  if (fs::exists(folder, none) && !fs::is_directory(folder, none)) refuse(folder, "no folder");
  if (fs::exists(file, none) && !fs::is_regular_file(file, none)) refuse(file, "no plain file");
}

void touch(const fs::path& file) {
  std::error_code none;
  fs::last_write_time(file, fs::file_time_type::clock::now(), none);
}

void shrink(const fs::path& folder, std::uintmax_t most_bytes) {
  struct Kept {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path path;
  };
  std::vector<Kept> files;
  std::uintmax_t total = 0;
  std::error_code trouble;
  for (fs::directory_iterator it(folder, trouble), end; !trouble && it != end;
       it.increment(trouble)) {
    std::error_code gone;
    if (!is_ours(it->path()) || !it->is_regular_file(gone)) continue;
    const std::uintmax_t bytes = it->file_size(gone);
    const fs::file_time_type used = it->last_write_time(gone);
    if (gone) continue;  // another program removed it
    files.push_back({used, bytes, it->path()});
    total += bytes;
  }
  std::sort(files.begin(), files.end(), [](const Kept& a, const Kept& b) {
    return std::tie(a.used, a.path) < std::tie(b.used, b.path);
  });
  for (const Kept& file : files) {
    if (total <= most_bytes) break;
    std::error_code none;
    fs::remove(file.path, none);
    total -= file.bytes;
  }
}

}  // namespace

BakeCache BakeCache::of_user() {
  if (const auto own = environment("MIMICRY_CACHE")) return BakeCache(*own);
  const std::string folder = cache_folder();
  return folder.empty() ? BakeCache() : BakeCache(join_path(folder, "mimicry"));
}

std::optional<Embedding> BakeCache::find(const TriangleMesh& mesh,
                                         const BakeOptions& options) const {
  if (folder_.empty()) return std::nullopt;
  const std::uint64_t hash = content_hash(mesh);
  const fs::path path = to_path(folder_) / name_of_bake(hash, options);
  require_place(path);
  std::error_code none;
  if (!fs::is_regular_file(path, none)) return std::nullopt;
  try {
    Embedding e = read_embedding(MappedFile(to_text(path), Accept::regular).bytes(), to_text(path));
    const bool is_it = e.mesh_hash == hash && e.mesh_vertex_count == mesh.vertex_count() &&
                       e.face_count() == mesh.face_count() &&
                       e.options.dimension == options.dimension &&
                       e.options.samples == options.samples && e.options.offset == options.offset;
    if (!is_it) return std::nullopt;
    touch(path);
    return e;
  } catch (const Error&) {
    return std::nullopt;  // it is made again and replaces this
  }
}

void BakeCache::keep(const Embedding& e) const {
  if (folder_.empty()) return;
  std::error_code trouble;
  fs::create_directories(to_path(folder_), trouble);
  const fs::path path = to_path(folder_) / name_of_bake(e.mesh_hash, e.options);
  write_file_atomically(to_text(path), write_embedding(e));
  shrink(folder_, most_bytes_);
}

}  // namespace mimicry
