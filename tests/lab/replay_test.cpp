#include "lab/replay.h"

#include <atomic>
#include <filesystem>
#include <iterator>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>
#include <mimicry/io/strokes.h>
#include <mimicry/io/study.h>

#include "files/file.h"
#include "lab/drawn_strokes.h"
#include "lab/measured_rows.h"
#include "lab/recorded_study.h"
#include "lab/replayer.h"
#include "lab/simulated_strokes.h"
#include "lab/simulated_study.h"
#include "support/environment.h"
#include "support/folder.h"

namespace mimicry::lab {
namespace {

constexpr const char* kMesh = "shape:torus:24";

std::vector<const TechniqueInfo*> techniques() {
  return {&find_technique("spraycan"), &find_technique("anchored-closest")};
}

std::vector<Stroke> drawn_strokes(int count) {
  SimulatedStrokesOptions options;
  options.mesh = kMesh;
  options.rate_hz = 30;
  options.count = count;
  return simulated_strokes(options);
}

std::string write_strokes(const test::TestFolder& folder, int count) {
  write_file_atomically(folder.path("s.json"), write_strokes(drawn_strokes(count)));
  return folder.path("s.json");
}

ReplayOptions options_of(const test::TestFolder& folder, const std::string& out) {
  ReplayOptions options;
  options.strokes = {folder.path("s.json")};
  options.techniques = techniques();
  options.mesh = kMesh;
  options.out = folder.path(out);
  options.threads = 2;
  return options;
}

StudyRows rows_of_file(const std::string& file) {
  return StudyRows(read_rows(read_file(file), "rows.csv"), "rows.csv");
}

TEST(Replay, ARunThatWasCancelledGoesOnAndGivesTheSameBytes) {
  const test::TestFolder folder;
  write_strokes(folder, 3);
  const ReplayResult whole = replay_strokes(options_of(folder, "whole"));
  EXPECT_EQ(whole.rejected, 0u);
  EXPECT_EQ(whole.rows % 6, 0u);
  ASSERT_GE(whole.rows, 18u);

  std::atomic<int> asked = 0;
  Monitor monitor;
  monitor.cancelled = [&] { return ++asked > 4; };
  std::string note;
  monitor.note = [&](const std::string& sentence) { note = sentence; };
  try {
    replay_strokes(options_of(folder, "cut"), monitor);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::cancelled);
  }
  monitor.cancelled = nullptr;
  const ReplayResult again = replay_strokes(options_of(folder, "cut"), monitor);
  EXPECT_NE(note.find("rows are there already"), std::string::npos) << note;
  EXPECT_EQ(again.rows, whole.rows);
  for (const char* name : {"rows.csv", "rows.jsonl"})
    EXPECT_EQ(read_file(folder.path(std::string("cut/") + name)),
              read_file(folder.path(std::string("whole/") + name)));
  ReplayOptions other = options_of(folder, "cut");
  other.misses = MissPolicy::split;
  EXPECT_THROW(replay_strokes(other), Error);
}

TEST(Replay, StrokesOfRowsAreFoundAndDrawnAgain) {
  const test::TestFolder folder;
  write_strokes(folder, 1);
  const ReplayResult result = replay_strokes(options_of(folder, "study/replay"));
  const StudyRows rows = rows_of_file(result.rows_file);
  // The folder was moved, and the strokes with it.
  std::filesystem::create_directories(folder.path("moved"));
  std::filesystem::rename(folder.path("study"), folder.path("moved/study"));
  std::filesystem::rename(folder.path("s.json"), folder.path("moved/s.json"));
  StrokeSources sources;
  add_replay_sources(folder.path("moved/study/replay"), sources);
  EXPECT_EQ(sources.mesh, kMesh);
  DrawnStrokes strokes(sources);
  ASSERT_FALSE(rows.rows().empty());
  for (const StudyRow& row : rows.rows()) {
    const DrawnStroke drawn = strokes.find(row);
    EXPECT_EQ(drawn.stroke.id, row.stroke);
    EXPECT_GT(drawn.curve.points.size(), 10u);
    EXPECT_FALSE(drawn.intended.empty());
  }
  StrokeSources nowhere;
  nowhere.mesh = kMesh;
  nowhere.recordings = folder.path("nowhere");
  EXPECT_THROW(DrawnStrokes(nowhere).find(rows.rows()[0]), Error);
}

// A study of two people on one shape, a torus, with two curves, on the disk.
SimulatedStudyOptions small_study(const test::TestFolder& folder,
                                  const std::string& name = "torus") {
  TargetShape shape;
  shape.name = name;
  shape.scale = 0.4;
  SimulatedStrokesOptions strokes;
  strokes.mesh = "shape:torus";
  strokes.rate_hz = 20;
  for (const Stroke& stroke : simulated_strokes(strokes))
    if (shape.curves.size() < 2) shape.curves.emplace_back().points = stroke.intended->points;
  write_file_atomically(folder.path("t.json"), write_targets({{shape}}, ""));
  SimulatedStudyOptions options;
  options.shapes.targets = folder.path("t.json");
  options.techniques = {"spraycan", "anchored-closest"};
  options.out = folder.path("study");
  options.count = 2;
  options.rate_hz = 30;
  return options;
}

// What `measure` finds of curves as recorded, on a mesh that stands in a folder.
RecordedStudy measured(const test::TestFolder& folder, std::vector<std::string> participants) {
  std::filesystem::create_directories(folder.path("shapes"));
  write_file_atomically(folder.path("shapes/torus.obj"),
                        write_mesh(load_mesh("shape:torus").mesh, MeshFormat::obj));
  RecordedStudyOptions options;
  options.participants = std::move(participants);
  options.shapes = folder.path("shapes");
  options.targets = folder.path("t.json");
  return measure_recordings(options);
}

StudyRows rows_of(const RecordedStudy& study) {
  std::string table = rows_heading();
  for (const MeasuredRow& row : study.rows) table += csv_row(row);
  return StudyRows(read_rows(table, "m.csv"), "m.csv");
}

// A curve that was recorded with a technique, and the same stroke drawn again with it.
TEST(Replay, MeasureAndReplayWriteTheSameColumns) {
  const test::TestFolder folder;
  const SimulatedStudyOptions study = small_study(folder);
  EXPECT_EQ(simulate_study(study), 2u * 2u * 4u);

  ReplayOptions options;
  options.strokes = {folder.path("study/p00"), folder.path("study/p01")};
  options.techniques = {&find_technique("spraycan")};
  options.targets = folder.path("t.json");
  options.out = folder.path("replay");
  const ReplayResult result = replay_strokes(options);
  EXPECT_EQ(result.rows, 16u);
  EXPECT_EQ(result.rejected, 0u);
  const StudyRows replayed = rows_of_file(result.rows_file);
  EXPECT_EQ(replayed.table().columns, row_columns());
  const StudyRows recorded = rows_of(measured(folder, options.strokes));
  EXPECT_EQ(recorded.table().columns, replayed.table().columns);
  std::size_t same = 0;
  for (const StudyRow& a : recorded.rows())
    for (const StudyRow& b : replayed.rows()) {
      if (a.method != "spraycan" || a.participant != b.participant || a.recording != b.recording ||
          a.index != b.index)
        continue;
      SCOPED_TRACE(a.name());
      ++same;
      EXPECT_EQ(std::tie(a.shape, a.curve, a.repetition, a.task, a.simulated),
                std::tie(b.shape, b.curve, b.repetition, b.task, b.simulated));
      for (const char* column : {"D_ep_mm", "D_sym_mm", "K_E", "T_h", "T_c", "tau_s"}) {
        const double value = recorded.number(a, column);
        EXPECT_GT(value, 0.0) << column;
        EXPECT_NEAR(replayed.number(b, column), value, 1e-3 * value) << column;
      }
    }
  EXPECT_EQ(same, 8u);
  StrokeSources sources;
  add_replay_sources(folder.path("replay"), sources);
  DrawnStrokes strokes(sources);
  for (const StudyRow& row : replayed.rows()) {
    EXPECT_EQ(row.stroke, row.recording + "#" + row.index);
    EXPECT_EQ(row.method, "spraycan");
    EXPECT_EQ(row.shape, "torus");
    EXPECT_GT(strokes.find(row).curve.points.size(), 5u);
  }
}

TEST(RecordedStudy, MethodsAreCalledByTheirNames) {
  const test::TestFolder folder;
  const SimulatedStudyOptions study = small_study(folder);
  simulate_study(study);
  std::filesystem::create_directories(folder.path("shapes"));
  const NamedMesh mesh = load_mesh("shape:torus");
  RecordedStudyOptions options;
  options.participants = {folder.path("study/p00"), folder.path("nobody")};
  options.shapes = folder.path("shapes");
  options.targets = folder.path("t.json");
  // Without the mesh every recording is left out, with its names.
  const RecordedStudy none = measure_recordings(options);
  EXPECT_TRUE(none.rows.empty());
  ASSERT_EQ(none.rejected.size(), 3u);
  EXPECT_EQ(none.rejected[0].participant, folder.path("nobody"));
  EXPECT_EQ(none.rejected[1].recording.substr(1), "_0.json");
  EXPECT_EQ(none.rejected[1].shape, "torus");

  write_file_atomically(folder.path("shapes/torus.obj"), write_mesh(mesh.mesh, MeshFormat::obj));
  const RecordedStudy measured = measure_recordings(options);
  ASSERT_EQ(measured.rows.size(), 8u);
  EXPECT_EQ(measured.rejected.size(), 1u);
  StrokeSources sources;
  sources.recordings = folder.path("study");
  sources.targets = options.targets;
  DrawnStrokes strokes(sources);
  std::string table = rows_heading();
  for (const MeasuredRow& row : measured.rows) {
    EXPECT_EQ(row.participant, "p00");
    EXPECT_EQ(row.stroke, "");
    EXPECT_EQ(row.method, row.method_number == 0 ? "spraycan" : "anchored-closest");
    EXPECT_EQ(row.recording, std::to_string(row.method_number) + "_0.json");
    EXPECT_EQ(row.shape, "torus");
    EXPECT_TRUE(row.simulated);
    table += csv_row(row);
  }
  const StudyRows read(read_rows(table, "rows.csv"), "rows.csv");
  for (const StudyRow& row : read.rows())
    EXPECT_GT(strokes.find(row).curve.points.size(), 5u) << row.name();
}

TEST(RecordedStudy, ShapesBeyondThePublishedOnesAreThoseOfTheTargetCurves) {
  const test::TestFolder folder;
  std::filesystem::create_directories(folder.path("shapes"));
  write_file_atomically(folder.path("shapes/ring.obj"),
                        write_mesh(load_mesh("shape:torus").mesh, MeshFormat::obj));
  SimulatedStudyOptions study = small_study(folder, "ring");
  study.shapes.folder = folder.path("shapes");
  simulate_study(study);
  RecordedStudyOptions options;
  options.participants = {folder.path("study/p00"), folder.path("study/p01")};
  options.shapes = folder.path("shapes");
  options.targets = folder.path("t.json");
  const RecordedStudy measured = measure_recordings(options);
  EXPECT_EQ(measured.rows.size(), 16u);
  for (const RejectedStroke& rejected : measured.rejected) ADD_FAILURE() << rejected.text();
  for (const MeasuredRow& row : measured.rows) {
    EXPECT_EQ(row.shape, "ring");
    EXPECT_EQ(row.shape_number, 6);
  }
}

TEST(Replay, PathsThatTheSystemDoesNotLookAtAreNamed) {
  const test::TestFolder folder;
  ReplayOptions options = options_of(folder, "out");
  const auto expect_error = [&](const std::string& path) {
    try {
      replay_strokes(options);
      ADD_FAILURE() << "no error for " << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::io);
      EXPECT_EQ(std::string(error.what()).find(path + ": "), 0u) << error.what();
    }
  };
  options.strokes = {folder.path(std::string(300, 's'))};
  expect_error(options.strokes[0]);
#ifndef _WIN32
  write_strokes(folder, 1);
  options = options_of(folder, "out");
  std::filesystem::create_directories(folder.path("out"));
  std::filesystem::create_symlink("rows.journal", folder.path("out/rows.journal"));
  expect_error(folder.path("out/rows.journal"));
#endif
}

