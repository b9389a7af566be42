#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/stroke_splitter.h"
#include "lab/participant_folder.h"

namespace mimicry::lab {

/// A piece of work: one stroke of a strokes file, or one recording of a participant.
struct ReplayJob {
  std::string source;     ///< name of the strokes file or the participant
  std::size_t index = 0;  ///< of the stroke in its file
  std::string text;       ///< the stroke, as a strokes file of its own
  std::shared_ptr<const ParticipantFolder> participant;
  RecordingName recording;
  std::string problem;  ///< the source could not be opened
};

/// The jobs of strokes files and participants' folders, in the order given. Holds one block of a
/// file at a time.
class ReplaySource {
 public:
  /// Throws Error(io) for a path that is not there.
  explicit ReplaySource(const std::vector<std::string>& paths);
  std::optional<ReplayJob> next();
  /// Of files; what a pipe will give is not known, and does not count. 0: there are only pipes.
  std::size_t bytes() const { return bytes_; }
  std::size_t bytes_read() const { return bytes_read_; }  ///< of these

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::optional<ReplayJob> next_of_file();
  std::optional<ReplayJob> next_of_folder();

  struct Path {
    std::string path;
    bool is_folder = false;
    bool has_size = false;
  };

  std::vector<Path> paths_;
  std::size_t path_ = 0;  // the next one to open
  std::size_t bytes_ = 0, bytes_read_ = 0;
  std::unique_ptr<std::FILE, Close> file_;
  std::optional<StrokeSplitter> splitter_;
  std::string name_;
  std::size_t index_ = 0;
  std::shared_ptr<const ParticipantFolder> participant_;
};

}  // namespace mimicry::lab
