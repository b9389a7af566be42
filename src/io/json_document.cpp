#include "io/json_document.h"

#include <string>
#include <utility>
#include <vector>

namespace mimicry {
namespace {

// From the leaves up: the destructor of an array or object takes memory for what is in it.
void empty(Json& value) noexcept {
  if (auto* const array = value.get_ptr<Json::array_t*>()) {
    for (Json& element : *array) empty(element);
    array->clear();
  } else if (auto* const object = value.get_ptr<Json::object_t*>()) {
    for (auto& [key, element] : *object) empty(element);
    object->clear();
  }
}

// Json's own parser builds in a value that an exception would give back as Json does.
class Builder final : public nlohmann::json_sax<Json> {
 public:
  Builder(Json& root, std::string_view name, const JsonEvent& event)
      : root_(root), name_(name), event_(event) {}

  bool null() override { return scalar(nullptr); }
  bool boolean(bool value) override { return scalar(value); }
  bool number_integer(Json::number_integer_t value) override { return scalar(value); }
  bool number_unsigned(Json::number_unsigned_t value) override { return scalar(value); }
  bool number_float(Json::number_float_t value, const std::string&) override {
    return scalar(value);
  }
  bool string(std::string& value) override { return scalar(std::move(value)); }
  bool binary(Json::binary_t& value) override { return scalar(std::move(value)); }
  bool start_object(std::size_t) override {
    return start(Json::value_t::object, Json::parse_event_t::object_start);
  }
  bool start_array(std::size_t) override {
    return start(Json::value_t::array, Json::parse_event_t::array_start);
  }
  bool end_object() override { return end(Json::parse_event_t::object_end); }
  bool end_array() override { return end(Json::parse_event_t::array_end); }

  bool key(std::string& name) override {
    key_ = std::move(name);
    if (event_) {
      Json value(key_);
      event_(depth(), Json::parse_event_t::key, value);
    }
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
    if (const auto* syntax = dynamic_cast<const Json::parse_error*>(&error)) throw *syntax;
    if (const auto* range = dynamic_cast<const Json::out_of_range*>(&error)) throw *range;
    throw error;
  }

 private:
  int depth() const { return static_cast<int>(open_.size()); }

  // Into the array or object that is open. An open value stays where it is: nothing is added to
  // what it is in before it ends.
  Json& add(Json&& value) {
    if (open_.empty()) return root_ = std::move(value);
    if (open_.back()->is_array())
      return open_.back()->get_ref<Json::array_t&>().emplace_back(std::move(value));
    Json& member = open_.back()->get_ref<Json::object_t&>()[key_];
    empty(member);  // a key that comes twice: the last counts
    return member = std::move(value);
  }

  template <class Value>
  bool scalar(Value&& given) {
    Json value(std::forward<Value>(given));
    if (!event_ || event_(depth(), Json::parse_event_t::value, value)) add(std::move(value));
    return true;
  }

  bool start(Json::value_t type, Json::parse_event_t kind) {
    if (depth() == kMostNested)
      json_fail(name_, "holds more than " + std::to_string(kMostNested) +
                           " arrays and objects in each other; export it again");
    if (event_) {
      Json none;
      event_(depth(), kind, none);
    }
    const std::string key = key_;  // children have keys of their own
    Json& value = add(Json(type));
    open_.push_back(&value);
    keys_.push_back(key);
    return true;
  }

  bool end(Json::parse_event_t kind) {
    Json& value = *open_.back();
    open_.pop_back();
    key_ = std::move(keys_.back());
    keys_.pop_back();
    if (event_ && !event_(depth(), kind, value)) {
      empty(value);
      remove_last();
    }
    return true;
  }

  void remove_last() {
    if (open_.empty())
      root_ = nullptr;
    else if (open_.back()->is_array())
      open_.back()->get_ref<Json::array_t&>().pop_back();
    else
      open_.back()->get_ref<Json::object_t&>().erase(key_);
  }

  Json& root_;
  std::string name_;
  const JsonEvent& event_;
  std::vector<Json*> open_;
  std::vector<std::string> keys_;  // of the open ones, in what they are in
  std::string key_;                // of the value that comes next
};

}  // namespace

JsonDocument::JsonDocument(std::string_view text, std::string_view name, const JsonEvent& event) {
  const FloatTrapMask mask;  // a number beyond a double overflows before it is refused
  try {
    Builder builder(root_, name, event);
    Json::sax_parse(text.begin(), text.end(), &builder);
  } catch (...) {
    empty(root_);
    throw;
  }
}

JsonDocument::~JsonDocument() {
  empty(root_);
}

}  // namespace mimicry
