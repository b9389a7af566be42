#pragma once

#include <vector>

#include <mimicry/base/parallel.h>
#include <mimicry/base/types.h>

#include "bake/incomplete_cholesky.h"

namespace mimicry {

using BlockVector = std::vector<double>;  // n by kBlock, by rows

/// Rows of a sparse matrix.
struct SparseRows {
  std::vector<Index> start{0};  // #rows + 1
  std::vector<Index> column;    // ascending in each row
  std::vector<double> value;
  Index rows() const { return static_cast<Index>(start.size()) - 1; }
};

SparseRows transpose(const SparseRows& a, Index columns);

/// Solves min |G x - g|^2 through G^T G x = G^T g for kBlock right-hand sides at once by conjugate
/// gradients, preconditioned with an incomplete Cholesky factor of G^T G. Unknowns and rows should
/// be in an order of locality. The bits do not depend on the number of threads.
class BlockPcg {
 public:
  /// Takes G (rows by unknowns).
  BlockPcg(SparseRows g, Index unknowns, Executor& executor, const ProgressCallback& progress = {});

  struct Result {
    int iterations = 0;
    bool converged = true;  // every column's residual is below tolerance times its right-hand side
  };
  /// g: #rows by kBlock. x: #unknowns by kBlock, the start and the answer.
  Result solve(const BlockVector& g, BlockVector& x, double tolerance, int most_iterations,
               const ProgressCallback& progress) const;

  Index unknowns() const { return unknowns_; }

 private:
  std::size_t widest_row() const;
  UpperRows assemble() const;

  Index unknowns_;
  Executor& executor_;
  SparseRows g_;  // columns scaled so that G^T G has a unit diagonal
  SparseRows gt_;
  std::vector<double> scale_;
  IncompleteCholesky preconditioner_;
};

}  // namespace mimicry
