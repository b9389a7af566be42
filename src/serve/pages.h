#pragma once

#include <map>
#include <memory>
#include <string>

#include "serve/message.h"

namespace mimicry::serve {

/// The studio's files, read and compressed once: what was not in the folder when the server started
/// (behind a link, above it, put there later) is not served whatever a path says.
class Pages {
 public:
  /// Throws Error(io) where the folder has no index.html or is larger than a studio can be.
  explicit Pages(const std::string& folder);

  /// A file, 304 where the browser has it, 404.
  Response answer(const Request& request) const;

 private:
  struct Page {
    std::string content, gzipped;  // empty where gzip does not help
    std::string type, tag;
    bool is_immutable = false;
  };
  std::map<std::string, std::shared_ptr<const Page>, std::less<>> pages_;
};

}  // namespace mimicry::serve
