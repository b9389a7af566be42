#pragma once

#include <array>
#include <span>
#include <vector>

#include "bake/delaunay.h"

namespace mimicry {

/// Elements (tetrahedra or triangles) around each vertex: those of vertex v are
/// element[start[v]] to element[start[v + 1] - 1], rising.
template <class Element>
struct Incidence {
  Incidence(std::span<const Element> elements, std::size_t vertices) : start(vertices + 1, 0) {
    for (const Element& e : elements)
      for (const Index v : e) ++start[static_cast<std::size_t>(v) + 1];
    for (std::size_t v = 0; v < vertices; ++v) start[v + 1] += start[v];
    element.resize(static_cast<std::size_t>(start.back()));
    std::vector<Index> fill(start.begin(), start.end() - 1);
    for (std::size_t t = 0; t < elements.size(); ++t)
      for (const Index v : elements[t])
        element[static_cast<std::size_t>(fill[static_cast<std::size_t>(v)]++)] =
            static_cast<Index>(t);
  }
  std::vector<Index> start, element;
};

/// For each corner, twice the area of the opposite face times its unit normal toward the corner:
/// over the sixfold volume it is the gradient of the corner's hat function.
std::array<Vec3, 4> area_vectors(std::span<const Vec3> positions, const Tet& t);

/// Gradients in the tetrahedra that are too flat to have one of their own (`is_flat`): the mean of
/// those of the tetrahedra across their faces. With nothing in their place the Laplacian of a
/// linear function would not vanish around them, and values would be rough at the size of
/// elements however fine they are.
class BorrowedGradients {
 public:
  /// The gradient of x is the sum of x(vertex) weight.
  struct Term {
    Index vertex;
    Vec3 weight;
  };

  BorrowedGradients(std::span<const Vec3> positions, std::span<const Tet> tets,
                    const Incidence<Tet>& around);

  /// Empty where the tetrahedron is not flat, or all across its faces are, or outside.
  std::span<const Term> of(Index tet) const;

 private:
  std::vector<Index> flat_;  // rising
  std::vector<std::size_t> start_ = {0};
  std::vector<Term> terms_;
};

}  // namespace mimicry
