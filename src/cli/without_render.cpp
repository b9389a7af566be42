#include "cli/commands.h"
#include "cli/contact_sheet.h"
#include "cli/missing_command.h"

namespace mimicry::cli {
namespace {
constexpr const char* kNeeds = "the option MIMICRY_RENDER (Embree, libpng)";
}

void add_paint(CLI::App& app, int&) {
  add_missing_command(app, "paint", "Paint a texture along curves", kNeeds);
}

void add_render(CLI::App& app, int&) {
  add_missing_command(app, "render", "Make a picture of a mesh, strokes and curves", kNeeds);
}

void add_report(CLI::App& app, int&) {
  add_missing_command(app, "report", "Make the report of a study", kNeeds);
}

std::optional<std::string> contact_sheet(const Target&, const std::vector<TargetCurve>&,
                                         const Vec3&) {
  return std::nullopt;
}

}  // namespace mimicry::cli
