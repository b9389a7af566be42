#include <array>
#include <atomic>
#include <csignal>
#include <string_view>

#include <unistd.h>

#include <mimicry/base/error.h>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "files/file.h"

namespace mimicry::cli {
namespace {

// Signal handlers can reach no other state than the program's own.
std::atomic<bool> requested{false};
std::atomic<long> child{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<long>::is_always_lock_free);

constexpr unsigned kOrderly_s = 1;
constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

void on_request(int) {
  if (requested.exchange(true)) end_now();
  ::alarm(kOrderly_s);
}

void on_alarm(int) {
  end_now();
}

}  // namespace

// Calls only what is safe in a signal handler.
void end_now() {
  if (const long running = child; running > 0) ::kill(static_cast<pid_t>(running), SIGKILL);
  remove_unfinished();
  constexpr std::string_view kMessage = "mimicry: interrupted\n";
  (void)!::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  ::_exit(kCancelled);
}

void catch_signals() {
  struct sigaction action = {};
  sigemptyset(&action.sa_mask);
  for (const int signal : kSignals) sigaddset(&action.sa_mask, signal);
  sigaddset(&action.sa_mask, SIGALRM);
  action.sa_flags = SA_RESTART;
  action.sa_handler = on_alarm;
  sigaction(SIGALRM, &action, nullptr);
  action.sa_handler = on_request;
  for (const int signal : kSignals) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    // A program under nohup outlives its terminal.
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) continue;
    sigaction(signal, &action, nullptr);
  }
  // Whoever started us may have held them back.
  sigprocmask(SIG_UNBLOCK, &action.sa_mask, nullptr);
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

bool end_requested() {
  return requested;
}

void end_if_requested() {
  if (end_requested()) throw Error(ErrorKind::cancelled, "interrupted");
}

void set_child(long process_number) {
  child = process_number;
}

}  // namespace mimicry::cli
