#pragma once

#include <optional>
#include <span>
#include <string>

#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/technique/technique.h>

#include "cli/embedding_input.h"

namespace mimicry::cli {

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
