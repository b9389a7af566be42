#include <cstdio>
#include <exception>
#include <new>

#include <mimicry/base/error.h>

#include "cli/commands.h"

namespace {

int exit_code_of(mimicry::ErrorKind kind) {
  if (kind == mimicry::ErrorKind::cancelled) return mimicry::cli::kCancelled;
  return kind == mimicry::ErrorKind::io ? mimicry::cli::kFileTrouble : mimicry::cli::kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace mimicry::cli;
  CLI::App app("Turns strokes drawn in mid-air into the curves that were meant on a surface.",
               "mimicry");
  app.set_version_flag("--version", MIMICRY_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 unexpected failure, 2 wrong command line, 3 input that cannot be "
      "used, 4 file that cannot be read or written, 5 done in part, 130 interrupted.");
  int status = kDone;
  add_info(app, status);
  add_shapes(app, status);
  add_techniques(app, status);
  add_simulate(app, status);
  add_project(app, status);
  add_render(app, status);
  add_report(app, status);
  add_geodesic(app, status);
  add_bake(app, status);
  add_import_embedding(app, status);
  add_quality(app, status);
  add_scp(app, status);
  add_compare(app, status);
  add_keypoints(app, status);
  add_measure(app, status);
  add_targets(app, status);
  add_serve(app, status);
  add_participants(app, status);
  add_replay(app, status);
  try {
    app.parse(argc, argv);
    if (std::fflush(stdout) != 0) {
      std::fprintf(stderr, "mimicry: standard output cannot be written to\n");
      return kFileTrouble;
    }
    return status;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  } catch (const mimicry::Error& error) {
    std::fprintf(stderr, "mimicry: %s\n", error.what());
    return exit_code_of(error.kind());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "mimicry: out of memory\n");
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mimicry: unexpected failure: %s\n", error.what());
    return kBug;
  }
}
