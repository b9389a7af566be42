#include "bake/block_pcg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mimicry {
namespace {

constexpr std::size_t kRowChunk = 2048;  // rows of a vector that one thread takes at a time
using Sums = std::array<double, kBlock>;

// y = a x by rows.
void multiply(const SparseRows& a, const BlockVector& x, BlockVector& y, Executor& executor) {
  executor.for_chunks(at(a.rows()), kRowChunk, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      Sums sum{};
      for (std::size_t k = at(a.start[i]); k < at(a.start[i + 1]); ++k) {
        const double* row = &x[at(a.column[k]) * kBlock];
        const double value = a.value[k];
        for (std::size_t c = 0; c < kBlock; ++c) sum[c] += value * row[c];
      }
      std::copy(sum.begin(), sum.end(), &y[i * kBlock]);
    }
  });
}

// Sums over the rows of what `term(row index, sums)` adds: chunk by chunk, then over the chunks.
template <class Term>
Sums reduce(std::size_t rows, Executor& executor, Term&& term) {
  std::vector<Sums> partial((rows + kRowChunk - 1) / kRowChunk, Sums{});
  executor.for_chunks(rows, kRowChunk, [&](std::size_t begin, std::size_t end, int) {
    Sums sum{};
    for (std::size_t i = begin; i < end; ++i) term(i, sum);
    partial[begin / kRowChunk] = sum;
  });
  Sums total{};
  for (const Sums& p : partial)
    for (std::size_t c = 0; c < kBlock; ++c) total[c] += p[c];
  return total;
}

}  // namespace

SparseRows transpose(const SparseRows& a, Index columns) {
  SparseRows t;
  t.start.assign(at(columns) + 1, 0);
  for (const Index c : a.column) ++t.start[at(c) + 1];
  for (std::size_t c = 0; c < at(columns); ++c) t.start[c + 1] += t.start[c];
  t.column.resize(a.column.size());
  t.value.resize(a.value.size());
  std::vector<Index> fill(t.start.begin(), t.start.end() - 1);
  for (Index r = 0; r < a.rows(); ++r)
    for (std::size_t k = at(a.start[at(r)]); k < at(a.start[at(r) + 1]); ++k) {
      const auto slot = at(fill[at(a.column[k])]++);
      t.column[slot] = r;
      t.value[slot] = a.value[k];
    }
  return t;
}

BlockPcg::BlockPcg(SparseRows g, Index unknowns, Executor& executor,
                   const ProgressCallback& progress)
    : unknowns_(unknowns), executor_(executor), g_(std::move(g)) {
  scale_.assign(at(unknowns), 0.0);
  for (std::size_t k = 0; k < g_.column.size(); ++k)
    scale_[at(g_.column[k])] += g_.value[k] * g_.value[k];
  for (double& s : scale_) s = s > 0.0 ? 1.0 / std::sqrt(s) : 0.0;
  for (std::size_t k = 0; k < g_.column.size(); ++k) g_.value[k] *= scale_[at(g_.column[k])];
  gt_ = transpose(g_, unknowns);
  preconditioner_ = IncompleteCholesky(assemble(), progress);
}

// Rows of more entries couple each of them with each (a vertex with many thousand neighbours): of
// these the preconditioner takes the diagonal alone.
std::size_t BlockPcg::widest_row() const {
  constexpr double kMostPairs = 2e4;  // an unknown; sound meshes have about a quarter
  std::size_t widest = 1024;
  for (;; widest /= 2) {
    double pairs = 0.0;
    for (std::size_t r = 0; r < at(g_.rows()); ++r) {
      const auto length = static_cast<double>(g_.start[r + 1] - g_.start[r]);
      if (length <= static_cast<double>(widest)) pairs += length * length;
    }
    if (pairs <= kMostPairs * (unknowns_ + 1000.0) || widest <= 32) return widest;
  }
}

// The upper triangle of G^T G.
UpperRows BlockPcg::assemble() const {
  const std::size_t widest = widest_row();
  // Once for the pattern, once for the values: chunks write to places of their own.
  struct Row {
    std::vector<double> sum;
    std::vector<Index> seen;
    std::vector<Index> columns;
  };
  std::vector<Row> rows(static_cast<std::size_t>(executor_.threads()));
  const auto visit = [&](std::size_t i, Row& row, bool values) {
    row.columns.clear();
    const auto add = [&row, i, values](Index j, double product) {
      if (row.seen[at(j)] != static_cast<Index>(i)) {
        row.seen[at(j)] = static_cast<Index>(i);
        row.columns.push_back(j);
        row.sum[at(j)] = 0.0;
      }
      if (values) row.sum[at(j)] += product;
    };
    for (std::size_t k = at(gt_.start[i]); k < at(gt_.start[i + 1]); ++k) {
      const std::size_t r = at(gt_.column[k]);
      const double value = gt_.value[k];
      if (at(g_.start[r + 1] - g_.start[r]) > widest) {
        add(static_cast<Index>(i), value * value);
        continue;
      }
      for (std::size_t l = at(g_.start[r + 1]); l-- > at(g_.start[r]);) {
        const Index j = g_.column[l];
        if (static_cast<std::size_t>(j) < i) break;
        add(j, value * g_.value[l]);
      }
    }
    // An unknown that no row speaks of stays as it starts.
    if (row.columns.empty() || row.seen[i] != static_cast<Index>(i)) {
      row.columns.push_back(static_cast<Index>(i));
      row.sum[i] = 1.0;
    }
  };
  const auto each_row = [&](auto&& body) {
    for (Row& row : rows) {
      row.sum.assign(at(unknowns_), 0.0);
      row.seen.assign(at(unknowns_), kNone);
    }
    executor_.for_chunks(at(unknowns_), kRowChunk, [&](std::size_t begin, std::size_t end, int w) {
      for (std::size_t i = begin; i < end; ++i) body(i, rows[static_cast<std::size_t>(w)]);
    });
  };
  UpperRows upper;
  upper.start.assign(at(unknowns_) + 1, 0);
  each_row([&](std::size_t i, Row& row) {
    visit(i, row, false);
    upper.start[i + 1] = static_cast<Index>(row.columns.size());
  });
  for (std::size_t i = 0; i < at(unknowns_); ++i) upper.start[i + 1] += upper.start[i];
  upper.column.resize(at(upper.start.back()));
  upper.value.resize(upper.column.size());
  each_row([&](std::size_t i, Row& row) {
    visit(i, row, true);
    std::sort(row.columns.begin(), row.columns.end());
    auto slot = at(upper.start[i]);
    for (const Index j : row.columns) {
      upper.column[slot] = j;
      upper.value[slot++] = static_cast<float>(row.sum[at(j)]);
    }
  });
  return upper;
}

