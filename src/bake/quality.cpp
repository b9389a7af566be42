#include "bake/quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mimicry {

double sliver_percent(std::span<const Tet> tets, const Values& values) {
  if (tets.empty()) return 0.0;
  // The angle at edge (i, j) is the angle between the parts of (i, k) and (i, l) across the edge.
  const double limit = std::cos(5.0 * std::numbers::pi / 180.0);
  std::size_t slivers = 0;
  Eigen::RowVectorXd edge, a, b;
  for (const Tet& t : tets)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        std::size_t k = 0;
        while (k == i || k == j) ++k;
        const std::size_t l = 6 - i - j - k;
        edge = values.row(t[j]) - values.row(t[i]);
        a = values.row(t[k]) - values.row(t[i]);
        b = values.row(t[l]) - values.row(t[i]);
        const double length2 = edge.squaredNorm();
        if (length2 > 0.0) {
          a -= (a.dot(edge) / length2) * edge;
          b -= (b.dot(edge) / length2) * edge;
        }
        const double size = a.norm() * b.norm();
        if (!(std::abs(a.dot(b)) <= limit * size) || !(size > 0.0)) ++slivers;
      }
  return 100.0 * static_cast<double>(slivers) / (6.0 * static_cast<double>(tets.size()));
}

}  // namespace mimicry
