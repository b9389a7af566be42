#include <cstdio>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include <mimicry/technique/technique.h>

#include "cli/commands.h"
#include "cli/console.h"

namespace mimicry::cli {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const TechniqueInfo& info) {
  Json options = Json::array();
  for (const OptionInfo& o : info.options) {
    const auto values = option_value(info, o, {});
    options.push_back({{"name", o.name},
                       {"kind", kind_name(o.kind)},
                       {"unit", o.unit},
                       {"description", o.description},
                       {"default", std::vector<double>(values.begin(), values.end())},
                       {"lowest", o.lowest},
                       {"highest", o.highest}});
    if (!o.choices.empty()) options.back()["choices"] = o.choices;
  }
  char color[8];
  std::snprintf(color, sizeof color, "#%06x", static_cast<unsigned>(info.color));
  return {{"name", info.name},
          {"title", info.title},
          {"sentence", info.sentence},
          {"description", info.description},
          {"paper", info.source},
          {"color", color},
          {"steering", info.steering == Steering::aims ? "aims" : "moves"},
          {"anchored", info.anchored},
          {"needs_bake", info.needs_bake},
          {"options", options}};
}

void print_text() {
  std::vector<std::vector<std::string>> rows;
  for (const TechniqueInfo& info : techniques()) {
    std::string options;
    for (const OptionInfo& o : info.options)
      options += (options.empty() ? "" : " ") + std::string(o.name);
    rows.push_back({std::string(info.name), info.needs_bake ? "yes" : "no",
                    options.empty() ? "-" : options, std::string(info.description)});
  }
  print_table({"technique", "bake", "options", ""}, rows);
}

}  // namespace

void add_techniques(CLI::App& app, int&) {
  auto* command = app.add_subcommand("techniques", "List the techniques and their options");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "For programs");
  command->callback([json] {
    if (!*json) return print_text();
    Json list = Json::array();
    for (const TechniqueInfo& info : techniques()) list.push_back(to_json(info));
    std::printf("%s\n", json_text(list).c_str());
  });
}

}  // namespace mimicry::cli
