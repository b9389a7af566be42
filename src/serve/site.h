#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "serve/checks.h"
#include "serve/message.h"
#include "serve/pages.h"

namespace mimicry::serve {

/// What a server answers to, whoever carries the requests.
struct Site {
  std::shared_ptr<const Pages> pages;
  std::vector<Route> routes;
  KnownHost known_host;

  /// The route that a request takes, or the answer at once: a page, 404, 405.
  std::variant<const Route*, Response> find(const Request& request) const;
};

}  // namespace mimicry::serve
