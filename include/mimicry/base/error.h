#pragma once

#include <stdexcept>
#include <string>

namespace mimicry {

enum class ErrorKind {
  invalid_input,  ///< a file, mesh, pose, stroke or option that cannot be used as it is
  io,             ///< a file or stream that cannot be read or written
  unsupported,    ///< well-formed, but of a version or kind that is not handled
  cancelled,      ///< stopped by the caller's cancellation callback
};

/// The one exception type of the library. The message names the thing, the place and the remedy:
/// "strokes.json: stroke 'a': frame 17: the time runs backwards; record it anew". A query that
/// finds nothing is a result and never an error.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace mimicry
