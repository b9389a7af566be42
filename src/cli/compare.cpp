#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <mimicry/base/error.h>
#include <mimicry/files/file.h>
#include <mimicry/io/csv.h>
#include <mimicry/study/comparison.h>

#include "cli/commands.h"
#include "cli/comparison_text.h"
#include "cli/console.h"
#include "cli/paired_rows.h"

namespace mimicry::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::string rows;
  std::vector<std::string> methods;
  PairingOptions pairing;
  study::ComparisonOptions comparison;
  bool pratt = false;
  bool percentile = false;
  bool json = false;
};

void print_group(const PairedGroup& group, const std::vector<study::Comparison>& comparisons,
                 const Arguments& args) {
  std::printf("%s: %zu pairs", group.name.c_str(), group.pairs);
  if (group.failed > 0) std::printf(", %zu left out (rejected or filtered)", group.failed);
  if (group.unpaired > 0) std::printf(", %zu rows without a partner", group.unpaired);
  std::printf("\n");
  std::vector<std::vector<std::string>> rows;
  for (const study::Comparison& c : comparisons)
    rows.push_back({c.name, significant(c.a.mean), significant(c.a.standard_deviation),
                    significant(c.b.mean), significant(c.b.standard_deviation), fixed(c.test.z, 2),
                    probability(c.test.p()), probability(c.p_holm), fixed(c.test.effect_r, 2),
                    fixed(c.test.rank_biserial, 2), significant(c.difference.low),
                    significant(c.difference.high)});
  const std::string level = fixed(100 * args.comparison.bootstrap.level, 0) + " %";
  print_table({"", args.methods[0], "sd", args.methods[1], "sd", "z", "p", "Holm p", "r",
               "rank-biserial", level + " from", "to"},
              rows);
  std::printf("\n");
}

void run(Arguments args) {
  if (args.methods.size() != 2 || args.methods[0] == args.methods[1])
    throw Error(ErrorKind::invalid_input, "--methods: give two, as in --methods spraycan,mimicry");
  const std::string name = std::filesystem::path(args.rows).filename().string();
  const io::CsvTable table = io::read_csv(files::read_file(args.rows), name);
  args.pairing.method_a = args.methods[0];
  args.pairing.method_b = args.methods[1];
  if (args.pratt) args.comparison.test.zeros = study::ZeroDifferences::ranked;
  if (args.percentile) args.comparison.bootstrap.kind = study::BootstrapKind::percentile;
  Json groups = Json::array();
  for (const PairedGroup& group : pair_rows(table, args.pairing, name)) {
    const auto comparisons = study::compare(group.measures, args.comparison);
    if (args.json)
      groups.push_back(to_json(group, comparisons));
    else
      print_group(group, comparisons, args);
  }
  if (args.json)
    std::printf(
        "%s\n",
        Json{{"a", args.methods[0]}, {"b", args.methods[1]}, {"groups", groups}}.dump(2).c_str());
}

}  // namespace

void add_compare(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "compare", "Compare two methods over measured strokes: means, signed-rank tests, intervals");
  auto args = std::make_shared<Arguments>();
  command->add_option("rows", args->rows, "A CSV file of measure or replay")->required();
  command->add_option("-m,--methods", args->methods, "Two methods: z > 0 where the first is larger")
      ->delimiter(',')
      ->required();
  command
      ->add_option("--measures", args->pairing.measures,
                   "Columns to compare (default: the paper's ten)")
      ->delimiter(',');
  command->add_option("--by", args->pairing.by, "Compare for each value of this column too")
      ->capture_default_str();
  command->add_option("--without", args->pairing.without,
                      "Leave out rows, COLUMN=VALUE (as in shape=torus)");
  command->add_flag("--keep-failed", args->pairing.keep_failed,
                    "Keep strokes that failed a filter");
  command->add_flag("--continuity", args->comparison.test.continuity_correction,
                    "Correct z for continuity, as R does (the paper does not)");
  command->add_flag("--pratt", args->pratt, "Rank zero differences (Pratt) instead of dropping");
  command->add_flag("--percentile", args->percentile, "Percentile intervals instead of BCa");
  command->add_option("--resamples", args->comparison.bootstrap.resamples, "Of the bootstrap")
      ->check(CLI::Range(100, 1000000))
      ->capture_default_str();
  command->add_option("--level", args->comparison.bootstrap.level, "Of the intervals")
      ->check(number_between(0.5, 0.9999))
      ->capture_default_str();
  command->add_option("--seed", args->comparison.bootstrap.seed, "Of the bootstrap")
      ->capture_default_str();
  command->add_flag("--json", args->json, "For programs");
  command->callback([args] { run(*args); });
}

}  // namespace mimicry::cli
