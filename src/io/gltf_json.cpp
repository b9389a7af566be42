#include "io/gltf_json.h"

#include <algorithm>
#include <cmath>

#include "io/text.h"

namespace mimicry {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

bool pads(char c) {
  return c == '\0' || is_blank(c) || c == '\n';
}

}  // namespace

std::size_t json_object_size(std::string_view bytes) {
  std::size_t at = bytes.substr(0, 3) == kByteOrderMark ? 3 : 0;
  while (at < bytes.size() && (is_blank(bytes[at]) || bytes[at] == '\n')) ++at;
  if (at == bytes.size() || bytes[at] != '{') return 0;
  std::size_t depth = 0;
  bool in_text = false;
  for (; at < bytes.size(); ++at) {
    const char c = bytes[at];
    if (in_text) {
      if (c == '\\')
        ++at;
      else if (c == '"')
        in_text = false;
    } else if (c == '"') {
      in_text = true;
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if ((c == '}' || c == ']') && --depth == 0) {
      return at + 1;
    }
  }
  return 0;
}

GltfJson::GltfJson(std::string_view text, std::string_view name,
                   std::function<void(const std::string&)> given_note)
    : name_(name), note_(std::move(given_note)) {
  if (const std::size_t size = json_object_size(text)) {
    const std::string_view rest = text.substr(size);
    if (!std::all_of(rest.begin(), rest.end(), pads))
      note(std::to_string(rest.size()) + " bytes after the JSON were passed over");
    text = text.substr(0, size);
  }
  try {
    document_ = JsonDocument(text, name);
  } catch (const Json::parse_error& error) {
    fail_at_byte(name_, error.byte, "the JSON of the file is broken or cut short; export it again");
  } catch (const Json::exception&) {
    fail("", "the JSON holds a number beyond double precision; export the file again");
  }
  if (!root().is_object()) fail("", "the JSON is no object; give a glTF 2.0 file");
  check_version();
  check_extensions();
}

void GltfJson::fail(const std::string& place, const std::string& what, ErrorKind kind) const {
  throw Error(kind, name_ + ": " + place + (place.empty() ? "" : ": ") + what);
}

void GltfJson::note(const std::string& sentence) const {
  constexpr std::size_t kMost = 20;
  if (!note_ || told_.size() > kMost || !told_.insert(sentence).second) return;
  note_(told_.size() > kMost ? "there is more of that kind" : sentence);
}

const Json* GltfJson::find(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto at = object.find(key);
  return at == object.end() ? nullptr : &*at;
}

const Json* GltfJson::extension(const Json& object, const char* name) {
  const Json* extensions = find(object, "extensions");
  return extensions ? find(*extensions, name) : nullptr;
}

std::size_t GltfJson::whole(const Json& object, const char* key, const std::string& place,
                            std::optional<std::size_t> otherwise) const {
  const Json* value = find(object, key);
  if (!value && otherwise) return *otherwise;
  if (!value) fail(place, std::string("'") + key + "' is missing; export the file again");
  if (value->is_number_unsigned()) return value->get<std::size_t>();
  if (value->is_number_float()) {  // some exporters write 3.0
    const double number = value->get<double>();
    if (number >= 0.0 && number < 9e15 && number == std::floor(number))
      return static_cast<std::size_t>(number);
  }
  fail(place, std::string("'") + key + "' is not a whole number from 0; export the file again");
}

std::vector<std::size_t> GltfJson::numbers_of(const Json& object, const char* key, std::size_t end,
                                              const std::string& place, const char* what) const {
  std::vector<std::size_t> out;
  const auto list = numbers(object, key, place);
  if (!list) return out;
  out.reserve(list->size());
  for (const double number : *list) {
    if (!(number >= 0.0 && number < static_cast<double>(end)) || number != std::floor(number))
      fail(place, "refers to " + std::string(what) + " " + format_double(number) +
                      ", but there are " + std::to_string(end) + "; export the file again");
    out.push_back(static_cast<std::size_t>(number));
  }
  return out;
}

std::optional<std::vector<double>> GltfJson::numbers(const Json& object, const char* key,
                                                     const std::string& place) const {
  const Json* list = find(object, key);
  if (!list) return std::nullopt;
  if (!list->is_array()) fail(place, std::string("'") + key + "' is not a list of numbers");
  std::vector<double> out;
  out.reserve(list->size());
  for (const Json& value : *list) {
    if (!value.is_number()) fail(place, std::string("'") + key + "' is not a list of numbers");
    out.push_back(value.get<double>());
  }
  return out;
}

const Json& GltfJson::array(const char* key) const {
  static const Json none = Json::array();
  const Json* value = find(root(), key);
  if (!value) return none;
  if (!value->is_array()) fail(key, "is not a list; export the file again");
  return *value;
}

const Json& GltfJson::item(const char* key, std::size_t index, const std::string& user) const {
  const Json& list = array(key);
  if (index >= list.size())
    fail(user, "refers to " + std::string(key) + " " + std::to_string(index) + ", but there are " +
                   std::to_string(list.size()) + "; export the file again");
  return list[index];
}

void GltfJson::check_version() const {
  const Json* asset = find(root(), "asset");
  const Json* version = asset ? find(*asset, "version") : nullptr;
  if (!version || !version->is_string())
    fail("asset", "'version' is missing; give a glTF 2.0 file");
  const std::string& number = version->get_ref<const std::string&>();
  if (number.substr(0, 2) != "2.")
    fail("asset", "version " + in_quotes(number) + " is not handled; export it as glTF 2.0",
         ErrorKind::unsupported);
}

}  // namespace mimicry
