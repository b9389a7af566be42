#pragma once

#include <optional>
#include <span>

#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/technique/technique.h>

namespace mimicry::cli {

/// What the given techniques look at: the target, and its bake, made in memory, where one of them
/// needs it. Refers to the target.
class PreparedCanvas {
 public:
  PreparedCanvas(const spatial::Target& target,
                 std::span<const technique::TechniqueInfo* const> techniques);
  const technique::Canvas& canvas() const { return canvas_; }

 private:
  std::optional<embedding::SmoothProjector> projector_;
  technique::Canvas canvas_;
};

}  // namespace mimicry::cli
