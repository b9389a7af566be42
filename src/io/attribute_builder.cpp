#include "io/attribute_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mimicry {

template <std::size_t N>
typename CornerValueBuilder<N>::Value CornerValueBuilder<N>::none() {
  Value value;
  value.fill(std::numeric_limits<float>::quiet_NaN());
  return value;
}

template <std::size_t N>
bool CornerValueBuilder<N>::is_none(const Value& value) {
  return std::any_of(value.begin(), value.end(), [](float x) { return !std::isfinite(x); });
}

template <std::size_t N>
void CornerValueBuilder<N>::cut(std::size_t first, std::size_t end,
                                std::span<const Face> triangles) {
  if (corners_.size() <= first) return;
  if (corners_.size() < end) corners_.resize(end, Face{kNone, kNone, kNone});
  std::vector<Index> numbers = {corners_[first][0], corners_[first][1]};
  for (std::size_t f = first; f < end; ++f) numbers.push_back(corners_[f][2]);
  for (std::size_t f = first; f < end; ++f)
    for (std::size_t k = 0; k < 3; ++k) corners_[f][k] = numbers[at(triangles[f - first][k])];
}

template <std::size_t N>
CornerValues<N> CornerValueBuilder<N>::finish(std::span<const Face> faces) {
  if (values_.empty() || (!by_vertex_ && corners_.empty())) {
    clear();
    return {};
  }
  const std::span<const Face> named = by_vertex_ ? faces : std::span<const Face>(corners_);
  CornerValues<N> result;
  result.corners.assign(3 * faces.size(), kNone);
  const bool all_are = std::none_of(values_.begin(), values_.end(), is_none);
  bool any = false;
  for (std::size_t f = 0; f < named.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index n = named[f][k];
      if (n < 0 || at(n) >= values_.size() || (!all_are && is_none(values_[at(n)]))) continue;
      result.corners[3 * f + k] = n;
      any = true;
    }
  for (Value& value : values_)
    if (is_none(value)) value.fill(0.0f);  // named by no corner
  result.values = std::move(values_);
  result.values.shrink_to_fit();
  clear();
  return any ? std::move(result) : CornerValues<N>{};
}

template class CornerValueBuilder<2>;
template class CornerValueBuilder<4>;

Index FaceLabelBuilder::number(std::string_view name) {
  const auto found = known_.find(name);
  if (found != known_.end()) return found->second;
  const auto number = static_cast<Index>(names_.size());
  names_.emplace_back(name);
  known_.emplace(names_.back(), number);
  return number;
}

void FaceLabelBuilder::begin(std::size_t face, Index number) {
  if (!runs_.empty() && runs_.back().first == face) runs_.pop_back();
  const Index last = runs_.empty() ? kNone : runs_.back().second;
  if (number != last) runs_.emplace_back(face, number);
}

FaceLabels FaceLabelBuilder::finish(std::size_t faces) {
  FaceLabels result;
  bool any = false;
  for (const auto& [first, number] : runs_) any = any || (number != kNone && first < faces);
  if (any) {
    result.names = std::move(names_);
    result.of_face.assign(faces, kNone);
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const std::size_t end = r + 1 < runs_.size() ? runs_[r + 1].first : faces;
      for (std::size_t f = runs_[r].first; f < end; ++f) result.of_face[f] = runs_[r].second;
    }
  }
  clear();
  return result;
}

std::shared_ptr<const MeshAttributes> AttributeBuilder::finish(std::span<const Face> faces) {
  MeshAttributes result;
  result.texcoords = texcoords.finish(faces);
  result.colors = colors.finish(faces);
  result.groups = groups.finish(faces.size());
  result.materials = materials.finish(faces.size());
  result.objects = objects.finish(faces.size());
  if (result.empty()) return nullptr;
  return std::make_shared<const MeshAttributes>(std::move(result));
}

}  // namespace mimicry
