#include "cli/participant.h"

#include <filesystem>

#include <mimicry/base/error.h>
#include <mimicry/files/file.h>

namespace mimicry::cli {
namespace {

constexpr const char* kSequenceName = "study_sequence.json";

std::string beside(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

}  // namespace

Participant open_participant(const std::string& folder) {
  // "participants/07/" has no file name of its own.
  std::filesystem::path path(folder);
  if (!path.has_filename()) path = path.parent_path();
  if (path == "." || path == "..") path = std::filesystem::absolute(path).lexically_normal();
  Participant participant;
  participant.folder = folder;
  participant.name = path.filename().string();
  participant.sequence = io::read_study_sequence(
      files::read_file(beside(folder, kSequenceName), files::Accept::regular),
      participant.name + "/" + kSequenceName);
  return participant;
}

std::string recording_name(Index method, Index shape) {
  return std::to_string(method) + "_" + std::to_string(shape) + ".json";
}

std::vector<study::RecordedStroke> load_recording(const Participant& participant, Index method,
                                                  Index shape) {
  const std::string name = recording_name(method, shape);
  return io::read_recording(
      files::read_file(beside(participant.folder, name), files::Accept::regular),
      participant.name + "/" + name);
}

}  // namespace mimicry::cli
