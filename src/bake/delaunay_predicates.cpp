#include <algorithm>
#include <cmath>

#include "bake/delaunay.h"
#include "base/compiler.h"

namespace mimicry {
namespace {

// Differences of 24-bit coordinates are below 2^24, their products and sums of two are exact in 64
// bits, an orientation is below 2^75, and the whole in-sphere determinant below 2^126.3.

int sign(double x) {
  return (x > 0.0) - (x < 0.0);
}
int sign(Int128 x) {
  return (x > 0) - (x < 0);
}

struct Differences {
  Differences(const GridPoint& a, const GridPoint& p)
      : x(a[0] - p[0]), y(a[1] - p[1]), z(a[2] - p[2]) {}
  double reach() const {
    return static_cast<double>(std::max({std::abs(x), std::abs(y), std::abs(z)}));
  }
  std::int32_t x, y, z;
};

template <class Real>
struct Row {
  explicit Row(const Differences& d)
      : x(static_cast<Real>(d.x)), y(static_cast<Real>(d.y)), z(static_cast<Real>(d.z)) {}
  Real x, y, z;
  Real square() const { return x * x + y * y + z * z; }
};

template <class Plane, class Real>
Real orientation_determinant(const Row<Plane>& a, const Row<Plane>& b, const Row<Plane>& c) {
  return static_cast<Real>(a.x) * static_cast<Real>(b.y * c.z - b.z * c.y) +
         static_cast<Real>(a.y) * static_cast<Real>(b.z * c.x - b.x * c.z) +
         static_cast<Real>(a.z) * static_cast<Real>(b.x * c.y - b.y * c.x);
}

// Plane holds products of two differences exactly, Real the rest.
template <class Plane, class Real>
Real in_sphere_determinant(const Row<Plane>& a, const Row<Plane>& b, const Row<Plane>& c,
                           const Row<Plane>& d) {
  const Real ab = static_cast<Real>(a.x * b.y - b.x * a.y);
  const Real bc = static_cast<Real>(b.x * c.y - c.x * b.y);
  const Real cd = static_cast<Real>(c.x * d.y - d.x * c.y);
  const Real da = static_cast<Real>(d.x * a.y - a.x * d.y);
  const Real ac = static_cast<Real>(a.x * c.y - c.x * a.y);
  const Real bd = static_cast<Real>(b.x * d.y - d.x * b.y);
  const Real az = static_cast<Real>(a.z), bz = static_cast<Real>(b.z);
  const Real cz = static_cast<Real>(c.z), dz = static_cast<Real>(d.z);
  const Real abc = az * bc - bz * ac + cz * ab;
  const Real bcd = bz * cd - cz * bd + dz * bc;
  const Real cda = cz * da + dz * ac + az * cd;
  const Real dab = dz * ab + az * bd + bz * da;
  return (static_cast<Real>(c.square()) * dab - static_cast<Real>(d.square()) * abc) +
         (static_cast<Real>(a.square()) * bcd - static_cast<Real>(b.square()) * cda);
}

// Bounds on the rounding of the two determinants above for differences up to 1: at most 6 and 72
// products of unit size, each rounded no more than 10 and 16 times.
constexpr double kOrientationError = 6.0 * 10.0 * 1.2e-16;
constexpr double kSphereError = 72.0 * 16.0 * 1.2e-16;

}  // namespace

int orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const Differences u(b, a), v(c, a), w(d, a);
  const double value =
      orientation_determinant<double, double>(Row<double>(u), Row<double>(v), Row<double>(w));
  const double reach = std::max({u.reach(), v.reach(), w.reach()});
  if (std::abs(value) > kOrientationError * (reach * reach * reach)) return sign(value);
  using Row64 = Row<std::int64_t>;
  return sign(orientation_determinant<std::int64_t, Int128>(Row64(u), Row64(v), Row64(w)));
}

int in_sphere(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d,
              const GridPoint& p) {
  const Differences i(a, p), j(b, p), k(c, p), l(d, p);
  const double value = in_sphere_determinant<double, double>(Row<double>(i), Row<double>(j),
                                                             Row<double>(k), Row<double>(l));
  const double reach = std::max({i.reach(), j.reach(), k.reach(), l.reach()});
  const double square = reach * reach;
  if (std::abs(value) > kSphereError * (square * square * reach)) return sign(value);
  using Row64 = Row<std::int64_t>;
  return sign(in_sphere_determinant<std::int64_t, Int128>(Row64(i), Row64(j), Row64(k), Row64(l)));
}

}  // namespace mimicry
