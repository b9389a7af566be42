#include "lab/participant_folder.h"

#include <filesystem>
#include <limits>

#include <mimicry/base/error.h>
#include <mimicry/io/study.h>

#include "files/file.h"
#include "files/names.h"
#include "io/number.h"

namespace mimicry::lab {
namespace {

constexpr const char* kSequenceName = "study_sequence.json";
constexpr std::string_view kRecordingEnding = ".json";
constexpr char kBeforeIndex = '#';

// Digits alone, as we write them.
std::optional<long long> digits(std::string_view text) {
  const auto number = parse_integer(text);
  if (!number || *number < 0 || std::to_string(*number) != text) return std::nullopt;
  return *number;
}

std::optional<Index> index_of(std::string_view text) {
  const auto number = digits(text);
  if (!number || *number > std::numeric_limits<Index>::max()) return std::nullopt;
  return static_cast<Index>(*number);
}

}  // namespace

std::string RecordingName::file() const {
  return std::to_string(method) + "_" + std::to_string(shape) + std::string(kRecordingEnding);
}

std::optional<RecordingName> RecordingName::of_file(std::string_view file) {
  const std::size_t line = file.find('_');
  if (line == std::string_view::npos || !file.ends_with(kRecordingEnding)) return std::nullopt;
  const auto method = index_of(file.substr(0, line));
  file.remove_suffix(kRecordingEnding.size());
  const auto shape = index_of(file.substr(line + 1));
  if (!method || !shape) return std::nullopt;
  return RecordingName{*method, *shape};
}

std::string RecordedStrokeName::text() const {
  return recording.file() + kBeforeIndex + std::to_string(index);
}

std::optional<RecordedStrokeName> recorded_stroke_of(std::string_view text) {
  const std::size_t at = text.find(kBeforeIndex);
  if (at == std::string_view::npos) return std::nullopt;
  const auto recording = RecordingName::of_file(text.substr(0, at));
  const auto index = digits(text.substr(at + 1));
  if (!recording || !index) return std::nullopt;
  return RecordedStrokeName{*recording, static_cast<std::size_t>(*index)};
}

std::string source_name(const std::string& path) {
  std::filesystem::path last = to_path(path);
  // "participants/07/" has no file name of its own.
  if (!last.has_filename()) last = last.parent_path();
  if (last == "." || last == "..") last = std::filesystem::absolute(last).lexically_normal();
  if (!last.has_filename()) last = last.parent_path();
  return to_text(last.filename());
}

ParticipantFolder::ParticipantFolder(const std::string& folder)
    : folder_(folder), name_(source_name(folder)) {
  sequence_ = read_study_sequence(read_file(join_path(folder, kSequenceName), Accept::regular),
                                  name_ + "/" + kSequenceName);
}

std::string ParticipantFolder::path(const RecordingName& recording) const {
  return join_path(folder_, recording.file());
}

std::string ParticipantFolder::title(const RecordingName& recording) const {
  return name_ + "/" + recording.file();
}

std::vector<RecordedStroke> ParticipantFolder::read(const RecordingName& recording) const {
  return read_recording(read_file(path(recording), Accept::regular), title(recording));
}

ParticipantWriter::ParticipantWriter(const std::string& folder) : folder_(folder) {}

void ParticipantWriter::write(const RecordingName& recording,
                              std::span<const RecordedStroke> strokes) const {
  make_folder(folder_);
  write_file_atomically(join_path(folder_, recording.file()), write_recording(strokes));
}

void ParticipantWriter::finish(const StudySequence& sequence) const {
  make_folder(folder_);
  write_file_atomically(join_path(folder_, kSequenceName), write_study_sequence(sequence));
}

}  // namespace mimicry::lab
