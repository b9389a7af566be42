#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>

#include "assets/bakes.h"
#include "assets/work.h"
#include "bake/projection_quality.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "files/names.h"
#include "io/csv.h"

namespace mimicry::cli {
namespace {

using Json = nlohmann::ordered_json;

// Arora and Singh 2021, table of appendix A. Vertices, faces, tetrahedra as printed there; a fail
// percentage of 0.01 stands for "below 0.01".
struct PaperRow {
  const char* name;
  const char *vertices, *faces, *shell_vertices, *tetrahedra;
  double sliver_percent, fail_percent;
};
constexpr PaperRow kPaper[] = {
    {"trebol", "1.2K", "2.3K", "7.9K", "38K", 6.89, 0.00},
    {"cube", "1.5K", "3.0K", "5.7K", "26K", 17.44, 0.01},
    {"torus", "1.7K", "3.5K", "11K", "58K", 0.41, 0.00},
    {"spiderman", "3.3K", "6.6K", "15K", "83K", 2.01, 0.02},
    {"hand", "4.2K", "8.5K", "19K", "114K", 0.49, 0.39},
    {"fertility", "4.5K", "9.0K", "21K", "124K", 0.61, 0.29},
    {"fandisk", "6.5K", "13K", "23K", "133K", 4.75, 0.96},
    {"bunny", "7.1K", "14K", "32K", "183K", 4.17, 0.08},
    {"horse", "7.7K", "15K", "34K", "198K", 0.41, 0.35},
    {"la-madeleine", "20K", "40K", "68K", "421K", 0.83, 0.24},
    {"beast", "30K", "61K", "132K", "837K", 0.57, 0.01},
    {"armadillo", "50K", "100K", "229K", "1.4M", 0.63, 0.01},
    {"noisy-cube-5", "1.5K", "3.0K", "29K-33K", "139K-167K", 35.8, 0.01},
    {"noisy-cube-10", "1.5K", "3.0K", "29K-33K", "139K-167K", 30.1, 0.05},
    {"noisy-cube-15", "1.5K", "3.0K", "29K-33K", "139K-167K", 21.1, 0.93},
    {"noisy-cube-20", "1.5K", "3.0K", "29K-33K", "139K-167K", 11.0, 3.73},
};

struct QualityArguments {
  std::vector<std::string> inputs;
  BakeSettings bake;
  bool csv = false, json = false;
  TargetOptions target;
};

struct QualityRow {
  std::string name;
  bool was_kept = false;
  const PaperRow* paper = nullptr;
  Index vertices = 0, faces = 0, shell_vertices = 0;
  std::size_t tetrahedra = 0;
  BakeQuality bake;
  ProjectionQuality projection;