BlockPcg::Result BlockPcg::solve(const BlockVector& g, BlockVector& x, double tolerance,
                                 int most_iterations, const ProgressCallback& progress) const {
  const std::size_t n = at(unknowns_);
  // In scaled unknowns y = x / scale.
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < kBlock; ++c)
      if (scale_[i] > 0.0) x[i * kBlock + c] /= scale_[i];

  BlockVector image(at(g_.rows()) * kBlock), r(n * kBlock), p(n * kBlock), q(n * kBlock);
  multiply(gt_, g, q, executor_);
  Sums right = reduce(n, executor_, [&](std::size_t i, Sums& sum) {
    for (std::size_t c = 0; c < kBlock; ++c) sum[c] += q[i * kBlock + c] * q[i * kBlock + c];
  });
  // Columns that are next to nothing beside the others need not be solved to their own last digit.
  constexpr double kNegligible = 1e-8;
  const double largest = *std::max_element(right.begin(), right.end());
  for (double& square : right) square = std::max(square, kNegligible * largest);
  multiply(g_, x, image, executor_);
  for (std::size_t k = 0; k < image.size(); ++k) image[k] = g[k] - image[k];
  multiply(gt_, image, r, executor_);

  IncompleteCholesky::Applied z;
  Sums rho{};
  Result result;
  result.converged = false;
  for (;; ++result.iterations) {
    const Sums squares = reduce(n, executor_, [&](std::size_t i, Sums& sum) {
      for (std::size_t c = 0; c < kBlock; ++c) sum[c] += r[i * kBlock + c] * r[i * kBlock + c];
    });
    std::array<bool, kBlock> active{};
    double worst = 0.0;
    for (std::size_t c = 0; c < kBlock; ++c) {
      active[c] = squares[c] > tolerance * tolerance * right[c];
      if (active[c] && right[c] > 0.0) worst = std::max(worst, squares[c] / right[c]);
    }
    if (std::none_of(active.begin(), active.end(), [](bool a) { return a; })) {
      result.converged = true;
      break;
    }
    if (result.iterations == most_iterations) break;
    // The residual falls about evenly on a logarithmic scale.
    report(progress, "ls-mesh",
           std::clamp(0.5 * std::log(std::max(worst, 1e-300)) / std::log(tolerance), 0.0, 1.0));

    preconditioner_.apply(r, z, executor_);
    const auto each = [&z](std::size_t i, auto&& body) {
      for (std::size_t c = 0; c < kBlock; c += z.width) {
        const float* row = z.row(i, c / z.width);
        for (std::size_t k = 0; k < z.width; ++k) body(c + k, static_cast<double>(row[k]));
      }
    };
    const Sums fresh = reduce(n, executor_, [&](std::size_t i, Sums& sum) {
      each(i, [&](std::size_t c, double value) { sum[c] += r[i * kBlock + c] * value; });
    });
    Sums beta{};
    for (std::size_t c = 0; c < kBlock; ++c)
      beta[c] = result.iterations > 0 && rho[c] > 0.0 ? fresh[c] / rho[c] : 0.0;
    rho = fresh;
    executor_.for_chunks(n, kRowChunk, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i)
        each(i, [&](std::size_t c, double value) {
          p[i * kBlock + c] = value + beta[c] * p[i * kBlock + c];
        });
    });
    multiply(g_, p, image, executor_);
    multiply(gt_, image, q, executor_);
    const Sums curvature = reduce(n, executor_, [&](std::size_t i, Sums& sum) {
      for (std::size_t c = 0; c < kBlock; ++c) sum[c] += p[i * kBlock + c] * q[i * kBlock + c];
    });
    Sums alpha{};
    for (std::size_t c = 0; c < kBlock; ++c)
      if (active[c] && curvature[c] > 0.0) alpha[c] = rho[c] / curvature[c];
    executor_.for_chunks(n, kRowChunk, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t c = 0; c < kBlock; ++c) {
          x[i * kBlock + c] += alpha[c] * p[i * kBlock + c];
          r[i * kBlock + c] -= alpha[c] * q[i * kBlock + c];
        }
    });
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < kBlock; ++c)
      if (scale_[i] > 0.0) x[i * kBlock + c] *= scale_[i];
  return result;
}

}  // namespace mimicry
