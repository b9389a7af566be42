// Requests: whatever the bytes, they are answered, refused with a sentence that is JSON, or lead to
// a route with a path that is fit to be looked up.
#include <cassert>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/string_body.hpp>
#include <nlohmann/json.hpp>

#include "serve/connection.h"
#include "serve/limits.h"

namespace {

using namespace mimicry::serve;

void require(bool holds) {
  if (!holds) std::abort();
}

Site make_site() {
  std::string name = (std::filesystem::temp_directory_path() / "http-fuzz-XXXXXX").string();
  require(::mkdtemp(name.data()) != nullptr);
  const std::filesystem::path folder = name;
  std::filesystem::create_directories(folder / "assets");
  std::ofstream(folder / "index.html") << "<!doctype html>";
  std::ofstream(folder / "assets" / "a.js") << std::string(1000, ' ');
  Site site;
  site.pages = std::make_shared<const Pages>(folder.string());
  std::filesystem::remove_all(folder);  // the pages are in memory
  site.routes = {{"GET", "/api/status", 0, {}, {}}, {"POST", "/api/bake", 1000, {}, {}}};
  site.known_host = [](const std::string& host) { return host == "localhost" || host == "::1"; };
  return site;
}

void check(const Response& response) {
  require(response.status >= 200 && response.status < 600);
  if (response.status < 400) return;
  require(nlohmann::json::parse(response.body).at("error").is_string());
}

void route(const Site& site, Head head) {
  const auto checked = check_head(std::move(head), site.known_host);
  if (const auto* refused = std::get_if<Response>(&checked)) return check(*refused);
  const auto& request = std::get<Request>(checked);
  require(request.path.starts_with('/') && request.path.find('\0') == std::string::npos);
  require(request.head.count("Host") == 1);
  require(request.head.count("Content-Length") + request.head.count("Transfer-Encoding") <= 1);
  const auto found = site.find(request);
  if (const auto* answer = std::get_if<Response>(&found)) check(*answer);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Site site = make_site();
  http::request_parser<http::string_body> parser;
  parser.header_limit(limits::kHeadBytes);
  parser.body_limit(100'000);
  parser.eager(true);
  Trouble trouble;
  bool routed = false;
  boost::asio::const_buffer rest(data, size);
  while (rest.size() != 0 && !parser.is_done()) {
    const std::size_t taken = parser.put(rest, trouble);
    if (!routed && parser.is_header_done()) {
      route(site, head_of(parser.get()));
      routed = true;
    }
    if (trouble || taken == 0) break;
    rest += taken;
  }
  return 0;
}
