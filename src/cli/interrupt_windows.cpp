#include <atomic>
#include <string_view>

#include <windows.h>

#include <mimicry/base/error.h>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "files/file.h"

namespace mimicry::cli {
namespace {

std::atomic<bool> requested{false};

constexpr DWORD kOrderly_ms = 1000;

// The system calls this in a thread of its own, and ends the program when it returns from what
// closes the console or the session.
BOOL WINAPI on_request(DWORD) {
  if (requested.exchange(true)) end_now();
  Sleep(kOrderly_ms);
  end_now();
}

}  // namespace

void end_now() {
  remove_unfinished();
  constexpr std::string_view kMessage = "mimicry: interrupted\n";
  DWORD written = 0;
  WriteFile(GetStdHandle(STD_ERROR_HANDLE), kMessage.data(), static_cast<DWORD>(kMessage.size()),
            &written, nullptr);
  TerminateProcess(GetCurrentProcess(), kCancelled);
  for (;;) Sleep(INFINITE);
}

void catch_signals() {
  SetConsoleCtrlHandler(on_request, TRUE);
}

bool end_requested() {
  return requested;
}

void end_if_requested() {
  if (end_requested()) throw Error(ErrorKind::cancelled, "interrupted");
}

}  // namespace mimicry::cli
