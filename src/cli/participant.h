#pragma once

#include <string>
#include <vector>

#include <mimicry/io/study_recording.h>

namespace mimicry::cli {

/// A participant's folder in the published study's format (docs/formats.md).
struct Participant {
  std::string folder;
  std::string name;  ///< the folder's
  study::StudySequence sequence;
};

/// Reads study_sequence.json. Throws Error where it is missing or wrong.
Participant open_participant(const std::string& folder);

/// "1_3.json".
std::string recording_name(Index method, Index shape);

/// Reads one file of the folder. Throws Error where it is missing or no recording; strokes that
/// cannot be read come with their problem.
std::vector<study::RecordedStroke> load_recording(const Participant& participant, Index method,
                                                  Index shape);

}  // namespace mimicry::cli
