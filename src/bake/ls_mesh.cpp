#include "bake/ls_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>

#include "bake/block_pcg.h"
#include "bake/flat_tets.h"
#include "bake/morton.h"

namespace mimicry {
namespace {

// Stiffness of the element's corner `k` against its other corners, and its share of the mass; false
// where the element is left out. weights[j] is the integral of the product of the gradients of the
// hat functions of k and j.
bool stiffness(std::span<const Vec3> positions, const Tet& t, std::size_t k,
               std::array<double, 4>& weights, double& mass) {
  const Vec3 &a = positions[at(t[0])], &d = positions[at(t[3])];
  if (is_flat(a, positions[at(t[1])], positions[at(t[2])], d)) return false;
  const std::array<Vec3, 4> area = area_vectors(positions, t);
  const double volume = area[3].dot(d - a) / 6.0;
  for (std::size_t j = 0; j < 4; ++j) weights[j] = area[k].dot(area[j]) / (36.0 * volume);
  mass = volume / 4.0;
  return true;
}

bool stiffness(std::span<const Vec3> positions, const Face& f, std::size_t k,
               std::array<double, 4>& weights, double& mass) {
  const Vec3& a = positions[at(f[0])];
  const Vec3& b = positions[at(f[1])];
  const Vec3& c = positions[at(f[2])];
  const double twice_area = (b - a).cross(c - a).norm();
  const double longest =
      std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()});
  constexpr double kFlat = 1e-3;
  if (!(twice_area > kFlat * longest)) return false;
  const std::array<Vec3, 3> edge = {c - b, a - c, b - a};
  for (std::size_t j = 0; j < 3; ++j) weights[j] = edge[k].dot(edge[j]) / (2.0 * twice_area);
  mass = twice_area / 6.0;
  return true;
}

// Where each vertex's value comes from.
struct Source {
  Index unknown = kNone;
  Index fixed = kNone;
  Index tie = kNone;
};

// One least-squares row under construction: a sum per unknown, and what the fixed ones contribute.
class RowSum {
 public:
  RowSum(std::size_t unknowns, Eigen::Index dimension)
      : sum_(unknowns, 0.0), seen_(unknowns, kNone), constant_(dimension) {}
  void begin(Index stamp) {
    stamp_ = stamp;
    columns_.clear();
    constant_.setZero();
  }
  void add(const LsMeshInput& input, const std::vector<Source>& sources, Index v, double weight) {
    const Source& s = sources[at(v)];
    if (s.tie != kNone) {
      const Tie& tie = input.ties[at(s.tie)];
      for (std::size_t k = 0; k < 3; ++k)
        if (tie.corners[k] != kNone && tie.weights[static_cast<Eigen::Index>(k)] != 0.0)
          add(input, sources, tie.corners[k], weight * tie.weights[static_cast<Eigen::Index>(k)]);
    } else if (s.fixed != kNone) {
      constant_ += weight * input.fixed_values->row(s.fixed);
    } else {
      if (seen_[at(s.unknown)] != stamp_) {
        seen_[at(s.unknown)] = stamp_;
        sum_[at(s.unknown)] = 0.0;
        columns_.push_back(s.unknown);
      }
      sum_[at(s.unknown)] += weight;
    }
  }
  void clear() {
    for (const Index u : columns_) sum_[at(u)] = 0.0;
    constant_.setZero();
  }
  std::vector<Index>& columns() { return columns_; }
  double sum(Index unknown) const { return sum_[at(unknown)]; }
  const Eigen::RowVectorXd& constant() const { return constant_; }

 private:
  std::vector<double> sum_;
  std::vector<Index> seen_;
  std::vector<Index> columns_;
  Eigen::RowVectorXd constant_;
  Index stamp_ = kNone;
};

// What flat elements borrow: triangles nothing.
struct NothingBorrowed {
  explicit NothingBorrowed(const auto&...) {}
};
template <class Element>
using Borrowed =
    std::conditional_t<std::is_same_v<Element, Tet>, BorrowedGradients, NothingBorrowed>;

// The elements as rows of M^-1/2 L are made of them.
template <class Element>
struct Elements {
  std::span<const Element> all;
  Incidence<Element> around;
  Borrowed<Element> borrowed;

  Elements(std::span<const Element> elements, std::span<const Vec3> positions)
      : all(elements), around(elements, positions.size()), borrowed(positions, elements, around) {}
};

