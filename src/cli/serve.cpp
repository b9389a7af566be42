#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <qrcodegen/qrcodegen.hpp>
#include <unistd.h>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "files/names.h"
#include "serve/server.h"

namespace mimicry::cli {
namespace {

// In the source tree, and of an installed program beside its folder.
std::string studio_folder() {
  std::error_code trouble;
  const auto program = std::filesystem::canonical("/proc/self/exe", trouble);
  const auto installed = program.parent_path().parent_path() / "share" / "mimicry" / "studio";
  return std::filesystem::is_directory(installed, trouble) ? to_text(installed) : MIMICRY_STUDIO;
}

std::string data_folder() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data && *data)
    return std::string(data) + "/mimicry";
  const char* home = std::getenv("HOME");
  return std::string(home && *home ? home : "/tmp") + "/.local/share/mimicry";
}

// Two rows of modules in a line, black on white whatever the terminal's colours.
void print_qr(const std::string& text) {
  const auto code = qrcodegen::QrCode::encodeText(text.c_str(), qrcodegen::QrCode::Ecc::MEDIUM);
  constexpr int kQuiet = 2;
  const int end = code.getSize() + kQuiet;
  for (int y = -kQuiet; y < end; y += 2) {
    std::string line = "  \033[30;107m";
    for (int x = -kQuiet; x < end; ++x) {
      const bool upper = code.getModule(x, y), lower = code.getModule(x, y + 1);
      line += upper ? (lower ? "█" : "▀") : (lower ? "▄" : " ");
    }
    std::printf("%s\033[0m\n", line.c_str());
  }
}

void print_addresses(const serve::Server& server, const serve::ServeOptions& options) {
  const auto& addresses = server.addresses();
  std::printf("The studio is at %s\n", addresses.front().c_str());
  if (options.lan && addresses.size() < 2)
    std::printf("This machine is in no network: a headset cannot reach it.\n");
  for (std::size_t i = 1; i < addresses.size(); ++i)
    std::printf("  and for a headset at %s\n", addresses[i].c_str());
  if (options.lan && addresses.size() > 1) {
    if (options.certificate.empty())
      std::printf("The certificate is this machine's own: tell the browser once to go on.\n");
    if (isatty(STDOUT_FILENO)) print_qr(addresses[1]);
  }
  std::printf("Ctrl-C stops it.\n");
  std::fflush(stdout);
}

std::uint64_t half_the_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGE_SIZE);
  if (pages <= 0 || size <= 0) return std::uint64_t{4} << 30;
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size) / 2;
}

// Ends the server when it is asked to, and the program where that takes longer than a second: a
// busy machine, a page that is still being read. Signals must be blocked in all threads.
class Watch {
 public:
  explicit Watch(const sigset_t& signals) : signals_(signals), thread_([this] { wait(); }) {}
  ~Watch() {
    over_ = true;
    pthread_kill(thread_.native_handle(), SIGTERM);
    thread_.join();
  }
  /// The server that is to end orderly; at once where that was asked for before.
  void set(serve::Server& server) {
    const std::lock_guard lock(mutex_);
    server_ = &server;
    if (asked_) server.stop();
  }

 private:
  void wait() {
    int signal = 0;
    sigwait(&signals_, &signal);
    {
      const std::lock_guard lock(mutex_);
      asked_ = true;
      if (server_ && !over_) server_->stop();
    }
    // Until it is over, time is up, or someone asks once more.
    constexpr timespec kOrderly = {1, 0};
    if (!over_) sigtimedwait(&signals_, nullptr, &kOrderly);
    if (!over_) end_now();
  }

  sigset_t signals_;
  std::mutex mutex_;
  serve::Server* server_ = nullptr;
  bool asked_ = false;
  std::atomic<bool> over_{false};
  std::thread thread_;
};

void run_serve(const serve::ServeOptions& options) {
  // Threads inherit the mask: the signals come to the one that waits for them.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::unique_ptr<serve::Server> server;  // outlives the watch
  Watch watch(signals);
  server = std::make_unique<serve::Server>(options);
  watch.set(*server);
  print_addresses(*server, options);
  server->run();
}

}  // namespace

void add_serve(CLI::App& app, int&) {
  auto* command = app.add_subcommand("serve", "Serve the studio to a browser or a headset");
  auto options = std::make_shared<serve::ServeOptions>();
  options->studio = studio_folder();
  options->data_folder = data_folder();
  options->threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  command->add_option("--port", options->port, "0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->add_flag("--lan", options->lan,
                    "Let other devices in the network in, over HTTPS as headsets want it");
  command->add_option("--cert", options->certificate,
                      "PEM file with certificate and key, for HTTPS; --lan makes one of its own");
  command->add_option("--studio", options->studio, "Folder of the built page")
      ->capture_default_str();
  command->add_option("--data", options->data_folder, "Folder for bakes and the certificate")
      ->capture_default_str();
  command->add_option("--name", options->names,
                      "Another name that the server answers to, such as studio.example");
  auto megabytes = std::make_shared<double>(256.0);
  command->add_option("--largest-upload-mb", *megabytes, "Models beyond it are not baked")
      ->check(number_between(0.001, 65536))
      ->capture_default_str();
  command->add_option("--longest-bake-s", options->longest_bake_s, "Then it is given up")
      ->check(number_between(0.001, 1e6))
      ->capture_default_str();
  command->add_option("--most-faces", options->most_faces, "Models beyond it are not baked")
      ->check(CLI::Range(1, 200'000'000))
      ->capture_default_str();
  auto memory =
      std::make_shared<double>(std::max(1024.0, static_cast<double>(half_the_memory() >> 20)));
  command
      ->add_option("--bake-memory-mb", *memory,
                   "A bake that needs more is given up (default: half of the machine's)")
      ->check(number_between(64, 1 << 24));
  options->bake_command = {"/proc/self/exe", "bake-worker"};
  options->note = [](const std::string& sentence) {
    std::fprintf(stderr, "mimicry: %s\n", sentence.c_str());
  };
  command->callback([options, megabytes, memory] {
    options->largest_upload = static_cast<std::size_t>(*megabytes * (1 << 20));
    options->bake_memory = static_cast<std::uint64_t>(*memory * (1 << 20));
    run_serve(*options);
  });
}

}  // namespace mimicry::cli
