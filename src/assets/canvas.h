#pragma once

#include <span>
#include <string>
#include <vector>

#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/technique/technique.h>

#include "assets/bakes.h"

namespace mimicry::assets {

/// The techniques of these names in the registry's order, each once; all where there are no names
/// or one is `all`. Throws Error(invalid_input) for a name that does not exist.
std::vector<const TechniqueInfo*> chosen_techniques(const std::vector<std::string>& names);

/// What the given techniques look at: the target and, where one of them needs it, its bake: from
/// `embedding_file`, or as `settings` say where that is empty.
class PreparedCanvas {
 public:
  PreparedCanvas(const Target& target, std::span<const TechniqueInfo* const> techniques,
                 const Monitor& monitor = {}, const std::string& embedding_file = {},
                 const BakeSettings& settings = {});
  const Canvas& canvas() const { return canvas_; }

 private:
  static SmoothProjector projector_of(const Target& target, const std::string& embedding_file,
                                      const BakeSettings& settings, const Monitor& monitor);

  Canvas canvas_;
};

}  // namespace mimicry::assets
