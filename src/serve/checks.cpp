#include "serve/checks.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "serve/limits.h"
#include "serve/text.h"

namespace mimicry::serve {
namespace {

using Refusal = std::optional<Response>;

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

bool is_token(std::string_view text) {
  constexpr std::string_view kOthers = "!#$%&'*+-.^_`|~";
  return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           kOthers.find(c) != std::string_view::npos;
  });
}

// RFC 9112, 6.1 and 6.3: two lengths are how requests are smuggled.
Refusal check_length(const Head& head) {
  const std::size_t lengths = head.count("Content-Length"),
                    codings = head.count("Transfer-Encoding");
  if (lengths + codings > 1)
    return refusal(400,
                   "the request has more than one length; send Content-Length or "
                   "Transfer-Encoding, once");
  if (lengths == 1) {
    const std::string_view digits = head.field("Content-Length");
    std::uint64_t value = 0;
    const auto [end, trouble] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (trouble != std::errc() || end != digits.data() + digits.size())
      return refusal(400, "Content-Length is no number of bytes");
  }
  if (codings == 1) {
    if (!head.is_http_1_1) return refusal(400, "HTTP/1.0 has no Transfer-Encoding");
    if (lower_case(head.field("Transfer-Encoding")) != "chunked")
      return refusal(501, "of the transfer codings only chunked is known");
  }
  return std::nullopt;
}

Refusal check_fields(const Head& head) {
  if (head.fields.size() > limits::kHeaders)
    return refusal(431,
                   "the request has more than " + std::to_string(limits::kHeaders) + " headers");
  for (const auto& [name, value] : head.fields)
    if (!is_token(name) || std::any_of(value.begin(), value.end(), [](char c) {
          return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F;
        }))
      return refusal(400, "a header's name or value has characters that it must not have");
  return std::nullopt;
}

Refusal check_host(const std::string& authority, const KnownHost& known_host) {
  const std::optional<std::string> host = host_of(authority);
  if (!host) return refusal(400, "the Host header is no host");
  if (known_host(*host)) return std::nullopt;
  return refusal(421, "this server does not answer to the name " + printable(*host) +
                          "; start it with --name " + printable(*host) + " if that is its name");
}

// The authority of an absolute target stands before the Host header (RFC 9112, 3.2.2).
Refusal cut_authority(std::string& target, std::string& authority) {
  if (target.starts_with('/')) return std::nullopt;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!lower_case(target).starts_with(scheme)) continue;
    const std::size_t end = std::min(target.find_first_of("/?#", scheme.size()), target.size());
    authority = target.substr(scheme.size(), end - scheme.size());
    target.erase(0, end);
    if (!target.starts_with('/')) target.insert(0, "/");
    return std::nullopt;
  }
  return refusal(400, "the request names no path");
}

Refusal read_target(std::string_view target, Request& request) {
  const std::size_t end = target.find('#');
  target = target.substr(0, end);
  const std::size_t mark = target.find('?');
  const auto path = percent_decoded(target.substr(0, mark));
  if (!path || path->find('\0') != std::string::npos)
    return refusal(400, "the path is not well formed");
  request.path = *path;
  std::string_view rest = mark == std::string_view::npos ? "" : target.substr(mark + 1);
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
    const std::size_t sign = pair.find('=');
    std::string plain(sign == std::string_view::npos ? "" : pair.substr(sign + 1));
    std::replace(plain.begin(), plain.end(), '+', ' ');
    const auto name = percent_decoded(pair.substr(0, sign)), value = percent_decoded(plain);
    if (!name || !value) return refusal(400, "the query is not well formed");
    request.query.emplace(*name, *value);
  }
  return std::nullopt;
}

// A browser tells where a page comes from that sends something.
Refusal check_origin(const Head& head, const std::string& authority) {
  if (head.method == "GET" || head.method == "HEAD") return std::nullopt;
  const std::string_view origin = head.field("Origin"), site = head.field("Sec-Fetch-Site");
  const std::string host = lower_case(authority), from = lower_case(origin);
  const bool own = origin.empty() || from == "http://" + host || from == "https://" + host;
  if (own && (site.empty() || site == "same-origin" || site == "none")) return std::nullopt;
  return refusal(403, "only the studio's own pages may send something to it");
}

}  // namespace

std::variant<Request, Response> check_head(Head head, const KnownHost& known_host) {
  Request request;
  request.head = std::move(head);
  const Head& h = request.head;
  if (Refusal no = check_fields(h)) return *no;
  if (Refusal no = check_length(h)) return *no;
  if (h.target.size() > limits::kTargetBytes)
    return refusal(414,
                   "the address is longer than " + std::to_string(limits::kTargetBytes) + " bytes");
  if (h.count("Host") != 1) return refusal(400, "the request must have one Host header");
  std::string target = h.target, authority(h.field("Host"));
  if (Refusal no = check_host(authority, known_host)) return *no;
  if (Refusal no = cut_authority(target, authority)) return *no;
  if (Refusal no = check_host(authority, known_host)) return *no;
  if (Refusal no = check_origin(h, authority)) return *no;
  if (Refusal no = read_target(target, request)) return *no;
  return request;
}

}  // namespace mimicry::serve
