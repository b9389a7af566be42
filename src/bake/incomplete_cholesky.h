#pragma once

#include <vector>

#include <mimicry/base/parallel.h>
#include <mimicry/base/types.h>

namespace mimicry {

/// Right-hand sides that are solved together: one cache line of doubles, two registers of floats.
inline constexpr int kBlock = 8;

/// Upper triangle of a symmetric matrix with a unit diagonal, by rows; the diagonal is first in
/// each.
struct UpperRows {
  std::vector<Index> start{0};  // #rows + 1
  std::vector<Index> column;    // ascending in each row
  std::vector<float> value;
  Index rows() const { return static_cast<Index>(start.size()) - 1; }
};

/// Approximate inverse of a sparse symmetric positive definite matrix: its Cholesky factor without
/// the entries that are small (Saad 2003, 10.8.2), in single precision, of the matrix with as large
/// a shift of its diagonal as it takes. Unknowns should be in an order of locality. The same bits
/// whatever the number of threads.
///
/// A factor on the matrix's own pattern needs a shift of 0.03 on the shells of uneven meshes, far
/// above the least eigenvalues (1e-5, of a dozen neighbours at the shell's outer side), which
/// conjugate gradients then have to find one by one. With one and a half times the entries, those
/// that weigh most, a fifth of the shift does, and half of the iterations.
class IncompleteCholesky {
 public:
  IncompleteCholesky() = default;
  explicit IncompleteCholesky(const UpperRows& matrix, const ProgressCallback& progress = {});

  /// #rows by kBlock, in groups of columns that one thread writes.
  struct Applied {
    std::vector<float> values;
    std::size_t rows = 0;
    std::size_t width = kBlock;  // columns of a group
    const float* row(std::size_t i, std::size_t group) const {
      return &values[(group * rows + i) * width];
    }
  };
  /// z = (L L^T)^-1 r. r: #rows by kBlock, by rows.
  void apply(const std::vector<double>& r, Applied& z, Executor& executor) const;

  float shift() const { return shift_; }

 private:
  bool factor(const UpperRows& matrix, float shift, const ProgressCallback& progress);
  template <std::size_t Width>
  void apply_group(const std::vector<double>& r, std::size_t first, float* z) const;

  // Below the diagonal by columns, rows ascending; and the inverse of the diagonal.
  std::vector<std::size_t> start_;
  std::vector<Index> row_;
  std::vector<float> value_;
  std::vector<float> inverse_;
  float shift_ = 0.0F;
};

}  // namespace mimicry