// The row of vertex v in M^-1/2 L x, but for the factor `scale`.
template <class Element>
void add_vertex_row(const LsMeshInput& input, const Elements<Element>& elements,
                    const std::vector<Source>& sources, Index v, RowSum& row, double& scale) {
  double mass = 0.0;
  std::array<double, 4> weights{};
  const Incidence<Element>& around = elements.around;
  const auto begin = at(around.start[at(v)]), end = at(around.start[at(v) + 1]);
  for (std::size_t i = begin; i < end; ++i) {
    const Index number = around.element[i];
    const Element& e = elements.all[at(number)];
    const auto k = static_cast<std::size_t>(std::find(e.begin(), e.end(), v) - e.begin());
    double share = 0.0;
    if (!stiffness(input.positions, e, k, weights, share)) {
      if constexpr (std::is_same_v<Element, Tet>) {
        const Vec3 flux = area_vectors(input.positions, e)[k] / 6.0;
        for (const BorrowedGradients::Term& term : elements.borrowed.of(number))
          row.add(input, sources, term.vertex, flux.dot(term.weight));
      }
      continue;
    }
    mass += share;
    for (std::size_t j = 0; j < e.size(); ++j) row.add(input, sources, e[j], weights[j]);
  }
  if (mass > 0.0) {
    scale = 1.0 / std::sqrt(mass);
    return;
  }
  // Flat elements only: as if it stood among its neighbours in a regular mesh of their distance.
  row.clear();
  double distance = 0.0;
  int count = 0;
  for (std::size_t i = begin; i < end; ++i)
    for (const Index u : elements.all[at(around.element[i])])
      if (u != v) {
        distance += (input.positions[at(u)] - input.positions[at(v)]).norm();
        ++count;
        row.add(input, sources, v, 1.0);
        row.add(input, sources, u, -1.0);
      }
  distance /= std::max(count, 1);
  scale = distance > 0.0 ? 1.0 / (count * std::sqrt(distance)) : 0.0;
}

