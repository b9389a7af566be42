#include "serve/pages.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <new>
#include <string_view>
#include <utility>

#include <zlib.h>

#include <mimicry/base/error.h>
#include <mimicry/files/file.h>

#include "serve/limits.h"
#include "serve/text.h"

namespace mimicry::serve {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, const char*>, 13> kTypes = {{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".webmanifest", "application/manifest+json"},
    {".wasm", "application/wasm"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".glb", "model/gltf-binary"},
    {".txt", "text/plain; charset=utf-8"},
    {".map", "application/json"},
}};

const char* type_of(const fs::path& file) {
  const std::string ending = file.extension().string();
  for (const auto& [known, type] : kTypes)
    if (ending == known) return type;
  return "application/octet-stream";
}

std::string gzipped(std::string_view content) {
  constexpr int kGzip = 15 + 16;  // the window's bits, and gzip's header
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    throw std::bad_alloc();
  std::string packed(deflateBound(&stream, static_cast<uLong>(content.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);  // there is room for all of it
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

// FNV-1a. A tag tells a browser that a file has changed, and guards nothing.
std::string tag_of(std::string_view content) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (const char c : content)
    hash = (hash ^ static_cast<unsigned char>(c)) * std::uint64_t{0x100000001B3u};
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

[[noreturn]] void too_much(const std::string& folder) {
  throw Error(ErrorKind::io, folder + ": it holds more than a studio does (" +
                                 std::to_string(limits::kStudioFiles) + " files, " +
                                 std::to_string(limits::kStudioBytes >> 20) +
                                 " MB); name the built page's folder with --studio");
}

// A word of a list such as "gzip;q=0.5, br" that is not refused with q=0.
bool accepts_gzip(std::string_view list) {
  const std::size_t at = list.find("gzip");
  if (at == std::string_view::npos) return false;
  std::string_view word = list.substr(at, list.find(',', at) - at);
  const std::size_t q = word.find("q=");
  return q == std::string_view::npos ||
         word.substr(q + 2).find_first_of("123456789") != std::string_view::npos;
}

}  // namespace

Pages::Pages(const std::string& folder) {
  std::error_code trouble;
  const fs::path root = fs::canonical(folder, trouble);
  if (trouble || !fs::is_regular_file(root / "index.html", trouble))
    throw Error(ErrorKind::io, folder +
                                   ": the studio is not there; build it with `cmake --preset wasm "
                                   "&& cmake --build --preset wasm --target web_page` (or ./run), "
                                   "or name its folder with --studio");
  std::uint64_t bytes = 0;
  for (fs::recursive_directory_iterator it(root, trouble), end; !trouble && it != end;
       it.increment(trouble)) {
    std::error_code gone;
    const fs::path file = fs::canonical(it->path(), gone);
    const bool inside =
        !gone &&
        std::mismatch(root.begin(), root.end(), file.begin(), file.end()).first == root.end();
    if (!inside || !fs::is_regular_file(file, gone)) continue;
    bytes += fs::file_size(file, gone);
    if (gone || bytes > limits::kStudioBytes || pages_.size() == limits::kStudioFiles)
      too_much(folder);
    auto page = std::make_shared<Page>();
    page->content = files::read_file(file.string());
    page->gzipped = gzipped(page->content);
    if (page->gzipped.size() > page->content.size() / 10 * 9) page->gzipped = {};
    page->type = type_of(file);
    page->tag = tag_of(page->content);
    const std::string path = "/" + it->path().lexically_relative(root).generic_string();
    // Built files carry a hash of their content in their names.
    page->is_immutable = path.starts_with("/assets/");
    pages_.emplace(path, std::move(page));
  }
  if (trouble)
    throw Error(ErrorKind::io, folder + ": the folder cannot be read: " + trouble.message());
}

Response Pages::answer(const Request& request) const {
  const auto found = pages_.find(request.path == "/" ? "/index.html" : request.path);
  if (found == pages_.end())
    return refusal(404, printable(request.path) + ": there is no such file");
  const Page& page = *found->second;
  Response response;
  const bool packed = !page.gzipped.empty() && accepts_gzip(request.head.field("Accept-Encoding"));
  const std::string tag = "\"" + page.tag + (packed ? "-gzip\"" : "\"");
  response.fields = {
      {"Content-Type", page.type},
      {"ETag", tag},
      {"Cache-Control", page.is_immutable ? "public, max-age=31536000, immutable" : "no-cache"}};
  if (!page.gzipped.empty()) response.fields.emplace_back("Vary", "Accept-Encoding");
  if (packed) response.fields.emplace_back("Content-Encoding", "gzip");
  const std::string_view known = request.head.field("If-None-Match");
  if (known == "*" || known.find(tag) != std::string_view::npos) {
    response.status = 304;
    return response;
  }
  response.body = packed ? page.gzipped : page.content;
  response.keeper = found->second;
  return response;
}

}  // namespace mimicry::serve
