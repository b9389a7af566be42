#include "cli/strokes_input.h"

#include <utility>

#include <mimicry/assets/files.h>

#include "cli/commands.h"
#include "cli/console.h"

namespace mimicry::cli {

void tell_left_out(const std::string& what, int& status) {
  complain("left out: " + what);
  status = kPartly;
}

std::vector<Stroke> load_strokes(const std::string& path, int& status) {
  StrokesFile file = mimicry::load_strokes(path);
  for (const std::string& what : file.left_out) tell_left_out(what, status);
  return std::move(file.strokes);
}

}  // namespace mimicry::cli
