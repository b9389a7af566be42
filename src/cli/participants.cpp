#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "lab/simulated_study.h"

namespace mimicry::cli {
namespace {

void run_participants(const lab::SimulatedStudyOptions& options) {
  const std::size_t strokes = lab::simulate_study(options, terminal_monitor());
  std::printf("%s: %d participants, %zu strokes\n", options.out.c_str(),
              static_cast<int>(options.count), strokes);
}

}  // namespace

void add_participants(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "participants", "Let simulated participants do the whole study; writes their recordings");
  auto options = std::make_shared<lab::SimulatedStudyOptions>();
  add_study_shape_options(*command, options->shapes);
  command->add_option("-t,--techniques", options->techniques, "The study's methods, one or more")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("-o,--out", options->out, "Folder; a folder for each participant comes there")
      ->required();
  command->add_option("--count", options->count, "Participants")
      ->check(CLI::Range(1, 9999))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of all that is random")->capture_default_str();
  command->add_option("--rate", options->rate_hz, "Frames a second")
      ->check(number_between(20, 1000))
      ->capture_default_str();
  add_threads_option(*command, options->threads);
  command->callback([options] { run_participants(*options); });
}

}  // namespace mimicry::cli
