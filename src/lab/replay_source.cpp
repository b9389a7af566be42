#include "lab/replay_source.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <mimicry/base/error.h>

#include "files/environment.h"
#include "files/file.h"
#include "files/names.h"

namespace mimicry::lab {

namespace fs = std::filesystem;

namespace {

// Of its files. Only progress needs it: what cannot be looked at counts nothing here, and is
// refused where it is read.
std::size_t bytes_of_folder(const std::string& path) {
  std::size_t bytes = 0;
  std::error_code trouble;
  for (fs::directory_iterator it(to_path(path), trouble), end; !trouble && it != end;
       it.increment(trouble)) {
    std::error_code none;
    const auto size = it->is_regular_file(none) ? it->file_size(none) : 0;
    if (!none) bytes += size;
  }
  return bytes;
}

}  // namespace

ReplaySource::ReplaySource(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    const fs::file_status status = status_of(path);
    if (!fs::exists(status)) throw Error(ErrorKind::io, path + ": is not there; check the path");
    Path& source = paths_.emplace_back();
    source.path = path;
    source.is_folder = fs::is_directory(status);
    // A folder counts by its files, so that progress is even.
    if (source.is_folder) {
      bytes_ += bytes_of_folder(path);
      continue;
    }
    std::error_code unknown;
    const auto size = fs::file_size(to_path(path), unknown);
    source.has_size = !unknown;
    if (source.has_size) bytes_ += size;
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
    const auto& [path, is_folder, has_size] = paths_[path_++];
    index_ = 0;
    if (is_folder) {
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
    splitter_.emplace([this, path = path, has_size = has_size](char* buffer, std::size_t size) {
      const std::size_t count = std::fread(buffer, 1, size, file_.get());
      if (count == 0 && std::ferror(file_.get()) != 0)
        throw Error(ErrorKind::io, path + ": cannot be read: " + std::strerror(errno));
      if (has_size) bytes_read_ += count;
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
