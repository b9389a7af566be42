#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <mimicry/io/strokes.h>

#include "assets/canvas.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "files/file.h"
#include "files/output_lock.h"
#include "lab/simulated_strokes.h"

namespace mimicry::cli {
namespace {

struct SimulateArguments {
  lab::SimulatedStrokesOptions strokes;
  std::vector<std::string> closed_loop;
  std::string up = "y";
  std::string out;
};

void run_simulate(SimulateArguments args) {
  const auto output_lock = OutputLock::of_file(args.out);
  args.strokes.z_up = args.up == "z";
  if (!args.closed_loop.empty()) args.strokes.closed_loop = chosen_techniques(args.closed_loop);
  const std::vector<Stroke> strokes = lab::simulated_strokes(args.strokes, terminal_monitor());
  write_file_atomically(args.out, write_strokes(strokes));
  std::size_t frames = 0;
  for (const auto& stroke : strokes) frames += stroke.frames.size();
  std::printf("%s: %zu strokes, %zu frames\n", args.out.c_str(), strokes.size(), frames);
}

}  // namespace

void add_simulate(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "simulate", "Make mid-air strokes as a person would who means given curves");
  auto args = std::make_shared<SimulateArguments>();
  command->add_option("mesh", args->strokes.mesh, kMeshHelp)->required();
  command->add_option("--shape", args->strokes.shape,
                      "Whose intended curves: of a built-in shape, or a name in --targets");
  command->add_option("--targets", args->strokes.targets, "A file of target curves on the mesh");
  command->add_option("-o,--out", args->out, "The mimicry-strokes file to write")->required();
  command->add_option("--curves", args->strokes.curves, "Only these intended curves")
      ->delimiter(',');
  command->add_option("--count", args->strokes.count, "Strokes for each curve")
      ->check(CLI::Range(1, 999))
      ->capture_default_str();
  command->add_option("--seed", args->strokes.seed, "Of all that is random")->capture_default_str();
  command->add_option("--rate", args->strokes.rate_hz, "Frames a second")
      ->check(number_between(20, 1000))
      ->capture_default_str();
  command
      ->add_option("--distance", args->strokes.distance_m,
                   "Mean distance from hand to surface, metres")
      ->capture_default_str();
  command
      ->add_option("--closed-loop", args->closed_loop,
                   "The person sees the ink of these techniques, or all, and corrects the visible "
                   "error; strokes for each")
      ->delimiter(',');
  command->add_option("--up", args->up, "The axis that points up in the mesh file: y or z")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
  add_target_options(*command, args->strokes.target);
  command
      ->add_option("--scale", args->strokes.scale,
                   "Metres per mesh unit (default: the shape's own)")
      ->check(number_between(1e-12, 1e12));
  command->callback([args] { run_simulate(*args); });
}

}  // namespace mimicry::cli
