#pragma once

#include <vector>

#include <mimicry/base/types.h>

namespace mimicry {

/// `Bvh` without a tree: every query visits every primitive, in order. The oracle of the tests.
template <int Dim, class PrimitiveType>
class BruteForce {
 public:
  using Primitive = PrimitiveType;
  using Point = Eigen::Matrix<double, Dim, 1>;

  BruteForce() = default;
  template <class Get>
  BruteForce(Index count, Get&& primitive) {
    for (Index i = 0; i < count; ++i) primitives_.push_back(primitive(i));
  }
  template <class Get>
  void refit(Get&& primitive) {
    for (Index i = 0; i < size(); ++i) primitives_[static_cast<std::size_t>(i)] = primitive(i);
  }

  Index size() const { return static_cast<Index>(primitives_.size()); }
  std::size_t memory_bytes() const { return primitives_.capacity() * sizeof(Primitive); }

  template <class Visit>
  void nearest(const Point&, double bound2, Visit&& visit) const {
    visit_all(bound2, visit);
  }
  template <class Visit>
  bool containing(const Point& y, Visit&& visit) const {
    for (Index i = 0; i < size(); ++i) {
      const Primitive& p = primitives_[static_cast<std::size_t>(i)];
      if (p.box().contains(y) && visit(i, p)) return true;
    }
    return false;
  }
  template <class Visit>
  void along(const Point&, const Point&, double bound, Visit&& visit) const {
    visit_all(bound, visit);
  }

 private:
  template <class Visit>
  void visit_all(double bound, Visit&& visit) const {
    for (Index i = 0; i < size(); ++i)
      bound = visit(i, primitives_[static_cast<std::size_t>(i)], bound);
  }

  std::vector<Primitive> primitives_;
};

}  // namespace mimicry
