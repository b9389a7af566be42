#include "bake/flat_tets.h"

#include <algorithm>

#include "bake/ls_mesh.h"

namespace mimicry {
namespace {

bool is_flat_tet(std::span<const Vec3> positions, const Tet& t) {
  return is_flat(positions[at(t[0])], positions[at(t[1])], positions[at(t[2])],
                 positions[at(t[3])]);
}

bool has(const Tet& t, Index v) {
  return std::find(t.begin(), t.end(), v) != t.end();
}

}  // namespace

std::array<Vec3, 4> area_vectors(std::span<const Vec3> positions, const Tet& t) {
  const Vec3 &a = positions[at(t[0])], &b = positions[at(t[1])], &c = positions[at(t[2])],
             &d = positions[at(t[3])];
  return {(d - b).cross(c - b), (c - a).cross(d - a), (d - a).cross(b - a), (b - a).cross(c - a)};
}

BorrowedGradients::BorrowedGradients(std::span<const Vec3> positions, std::span<const Tet> tets,
                                     const Incidence<Tet>& around) {
  std::vector<Index> lenders;
  for (std::size_t i = 0; i < tets.size(); ++i) {
    const Tet& t = tets[i];
    if (!is_flat_tet(positions, t)) continue;
    lenders.clear();
    for (std::size_t k = 0; k < 4; ++k) {
      const Index u = t[(k + 1) % 4], v = t[(k + 2) % 4], w = t[(k + 3) % 4];
      for (Index j = around.start[at(u)]; j < around.start[at(u) + 1]; ++j) {
        const Index other = around.element[at(j)];
        const Tet& o = tets[at(other)];
        if (at(other) != i && has(o, v) && has(o, w) && !is_flat_tet(positions, o))
          lenders.push_back(other);
      }
    }
    if (lenders.empty()) continue;
    for (const Index lender : lenders) {
      const Tet& o = tets[at(lender)];
      const std::array<Vec3, 4> area = area_vectors(positions, o);
      const double volume6 = area[3].dot(positions[at(o[3])] - positions[at(o[0])]);
      for (std::size_t k = 0; k < 4; ++k)
        terms_.push_back({o[k], area[k] / (volume6 * static_cast<double>(lenders.size()))});
    }
    flat_.push_back(static_cast<Index>(i));
    start_.push_back(terms_.size());
  }
}

std::span<const BorrowedGradients::Term> BorrowedGradients::of(Index tet) const {
  const auto found = std::lower_bound(flat_.begin(), flat_.end(), tet);
  if (found == flat_.end() || *found != tet) return {};
  const auto k = static_cast<std::size_t>(found - flat_.begin());
  return std::span(terms_).subspan(start_[k], start_[k + 1] - start_[k]);
}

}  // namespace mimicry
