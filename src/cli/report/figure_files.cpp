#include "cli/report/figure_files.h"

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <spawn.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <mimicry/base/error.h>

#include "cli/interrupt.h"
#include "cli/report/base64.h"
#include "cli/report/bundle.h"
#include "files/names.h"
#include "render/text.h"

extern char** environ;

namespace mimicry::cli {
namespace {

[[noreturn]] void fail(const std::string& what, int error) {
  throw Error(ErrorKind::io, "node: " + what + ": " + std::generic_category().message(error));
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// A program reading its script from the returned file; 0 where there is no such program.
pid_t start_node(const std::string& folder, int& script) {
  int ends[2];
  if (::pipe(ends) != 0) fail("cannot be given a script", errno);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  // It works in the folder: Node takes only names that are UTF-8.
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::string name = "node", kind = "--input-type=commonjs", dash = "-", where = ".";
  char* arguments[] = {name.data(), kind.data(), dash.data(), where.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, "node", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[0]);
  if (error != 0) {
    ::close(ends[1]);
    if (error == ENOENT) return 0;
    fail("cannot be started", error);
  }
  script = ends[1];
  return child;
}

// The child's status; it is ended where we are asked to end.
int wait_for(pid_t child) {
  int status = 0;
  for (pid_t ended = 0; ended != child;) {
    if (end_requested()) ::kill(child, SIGKILL);
    ended = ::waitpid(child, &status, WNOHANG);
    if (ended < 0 && errno != EINTR) fail("cannot be waited for", errno);
    constexpr timespec kPause{0, 10'000'000};
    if (ended != child) ::nanosleep(&kPause, nullptr);
  }
  set_child(0);
  return status;
}

void remove_parts(const std::string& folder) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(to_path(folder), none))
    if (entry.path().extension() == ".part") std::filesystem::remove(entry.path(), none);
}

}  // namespace

bool draw_figure_files(const std::string& folder) {
  int script = -1;
  const pid_t child = start_node(folder, script);
  if (child == 0) return false;
  set_child(child);
  write_all(script, "const mimicryFont = '") && write_all(script, base64(render::font_file())) &&
      write_all(script, "';\n") && write_all(script, files_script());
  ::close(script);
  const int status = wait_for(child);
  if (end_requested()) {
    remove_parts(folder);
    end_if_requested();
  }
  // 127: what spawning reports from the child where the program is not there.
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) return false;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(ErrorKind::io,
                "node: could not draw the figures of " + folder + "; it needs Node 18 or newer");
  return true;
}

}  // namespace mimicry::cli