template <class Element>
LsMeshResult solve(const LsMeshInput& input, std::span<const Element> elements,
                   const LsMeshOptions& options, Executor& executor,
                   const ProgressCallback& progress) {
  const std::size_t vertices = input.positions.size();
  const Eigen::Index dimension =
      input.fixed_values ? input.fixed_values->cols() : input.soft_values->cols();

  // Unknowns and rows along the Morton curve.
  std::vector<std::pair<std::uint64_t, Index>> keys(vertices);
  Eigen::AlignedBox3d box;
  for (const Vec3& p : input.positions) box.extend(p);
  const double width = std::max(box.sizes().maxCoeff(), 1e-300);
  for (std::size_t v = 0; v < vertices; ++v) {
    const Vec3 p = (input.positions[v] - box.min()) / width * 2097151.0;
    keys[v] = {morton(static_cast<std::uint64_t>(p.x()), static_cast<std::uint64_t>(p.y()),
                      static_cast<std::uint64_t>(p.z())),
               static_cast<Index>(v)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Source> sources(vertices);
  for (std::size_t k = 0; k < input.fixed.size(); ++k)
    sources[at(input.fixed[k])].fixed = static_cast<Index>(k);
  for (std::size_t k = 0; k < input.ties.size(); ++k) {
    assert(sources[at(input.ties[k].vertex)].fixed == kNone);
    sources[at(input.ties[k].vertex)].tie = static_cast<Index>(k);
  }
  std::vector<Index> unknown_vertices;
  for (const auto& [key, v] : keys) {
    Source& s = sources[at(v)];
    if (s.fixed != kNone || s.tie != kNone) continue;
    s.unknown = static_cast<Index>(unknown_vertices.size());
    unknown_vertices.push_back(v);
  }
  const std::size_t unknowns = unknown_vertices.size();

  // Rows in chunks, joined in their order afterwards.
  struct Chunk {
    SparseRows rows;
    std::vector<double> constants;
  };
  constexpr std::size_t kMatrixChunk = 1024;
  const std::size_t row_count = vertices + input.soft.size();
  std::vector<Chunk> chunks((row_count + kMatrixChunk - 1) / kMatrixChunk);
  {
    const Elements<Element> parts(elements, input.positions);
    std::vector<RowSum> sums(static_cast<std::size_t>(executor.threads()),
                             RowSum(unknowns, dimension));
    executor.for_chunks(
        row_count, kMatrixChunk, [&](std::size_t begin, std::size_t end, int worker) {
          RowSum& row = sums[static_cast<std::size_t>(worker)];
          Chunk& chunk = chunks[begin / kMatrixChunk];
          for (std::size_t i = begin; i < end; ++i) {
            row.begin(static_cast<Index>(i));
            double scale = 1.0;
            Eigen::RowVectorXd wished = Eigen::RowVectorXd::Zero(dimension);
            if (i < vertices) {
              add_vertex_row(input, parts, sources, keys[i].second, row, scale);
            } else {
              const SoftConstraint& soft = input.soft[i - vertices];
              for (std::size_t k = 0; k < 4; ++k)
                if (soft.vertices[k] != kNone)
                  row.add(input, sources, soft.vertices[k],
                          soft.weights[static_cast<Eigen::Index>(k)]);
              scale = soft.strength;
              wished = input.soft_values->row(soft.row);
            }
            std::sort(row.columns().begin(), row.columns().end());
            for (const Index u : row.columns()) {
              chunk.rows.column.push_back(u);
              chunk.rows.value.push_back(scale * row.sum(u));
            }
            chunk.rows.start.push_back(static_cast<Index>(chunk.rows.column.size()));
            for (Eigen::Index c = 0; c < dimension; ++c)
              chunk.constants.push_back(scale * (wished[c] - row.constant()[c]));
          }
        });
  }
  SparseRows g;
  std::vector<double> constants;
  constants.reserve(row_count * static_cast<std::size_t>(dimension));
  for (Chunk& chunk : chunks) {
    const Index base = g.start.back();
    for (std::size_t k = 1; k < chunk.rows.start.size(); ++k)
      g.start.push_back(base + chunk.rows.start[k]);
    g.column.insert(g.column.end(), chunk.rows.column.begin(), chunk.rows.column.end());
    g.value.insert(g.value.end(), chunk.rows.value.begin(), chunk.rows.value.end());
    constants.insert(constants.end(), chunk.constants.begin(), chunk.constants.end());
    chunk = {};
  }
  chunks = {};

  const BlockPcg pcg(std::move(g), static_cast<Index>(unknowns), executor, progress);
  LsMeshResult result;
  result.values = Values::Zero(static_cast<Eigen::Index>(vertices), dimension);
  for (Eigen::Index first = 0; first < dimension; first += kBlock) {
    const Eigen::Index width_here = std::min<Eigen::Index>(kBlock, dimension - first);
    BlockVector right(row_count * kBlock, 0.0), x(unknowns * kBlock, 0.0);
    for (std::size_t i = 0; i < row_count; ++i)
      for (Eigen::Index c = 0; c < width_here; ++c)
        right[i * kBlock + static_cast<std::size_t>(c)] =
            constants[i * static_cast<std::size_t>(dimension) +
                      static_cast<std::size_t>(first + c)];
    if (input.start)
      for (std::size_t u = 0; u < unknowns; ++u)
        for (Eigen::Index c = 0; c < width_here; ++c)
          x[u * kBlock + static_cast<std::size_t>(c)] =
              (*input.start)(unknown_vertices[u], first + c);
    const BlockPcg::Result solved =
        pcg.solve(right, x, options.tolerance, options.most_iterations, progress);
    result.iterations = std::max(result.iterations, solved.iterations);
    result.converged = result.converged && solved.converged;
    for (std::size_t u = 0; u < unknowns; ++u)
      for (Eigen::Index c = 0; c < width_here; ++c)
        result.values(unknown_vertices[u], first + c) = x[u * kBlock + static_cast<std::size_t>(c)];
  }
  for (std::size_t k = 0; k < input.fixed.size(); ++k)
    result.values.row(input.fixed[k]) = input.fixed_values->row(static_cast<Eigen::Index>(k));
  for (const Tie& tie : input.ties) {
    result.values.row(tie.vertex).setZero();
    for (std::size_t k = 0; k < 3; ++k)
      if (tie.corners[k] != kNone)
        result.values.row(tie.vertex) +=
            tie.weights[static_cast<Eigen::Index>(k)] * result.values.row(tie.corners[k]);
  }
  return result;
}

}  // namespace

bool is_flat(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  constexpr double kFlat = 6.0 * 1e-2;  // of the sixfold volume
  const double longest =
      std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (d - a).squaredNorm(),
                (c - b).squaredNorm(), (d - b).squaredNorm(), (d - c).squaredNorm()});
  return !((b - a).cross(c - a).dot(d - a) > kFlat * longest * std::sqrt(longest));
}

LsMeshResult ls_mesh(const LsMeshInput& input, const LsMeshOptions& options, Executor& executor,
                     const ProgressCallback& progress) {
  assert(input.fixed.empty() || input.fixed_values);
  assert(input.soft.empty() || input.soft_values);
  assert(input.fixed_values || input.soft_values);
  if (!input.faces.empty()) return solve<Face>(input, input.faces, options, executor, progress);
  return solve<Tet>(input, input.tets, options, executor, progress);
}

}  // namespace mimicry
