#include "assets/canvas.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include <mimicry/base/error.h>

#include "files/names.h"

namespace mimicry {
namespace {

SmoothProjector projector_of(const Target& target, const std::string& embedding_file,
                             const BakeSettings& settings, const Monitor& monitor) {
  if (embedding_file.empty())
    return {bake_mesh(target.mesh(), settings, monitor).embedding, target};
  Embedding embedding = load_embedding(embedding_file);
  try {
    return {std::move(embedding), target};
  } catch (const Error& error) {
    throw Error(error.kind(), file_name(embedding_file) + ": " + error.what());
  }
}

}  // namespace

std::vector<const TechniqueInfo*> chosen_techniques(const std::vector<std::string>& names) {
  bool all = names.empty();
  std::set<const TechniqueInfo*> named;
  for (const std::string& name : names)
    if (name == "all")
      all = true;
    else
      named.insert(&find_technique(name));
  std::vector<const TechniqueInfo*> chosen;
  for (const TechniqueInfo& info : techniques())
    if (all || named.contains(&info)) chosen.push_back(&info);
  return chosen;
}

Canvas make_canvas(const Target& target, std::span<const TechniqueInfo* const> techniques,
                   const Monitor& monitor, const std::string& embedding_file,
                   const BakeSettings& settings) {
  Canvas canvas{target};
  if (std::any_of(techniques.begin(), techniques.end(),
                  [](const auto* info) { return info->needs_bake; }))
    canvas.projector = projector_of(target, embedding_file, settings, monitor);
  return canvas;
}

Canvas load_canvas(const std::string& spec, const TechniqueInfo& technique,
                   const Monitor& monitor) {
  const NamedMesh named = load_mesh(spec, monitor);
  const TechniqueInfo* only[] = {&technique};
  Canvas canvas = make_canvas(make_target(named, {}, monitor), only, monitor);
  canvas.metres_per_unit = named.metres_per_unit;
  return canvas;
}

}  // namespace mimicry
