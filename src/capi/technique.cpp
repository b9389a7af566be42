#include <algorithm>
#include <deque>
#include <mutex>

#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

namespace {

// A row in C's words: it points into the row's own texts, which live as long as the program.
struct Row {
  std::vector<std::vector<const char*>> choices;
  std::vector<mimicry_option_info> options;
  mimicry_technique_info info{};

  explicit Row(const TechniqueInfo& row) {
    choices.reserve(row.options.size());
    for (const OptionInfo& o : row.options) options.push_back(option(row, o));
    info = {row.name.c_str(),
            row.title.c_str(),
            row.sentence.c_str(),
            row.description.c_str(),
            row.source.c_str(),
            row.screen_note.c_str(),
            row.color,
            row.steering == Steering::aims ? MIMICRY_AIMED : MIMICRY_MOVED,
            row.anchored,
            row.needs_bake,
            row.rank,
            static_cast<int32_t>(options.size()),
            options.data()};
  }

  mimicry_option_info option(const TechniqueInfo& row, const OptionInfo& o) {
    const OptionValue values = option_value(row, o, {});
    std::vector<const char*>& names = choices.emplace_back();
    for (const std::string& choice : o.choices) names.push_back(choice.c_str());
    mimicry_option_info out{};
    out.name = o.name.c_str();
    out.unit = o.unit.c_str();
    out.description = o.description.c_str();
    out.kind = static_cast<mimicry_option_kind>(o.kind);
    out.count = static_cast<int32_t>(values.size());
    out.choice_count = static_cast<int32_t>(names.size());
    out.choices = names.empty() ? nullptr : names.data();
    std::copy(values.begin(), values.end(), out.defaults);
    out.lowest = o.lowest;
    out.highest = o.highest;
    return out;
  }
};

static_assert(static_cast<int>(OptionKind::boolean) == MIMICRY_OPTION_BOOLEAN &&
              static_cast<int>(OptionKind::number) == MIMICRY_OPTION_NUMBER &&
              static_cast<int>(OptionKind::direction) == MIMICRY_OPTION_DIRECTION &&
              static_cast<int>(OptionKind::choice) == MIMICRY_OPTION_CHOICE);

}  // namespace

int32_t mimicry_technique_count(void) {
  return static_cast<int32_t>(techniques().size());
}

const mimicry_technique_info* mimicry_technique(int32_t number) {
  const auto rows = techniques();
  if (number < 0 || at(number) >= rows.size()) return nullptr;
  static std::mutex making;
  static std::deque<Row>& made = *new std::deque<Row>;  // never destroyed, as the rows
  const std::lock_guard<std::mutex> lock(making);
  while (made.size() <= at(number)) made.emplace_back(rows[made.size()]);
  return &made[at(number)].info;
}
