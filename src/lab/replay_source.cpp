#include "lab/replay_source.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <mimicry/base/error.h>

#include "files/environment.h"
#include "files/names.h"

namespace mimicry::lab {

namespace fs = std::filesystem;

ReplaySource::ReplaySource(const std::vector<std::string>& paths) : paths_(paths) {
  for (const std::string& path : paths_) {
    std::error_code trouble;
    const fs::file_status status = fs::status(to_path(path), trouble);
    if (!fs::exists(status)) throw Error(ErrorKind::io, path + ": is not there; check the path");
    // A folder counts by its files, so that progress is even.
    if (fs::is_directory(status)) {
      for (const auto& entry : fs::directory_iterator(to_path(path)))
        if (entry.is_regular_file()) bytes_ += entry.file_size();
    } else {
      const auto size = fs::file_size(to_path(path), trouble);
      if (!trouble) bytes_ += size;  // what a pipe will give is not known
    }
  }
}

std::optional<ReplayJob> ReplaySource::next() {
  for (;;) {
    if (splitter_) {
      if (auto job = next_of_file()) return job;
    } else if (participant_) {
      if (auto job = next_of_folder()) return job;
    }
    splitter_.reset();
    participant_.reset();
    if (path_ == paths_.size()) return std::nullopt;
    const std::string& path = paths_[path_++];
    index_ = 0;
    if (fs::is_directory(to_path(path))) {
      try {
        participant_ = std::make_shared<const ParticipantFolder>(path);
      } catch (const Error& error) {
        ReplayJob job;
        job.source = path;
        job.problem = error.what();
        return job;
      }
      continue;
    }
    name_ = source_name(path);
    file_.reset(open_stream(path));
    if (!file_) throw Error(ErrorKind::io, path + ": cannot be opened: " + std::strerror(errno));
    splitter_.emplace([this, path](char* buffer, std::size_t size) {
      const std::size_t count = std::fread(buffer, 1, size, file_.get());
      if (count == 0 && std::ferror(file_.get()) != 0)
        throw Error(ErrorKind::io, path + ": cannot be read: " + std::strerror(errno));
      bytes_read_ += count;
      return count;
    });
  }
}

std::optional<ReplayJob> ReplaySource::next_of_file() {
  std::optional<std::string> text = splitter_->next();
  if (!text) return std::nullopt;
  ReplayJob job;
  job.source = name_;
  job.index = index_++;
  job.text = std::move(*text);
  return job;
}

std::optional<ReplayJob> ReplaySource::next_of_folder() {
  const StudySequence& sequence = participant_->sequence();
  if (index_ == sequence.methods.size() * sequence.shapes.size()) return std::nullopt;
  ReplayJob job;
  job.source = participant_->name();
  job.participant = participant_;
  job.recording = {sequence.methods[index_ / sequence.shapes.size()],
                   sequence.shapes[index_ % sequence.shapes.size()]};
  ++index_;
  std::error_code none;
  const auto size = fs::file_size(to_path(participant_->path(job.recording)), none);
  if (!none) bytes_read_ += size;
  return job;
}

}  // namespace mimicry::lab
