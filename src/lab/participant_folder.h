#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/study/recording.h>

namespace mimicry::lab {

/// Which file of a participant's folder: the strokes of one method on one shape, by the study's
/// numbers.
struct RecordingName {
  Index method = kNone, shape = kNone;

  /// "1_3.json".
  std::string file() const;
  /// nullopt for the name of another file.
  static std::optional<RecordingName> of_file(std::string_view file);
  friend bool operator==(const RecordingName&, const RecordingName&) = default;
};

/// A stroke of a participant, as tables call it.
struct RecordedStrokeName {
  RecordingName recording;
  std::size_t index = 0;  ///< in the file, from 0

  /// "1_3.json#7".
  std::string text() const;
};
/// nullopt for a stroke of another name.
std::optional<RecordedStrokeName> recorded_stroke_of(std::string_view text);

/// A participant's folder in the published study's format (docs/formats.md), to be read.
class ParticipantFolder {
 public:
  /// Reads the sequence. Throws Error where it is missing or wrong.
  explicit ParticipantFolder(const std::string& folder);

  const std::string& name() const { return name_; }  ///< the folder's, as tables call it
  const StudySequence& sequence() const { return sequence_; }
  std::string path(const RecordingName& recording) const;
  /// "p07/1_3.json", for messages.
  std::string title(const RecordingName& recording) const;
  /// Reads one file. Throws Error where it is missing or no recording; strokes that cannot be read
  /// come with their problem.
  std::vector<RecordedStroke> read(const RecordingName& recording) const;

 private:
  std::string folder_, name_;
  StudySequence sequence_;
};

/// Writes such a folder. Const members may be called from several threads for different files.
class ParticipantWriter {
 public:
  /// The folder is made with its first file.
  explicit ParticipantWriter(const std::string& folder);

  /// Throws Error(io), and so does `finish`.
  void write(const RecordingName& recording, std::span<const RecordedStroke> strokes) const;
  /// Comes last: a folder that has its sequence is whole.
  void finish(const StudySequence& sequence) const;

 private:
  std::string folder_;
};

/// What tables call the participant of a folder, or the strokes of a file: the last part of the
/// path, also of "study/p07/".
std::string source_name(const std::string& path);

}  // namespace mimicry::lab
