#include "serve/pages.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <utility>

#include <mimicry/base/error.h>

#include "files/file.h"
#include "files/names.h"
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

// A coding of a list such as "gzip;q=0.5, br" that is not refused with q=0.
bool accepts(std::string_view list, std::string_view coding) {
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    std::string_view word = list.substr(0, comma);
    list.remove_prefix(std::min(comma + 1, list.size()));
    word.remove_prefix(std::min(word.find_first_not_of(" \t"), word.size()));
    if (word.substr(0, word.find_first_of("; \t")) != coding) continue;
    const std::size_t q = word.find("q=");
    return q == std::string_view::npos ||
           word.substr(q + 2).find_first_of("123456789") != std::string_view::npos;
  }
  return false;
}

// Of a file's name: how its content is packed, and the ending that says so.
constexpr std::array<std::pair<std::string_view, const char*>, 2> kCodings = {
    {{".br", "br"}, {".gz", "gzip"}}};

// The ending alone does not tell: a studio may have a file that is called so.
bool is_packed_form(const std::string& path, const auto& forms) {
  return std::any_of(kCodings.begin(), kCodings.end(), [&](const auto& coding) {
    const std::string_view ending = coding.first;
    return path.ends_with(ending) && forms.contains(path.substr(0, path.size() - ending.size()));
  });
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
  std::map<std::string, Form> forms;
  for (fs::recursive_directory_iterator it(root, trouble), end; !trouble && it != end;
       it.increment(trouble)) {
    std::error_code gone;
    const fs::path file = fs::canonical(it->path(), gone);
    const bool inside =
        !gone &&
        std::mismatch(root.begin(), root.end(), file.begin(), file.end()).first == root.end();
    if (!inside || !fs::is_regular_file(file, gone)) continue;
    bytes += fs::file_size(file, gone);
    if (gone || bytes > limits::kStudioBytes || forms.size() == limits::kStudioFiles)
      too_much(folder);
    const std::string path = "/" + it->path().lexically_relative(root).generic_string();
    std::string content = read_file(to_text(file));
    std::string tag = tag_of(content);
    forms.emplace(path, Form{std::move(content), std::move(tag)});
  }
  if (trouble)
    throw Error(ErrorKind::io, folder + ": the folder cannot be read: " + trouble.message());
  for (auto& [path, form] : forms) {
    if (is_packed_form(path, forms)) continue;
    auto page = std::make_shared<Page>();
    page->plain = std::move(form);
    page->type = type_of(path);
    // Built files carry a hash of their content in their names.
    page->is_immutable = path.starts_with("/assets/");
    for (const auto& [ending, coding] : kCodings)
      if (const auto packed = forms.find(path + std::string(ending)); packed != forms.end())
        page->packed.emplace_back(coding, std::move(packed->second));
    pages_.emplace(path, std::move(page));
  }
}

Response Pages::answer(const Request& request) const {
  const auto found = pages_.find(request.path == "/" ? "/index.html" : request.path);
  if (found == pages_.end())
    return refusal(404, printable(request.path) + ": there is no such file");
  const Page& page = *found->second;
  const std::string_view accepted = request.head.field("Accept-Encoding");
  const auto packed = std::find_if(page.packed.begin(), page.packed.end(),
                                   [&](const auto& form) { return accepts(accepted, form.first); });
  const Form& form = packed == page.packed.end() ? page.plain : packed->second;
  const std::string tag = "\"" + form.tag + "\"";
  Response response;
  response.fields = {
      {"Content-Type", page.type},
      {"ETag", tag},
      {"Cache-Control", page.is_immutable ? "public, max-age=31536000, immutable" : "no-cache"}};
  if (!page.packed.empty()) response.fields.emplace_back("Vary", "Accept-Encoding");
  if (packed != page.packed.end()) response.fields.emplace_back("Content-Encoding", packed->first);
  const std::string_view known = request.head.field("If-None-Match");
  if (known == "*" || known.find(tag) != std::string_view::npos) {
    response.status = 304;
    return response;
  }
  response.body = form.content;
  response.keeper = found->second;
  return response;
}

}  // namespace mimicry::serve
