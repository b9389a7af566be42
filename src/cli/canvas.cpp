#include "cli/canvas.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <mimicry/base/error.h>

namespace mimicry::cli {

std::vector<const technique::TechniqueInfo*> chosen_techniques(
    const std::vector<std::string>& names) {
  bool all = names.empty();
  std::set<const technique::TechniqueInfo*> named;
  for (const std::string& name : names)
    if (name == "all")
      all = true;
    else
      named.insert(&technique::find_technique(name));
  std::vector<const technique::TechniqueInfo*> chosen;
  for (const technique::TechniqueInfo& info : technique::techniques())
    if (all || named.contains(&info)) chosen.push_back(&info);
  return chosen;
}

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
