#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace mimicry::io {

/// Cuts a `mimicry-strokes` file into files of one stroke each, without reading what is in them:
/// large files are streamed, and strokes read by several threads. Only finds where values end; what
/// is wrong with a stroke or the file, `read_strokes` says of the part.
class StrokeSplitter {
 public:
  /// Fills a buffer of the given size with the file's next bytes; 0 at its end.
  using Source = std::function<std::size_t(char*, std::size_t)>;
  explicit StrokeSplitter(Source source);

  /// The next stroke with all that stands before `strokes`; nothing behind the last one. A file
  /// without strokes gives itself once. O(bytes).
  std::optional<std::string> next();

 private:
  bool fill();
  int get();

  Source source_;
  std::string block_;
  std::size_t at_ = 0;
  std::string head_;  // up to and with the bracket that opens the array
  bool in_array_ = false, done_ = false;
};

}  // namespace mimicry::io
