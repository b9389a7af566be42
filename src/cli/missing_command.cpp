#include "cli/missing_command.h"

namespace mimicry::cli {

void add_missing_command(CLI::App& app, const std::string& name, const std::string& title,
                         const std::string& needs) {
  auto* command = app.add_subcommand(name, title + " (not in this build)");
  command->allow_extras();
  command->callback([name, needs] {
    throw CLI::ValidationError(name, "is not in this build of mimicry; it is in one with " + needs);
  });
}

}  // namespace mimicry::cli
