#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/technique/technique.h>

#include "cli/embedding_input.h"

namespace mimicry::cli {

/// The techniques of these names in the registry's order, each once; all where there are no names
/// or one is `all`. Throws Error(invalid_input) for a name that does not exist.
std::vector<const technique::TechniqueInfo*> chosen_techniques(
    const std::vector<std::string>& names);

/// What the given techniques look at: the target and, where one of them needs it, its bake: from
/// `embedding_file`, or as `settings` say where that is empty. Refers to the target.
class PreparedCanvas {
 public:
  PreparedCanvas(const spatial::Target& target,
                 std::span<const technique::TechniqueInfo* const> techniques,
                 const std::string& embedding_file = {}, const BakeSettings& settings = {});
  const technique::Canvas& canvas() const { return canvas_; }

 private:
  const embedding::SmoothProjector& projector_of(const spatial::Target& target,
                                                 const std::string& embedding_file,
                                                 const BakeSettings& settings);

  std::optional<embedding::SmoothProjector> projector_;
  technique::Canvas canvas_;
};

}  // namespace mimicry::cli
