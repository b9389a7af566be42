#include "segment/corner_values.h"

#include <map>
#include <vector>

namespace mimicry {
namespace {

// Numbers of values that are new, by vertex and the values between which it lies.
using NewValues = std::map<std::array<Index, 3>, Index>;

// The half-edge of the parent that the corner lies inside of; kNone.
Index edge_of(Index parent, const Vec3& bary) {
  for (int k = 0; k < 3; ++k)
    if (bary[(k + 2) % 3] == 0.0 && bary[k] > 0.0 && bary[(k + 1) % 3] > 0.0) return 3 * parent + k;
  return kNone;
}

template <std::size_t N>
Index value_at(const CornerValues<N>& old, CornerValues<N>& values, NewValues& made,
               const HalfEdges& half_edges, Index parent, const CutCorner& corner) {
  for (int k = 0; k < 3; ++k)
    if (corner.bary[k] == 1.0) return old.corners[3 * at(parent) + at(k)];
  const Index h = edge_of(parent, corner.bary);
  std::array<Index, 3> key{corner.vertex, kNone, kNone};
  double t = 0.0;
  if (h != kNone) {
    const bool own = half_edges.edge(h) == h;  // both sides count from the same end
    const Index tail = own ? h : HalfEdges::next(h), head = own ? HalfEdges::next(h) : h;
    t = corner.bary[HalfEdges::corner(head)];
    key[1] = old.corners[at(tail)];
    key[2] = old.corners[at(head)];
    if (key[1] == kNone || key[2] == kNone) return kNone;
  } else {
    for (int k = 0; k < 3; ++k)
      if (old.at_corner(parent, k) == nullptr) return kNone;
  }
  const auto [entry, is_new] = made.try_emplace(key, static_cast<Index>(values.values.size()));
  if (!is_new) return entry->second;
  if (h == kNone) {
    values.values.push_back(old.interpolated(parent, corner.bary));
    return entry->second;
  }
  typename CornerValues<N>::Value value;
  for (std::size_t i = 0; i < N; ++i)
    value[i] = static_cast<float>((1.0 - t) * static_cast<double>(old.values[at(key[1])][i]) +
                                  t * static_cast<double>(old.values[at(key[2])][i]));
  values.values.push_back(value);
  return entry->second;
}

template <std::size_t N>
CornerValues<N> cut_values(const CornerValues<N>& old, const HalfEdges& half_edges,
                           std::span<const Index> parents,
                           std::span<const std::array<CutCorner, 3>> corners) {
  CornerValues<N> values;
  if (old.empty()) return values;
  values.values = old.values;
  values.corners.reserve(3 * parents.size());
  NewValues made;
  for (std::size_t f = 0; f < parents.size(); ++f)
    for (const CutCorner& corner : corners[f])
      values.corners.push_back(value_at(old, values, made, half_edges, parents[f], corner));
  return values;
}

FaceLabels cut_labels(const FaceLabels& old, std::span<const Index> parents) {
  FaceLabels labels;
  if (old.empty()) return labels;
  labels.names = old.names;
  labels.of_face.reserve(parents.size());
  for (const Index parent : parents) labels.of_face.push_back(old.of_face[at(parent)]);
  return labels;
}

}  // namespace

std::shared_ptr<const MeshAttributes> cut_attributes(
    const MeshAttributes& of_target, const HalfEdges& half_edges, std::span<const Index> parents,
    std::span<const std::array<CutCorner, 3>> corners) {
  auto cut = std::make_shared<MeshAttributes>();
  cut->texcoords = cut_values(of_target.texcoords, half_edges, parents, corners);
  cut->colors = cut_values(of_target.colors, half_edges, parents, corners);
  cut->groups = cut_labels(of_target.groups, parents);
  cut->materials = cut_labels(of_target.materials, parents);
  cut->objects = cut_labels(of_target.objects, parents);
  return cut;
}

}  // namespace mimicry
