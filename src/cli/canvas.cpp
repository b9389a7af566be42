#include "cli/canvas.h"

#include <algorithm>
#include <filesystem>
#include <thread>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/files/file.h>
#include <mimicry/io/embedding_file.h>

#include "cli/console.h"

namespace mimicry::cli {

PreparedCanvas::PreparedCanvas(const spatial::Target& target,
                               std::span<const technique::TechniqueInfo* const> techniques,
                               const std::string& embedding_file) {
  canvas_.target = &target;
  if (std::none_of(techniques.begin(), techniques.end(),
                   [](const auto* info) { return info->needs_bake; }))
    return;
  canvas_.projector = &projector_of(target, embedding_file);
}

const embedding::SmoothProjector& PreparedCanvas::projector_of(const spatial::Target& target,
                                                               const std::string& embedding_file) {
  if (!embedding_file.empty()) {
    const std::string name = std::filesystem::path(embedding_file).filename().string();
    try {
      return projector_.emplace(io::read_embedding(files::read_file(embedding_file), name), target);
    } catch (const Error& error) {
      const std::string message = error.what();
      throw Error(error.kind(), message.starts_with(name) ? message : name + ": " + message);
    }
  }
  ProgressLine line("baking");
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return projector_.emplace(
      bake::bake(target.mesh(), {}, threads,
                 [&](const Progress& progress) {
                   line.update(static_cast<std::size_t>(100 * progress.fraction), 100);
                   return true;
                 }),
      target);
}

}  // namespace mimicry::cli
