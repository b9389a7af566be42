#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/QR>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/mesh/connect.h>

#include "bake/ls_mesh.h"
#include "bake/mds.h"
#include "bake/normal_constraints.h"
#include "bake/quality.h"
#include "bake/samples.h"
#include "bake/shell.h"
#include "bake/unit_mesh.h"
#include "geodesic/fast_marching.h"
#include "phong/tangent_bases.h"

namespace mimicry {
namespace {

void check(const BakeOptions& options) {
  const auto refuse = [](const std::string& what) {
    throw Error(ErrorKind::invalid_input, "bake: " + what);
  };
  if (options.dimension < 3 || options.dimension > 8)
    refuse("dimension " + std::to_string(options.dimension) + "; it must be 3 to 8");
  if (options.samples < 10 || options.samples > 20000)
    refuse(std::to_string(options.samples) + " samples; there must be 10 to 20000");
  if (!(options.offset >= 1e-3 && options.offset <= 0.5))
    refuse("offset " + std::to_string(options.offset) +
           "; it must be 0.001 to 0.5 of the diagonal");
}

// The affine map from R^3 to the samples' values that fits best: where nothing else is known.
class AffineGuess {
 public:
  AffineGuess(std::span<const Vec3> positions, std::span<const Index> samples,
              const Values& values) {
    Eigen::MatrixXd from(static_cast<Eigen::Index>(samples.size()), 4);
    for (std::size_t k = 0; k < samples.size(); ++k)
      from.row(static_cast<Eigen::Index>(k)) << positions[at(samples[k])].transpose(), 1.0;
    map_ = from.completeOrthogonalDecomposition().solve(Eigen::MatrixXd(values));
  }
  Eigen::RowVectorXd operator()(const Vec3& p) const {
    return p.transpose() * map_.topRows<3>() + map_.row(3);
  }

