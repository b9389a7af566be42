#include "paint/cell_sizes.h"

#include <algorithm>
#include <cmath>

namespace mimicry {
namespace {

// More halvings than a double has bits of difference to show.
constexpr int kHalvings = 48;

// A measure of each face in model units, to which its steps are proportional.
std::vector<double> face_sizes(const TriangleMesh& mesh) {
  std::vector<double> sizes(at(mesh.face_count()), 0.0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k)).squaredNorm());
    const double size = std::sqrt(std::max(mesh.area_vector(f).norm(), 0.25 * longest));
    if (std::isfinite(size)) sizes[at(f)] = size;
  }
  return sizes;
}

void count_steps(const TriangleMesh& mesh, std::span<const double> sizes, double density, int most,
                 std::vector<int>& steps, std::vector<int>& counts) {
  std::fill(counts.begin(), counts.end(), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    int& s = steps[at(f)];
    s = repeats_corner(mesh.face(f))
            ? 0
            : static_cast<int>(std::clamp(sizes[at(f)] * density, 1.0, double(most)));
    ++counts[at(s)];
  }
  counts[0] = 0;
}

}  // namespace

int corner_of_largest_angle(const TriangleMesh& mesh, Index face) {
  int best = 0;
  double longest = -1.0;
  for (int k = 0; k < 3; ++k) {
    const double length =
        (mesh.corner(face, (k + 2) % 3) - mesh.corner(face, (k + 1) % 3)).squaredNorm();
    if (length > longest) longest = length, best = k;
  }
  return best;
}

std::vector<CellRow> place_rows(std::span<const int> counts, int size) {
  std::vector<CellRow> rows;
  int x = 0, y = 0, height = 0;
  for (int s = static_cast<int>(counts.size()) - 1; s >= 1; --s) {
    for (int left = (counts[at(s)] + 1) / 2; left > 0;) {
      if (x + s + 3 > size) {
        x = 0;
        y += height;
        height = 0;
      }
      height = std::max(height, s + 2);
      const int count = std::min(left, (size - x) / (s + 3));
      if (count == 0 || y + s + 2 > size) return {};
      rows.push_back({s, x, y, count});
      x += count * (s + 3);
      left -= count;
    }
  }
  return rows;
}

bool has_room(int faces, int size) {
  const int counts[2] = {0, faces};
  return faces == 0 || !place_rows(counts, size).empty();
}

std::vector<int> cell_steps(const TriangleMesh& mesh, int size) {
  const std::vector<double> sizes = face_sizes(mesh);
  const int most = size - 3;
  std::vector<int> steps(sizes.size()), counts(at(most) + 1);
  const auto fits = [&](double density) {
    count_steps(mesh, sizes, density, most, steps, counts);
    const bool is_empty = std::all_of(counts.begin(), counts.end(), [](int n) { return n == 0; });
    return is_empty || !place_rows(counts, size).empty();
  };
  if (!fits(0.0)) return {};
  double largest = 0.0, squares = 0.0;
  for (const double s : sizes) {
    largest = std::max(largest, s);
    squares += s * s;
  }
  if (!(squares > 0.0)) return steps;
  // At `low` all fit; at `high` legs alone have as many texels as there are.
  double low = 0.0, high = std::sqrt(2.0 * double(size) * double(size) / squares);
  high = std::max(high, double(most) / largest);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = low + 0.5 * (high - low);
    (fits(middle) ? low : high) = middle;
  }
  fits(low);
  return steps;
}

}  // namespace mimicry
