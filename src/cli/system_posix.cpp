#include <cerrno>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include "cli/system.h"

namespace mimicry::cli {

std::vector<std::string> command_line(int argc, char** argv) {
  return {argv, argv + argc};
}

// Where a standard stream is closed, the next file that is opened would take its place and get what
// is printed. What stands there instead cannot be written to.
void prepare_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF) (void)::open("/dev/null", O_RDONLY);
}

bool is_terminal(std::FILE* stream) {
  return ::isatty(::fileno(stream)) != 0;
}

bool output_reader_is_gone() {
  pollfd reader{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&reader, 1, 0) == 1 && (reader.revents & POLLERR) != 0;
}

}  // namespace mimicry::cli
