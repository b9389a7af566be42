#include "io/creased_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <mimicry/mesh/surface.h>

namespace mimicry {
namespace {

/// Sums of the same faces in another order differ by less.
constexpr double kSame = 1e-9;
/// A shorter sum of normals is rounding and no direction.
constexpr double kLeastSum = 1e-12;
/// Each corner of a place is compared with each.
constexpr std::size_t kMostCreased = 256;

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

struct Corner {
  Index face = 0;
  int k = 0;
};

// All corners, those of one place side by side.
std::vector<Corner> by_place(const TriangleMesh& mesh) {
  std::vector<Corner> corners;
  corners.reserve(mesh.faces().size() * 3);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) corners.push_back({f, k});
  const auto at = [&](const Corner& c) -> const Vec3& {
    return mesh.position(mesh.faces()[c.face][c.k]);
  };
  std::stable_sort(corners.begin(), corners.end(),
                   [&](const Corner& a, const Corner& b) { return before(at(a), at(b)); });
  return corners;
}

double angle_at(const TriangleMesh& mesh, const Corner& c) {
  const Face& f = mesh.faces()[c.face];
  const Vec3& here = mesh.position(f[c.k]);
  const Vec3 a = mesh.position(f[(c.k + 1) % 3]) - here, b = mesh.position(f[(c.k + 2) % 3]) - here;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

class Creaser {
 public:
  Creaser(const TriangleMesh& mesh, double crease_rad)
      : mesh_(mesh),
        least_(std::cos(crease_rad)),
        corners_(by_place(mesh)),
        faces_(mesh.faces().begin(), mesh.faces().end()) {
    for (Index f = 0; f < mesh.face_count(); ++f) flat_.push_back(face_normal(mesh, f));
  }

  CreasedMesh run() {
    for (std::size_t first = 0, end = 0; first < corners_.size(); first = end) {
      for (end = first + 1; end < corners_.size() && !before(place(first), place(end));) ++end;
      add_place(first, end);
    }
    return {TriangleMesh(std::move(positions_), std::move(faces_)), std::move(normals_)};
  }

 private:
  const Vec3& place(std::size_t c) const {
    return mesh_.position(mesh_.faces()[corners_[c].face][corners_[c].k]);
  }
  const Vec3& flat(std::size_t c) const { return flat_[corners_[c].face]; }

  // The unit mean of the normals of those corners in [first, end) that count, or the fallback.
  template <class Counts>
  Vec3 mean(std::size_t first, std::size_t end, const Vec3& fallback, Counts&& counts) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t c = first; c < end; ++c)
      if (counts(c)) sum += angle_at(mesh_, corners_[c]) * flat(c);
    return sum.norm() > kLeastSum ? sum.normalized().eval() : fallback;
  }

  // Makes the vertices of a place, one for each normal.
  void add_place(std::size_t first, std::size_t end) {
    const std::size_t made = positions_.size();
    const Vec3 smooth = mean(first, end, Vec3::UnitY(), [](std::size_t) { return true; });
    const bool is_smooth = end - first > kMostCreased;
    for (std::size_t c = first; c < end; ++c) {
      const Vec3& own = flat(c);
      const Vec3 normal =
          is_smooth || own.isZero() ? smooth : mean(first, end, own, [&](std::size_t d) {
            return d == c || own.dot(flat(d)) > least_;
          });
      std::size_t v = made;
      while (v < positions_.size() && (normals_[v] - normal).squaredNorm() > kSame * kSame) ++v;
      if (v == positions_.size()) {
        positions_.push_back(place(c));
        normals_.push_back(normal);
      }
      faces_[corners_[c].face][corners_[c].k] = static_cast<Index>(v);
    }
  }

  const TriangleMesh& mesh_;
  const double least_;
  const std::vector<Corner> corners_;
  std::vector<Vec3> flat_;  // #F, zero without area
  std::vector<Vec3> positions_, normals_;
  std::vector<Face> faces_;
};

}  // namespace

CreasedMesh creased_mesh(const TriangleMesh& mesh, double crease_rad) {
  return Creaser(mesh, crease_rad).run();
}

}  // namespace mimicry
