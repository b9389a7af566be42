#include "cli/commands.h"
#include "cli/missing_command.h"

namespace mimicry::cli {

void add_serve(CLI::App& app, int&) {
  add_missing_command(app, "serve", "Serve the studio to a browser or a headset",
                      "the option MIMICRY_SERVE (Boost, OpenSSL)");
}

// What the server starts; of no use without it.
void add_bake_worker(CLI::App&, int&) {}

}  // namespace mimicry::cli
