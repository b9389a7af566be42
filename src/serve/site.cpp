#include "serve/site.h"

#include "serve/text.h"

namespace mimicry::serve {
namespace {

Response not_allowed(const Request& request, const std::string& methods) {
  Response no = refusal(405, printable(request.path) + " takes " + methods);
  no.fields.emplace_back("Allow", methods);
  return no;
}

}  // namespace

std::variant<const Route*, Response> Site::find(const Request& request) const {
  const bool reads = request.head.method == "GET" || request.head.method == "HEAD";
  const std::string_view method = reads ? std::string_view("GET") : request.head.method;
  std::string methods;
  for (const Route& route : routes) {
    if (route.path != request.path) continue;
    if (route.method == method) return &route;
    methods += (methods.empty() ? "" : ", ") + (route.method == "GET" ? "GET, HEAD" : route.method);
  }
  if (!methods.empty()) return not_allowed(request, methods);
  if (!reads) return not_allowed(request, "GET, HEAD");
  return pages->answer(request);
}

}  // namespace mimicry::serve
