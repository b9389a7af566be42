#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "serve/message.h"

namespace mimicry::serve {

/// The studio's files, read once. Beside a file lie, made when the page was built, its forms in
/// brotli (`.br`) and gzip (`.gz`): browsers get the one that they take. What was not in the folder
/// when the server started (behind a link, above it, put there later) is not served whatever a path
/// says.
class Pages {
 public:
  /// Throws Error(io) where the folder has no index.html or is larger than a studio can be.
  explicit Pages(const std::string& folder);

  /// A file, 304 where the browser has it, 404.
  Response answer(const Request& request) const;

 private:
  struct Form {
    std::string content, tag;
  };
  struct Page {
    Form plain;
    std::vector<std::pair<const char*, Form>> packed;  // by coding, the smallest first
    std::string type;
    bool is_immutable = false;
  };
  std::map<std::string, std::shared_ptr<const Page>, std::less<>> pages_;
};

}  // namespace mimicry::serve
