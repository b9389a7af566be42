#include "cli/canvas.h"

#include <algorithm>
#include <thread>

#include <mimicry/bake/bake.h>

#include "cli/console.h"

namespace mimicry::cli {

PreparedCanvas::PreparedCanvas(const spatial::Target& target,
                               std::span<const technique::TechniqueInfo* const> techniques) {
  canvas_.target = &target;
  if (std::none_of(techniques.begin(), techniques.end(),
                   [](const auto* info) { return info->needs_bake; }))
    return;
  ProgressLine line("baking");
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  projector_.emplace(bake::bake(target.mesh(), {}, threads,
                                [&](const Progress& progress) {
                                  line.update(static_cast<std::size_t>(100 * progress.fraction),
                                              100);
                                  return true;
                                }),
                     target);
  canvas_.projector = &*projector_;
}

}  // namespace mimicry::cli