  bool knows_stress() const { return bake.samples > 0; }
};

// The paper's row of a file's name without folder and ending; built-in shapes are others'
// namesakes.
const PaperRow* paper_row(const std::string& spec) {
  if (spec.starts_with("shape:")) return nullptr;
  const std::string stem = file_stem(spec);
  for (const PaperRow& row : kPaper)
    if (row.name == stem) return &row;
  return nullptr;
}

QualityRow measure(const std::string& spec, const QualityArguments& args, Executor& executor) {
  QualityRow row;
  row.paper = paper_row(spec);
  Embedding e;
  if (is_embedding_file(spec)) {
    row.name = file_name(spec);
    e = load_embedding(spec);
  } else {
    const NamedMesh named = load_mesh(spec, terminal_monitor());
    row.name = spec.starts_with("shape:") ? spec : named.name;
    const Target target = make_target(named, args.target, terminal_monitor());
    Baked baked = bake_mesh(target.mesh(), args.bake, terminal_monitor());
    row.was_kept = baked.was_kept;
    e = std::move(baked.embedding);
  }
  row.vertices = e.mesh_vertex_count;
  row.faces = e.face_count();
  row.shell_vertices = e.vertex_count();
  row.tetrahedra = e.tets.size();
  row.bake = e.quality;
  const SmoothProjector projector = make_projector(std::move(e), row.name);
  ProgressLine line("measuring " + row.name);
  row.projection = projection_quality(projector, executor, [&](const Progress& now) {
    line.update(static_cast<std::size_t>(100 * now.fraction), 100);
    return true;
  });
  return row;
}

std::string paper_fail(const PaperRow& row) {
  return row.fail_percent == 0.01 ? "<0.01" : fixed(row.fail_percent, 2);
}

std::string fail_text(double percent) {
  return percent > 0.0 && percent < 0.01 ? "<0.01" : fixed(percent, 2);
}

void print_text(const std::vector<QualityRow>& rows) {
  std::vector<std::vector<std::string>> cells;
  bool any_lattice = false, any_cap = false;
  for (const QualityRow& row : rows) {
    const PaperRow* paper = row.paper;
    char error[32];
    std::snprintf(error, sizeof error, "%.1e", row.projection.surface_error);
    any_lattice = any_lattice || row.bake.is_lattice;
    any_cap = any_cap || row.bake.hit_a_cap;
    cells.push_back(
        {row.name + (row.bake.is_lattice ? " [1]" : "") + (row.bake.hit_a_cap ? " [2]" : ""),
         std::to_string(row.vertices) + ", " + std::to_string(row.faces),
         paper ? paper->vertices + std::string(", ") + paper->faces : "-",
         std::to_string(row.shell_vertices) + ", " + std::to_string(row.tetrahedra),
         paper ? paper->shell_vertices + std::string(", ") + paper->tetrahedra : "-",
         fixed(row.bake.sliver_percent, 2), paper ? fixed(paper->sliver_percent, 2) : "-",
         fail_text(row.projection.fail_percent), paper ? paper_fail(*paper) : "-",
         fail_text(row.projection.no_solution_percent),
         row.knows_stress() ? fixed(row.bake.stress, 4) : "-", error});
  }
  print_table({"mesh", "|M| V, F", "paper", "|T| V, tets", "paper", "slivers %", "paper", "fail %",
               "paper", "no solution %", "stress", "error on M"},
              cells);
  if (any_lattice) std::printf("[1] a lattice: the mesh does not stand in its tetrahedra\n");
  if (any_cap) std::printf("[2] a limit of the refinement or of an iteration was hit\n");
}

void print_csv(const std::vector<QualityRow>& rows) {
  const std::vector<std::string> columns = {"mesh",
                                            "vertices",
                                            "faces",
                                            "shell_vertices",
                                            "tetrahedra",
                                            "sliver_percent",
                                            "fail_percent",
                                            "no_solution_percent",
                                            "stress",
                                            "surface_error",
                                            "lattice",
                                            "hit_a_cap",
                                            "paper_sliver_percent",
                                            "paper_fail_percent"};
  std::string out = csv_heading(columns);
  const auto flag = [](bool x) { return Cell(std::int64_t{x}); };
  for (const QualityRow& row : rows) {
    const std::vector<Cell> cells = {row.name,
                                     std::int64_t{row.vertices},
                                     std::int64_t{row.faces},
                                     std::int64_t{row.shell_vertices},
                                     static_cast<std::int64_t>(row.tetrahedra),
                                     row.bake.sliver_percent,
                                     row.projection.fail_percent,
                                     row.projection.no_solution_percent,
                                     row.knows_stress() ? Cell(row.bake.stress) : Cell(),
                                     row.projection.surface_error,
                                     flag(row.bake.is_lattice),
                                     flag(row.bake.hit_a_cap),
                                     row.paper ? Cell(row.paper->sliver_percent) : Cell(),
                                     row.paper ? Cell(row.paper->fail_percent) : Cell()};
    out += csv_line(cells);
  }
  std::fputs(out.c_str(), stdout);
}

Json row_json(const QualityRow& row) {
  const ProjectionQuality& p = row.projection;
  const BakeQuality& b = row.bake;
  Json paper;
  if (row.paper)
    paper = {{"vertices", row.paper->vertices},
             {"faces", row.paper->faces},
             {"shell_vertices", row.paper->shell_vertices},
             {"tetrahedra", row.paper->tetrahedra},
             {"sliver_percent", row.paper->sliver_percent},
             {"fail_percent", row.paper->fail_percent}};
  return {{"mesh", row.name},
          {"from_cache", row.was_kept},
          {"vertices", row.vertices},
          {"faces", row.faces},
          {"shell_vertices", row.shell_vertices},
          {"tetrahedra", row.tetrahedra},
          {"sliver_percent", b.sliver_percent},
          {"fail_percent", p.fail_percent},
          {"no_solution_percent", p.no_solution_percent},
          {"outside_percent", p.outside_percent},
          {"queries", p.queries},
          {"beyond_fail_percent", p.beyond_fail_percent},
          {"beyond_queries", p.beyond_queries},
          {"stress", row.knows_stress() ? Json(b.stress) : Json()},
          {"distortion", row.knows_stress() ? Json(b.distortion) : Json()},
          {"surface_error", p.surface_error},
          {"surface_queries", p.surface_queries},
          {"surface_misses", p.surface_misses},
          {"lattice", b.is_lattice},
          {"hit_a_cap", b.hit_a_cap},
          {"samples", b.samples},
          {"added_vertices", b.added_vertices},
          {"missing_edges", b.missing_edges},
          {"pierced_faces", b.pierced_faces},
          {"crossing_faces", b.crossing_faces},
          {"paper", paper}};
}

// What cannot be measured is named and left out; where that is all, it is an error.
std::vector<QualityRow> measure_all(const QualityArguments& args) {
  Executor executor(thread_count(args.bake.threads));
  std::vector<QualityRow> rows;
  std::vector<Error> errors;
  for (const std::string& spec : args.inputs) {
    try {
      rows.push_back(measure(spec, args, executor));
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::cancelled) throw;
      errors.push_back(error);
    }
  }
  if (rows.empty() && !errors.empty()) throw Error(errors.front());
  for (const Error& error : errors) complain("left out: " + std::string(error.what()));
  return rows;
}

void run_quality(const QualityArguments& args, int& status) {
  const std::vector<QualityRow> rows = measure_all(args);
  if (rows.size() < args.inputs.size()) status = kPartly;
  if (args.json) {
    Json list = Json::array();
    for (const QualityRow& row : rows) list.push_back(row_json(row));
    std::printf("%s\n", json_text(list).c_str());
  } else if (args.csv) {
    print_csv(rows);
  } else {
    print_text(rows);
  }
}

}  // namespace

void add_quality(CLI::App& app, int& status) {
  auto* command = app.add_subcommand(
      "quality", "How well bakes serve: the paper's table, beside the paper's figures");
  auto args = std::make_shared<QualityArguments>();
  command
      ->add_option("inputs", args->inputs,
                   ".mimicry files, or meshes, which are baked: " + std::string(kMeshHelp))
      ->required();
  add_threads_option(*command, args->bake.threads);
  add_cache_option(*command, args->bake);
  add_target_options(*command, args->target);
  auto* csv = command->add_flag("--csv", args->csv, "As CSV");
  command->add_flag("--json", args->json, "For programs")->excludes(csv);
  command->callback([args, &status] { run_quality(*args, status); });
}

}  // namespace mimicry::cli