 private:
  Eigen::MatrixXd map_;  // 4 by dimension
};

// Vertices whose part of the elements holds no fixed vertex float freely: they are held, softly and
// once each, near where the affine map puts them.
template <class Element>
std::vector<Index> floating_vertices(std::size_t vertices, std::span<const Element> elements,
                                     std::span<const Index> fixed) {
  std::vector<Index> parent(vertices);
  for (std::size_t v = 0; v < vertices; ++v) parent[v] = static_cast<Index>(v);
  const auto root = [&parent](Index v) {
    while (parent[at(v)] != v) v = parent[at(v)] = parent[at(parent[at(v)])];
    return v;
  };
  for (const Element& e : elements)
    for (std::size_t k = 1; k < e.size(); ++k) {
      const Index a = root(e[0]), b = root(e[k]);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  std::vector<bool> held(vertices, false);
  for (const Index v : fixed) held[at(root(v))] = true;
  std::vector<Index> floating;
  for (std::size_t v = 0; v < vertices; ++v)
    if (!held[at(root(static_cast<Index>(v)))]) floating.push_back(static_cast<Index>(v));
  return floating;
}

class LsMeshStage {
 public:
  LsMeshStage(const TriangleMesh& mesh, const Shell& shell, std::span<const Index> samples,
              const Values& sample_values, Executor& executor, const ProgressCallback& progress)
      : mesh_(mesh),
        shell_(shell),
        samples_(samples),
        sample_values_(sample_values),
        executor_(executor),
        progress_(progress),
        guess_(shell.positions, samples, sample_values),
        work_left_(kWork + kWorkOfFace * mesh.face_count()) {}

  Values run(BakeQuality& quality) {
    if (shell_.is_lattice) return lattice(quality);
    Values values = tied(quality);
    if (values.cols() <= kDimension) turn_normals(values, quality);
    return values;
  }

 private:
  static constexpr double kHold = 1e-2;  // strength that holds what floats
  static constexpr int kMostDirect = 150;
  static constexpr int kMost = 1000;
  // Vertices times iterations that all solves of a bake may take together, about a microsecond
  // each: several times what sound meshes take.
  static constexpr double kWork = 16e6;
  static constexpr double kWorkOfFace = 800.0;

  template <class Element>
  LsMeshResult solve(LsMeshInput input, std::span<const Element> elements,
                     std::vector<SoftConstraint> soft, Values soft_values, int most,
                     double tolerance = 1e-6) {
    // Tied vertices follow their corners.
    std::vector<bool> tied(input.positions.size(), false);
    for (const Tie& tie : input.ties) tied[at(tie.vertex)] = true;
    std::vector<Index> floating = floating_vertices(input.positions.size(), elements, input.fixed);
    if (!soft.empty() && input.fixed.empty()) floating.clear();  // held by what is given
    std::erase_if(floating, [&tied](Index v) { return tied[at(v)]; });
    const Eigen::Index given = soft_values.rows();
    soft_values.conservativeResize(given + static_cast<Eigen::Index>(floating.size()),
                                   sample_values_.cols());
    for (std::size_t k = 0; k < floating.size(); ++k) {
      SoftConstraint hold;
      hold.vertices[0] = floating[k];
      hold.weights[0] = 1.0;
      hold.strength = kHold;
      hold.row = static_cast<Index>(given + static_cast<Eigen::Index>(k));
      soft_values.row(hold.row) = guess_(input.positions[at(floating[k])]);
      soft.push_back(hold);
    }
    input.soft = soft;
    input.soft_values = &soft_values;
    const auto vertices = static_cast<double>(input.positions.size());
    most = static_cast<int>(std::min<double>(most, std::max(0.0, work_left_ / vertices)));
    LsMeshResult result =
        ls_mesh(input, {.tolerance = tolerance, .most_iterations = most}, executor_, progress_);
    work_left_ -= vertices * result.iterations;
    return result;
  }

  Values guesses(std::size_t count) const {
    Values start(static_cast<Eigen::Index>(count), sample_values_.cols());
    for (std::size_t v = 0; v < count; ++v)
      start.row(static_cast<Eigen::Index>(v)) = guess_(shell_.positions[v]);
    return start;
  }

  LsMeshInput of_shell() const {
    return {.positions = shell_.positions, .tets = shell_.tets, .ties = shell_.ties};
  }

  std::vector<Index> mesh_vertices() const {
    std::vector<Index> all(at(mesh_.vertex_count()));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  // The surface alone.
  LsMeshResult surface() {
    const Values start = guesses(at(mesh_.vertex_count()));
    LsMeshInput input;
    input.positions = mesh_.positions();
    input.faces = mesh_.faces();
    input.fixed = samples_;
    input.fixed_values = &sample_values_;
    input.start = &start;
    return solve<Face>(input, mesh_.faces(), {}, {}, kMost);
  }

  Values tied(BakeQuality& quality) {
    Values start = guesses(shell_.positions.size());
    LsMeshInput input = of_shell();
    input.fixed = samples_;
    input.fixed_values = &sample_values_;
    input.start = &start;
    LsMeshResult result = solve<Tet>(input, shell_.tets, {}, {}, kMostDirect);
    quality.ls_mesh_iterations = result.iterations;
    if (result.converged) return std::move(result.values);

    // A slow one: the surface first, then what hangs on it, then all of it from there.
    quality.surface_first = true;
    const Values on_surface = surface().values;
    const std::vector<Index> all = mesh_vertices();
    start = std::move(result.values);
    input.fixed = all;
    input.fixed_values = &on_surface;
    start = solve<Tet>(input, shell_.tets, {}, {}, kMostDirect).values;
    input.fixed = samples_;
    input.fixed_values = &sample_values_;
    result = solve<Tet>(input, shell_.tets, {}, {}, kMost);
    quality.ls_mesh_iterations += result.iterations;
    quality.hit_a_cap = quality.hit_a_cap || !result.converged;
    return std::move(result.values);
  }

  // The shell once more around the surface's values, which stay: from what is nearly the solution,
  // and where the last digits do not show.
  void turn_normals(Values& values, BakeQuality& quality) {
    constexpr double kLoose = 1e-4;
    NormalConstraints constraints = normal_constraints(mesh_, shell_, values);
    const std::vector<Index> all = mesh_vertices();
    const Values on_surface = values.topRows(mesh_.vertex_count());
    LsMeshInput input = of_shell();
    input.fixed = all;
    input.fixed_values = &on_surface;
    input.start = &values;
    LsMeshResult result = solve<Tet>(input, shell_.tets, std::move(constraints.constraints),
                                     std::move(constraints.values), kMost, kLoose);
    quality.ls_mesh_iterations += result.iterations;
    quality.hit_a_cap = quality.hit_a_cap || !result.converged;
    values = std::move(result.values);
  }

  // The surface's own solution holds the lattice softly.
  Values lattice(BakeQuality& quality) {
    quality.surface_first = true;
    Values on_surface = surface().values;
    const Values start = guesses(shell_.positions.size());
    std::vector<SoftConstraint> soft = shell_.bindings;
    // Rows of the energy are second differences over the square root of a length.
    const Vec3 step =
        shell_.positions[at(shell_.tets.front()[3])] - shell_.positions[at(shell_.tets.front()[0])];
    for (SoftConstraint& s : soft) s.strength = 10.0 / std::sqrt(step.norm());
    LsMeshInput input;
    input.positions = shell_.positions;
    input.tets = shell_.tets;
    input.start = &start;
    // Its steps are rougher than what the last digits would change.
    constexpr double kRough = 1e-4;
    LsMeshResult result =
        solve<Tet>(input, shell_.tets, std::move(soft), on_surface, kMost, kRough);
    quality.ls_mesh_iterations = result.iterations;
    quality.hit_a_cap = quality.hit_a_cap || !result.converged;
    result.values.topRows(mesh_.vertex_count()) = on_surface;
    return std::move(result.values);
  }

  const TriangleMesh& mesh_;
  const Shell& shell_;
  std::span<const Index> samples_;
  const Values& sample_values_;
  Executor& executor_;
  const ProgressCallback& progress_;
  AffineGuess guess_;
  double work_left_;
};

}  // namespace

Embedding bake(const TriangleMesh& given, const BakeOptions& options, int threads,
               const ProgressCallback& caller) {
  check(options);
  const TriangleMesh mesh = connect(given).mesh;
  Executor executor(threads);
  // Stages tell how far they are; long loops say it again, so that they can be cancelled.
  std::string stage = "shell";
  double fraction = 0.0;
  const ProgressCallback progress = [&](const Progress& now) {
    stage = now.stage;
    fraction = now.fraction;
    return !caller || caller(now);
  };
  executor.set_between([&, chunks = 0U]() mutable {
    if (++chunks % 16 == 0) report(caller, stage, fraction);
  });
  const UnitMesh unit = make_unit_mesh(mesh, grid_half_side(options.offset));

  Embedding out;
  out.dimension = options.dimension;
  out.mesh_vertex_count = mesh.vertex_count();
  out.faces.assign(mesh.faces().begin(), mesh.faces().end());
  out.mesh_hash = content_hash(mesh);
  out.diagonal = unit.diagonal;
  out.options = options;
  BakeQuality& quality = out.quality;

  const Shell shell = make_some_shell(unit.mesh, {.offset = options.offset}, executor, progress);
  quality.is_lattice = shell.is_lattice;
  quality.hit_a_cap = shell.hit_a_cap;
  quality.shell_rounds = shell.rounds;
  quality.added_vertices = shell.added_vertices;
  quality.missing_edges = shell.missing_edges;
  quality.pierced_faces = shell.pierced_faces;
  quality.crossing_faces = shell.crossing_faces;
  quality.joined_vertices = mesh.vertex_count() - unit.mesh.vertex_count();

  std::vector<Index> samples;
  Values sample_values;
  {
    const FastMarching march(unit.mesh);
    report(progress, "samples", 0.0);
    samples = farthest_points(unit.mesh, march, options.samples, progress);
    const Eigen::MatrixXd distances =
        sample_distances(unit.mesh, march, samples, executor, progress);
    MdsResult mds =
        multidimensional_scaling(distances, {.dimension = options.dimension}, executor, progress);
    sample_values = mds.positions;
    quality.samples = static_cast<std::int32_t>(samples.size());
    quality.stress = mds.stress;
    quality.distortion = mds.distortion;
    quality.mds_iterations = mds.iterations;
    quality.hit_a_cap = quality.hit_a_cap || !mds.converged;
  }

  report(progress, "ls-mesh", 0.0);
  const Values values =
      LsMeshStage(unit.mesh, shell, samples, sample_values, executor, progress).run(quality);
  quality.sliver_percent = sliver_percent(shell.tets, values);

  // From the unit mesh to the target: joined vertices become several again.
  const Index inner = unit.mesh.vertex_count(), outer = mesh.vertex_count();
  const auto renumber = [&](Index v) { return v < inner ? unit.first[at(v)] : v - inner + outer; };
  const std::size_t count = shell.positions.size() + at(outer - inner);
  out.positions.resize(count);
  out.values.resize(count * at(options.dimension));
  const auto put_value = [&](Index to, Index from) {
    for (Eigen::Index c = 0; c < options.dimension; ++c)
      out.values[at(to) * at(options.dimension) + static_cast<std::size_t>(c)] =
          unit.diagonal * values(from, c);
  };
  for (Index v = 0; v < outer; ++v) {
    out.positions[at(v)] = mesh.position(v);
    put_value(v, unit.joined[at(v)]);
  }
  for (Index v = inner; v < static_cast<Index>(shell.positions.size()); ++v) {
    out.positions[at(renumber(v))] = unit.to_target(shell.positions[at(v)]);
    put_value(renumber(v), v);
  }
  // To the last bit, so that tetrahedra that overlap have the same coordinates.
  for (std::size_t k = 0; k < shell.copy_of.size(); ++k)
    out.positions[count - shell.copy_of.size() + k] = out.positions[at(renumber(shell.copy_of[k]))];
  out.overlapping_tets = shell.overlapping_tets;
  out.tets.reserve(shell.tets.size());
  for (const Tet& t : shell.tets)
    out.tets.push_back({renumber(t[0]), renumber(t[1]), renumber(t[2]), renumber(t[3])});
  sort_for_search(out);
  report(progress, "done", 1.0);
  return out;
}

}  // namespace mimicry
