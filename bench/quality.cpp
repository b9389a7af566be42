// quality [--small] [--threads N] OUT.csv: draws a fixed set of strokes with every technique and
// writes the table of docs/quality.md as CSV; --small is the part that the regression test stores.
// It prints the table's condensed form in Markdown.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include <mimicry/io/study.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/spatial/target.h>
#include <mimicry/study/targets.h>

#include "files/file.h"
#include "quality_table.h"
#include "study_mesh.h"

namespace mimicry::bench {
namespace {

std::vector<QualityShape> all_shapes() {
  std::vector<QualityShape> shapes;
  for (const char* name : {"torus", "rounded-cube", "hand", "noisy-cube", "double-torus"}) {
    QualityShape shape{
        std::string("built-in ") + name, make_shape(name), find_shape(name)->metres_per_unit, {}};
    shape.curves = intended_curves(name, Target(shape.mesh));
    shapes.push_back(std::move(shape));
  }
  for (const char* name : {"cube", "trebol", "bunny", "hand", "fertility"}) {
    auto mesh = study_mesh(name);
    if (!mesh) continue;
    const TargetSet set =
        read_targets(read_file(MIMICRY_STUDY_DATA "/targets.json"), "targets.json");
    const TargetShape& target = *set.find(name);
    QualityShape shape{std::string("study ") + name, std::move(*mesh), target.scale, {}};
    for (std::size_t c = 0; c < 3; ++c)
      shape.curves.push_back({std::to_string(c), false, target.curves[c].points});
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

const QualityRow& find(const std::map<std::string, QualityRow>& rows, const QualityRow& wanted) {
  return rows.at(wanted.key());
}

void print_markdown(const std::vector<QualityRow>& rows) {
  std::map<std::string, QualityRow> by_key;
  std::vector<std::string> techniques;
  for (const QualityRow& row : rows) {
    by_key[row.key()] = row;
    if (techniques.empty() || techniques.back() != row.technique)
      techniques.push_back(row.technique);
  }
  for (const char* loop : {"open", "closed"}) {
    std::printf(
        "\n| %s loop | D_ep mm: 30 Hz | 90 Hz | 240 Hz | high noise | D_sym mm | K_g rad/m: usual "
        "| "
        "high noise | jumps %% | length ratio | failed %% |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        loop);
    for (const std::string& technique : techniques) {
      const auto row = [&](const char* noise, double rate) -> const QualityRow& {
        return find(by_key, {technique, noise, loop, rate, {}, {}, {}, {}, {}, {}});
      };
      const QualityRow& usual = row("usual", 90);
      const QualityRow& high = row("high", 90);
      std::printf(
          "| %s | %.1f | %.1f ± %.1f | %.1f | %.1f | %.1f | %.0f ± %.0f | %.0f | %.2f | %.3f | "
          "%.1f |\n",
          technique.c_str(), row("usual", 30).d_ep_mm.mean, usual.d_ep_mm.mean,
          usual.d_ep_mm.spread, row("usual", 240).d_ep_mm.mean, high.d_ep_mm.mean,
          usual.d_sym_mm.mean, usual.k_g.mean, usual.k_g.spread, high.k_g.mean, usual.jumps.mean,
          usual.length_ratio.mean, usual.failed.mean);
    }
  }
}

}  // namespace
}  // namespace mimicry::bench

int main(int argc, char** argv) {
  using namespace mimicry;
  bool small = false;
  int threads = 2;
  std::string out;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--small")
      small = true;
    else if (word == "--threads" && i + 1 < argc)
      threads = std::atoi(argv[++i]);
    else
      out = word;
  }
  if (out.empty() || out.front() == '-') {
    std::fprintf(stderr, "quality [--small] [--threads N] OUT.csv\n");
    return 2;
  }
  Executor executor(threads);
  const auto rows = small ? bench::quality_table(bench::small_quality_shapes(),
                                                 bench::small_quality_plan(), executor)
                          : bench::quality_table(bench::all_shapes(), {}, executor);
  write_file_atomically(out, bench::write_quality(rows));
  bench::print_markdown(rows);
}
