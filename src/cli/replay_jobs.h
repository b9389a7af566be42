#pragma once

#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/io/stroke_splitter.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/study/measures.h>

#include "cli/canvas.h"
#include "cli/mesh_input.h"
#include "cli/participant.h"
#include "cli/study_shapes.h"

namespace mimicry::cli {

/// A piece of work: one stroke of a strokes file, or one recording of a participant.
struct ReplayJob {
  std::string source;     ///< name of the strokes file or the participant
  std::size_t index = 0;  ///< of the stroke in its file
  std::string text;       ///< the stroke, as a strokes file of its own
  std::shared_ptr<const Participant> participant;
  Index method = kNone, shape = kNone;
  std::string problem;  ///< the source could not be opened
};

/// The jobs of strokes files and participants' folders, in the order given. Holds one block of a
/// file at a time.
class ReplaySource {
 public:
  /// Throws Error(io) for a path that is not there.
  explicit ReplaySource(const std::vector<std::string>& paths);
  std::optional<ReplayJob> next();
  std::size_t bytes() const { return bytes_; }
  std::size_t bytes_read() const { return bytes_read_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::optional<ReplayJob> next_of_file();
  std::optional<ReplayJob> next_of_folder();

  std::vector<std::string> paths_;
  std::size_t path_ = 0;  // the next one to open
  std::size_t bytes_ = 0, bytes_read_ = 0;
  std::unique_ptr<std::FILE, Close> file_;
  std::optional<io::StrokeSplitter> splitter_;
  std::string name_;
  std::size_t index_ = 0;
  std::shared_ptr<const Participant> participant_;
};

struct ReplayOptions {
  std::vector<const technique::TechniqueInfo*> techniques;
  std::string shapes, targets, mesh;
  session::MissPolicy misses = session::MissPolicy::connect;
};

struct ReplayRows {
  std::string csv, json_lines;
  std::size_t rows = 0, rejected = 0;
  std::vector<std::string> reasons;  ///< of what was rejected, with its place
};

/// Heading of rows.csv (docs/formats.md).
const std::vector<std::string>& replay_columns();

/// Draws the strokes of a job with every technique and measures the curves. Thread-safe; equal jobs
/// give equal bytes. Loads each shape once, when it is first needed.
class Replayer {
 public:
  explicit Replayer(const ReplayOptions& options);
  ~Replayer();
  ReplayRows run(const ReplayJob& job) const;

 private:
  struct Shape;
  struct Row;
  const Shape& shape(const std::string& name) const;
  void replay_stroke(const stroke::Stroke& stroke, const Shape& shape,
                     const study::IntendedCurve& intended, const Row& row, ReplayRows& rows) const;
  void replay_text(const ReplayJob& job, ReplayRows& rows) const;
  void replay_recording(const ReplayJob& job, ReplayRows& rows) const;
  void reject(const Row& row, const std::string& reason, ReplayRows& rows) const;

  ReplayOptions options_;
  std::optional<StudyShapes> study_;
  mutable std::mutex lock_;
  mutable std::map<std::string, std::unique_ptr<Shape>> loaded_;
};

}  // namespace mimicry::cli
