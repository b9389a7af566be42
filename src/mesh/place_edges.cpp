#include "mesh/place_edges.h"

namespace mimicry {

PlaceEdges::PlaceEdges(const TriangleMesh& mesh, const std::vector<Index>& place,
                       const std::vector<bool>& left_out)
    : mesh_(mesh), place_(place) {
  // By the smaller place into buckets, then each small bucket by the other.
  std::vector<Index> start(place.size() + 1, 0);
  const auto each = [&](auto&& visit) {
    for (Index h = 0; h < 3 * mesh.face_count(); ++h)
      if (!left_out[at(h / 3)]) visit(h, std::minmax({place[at(tail(h))], place[at(head(h))]}));
  };
  each([&](Index, std::pair<Index, Index> ends) { ++start[at(ends.first) + 1]; });
  for (std::size_t v = 0; v < place.size(); ++v) start[v + 1] += start[v];
  std::vector<std::pair<Index, Index>> keyed(at(start.back()));
  std::vector<Index> fill(start.begin(), start.end() - 1);
  each([&](Index h, std::pair<Index, Index> ends) {
    keyed[at(fill[at(ends.first)]++)] = {ends.second, h};
  });
  half_edges_.reserve(keyed.size());
  for (std::size_t v = 0; v < place.size(); ++v) {
    const auto first = keyed.begin() + start[v], last = keyed.begin() + start[v + 1];
    std::sort(first, last);
    for (auto it = first; it != last; ++it) {
      if (it == first || it->first != (it - 1)->first) runs_.push_back(half_edges_.size());
      half_edges_.push_back(it->second);
    }
  }
  runs_.push_back(half_edges_.size());
}

}  // namespace mimicry
