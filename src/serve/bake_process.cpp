#include "serve/bake_process.h"

#include <cerrno>
#include <csignal>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <mimicry/base/error.h>

#include "serve/text.h"

namespace mimicry::serve {
namespace {

using Json = nlohmann::json;
constexpr std::size_t kLongestLine = 64 * 1024;

// The signals that end the server are for it alone; it ends its bake itself.
int spawn(const std::vector<std::string>& command, int mesh, int messages, int result) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&files);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&files, mesh, 0);
  posix_spawn_file_actions_adddup2(&files, messages, 1);
  posix_spawn_file_actions_adddup2(&files, result, 3);
  posix_spawn_file_actions_addclosefrom_np(&files, 4);
  sigset_t none, usual;
  sigemptyset(&none);
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  pid_t process = 0;
  const int trouble = posix_spawn(&process, words[0], &files, &attributes, words.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  return trouble == 0 ? process : 0;
}

}  // namespace

BakeProcess::BakeProcess(boost::asio::io_context& io, Events events)
    : events_(std::move(events)), messages_(io), limit_(io), block_(4096, '\0') {}

BakeProcess::~BakeProcess() {
  if (process_ == 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void BakeProcess::start(const std::vector<std::string>& command, MemoryFile mesh, double longest_s,
                        const HeldBytes& held) {
  result_ = MemoryFile::make(held);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw Error(ErrorKind::io, "there is no file left for a bake; try again later");
  messages_.assign(ends[0]);
  // What is written last is what is read first: the mesh from its start.
  ::lseek(mesh.descriptor(), 0, SEEK_SET);
  process_ = spawn(command, mesh.descriptor(), ends[1], result_.descriptor());
  ::close(ends[1]);
  if (process_ == 0)
    throw Error(ErrorKind::io, "no process can be started for a bake; try again later");
  limit_.expires_after(std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(longest_s)));
  limit_.async_wait([weak = weak_from_this()](const boost::system::error_code& trouble) {
    const auto self = weak.lock();
    if (!trouble && self)
      self->kill(
          "the bake took longer than is allowed; simplify the model, or bake it with the "
          "command line");
  });
  read();
}

void BakeProcess::kill(const std::string& sentence) {
  if (process_ == 0) return;
  if (killed_because_.empty()) killed_because_ = sentence;
  ::kill(process_, SIGKILL);  // `read` comes to the end of its messages
}

void BakeProcess::read() {
  messages_.async_read_some(
      boost::asio::buffer(block_),
      [self = shared_from_this()](const boost::system::error_code& trouble, std::size_t count) {
        if (trouble) return self->finish();
        try {
          self->take(std::string_view(self->block_).substr(0, count));
        } catch (const std::exception& error) {  // out of memory, or nonsense from the process
          self->kill(error.what());
        }
        self->read();
      });
}

void BakeProcess::take(std::string_view block) {
  text_ += block;
  for (std::size_t end; (end = text_.find('\n')) != std::string::npos;) {
    const std::string line = text_.substr(0, end);
    text_.erase(0, end + 1);
    take_line(line);
  }
  if (text_.size() > kLongestLine) text_.clear();
}

void BakeProcess::take_line(const std::string& line) {
  const Json message = Json::parse(line, nullptr, false);
  if (!message.is_object()) return;
  if (message.contains("stage")) {
    stage_ = message.value("stage", "");
    fraction_ = message.value("fraction", 0.0);
  } else if (message.contains("note")) {
    events_.note(printable(message.value("note", "")));
  } else if (message.contains("error")) {
    give(refusal(message.value("status", 500), message.value("error", "")));
  } else if (message.contains("done")) {
    Response response;
    response.fields.emplace_back("Content-Type", "application/octet-stream");
    response.fields.emplace_back("Cache-Control", "no-store");
    const auto bytes = MemoryFile::map(std::exchange(result_, {}));
    if (!bytes) return give(refusal(507, "the result is too large for this machine's memory"));
    response.body = *bytes;
    response.keeper = bytes;
    give(std::move(response));
  }
}

void BakeProcess::give(Response response) {
  if (!std::exchange(answered_, true)) events_.answer(std::move(response));
}

void BakeProcess::finish() {
  limit_.cancel();
  boost::system::error_code none;
  messages_.close(none);
  // It has closed its messages: it is ending. Killing it makes sure.
  ::kill(process_, SIGKILL);
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  process_ = 0;
  if (!killed_because_.empty()) {
    give(busy(killed_because_));
  } else if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    give(
        busy("the bake took longer than is allowed; simplify the model, or bake it with the "
             "command line"));
  } else if (!answered_) {
    const std::string how = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                                : "code " + std::to_string(WEXITSTATUS(status));
    events_.note("a bake ended unexpectedly (" + how + ")");
    give(refusal(500, "the bake ended unexpectedly (" + how +
                          "); bake the model with the command line to see why"));
  }
  events_.ended();
}

}  // namespace mimicry::serve
