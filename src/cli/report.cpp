#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <mimicry/base/error.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "cli/report/bundle.h"
#include "cli/report/figure_files.h"
#include "cli/report/gallery.h"
#include "cli/report/page.h"
#include "files/file.h"
#include "files/names.h"
#include "files/output_lock.h"
#include "lab/measured_rows.h"
#include "lab/report_data.h"

namespace mimicry::cli {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string folder;
  std::string rows = "rows.csv";
  std::string out;
  std::string title;
  lab::SummaryOptions summary;
  GalleryOptions gallery;
};

// What `measure` lists beside its rows; none where there is no such file.
std::vector<lab::RejectedStroke> read_rejected(const std::string& rows) {
  const std::string path = lab::rejected_beside(rows);
  if (!fs::exists(to_path(path))) return {};
  return lab::read_rejected(read_file(path, Accept::regular), file_name(path));
}

// mimicry-worst-1.png.
void write_pictures(const Gallery& gallery, const std::string& folder) {
  std::map<std::string, int> numbers;
  for (const GalleryPicture& picture : gallery.pictures) {
    const std::string kind = lab::file_part(picture.pick.row->method) + "-" +
                             (picture.pick.best ? "best" : "worst") + "-";
    write_file_atomically(join_path(folder, kind + std::to_string(++numbers[kind]) + ".png"),
                          picture.png);
  }
}

void run_report(ReportArguments args) {
  if (page_script().empty())
    throw Error(ErrorKind::unsupported,
                "report: this build has no plots; run scripts/setup and build again");
  if (!fs::is_directory(to_path(args.folder)))
    throw Error(ErrorKind::io, args.folder +
                                   ": is no folder; give the one that has the measured "
                                   "strokes, " +
                                   args.rows);
  const std::string rows_file = join_path(args.folder, args.rows);
  if (!fs::exists(to_path(rows_file)))
    throw Error(ErrorKind::io, args.folder + ": has no " + args.rows +
                                   "; measure strokes with mimicry measure --out " + rows_file +
                                   ", or name the file with --rows");
  const lab::StudyRows rows(lab::read_rows(read_file(rows_file), args.rows, terminal_monitor()),
                            args.rows);
  const std::vector<lab::RejectedStroke> rejected = read_rejected(rows_file);
  const lab::Summary summary = lab::summarise(rows, args.summary);
  if (args.gallery.count > 0 && !rows.has(args.gallery.measure))
    throw Error(ErrorKind::invalid_input,
                "--gallery-by: " + args.rows + " has no column '" + args.gallery.measure + "'");
  if (args.gallery.count > 0)
    lab::add_replay_sources(to_text(to_path(rows_file).parent_path()), args.gallery.sources);
  if (args.gallery.sources.recordings.empty()) args.gallery.sources.recordings = args.folder;
  const Gallery gallery = make_gallery(rows, summary, args.gallery);

  const std::string out = args.out.empty() ? args.folder : args.out;
  const std::string figures = join_path(out, "figures");
  const auto output_lock = OutputLock::of_folder(figures);
  const std::string data = lab::figure_data(summary, method_color);
  write_file_atomically(join_path(figures, "data.json"), data);
  write_pictures(gallery, figures);
  if (args.title.empty())
    args.title =
        "Study " + to_text(fs::absolute(to_path(args.folder)).lexically_normal().filename());
  const std::string page = join_path(out, "report.html");
  write_file_atomically(page, write_page(summary, rejected, gallery, args.gallery, data,
                                         {args.title, args.summary.comparison.bootstrap.level}));
  std::printf("%s\n", page.c_str());
  if (gallery.pictures.empty() && !gallery.problems.empty())
    complain("no pictures of strokes (" + gallery.problems.front() +
             "); --recordings, --shapes and --targets say where they are, --gallery 0 leaves them "
             "out");
  if (draw_figure_files(figures))
    std::printf("%s: the figures as SVG and PNG\n", figures.c_str());
  else
    complain(
        "no SVG and PNG files, for want of the program node (18 or newer); the page draws its "
        "plots "
        "itself and offers them for saving");
}

}  // namespace

void add_report(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "report", std::string("Make a page of tables, plots and pictures of a study's strokes") +
                    (page_script().empty() ? " (this build is without plots)" : ""));
  auto args = std::make_shared<ReportArguments>();
  command->add_option("folder", args->folder, "With the rows of measure or replay")->required();
  command->add_option("--rows", args->rows, "The file of rows in it")->capture_default_str();
  command->add_option("-o,--out", args->out,
                      "Folder for report.html and figures/ (default: the same)");
  command->add_option("--title", args->title, "Of the page");
  command
      ->add_option("-m,--methods", args->summary.methods,
                   "Techniques; each is compared with the first (default: all, spraycan first)")
      ->delimiter(',');
  command->add_flag("--keep-tutorial", args->summary.keep_tutorial,
                    "Count the participants' first shape, torus, too");
  command->add_option("--gallery", args->gallery.count, "Worst and best strokes shown a technique")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  command->add_option("--gallery-by", args->gallery.measure, "The column that says which")
      ->capture_default_str();
  command->add_option("--recordings", args->gallery.sources.recordings,
                      "Folder of the participants' folders or strokes files (default: where replay "
                      "had them from, or the same folder)");
  command->add_option(
      "--shapes", args->gallery.sources.shapes,
      "Folder of the shapes' meshes (default: as in the replay, or built-in shapes)");
  command->add_option("--targets", args->gallery.sources.targets,
                      "The file of target curves, to show them in the pictures (default: as in the "
                      "replay)");
  command
      ->add_option("--resamples", args->summary.comparison.bootstrap.resamples, "Of the intervals")
      ->check(CLI::Range(100, 1000000))
      ->capture_default_str();
  command->add_option("--seed", args->summary.comparison.bootstrap.seed, "Of the intervals")
      ->capture_default_str();
  add_threads_option(*command, args->gallery.threads);
  command->callback([args] { run_report(*args); });
}

}  // namespace mimicry::cli
