#include "bake/incomplete_cholesky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace mimicry {
namespace {

// Columns that wait until their next entry's row is reached, in a list for each row.
class Waiting {
 public:
  explicit Waiting(std::size_t columns) : first_(columns, kNone), next_(columns, kNone) {}
  void add(Index row, Index column) {
    next_[at(column)] = first_[at(row)];
    first_[at(row)] = column;
  }
  Index first(Index row) const { return first_[at(row)]; }
  Index next(Index column) const { return next_[at(column)]; }

 private:
  std::vector<Index> first_, next_;
};

}  // namespace

IncompleteCholesky::IncompleteCholesky(const UpperRows& matrix, const ProgressCallback& progress) {
  constexpr float kFirstShift = 1.6e-3F;
  constexpr float kGrowth = 2.0F;
  for (shift_ = kFirstShift; !factor(matrix, shift_, progress); shift_ *= kGrowth) {
  }
}

// False where a pivot fails: the shift is too small.
bool IncompleteCholesky::factor(const UpperRows& matrix, float shift,
                                const ProgressCallback& progress) {
  constexpr double kDrop = 2e-3;    // entries below, against the square root of their pivot so far
  constexpr std::size_t kMost = 3;  // times a column's entries of the matrix are kept
  constexpr double kLeastPivot = 1e-3;  // times the shift, against a diagonal of 1
  const auto rows = at(matrix.rows());
  start_.assign(1, 0);
  row_.clear();
  value_.clear();
  inverse_.resize(rows);
  std::vector<double> pivot(rows, 1.0 + static_cast<double>(shift)), sum(rows, 0.0);
  std::vector<char> in_column(rows, 0);
  std::vector<std::size_t> reached(rows);  // of each column: its next entry
  Waiting waiting(rows);
  std::vector<Index> entries;
  std::vector<std::pair<double, Index>> kept;
  for (std::size_t j = 0; j < rows; ++j) {
    if (j % 4096 == 0) report(progress, "ls-mesh", 0.0);
    entries.clear();
    for (auto k = at(matrix.start[j]) + 1; k < at(matrix.start[j + 1]); ++k) {
      const Index i = matrix.column[k];
      sum[at(i)] = static_cast<double>(matrix.value[k]);
      in_column[at(i)] = 1;
      entries.push_back(i);
    }
    const std::size_t most = kMost * entries.size() + 5;
    for (Index k = waiting.first(static_cast<Index>(j)); k != kNone;) {
      const Index following = waiting.next(k);
      const std::size_t first = reached[at(k)]++, end = start_[at(k) + 1];
      const auto factor = static_cast<double>(value_[first]);
      for (std::size_t l = first + 1; l < end; ++l) {
        const Index i = row_[l];
        if (!in_column[at(i)]) {
          in_column[at(i)] = 1;
          sum[at(i)] = 0.0;
          entries.push_back(i);
        }
        sum[at(i)] -= factor * static_cast<double>(value_[l]);
      }
      if (first + 1 < end) waiting.add(row_[first + 1], k);
      k = following;
    }
    for (const Index i : entries) in_column[at(i)] = 0;
    if (!(pivot[j] > kLeastPivot * static_cast<double>(shift))) return false;
    const double inverse = 1.0 / std::sqrt(pivot[j]);
    inverse_[j] = static_cast<float>(inverse);
    kept.clear();
    for (const Index i : entries) {
      const double size = std::abs(sum[at(i)]) * inverse;
      if (size * size > kDrop * kDrop * pivot[at(i)]) kept.emplace_back(size, i);
    }
    if (kept.size() > most) {
      std::nth_element(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(most), kept.end(),
                       std::greater<>());
      kept.resize(most);
    }
    std::sort(kept.begin(), kept.end(),
              [](const auto& a, const auto& b) { return a.second < b.second; });
    reached[j] = row_.size();
    for (const auto& [size, i] : kept) {
      const double value = sum[at(i)] * inverse;
      row_.push_back(i);
      value_.push_back(static_cast<float>(value));
      pivot[at(i)] -= value * value;
    }
    start_.push_back(row_.size());
    if (!kept.empty()) waiting.add(kept.front().second, static_cast<Index>(j));
  }
  return true;
}

template <std::size_t Width>
void IncompleteCholesky::apply_group(const std::vector<double>& r, std::size_t first,
                                     float* z) const {
  const std::size_t rows = inverse_.size();
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t c = 0; c < Width; ++c)
      z[i * Width + c] = static_cast<float>(r[i * kBlock + first + c]);
  std::array<float, Width> value;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t c = 0; c < Width; ++c) value[c] = z[j * Width + c] *= inverse_[j];
    for (std::size_t k = start_[j]; k < start_[j + 1]; ++k) {
      float* row = z + at(row_[k]) * Width;
      for (std::size_t c = 0; c < Width; ++c) row[c] -= value_[k] * value[c];
    }
  }
  for (std::size_t j = rows; j-- > 0;) {
    for (std::size_t c = 0; c < Width; ++c) value[c] = z[j * Width + c];
    for (std::size_t k = start_[j]; k < start_[j + 1]; ++k) {
      const float* row = z + at(row_[k]) * Width;
      for (std::size_t c = 0; c < Width; ++c) value[c] -= value_[k] * row[c];
    }
    for (std::size_t c = 0; c < Width; ++c) z[j * Width + c] = value[c] * inverse_[j];
  }
}

// Threads share the right-hand sides: the order of the unknowns is one.
void IncompleteCholesky::apply(const std::vector<double>& r, Applied& z, Executor& executor) const {
  const std::size_t groups = executor.threads() >= 4 ? 4 : executor.threads() >= 2 ? 2 : 1;
  z.rows = inverse_.size();
  z.width = kBlock / groups;
  z.values.resize(z.rows * kBlock);
  executor.for_chunks(groups, 1, [&](std::size_t group, std::size_t, int) {
    float* values = z.values.data() + group * z.rows * z.width;
    if (groups == 1)
      apply_group<kBlock>(r, 0, values);
    else if (groups == 2)
      apply_group<kBlock / 2>(r, group * z.width, values);
    else
      apply_group<kBlock / 4>(r, group * z.width, values);
  });
}

}  // namespace mimicry
