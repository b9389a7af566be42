#include <algorithm>

#include <mimicry/study/recording.h>

namespace mimicry {
namespace {

constexpr std::array<std::string_view, 2> kMethodWords = {"Spray", "AnchorPhong"};
constexpr std::array<std::string_view, 2> kMethodTechniques = {"spraycan", "mimicry"};

Index place_in(const std::array<std::string_view, 2>& list, std::string_view word) {
  const auto found = std::find(list.begin(), list.end(), word);
  return found == list.end() ? kNone : static_cast<Index>(found - list.begin());
}

bool all_different(std::span<const Index> curves) {
  for (std::size_t i = 0; i < curves.size(); ++i)
    if (std::find(curves.begin() + static_cast<std::ptrdiff_t>(i) + 1, curves.end(), curves[i]) !=
        curves.end())
      return false;
  return true;
}

}  // namespace

std::string_view method_word(Index method) {
  const auto m = static_cast<std::size_t>(method);
  return method >= 0 && m < kMethodWords.size() ? kMethodWords[m] : std::string_view();
}

Index method_number(std::string_view word) {
  return place_in(kMethodWords, word);
}

Index method_of_technique(std::string_view technique) {
  return place_in(kMethodTechniques, technique);
}

std::string_view task_name(TaskKind task) {
  return task == TaskKind::tracing ? "tracing" : "re-creating";
}

std::vector<Trial> StudySequence::trials(Index method, Index shape) const {
  const auto m = std::find(methods.begin(), methods.end(), method);
  const auto s = std::find(shapes.begin(), shapes.end(), shape);
  if (m == methods.end() || s == shapes.end()) return {};
  auto list = static_cast<std::size_t>(s - shapes.begin());
  if (strokes.size() != shapes.size())
    list += static_cast<std::size_t>(m - methods.begin()) * shapes.size();
  if (list >= strokes.size()) return {};
  const std::vector<Index>& curves = strokes[list];
  const std::size_t half = curves.size() / 2;
  std::vector<Trial> result;
  result.reserve(curves.size());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::size_t first = i < half ? 0 : half;
    const auto begin = curves.begin();
    const auto at = begin + static_cast<std::ptrdiff_t>(i);
    const bool repeat = std::find(begin + static_cast<std::ptrdiff_t>(first), at, curves[i]) != at;
    result.push_back({curves[i], i < half ? TaskKind::tracing : TaskKind::re_creating, repeat});
  }
  return result;
}

std::vector<Index> with_repeats(std::span<const Index> curves) {
  const std::size_t count = curves.size();
  if (count < 2 || count % 2 != 0) return {};
  const auto first = curves.first(count / 2);
  const auto second = curves.last(count / 2);
  std::vector<Index> result;
  if (all_different(curves)) {
    for (const auto half : {first, second}) {
      result.insert(result.end(), half.begin(), half.end());
      result.push_back(half.front());
    }
    return result;
  }
  if (first.size() < 2 || first.front() != first.back() || second.front() != second.back())
    return {};
  result.assign(first.begin(), first.end() - 1);
  result.insert(result.end(), second.begin(), second.end() - 1);
  if (!all_different(result)) return {};
  return {curves.begin(), curves.end()};
}

}  // namespace mimicry
