#include <algorithm>
#include <deque>

#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

namespace {

struct Registry {
  std::deque<std::string> texts;  // views of the registry, ended by 0
  std::deque<std::vector<mimicry_option_info>> options;
  std::vector<mimicry_technique_info> techniques;

  const char* text(std::string_view view) { return texts.emplace_back(view).c_str(); }

  mimicry_option_info option(const technique::OptionInfo& info) {
    const technique::Options defaults;
    const auto values = info.get(defaults);
    mimicry_option_info out{};
    out.name = text(info.name);
    out.unit = text(info.unit);
    out.description = text(info.description);
    out.count = static_cast<int32_t>(values.size());
    std::copy(values.begin(), values.end(), out.defaults);
    out.lowest = info.lowest;
    out.highest = info.highest;
    return out;
  }

  Registry() {
    for (const technique::TechniqueInfo& info : technique::techniques()) {
      auto& list = options.emplace_back();
      for (const technique::OptionInfo& o : info.options) list.push_back(option(o));
      techniques.push_back({text(info.name), text(info.description), text(info.source),
                            info.anchored, info.needs_bake, static_cast<int32_t>(list.size()),
                            list.data()});
    }
  }
};

}  // namespace

int32_t mimicry_technique_count(void) {
  return static_cast<int32_t>(technique::techniques().size());
}

const mimicry_technique_info* mimicry_technique(int32_t number) {
  if (number < 0 || number >= mimicry_technique_count()) return nullptr;
  static const Registry registry;
  return &registry.techniques[static_cast<size_t>(number)];
}
