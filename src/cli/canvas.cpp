#include "cli/canvas.h"

#include <algorithm>
#include <filesystem>

#include <mimicry/base/error.h>

namespace mimicry::cli {

PreparedCanvas::PreparedCanvas(const spatial::Target& target,
                               std::span<const technique::TechniqueInfo* const> techniques,
                               const std::string& embedding_file, const BakeSettings& settings) {
  canvas_.target = &target;
  if (std::none_of(techniques.begin(), techniques.end(),
                   [](const auto* info) { return info->needs_bake; }))
    return;
  canvas_.projector = &projector_of(target, embedding_file, settings);
}

const embedding::SmoothProjector& PreparedCanvas::projector_of(const spatial::Target& target,
                                                               const std::string& embedding_file,
                                                               const BakeSettings& settings) {
  if (embedding_file.empty())
    return projector_.emplace(bake_mesh(target.mesh(), settings).embedding, target);
  embedding::Embedding embedding = load_embedding(embedding_file);
  try {
    return projector_.emplace(std::move(embedding), target);
  } catch (const Error& error) {
    throw Error(error.kind(),
                std::filesystem::path(embedding_file).filename().string() + ": " + error.what());
  }
}

}  // namespace mimicry::cli
