#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <mimicry/assets/canvas.h>
#include <mimicry/assets/files.h>
#include <mimicry/study/targets.h>

#include "assets/target_curves.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "files/names.h"

namespace mimicry::cli {
namespace {

struct KeypointsArguments {
  std::string mesh;
  std::string targets;
  std::string shape;
  double scale = 0.0;
  TargetOptions target;
  bool json = false;
};

void run_keypoints(const KeypointsArguments& args) {
  const NamedMesh named = load_mesh(args.mesh, terminal_monitor());
  const Target target = make_target(named, args.target, terminal_monitor());
  const TargetSet set = load_target_curves(args.targets);
  const std::string wanted = args.shape.empty() ? file_stem(named.name) : args.shape;
  const TargetShape& shape = find_target_shape(set, wanted, args.targets);
  require_fits(shape, named.mesh);
  const double scale = args.scale > 0.0 ? args.scale : shape.scale;

  nlohmann::ordered_json curves = nlohmann::ordered_json::array();
  std::vector<std::vector<std::string>> rows;
  for (const TargetCurve& curve : shape.curves) {
    const std::vector<Index> found = keypoints(target.surface(), curve.points, scale);
    curves.push_back({{"keypoints", found}});
    std::string list;
    for (const Index k : found) list += (list.empty() ? "" : " ") + std::to_string(k);
    rows.push_back({std::to_string(rows.size()), std::to_string(curve.points.size()),
                    std::to_string(found.size()), list});
  }
  if (args.json)
    std::printf("%s\n", json_text({{"curves", curves}}, -1).c_str());
  else
    print_table({"curve", "points", "keypoints", "numbers of points"}, rows);
}

}  // namespace

void add_keypoints(CLI::App& app, int&) {
  auto* command =
      app.add_subcommand("keypoints", "The keypoints of target curves: ends, bends, long sections");
  auto args = std::make_shared<KeypointsArguments>();
  command->add_option("mesh", args->mesh, kMeshHelp)->required();
  command->add_option("--targets", args->targets, "A file of target curves on the mesh")
      ->required();
  command->add_option("--shape", args->shape,
                      "The mesh's name in --targets (default: the file's name)");
  command->add_option("--scale", args->scale, "Metres per mesh unit (default: that in --targets)")
      ->check(number_between(1e-12, 1e12));
  add_target_options(*command, args->target);
  command->add_flag("--json", args->json, "For programs");
  command->callback([args] { run_keypoints(*args); });
}

}  // namespace mimicry::cli
