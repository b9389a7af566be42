#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "serve/message.h"

namespace mimicry::serve {

/// Whether the server answers to this host (lower case, without port).
using KnownHost = std::function<bool(const std::string& host)>;

/// A request that may be routed, or the refusal of one that may not: malformed, smuggled (its
/// length could be understood in two ways), for a host that is not this server (a page whose name
/// was bound to this address anew, DNS rebinding), or one that a page of another site sends. Any
/// head gives one of the two. After a refusal the connection ends: where its body ends is not
/// known.
std::variant<Request, Response> check_head(Head head, const KnownHost& known_host);

}  // namespace mimicry::serve
