#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/study/comparison.h>

#include "cli/commands.h"
#include "cli/comparison_text.h"
#include "cli/console.h"
#include "cli/options.h"
#include "files/file.h"
#include "files/names.h"
#include "lab/measured_rows.h"
#include "lab/pairing.h"
#include "lab/paper_agreement.h"
#include "lab/report_data.h"

namespace mimicry::cli {
namespace {

struct CompareArguments {
  std::string rows;
  std::vector<std::string> methods;
  lab::PairingOptions pairing;
  ComparisonOptions comparison;
  bool pratt = false;
  bool percentile = false;
  bool json = false;
};

void print_group(const lab::PairedGroup& group, const std::vector<Comparison>& comparisons,
                 const CompareArguments& args) {
  std::printf("%s: %zu pairs", group.name.c_str(), group.pairs);
  if (group.failed > 0) std::printf(", %zu left out (rejected or filtered)", group.failed);
  if (group.unpaired > 0) std::printf(", %zu rows without a partner", group.unpaired);
  const int participants = comparisons.empty() ? 0 : comparisons.front().participants;
  if (participants > 1) std::printf(", %d participants", participants);
  std::printf("\n");
  const std::string& a = args.methods[0];
  const std::string& b = args.methods[1];
  const bool has_paper = lab::count_agreement(a, b, group, comparisons).rows > 0;
  std::vector<std::vector<std::string>> rows;
  for (const Comparison& c : comparisons) {
    rows.push_back({c.name, significant(c.a.mean), significant(c.a.standard_deviation),
                    significant(c.b.mean), significant(c.b.standard_deviation), fixed(c.test.z, 2),
                    probability(c.test.p()), probability(c.p_holm), participants_probability(c),
                    fixed(c.test.effect_r, 2), fixed(c.test.rank_biserial, 2),
                    significant(c.difference.low), significant(c.difference.high)});
    if (!has_paper) continue;
    const auto* paper = lab::published_figure(a, b, group.name, c.name);
    const auto agrees = paper != nullptr ? agreement(c, *paper) : Agreement();
    const auto mark = [&](bool yes) { return paper == nullptr ? "" : yes ? "yes" : "no"; };
    rows.back().emplace_back(mark(agrees.means()));
    rows.back().emplace_back(mark(paper != nullptr && agrees.difference(*paper)));
  }
  const std::string level = fixed(100 * args.comparison.bootstrap.level, 0) + " %";
  std::vector<std::string> heading = {"",
                                      a,
                                      "sd",
                                      b,
                                      "sd",
                                      "z",
                                      "p",
                                      "Holm p",
                                      "p by participant",
                                      "r",
                                      "rank-biserial",
                                      level + " from",
                                      "to"};
  if (has_paper) {
    heading.emplace_back("paper: means");
    heading.emplace_back("difference");
  }
  print_table(heading, rows);
  std::printf("\n");
}

void run_compare(CompareArguments args) {
  if (args.methods.size() != 2 || args.methods[0] == args.methods[1])
    throw Error(ErrorKind::invalid_input, "--methods: give two, as in --methods spraycan,mimicry");
  const std::string name = file_name(args.rows);
  const CsvTable table = lab::read_rows(read_file(args.rows), name, terminal_monitor());
  args.pairing.method_a = args.methods[0];
  args.pairing.method_b = args.methods[1];
  if (args.pratt) args.comparison.test.zeros = ZeroDifferences::ranked;
  if (args.percentile) args.comparison.bootstrap.kind = BootstrapKind::percentile;
  const std::string &a = args.methods[0], &b = args.methods[1];
  const std::vector<lab::PairedGroup> groups = lab::pair_rows(table, args.pairing, name);
  std::vector<std::vector<Comparison>> comparisons;
  lab::AgreementCount agreement;
  for (const lab::PairedGroup& group : groups) {
    comparisons.push_back(compare(group.measures, args.comparison));
    agreement += lab::count_agreement(a, b, group, comparisons.back());
    if (!args.json) print_group(group, comparisons.back(), args);
  }
  if (args.json)
    std::printf("%s\n", lab::comparison_json(a, b, groups, comparisons).c_str());
  else if (agreement.rows > 0)
    std::printf("Beside the paper's table: %s.\n", agreement.text().c_str());
}

}  // namespace

void add_compare(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "compare", "Compare two methods over measured strokes: means, signed-rank tests, intervals");
  auto args = std::make_shared<CompareArguments>();
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
  command->callback([args] { run_compare(*args); });
}

}  // namespace mimicry::cli
