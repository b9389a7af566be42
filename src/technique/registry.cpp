#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/technique/technique.h>

#include "base/comma_list.h"
#include "technique/options.h"
#include "technique/rows.h"

namespace mimicry {

namespace {

// Rows never move: there is room for all from the start, and readers see those that are counted.
class Registry {
 public:
  Registry() {
    std::vector<TechniqueInfo> built_in = built_in_techniques();
    most_ = built_in.size() + kMostRegistered;
    rows_.reserve(most_);
    for (TechniqueInfo& row : built_in) rows_.push_back(std::move(row));
    count_ = rows_.size();
  }

  std::span<const TechniqueInfo> rows() const {
    return {rows_.data(), count_.load(std::memory_order_acquire)};
  }

  const TechniqueInfo& add(TechniqueInfo info) {
    const std::lock_guard<std::mutex> lock(adding_);
    if (technique_named(info.name))
      throw Error(ErrorKind::invalid_input,
                  "technique '" + info.name + "' exists already; choose another name");
    if (rows_.size() == most_)
      throw Error(ErrorKind::invalid_input, "technique '" + info.name + "': no more than " +
                                                std::to_string(kMostRegistered) +
                                                " can be registered");
    rows_.push_back(std::move(info));
    count_.store(rows_.size(), std::memory_order_release);
    return rows_.back();
  }

 private:
  std::vector<TechniqueInfo> rows_;
  std::size_t most_ = 0;
  std::atomic<std::size_t> count_ = 0;
  std::mutex adding_;
};

// Never destroyed: other objects of the program's whole life may use it at its end.
Registry& registry() {
  static Registry& all = *new Registry;
  return all;
}

bool is_word(std::string_view name) {
  const auto is_fine = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  };
  return !name.empty() && name.front() != '-' && name.back() != '-' &&
         name.find("--") == std::string_view::npos &&
         std::all_of(name.begin(), name.end(), is_fine);
}

void require_sound(const TechniqueInfo& info) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::invalid_input, "technique '" + info.name + "' " + why);
  };
  if (!is_word(info.name))
    refuse(
        "cannot be registered: write its name as words in lower case letters and digits, joined by "
        "'-'");
  if (!info.step) refuse("has no step function");
  if (info.color > 0xffffff) refuse("has a colour that is not 0xrrggbb");
  for (std::size_t i = 0; i < info.options.size(); ++i) {
    const OptionInfo& option = info.options[i];
    if (!is_word(option.name))
      refuse("has an option '" + option.name +
             "': write its name in lower case letters, digits and '-'");
    for (std::size_t j = 0; j < i; ++j)
      if (info.options[j].name == option.name) refuse("has two options '" + option.name + "'");
    require_sound_option(info, option);
  }
}

}  // namespace

std::string_view answer_name(Answer answer) {
  constexpr std::array<std::string_view, kAnswerCount> kNames = {
      "miss",    "ray",           "closest",           "smooth",
      "section", "outside-shell", "no-phong-solution", "replaced"};
  return kNames[static_cast<std::size_t>(answer)];
}

std::span<const TechniqueInfo> techniques() {
  return registry().rows();
}

const TechniqueInfo* technique_named(std::string_view name) {
  for (const TechniqueInfo& t : techniques())
    if (t.name == name) return &t;
  return nullptr;
}

const TechniqueInfo& find_technique(std::string_view name) {
  if (const TechniqueInfo* found = technique_named(name)) return *found;
  throw Error(ErrorKind::invalid_input,
              "technique '" + std::string(name) + "' does not exist; choose one of " +
                  comma_list(techniques(), [](const TechniqueInfo& t) { return t.name; }));
}

const TechniqueInfo& register_technique(TechniqueInfo info) {
  require_sound(info);
  if (info.title.empty()) info.title = info.name;
  if (info.source.empty()) info.source = "-";
  return registry().add(std::move(info));
}

}  // namespace mimicry
