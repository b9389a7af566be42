#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>
#include <mimicry/io/study.h>
#include <mimicry/study/targets.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/contact_sheet.h"
#include "cli/options.h"
#include "files/file.h"
#include "files/names.h"
#include "files/output_lock.h"

namespace mimicry::cli {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct TargetsArguments {
  std::string mesh;
  std::string out;
  std::string picture;  // empty: beside `out`
  std::string embedding;
  std::string name;
  std::size_t count = 10;
  std::uint64_t seed = 1;
  double scale = 0.0;
  std::string up = "y";
  TargetSampling sampling;
  std::vector<double> k_g;
  std::vector<double> k_n_deg;
  TargetOptions target;
  bool no_picture = false;
};

void set_range(const std::vector<double>& given, double unit, double& least, double& most) {
  if (given.empty()) return;
  least = unit * given.front();
  most = unit * given.back();
}

void run_targets(const TargetsArguments& args) {
  const auto output_lock = OutputLock::of_file(args.out);
  TargetSampling sampling = args.sampling;
  set_range(args.k_g, 1.0, sampling.least_k_g, sampling.most_k_g);
  set_range(args.k_n_deg, kDegree, sampling.least_k_n_rad, sampling.most_k_n_rad);
  const NamedMesh named = load_mesh(args.mesh, terminal_monitor());
  const Target target = make_target(named, args.target, terminal_monitor());
  const double scale = args.scale > 0.0 ? args.scale : named.metres_per_unit;
  // A technique that needs the bake stands for the splines, which do.
  const TechniqueInfo* needs = &find_technique("mimicry");
  const Canvas canvas =
      make_canvas(target, std::span(&needs, 1), terminal_monitor(), args.embedding);

  SampledTargets sampled;
  {
    ProgressLine line("sampling");
    sampled = sample_targets(canvas.projector, scale, args.count, sampling, Random(args.seed),
                             [&](const Progress& progress) {
                               line.update(static_cast<std::size_t>(100 * progress.fraction), 100);
                               return true;
                             });
  }
  TargetShape shape;
  shape.name = args.name.empty() ? file_stem(named.name) : args.name;
  shape.scale = scale;
  shape.curves = sampled.curves;
  const std::string note = "Target curves on " + named.name + " (" +
                           std::to_string(named.mesh.vertex_count()) + " vertices, " +
                           std::to_string(named.mesh.face_count()) +
                           " faces). face: 0-based, in file order; bary: of the face's three "
                           "corners; keypoints: numbers "
                           "of the curve's points; scale: metres per mesh unit. seed " +
                           std::to_string(args.seed) + ".";
  const std::string text = write_targets({{shape}}, note);
  std::string picture = args.picture;
  if (picture.empty()) picture = to_text(to_path(args.out).replace_extension(".png"));
  std::optional<std::string> sheet;
  if (!args.no_picture)
    sheet = contact_sheet(target, shape.curves, args.up == "z" ? Vec3::UnitZ() : Vec3::UnitY());
  write_file_atomically(args.out, text);
  const SamplingCounts& n = sampled.counts;
  std::printf(
      "%s: %zu curves; refused: %zu that met themselves, %zu that jumped, %zu without room "
      "for their controls\n",
      args.out.c_str(), n.accepted, n.self_crossing, n.jumps, n.no_controls);
  if (args.no_picture) return;
  if (!sheet) return complain("this build makes no pictures: the curves are there, without theirs");
  write_file_atomically(picture, *sheet);
  std::printf("%s\n", picture.c_str());
}

}  // namespace

void add_targets(CLI::App& app, int&) {
  auto* command = app.add_subcommand("targets", "Sample target curves for a study on a mesh");
  auto args = std::make_shared<TargetsArguments>();
  command->add_option("mesh", args->mesh, kMeshHelp)->required();
  command->add_option("-o,--out", args->out, "The file of target curves to write")->required();
  command->add_option("--picture", args->picture, "The contact sheet (PNG); default: beside --out");
  command->add_flag("--no-picture", args->no_picture, "Without the contact sheet");
  command->add_option("--count", args->count, "Curves")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--seed", args->seed, "Of all that is random")->capture_default_str();
  command->add_option("--controls", args->sampling.controls, "Control points of each curve")
      ->check(CLI::Range(4, 100))
      ->capture_default_str();
  command->add_option("--points", args->sampling.points, "Points of each curve")
      ->check(CLI::Range(50, 100000))
      ->capture_default_str();
  command
      ->add_option("--k-g", args->k_g,
                   "Distance between controls in diagonals: one number or LOW,HIGH "
                   "(default 0.05,0.25)")
      ->delimiter(',')
      ->expected(1, 2)
      ->check(number_between(1e-3, 10));
  command
      ->add_option("--k-n", args->k_n_deg,
                   "Angle between their normals in degrees: one number or LOW,HIGH "
                   "(default 30,75)")
      ->delimiter(',')
      ->expected(1, 2)
      ->check(number_between(0, 180));
  command->add_option("--name", args->name, "The shape's name in the file (default: the mesh's)");
  command
      ->add_option("--scale", args->scale,
                   "Metres per mesh unit, for the keypoints (default: the shape's own)")
      ->check(number_between(1e-12, 1e12));
  command->add_option("--embedding", args->embedding,
                      "The mesh's bake (mimicry bake); without it one is made");
  command->add_option("--up", args->up, "The axis that points up in the mesh file: y or z")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
  add_target_options(*command, args->target);
  command->callback([args] { run_targets(*args); });
}

}  // namespace mimicry::cli
