#include "serve/message.h"

#include <algorithm>

#include "serve/text.h"

namespace mimicry::serve {
namespace {

bool same(std::string_view a, std::string_view b) {
  const auto lower = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

std::string_view Head::field(std::string_view name) const {
  for (const auto& [known, value] : fields)
    if (same(known, name)) return value;
  return {};
}

std::size_t Head::count(std::string_view name) const {
  return static_cast<std::size_t>(std::count_if(
      fields.begin(), fields.end(), [&](const auto& f) { return same(f.first, name); }));
}

Response Response::text(int status, std::string type, std::string content) {
  Response made;
  made.status = status;
  made.fields.emplace_back("Content-Type", std::move(type));
  const auto kept = std::make_shared<const std::string>(std::move(content));
  made.body = *kept;
  made.keeper = kept;
  return made;
}

Response refusal(int status, std::string_view sentence) {
  return Response::text(status, "application/json", error_json(sentence));
}

Response busy(std::string_view sentence) {
  Response made = refusal(503, sentence);
  made.fields.emplace_back("Retry-After", "10");
  return made;
}

}  // namespace mimicry::serve
