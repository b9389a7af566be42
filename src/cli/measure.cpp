#include <cstdio>
#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "files/file.h"
#include "files/output_lock.h"
#include "lab/recorded_study.h"

namespace mimicry::cli {
namespace {

struct MeasureArguments {
  lab::RecordedStudyOptions study;
  std::string out;
};

void run_measure(const MeasureArguments& args, int& status) {
  const auto output_lock = OutputLock::of_file(args.out);
  const lab::RecordedStudy study = lab::measure_recordings(args.study, terminal_monitor());
  for (const lab::RejectedStroke& rejected : study.rejected)
    complain("left out: " + rejected.text());
  std::string rows = lab::rows_heading();
  for (const lab::MeasuredRow& row : study.rows) rows += lab::csv_row(row);
  const std::string rejected_file = lab::rejected_beside(args.out);
  write_file_atomically(args.out, rows);
  write_file_atomically(rejected_file, lab::write_rejected(study.rejected));
  std::printf("%s: %zu strokes, %zu of them short, noisy or inverted\n", args.out.c_str(),
              study.rows.size(), study.failed_filters);
  if (study.rejected.empty()) return;
  std::printf("%s: what was left out, %zu entries\n", rejected_file.c_str(), study.rejected.size());
  status = study.rows.empty() ? kBadInput : kPartly;
}

}  // namespace

void add_measure(CLI::App& app, int& status) {
  auto* command = app.add_subcommand("measure", "Measure the recorded curves of a study");
  auto args = std::make_shared<MeasureArguments>();
  command->add_option("participants", args->study.participants, "Folders, one for each participant")
      ->required();
  command
      ->add_option("--shapes", args->study.shapes, "Folder of the shapes' meshes (torus.obj ...)")
      ->required();
  command->add_option("--targets", args->study.targets, "The file of target curves")->required();
  command->add_option("-o,--out", args->out, "The CSV file to write")->required();
  command
      ->add_flag_callback(
          "--all", [] { complain("--all is no longer needed: all columns are always written"); })
      ->group("");
  command->add_flag("!--per-piece", args->study.join_pieces,
                    "K_E, K_g and F_g are sums over the pieces; what joins them does not count");
  add_threads_option(*command, args->study.threads);
  command->callback([args, &status] { run_measure(*args, status); });
}

}  // namespace mimicry::cli
