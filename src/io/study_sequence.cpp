#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include <mimicry/io/study.h>

#include "io/json.h"
#include "io/json_document.h"
#include "io/text.h"

namespace mimicry {
namespace {

using Numbers = std::vector<Index>;

bool is_list_of_lists(const Json& value) {
  return value.is_array() && !value.empty() && value.front().is_array();
}

Numbers numbers(const Json& value, const std::string& where) {
  if (!value.is_array()) json_fail(where, "is not an array of numbers");
  Numbers list;
  for (const Json& entry : value) list.push_back(index(entry, where));
  return list;
}

Numbers without_duplicates(const Numbers& list) {
  Numbers result;
  for (const Index n : list)
    if (std::find(result.begin(), result.end(), n) == result.end()) result.push_back(n);
  return result;
}

// The order of one method and shape, or of all.
Numbers checked(const Numbers& curves, const std::string& where) {
  Numbers list = with_repeats(curves);
  if (list.empty())
    json_fail(where, "'StrokeSequence' has " + std::to_string(curves.size()) +
                         " curves for a shape that are neither all different nor in two halves "
                         "which each end in the curve that they begin with");
  return list;
}

// Cuts a flat list into `count` orders; nothing where one of them is not an order.
std::optional<std::vector<Numbers>> cut(const Numbers& flat, std::size_t count) {
  if (count == 0 || flat.size() % count != 0) return std::nullopt;
  const std::size_t size = flat.size() / count;
  std::vector<Numbers> lists;
  for (std::size_t i = 0; i < count; ++i) {
    lists.push_back(with_repeats(std::span(flat).subspan(i * size, size)));
    if (lists.back().empty()) return std::nullopt;
  }
  return lists;
}

// Entry i of all three lists belongs to stroke i.
StudySequence from_parallel(const Numbers& methods, const Numbers& shapes, const Numbers& curves,
                            const std::string& where) {
  StudySequence sequence{without_duplicates(methods), without_duplicates(shapes), {}};
  for (const Index m : sequence.methods)
    for (const Index s : sequence.shapes) {
      Numbers list;
      for (std::size_t i = 0; i < curves.size(); ++i)
        if (methods[i] == m && shapes[i] == s) list.push_back(curves[i]);
      sequence.strokes.push_back(checked(list, where));
    }
  return sequence;
}

void add_lists(const Json& value, std::vector<Numbers>& lists, const std::string& where) {
  for (const Json& entry : value)
    if (is_list_of_lists(entry))
      add_lists(entry, lists, where);
    else
      lists.push_back(checked(numbers(entry, where + ": StrokeSequence"), where));
}

StudySequence from_json(const Json& root, const std::string& file) {
  const Numbers methods = numbers(array(root, "MethodSequence", file), file + ": MethodSequence");
  const Numbers shapes = numbers(array(root, "ShapeSequence", file), file + ": ShapeSequence");
  const Json& strokes = array(root, "StrokeSequence", file);
  StudySequence sequence{without_duplicates(methods), without_duplicates(shapes), {}};
  if (sequence.methods.empty() || sequence.shapes.empty() || strokes.empty())
    json_fail(file, "a sequence is empty");
  const std::size_t shape_count = sequence.shapes.size();
  const std::size_t pairs = sequence.methods.size() * shape_count;
  if (is_list_of_lists(strokes)) {
    add_lists(strokes, sequence.strokes, file);
    if (sequence.strokes.size() == 1) sequence.strokes.resize(shape_count, sequence.strokes[0]);
    if (sequence.strokes.size() != shape_count && sequence.strokes.size() != pairs)
      json_fail(file, "'StrokeSequence' has " + std::to_string(sequence.strokes.size()) +
                          " lists, neither one for each of the " + std::to_string(shape_count) +
                          " shapes nor for each method and shape");
    return sequence;
  }
  const Numbers curves = numbers(strokes, file + ": StrokeSequence");
  if (methods.size() == curves.size() && shapes.size() == curves.size() && pairs < curves.size())
    return from_parallel(methods, shapes, curves, file);
  if (const Numbers same = with_repeats(curves); !same.empty())
    sequence.strokes.assign(shape_count, same);
  else if (auto by_shape = cut(curves, shape_count))
    sequence.strokes = std::move(*by_shape);
  else if (auto by_pair = cut(curves, pairs))
    sequence.strokes = std::move(*by_pair);
  else
    checked(curves, file);
  return sequence;
}

}  // namespace

StudySequence read_study_sequence(std::string_view bytes, std::string_view name) {
  const std::string file(name);
  try {
    return from_json(JsonDocument(text_of(bytes, name), name).root(), file);
  } catch (const Json::parse_error& error) {
    json_fail(file, "the text ends early or is not JSON at byte " + std::to_string(error.byte));
  } catch (const Json::exception& error) {
    json_fail(file, error.what());
  }
}

std::string write_study_sequence(const StudySequence& sequence) {
  return OrderedJson{{"MethodSequence", sequence.methods},
                     {"ShapeSequence", sequence.shapes},
                     {"StrokeSequence", sequence.strokes}}
             .dump(2) +
         "\n";
}

}  // namespace mimicry
