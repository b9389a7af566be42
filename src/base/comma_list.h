#pragma once

#include <string>

namespace mimicry {

/// "a, b, c": names in a message. name_of: of an element, anything that a std::string is made of;
/// empty ones are left out.
template <class Elements, class NameOf>
std::string comma_list(const Elements& elements, const NameOf& name_of) {
  std::string all;
  for (const auto& element : elements) {
    const std::string name(name_of(element));
    if (!name.empty()) all += (all.empty() ? "" : ", ") + name;
  }
  return all;
}

template <class Names>
std::string comma_list(const Names& names) {
  return comma_list(
      names, [](const auto& name) -> const auto& { return name; });
}

}  // namespace mimicry