#ifdef __linux__
// How many threads beside those of before run when a bake first tells of itself, which ends it.
template <class Work>
std::size_t threads_of_bake(const test::TestFolder& folder, const Work& work) {
  const test::TestVariable cache("MIMICRY_CACHE", folder.path("cache"));
  const auto running = [] {
    const std::filesystem::directory_iterator tasks("/proc/self/task");
    return static_cast<std::size_t>(std::distance(begin(tasks), end(tasks)));
  };
  const std::size_t before = running();
  std::size_t during = 0;
  Monitor monitor;
  monitor.progress = [&](std::string_view of, double) {
    if (of != "baking") return;
    during = running();
    throw Error(ErrorKind::cancelled, "enough");
  };
  EXPECT_THROW(work(monitor), Error);
  EXPECT_GE(during, before);
  return during - before;
}

TEST(Replay, BakesHaveTheThreadsThatWereAskedFor) {
  const test::TestFolder folder;
  const int threads = static_cast<int>(std::thread::hardware_concurrency()) + 3;
  ReplayOptions options;
  options.techniques = {&find_technique("mimicry")};
  options.mesh = kMesh;
  options.threads = threads;
  ReplayJob job;
  job.source = "s.json";
  job.text = write_strokes(drawn_strokes(1));
  const auto others = static_cast<std::size_t>(threads - 1);
  EXPECT_EQ(
      threads_of_bake(folder, [&](const Monitor& monitor) { Replayer(options, monitor).run(job); }),
      others);

  SimulatedStudyOptions study = small_study(folder);
  study.techniques = {"mimicry"};
  study.threads = threads;
  EXPECT_EQ(
      threads_of_bake(folder, [&](const Monitor& monitor) { simulate_study(study, monitor); }),
      2 * others)
      << "those that draw wait beside those that bake";
}
#endif

}  // namespace
}  // namespace mimicry::lab
