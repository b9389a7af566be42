#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/version.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/system.h"

namespace {

using namespace mimicry::cli;

int exit_code_of(mimicry::ErrorKind kind) {
  if (kind == mimicry::ErrorKind::cancelled) return kCancelled;
  return kind == mimicry::ErrorKind::io ? kFileTrouble : kBadInput;
}

// The status, or that what was printed did not arrive.
int status_after_printing(int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  // Whoever read has enough: no news for them.
  if (!output_reader_is_gone()) complain("standard output cannot be written to; give it room");
  return kFileTrouble;
}

template <class Number>
std::string fault_of(const std::string& text) {
  Number value = 0;
  const char* const end = text.data() + text.size();
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const auto [at, error] = std::from_chars(text.data() + (has_plus ? 1 : 0), end, value);
  if (error == std::errc() && at == end) return "";
  const std::string kind = std::is_floating_point_v<Number> ? "number" : "whole number";
  return "'" + text + "' is not a " + kind + (std::is_unsigned_v<Number> ? " from 0 on" : "") +
         (error == std::errc::result_out_of_range ? " (there are none that large or small)" : "");
}

// The parser takes no text for 0, and wraps numbers that are out of range around.
void check_numbers(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({}))
    for (CLI::Option* option : command->get_options()) {
      const std::string type = option->get_type_name();
      std::string (*fault)(const std::string&) = nullptr;
      if (type.starts_with("UINT")) fault = fault_of<std::uint64_t>;
      if (type.starts_with("INT")) fault = fault_of<std::int64_t>;
      if (type.starts_with("FLOAT")) fault = fault_of<double>;
      if (fault != nullptr)
        option->check([fault](const std::string& text) { return fault(text); }, "");
    }
}

}  // namespace

int main(int argc, char** argv) {
  catch_signals();
  prepare_standard_streams();
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
  add_paint(app, status);
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
  add_bake_worker(app, status);
  add_participants(app, status);
  add_replay(app, status);
  check_numbers(app);
  try {
    std::vector<std::string> arguments = command_line(argc, argv);
    arguments.erase(arguments.begin(), arguments.begin() + (arguments.empty() ? 0 : 1));
    std::reverse(arguments.begin(), arguments.end());  // the last first, as the parser takes them
    app.parse(std::move(arguments));
    return status_after_printing(status);
  } catch (const CLI::ParseError& error) {
    std::ostringstream help, fault;
    const bool done = app.exit(error, help, fault) == 0;
    std::fputs(help.str().c_str(), stdout);
    std::fputs(printable(fault.str()).c_str(), stderr);
    return status_after_printing(done ? kDone : kUsage);
  } catch (const mimicry::Error& error) {
    complain(error.what());
    return exit_code_of(error.kind());
  } catch (const std::bad_alloc&) {
    complain("out of memory; give more, fewer --threads, or a smaller model");
    return kBadInput;
  } catch (const std::filesystem::filesystem_error& error) {
    complain(std::string(error.what()) + "; check the path, the rights and the room left");
    return kFileTrouble;
  } catch (const std::system_error& error) {
    const bool is_limit = error.code() == std::errc::resource_unavailable_try_again;
    complain(std::string(error.what()) +
             (is_limit ? "; raise the limits of this user or container (ulimit -a)" : ""));
    return kFileTrouble;
  } catch (const std::exception& error) {
    complain("unexpected failure: " + std::string(error.what()));
    return kBug;
  }
}
