#include "cli/strokes_input.h"

#include <filesystem>
#include <utility>

#include <mimicry/io/strokes.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "files/file.h"
#include "files/names.h"

namespace mimicry::cli {

void tell_left_out(const std::string& what, int& status) {
  complain("left out: " + what);
  status = kPartly;
}

std::vector<Stroke> load_strokes(const std::string& path, int& status) {
  const std::string name = file_name(path);
  StrokesFile file = read_strokes(read_file(path), name);
  for (const std::string& what : file.left_out) tell_left_out(what, status);
  return std::move(file.strokes);
}

}  // namespace mimicry::cli
