#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace mimicry {

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

  /// What stands before the strokes, up to and with the bracket that opens their array; empty
  /// before the first call of `next`, and where there is no such array.
  std::string_view head() const { return in_array_ ? std::string_view(head_) : std::string_view(); }
  /// Where the last part's own text begins in the file.
  std::size_t begin() const { return begin_; }
  /// How many bytes have been used; whether the last one closes the array.
  std::size_t used() const { return used_ + at_; }
  bool closed() const { return closed_; }

 private:
  bool fill();
  int get();

  Source source_;
  std::string block_;
  std::size_t at_ = 0;
  std::size_t used_ = 0;  // of the blocks before
  std::size_t begin_ = 0;
  std::string head_;  // up to and with the bracket that opens the array
  bool in_array_ = false, closed_ = false, done_ = false;
};

}  // namespace mimicry
