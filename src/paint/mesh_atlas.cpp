#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/paint/atlas.h>

namespace mimicry {
namespace {

using Corners = std::array<Vec2, 3>;

constexpr double kOutside = 1e-6;  // beyond 0 and 1, of single precision

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorKind::invalid_input,
              "texture coordinates: " + why + "; unwrap the mesh anew, or take the atlas 'cells'");
}

/// Faces of one fault.
struct Fault {
  Index count = 0;
  Index first = kNone;
  void add(Index face) {
    if (count++ == 0) first = face;
  }
  void refuse_if_any(const std::string& what) const {
    if (count > 0)
      refuse(std::to_string(count) + " faces " + what + " (first: face " + std::to_string(first) +
             ")");
  }
};

// Positive where p lies to the left of the edge; the other way round exactly the opposite, so that
// a texel on a shared edge is of one face.
double side(const Vec2& a, const Vec2& b, const Vec2& p) {
  const bool swapped = std::pair(b.x(), b.y()) < std::pair(a.x(), a.y());
  const Vec2& from = swapped ? b : a;
  const Vec2& to = swapped ? a : b;
  const double area =
      (to.x() - from.x()) * (p.y() - from.y()) - (to.y() - from.y()) * (p.x() - from.x());
  return swapped ? -area : area;
}

bool holds(const Corners& c, const Vec2& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 &a = c[k], &b = c[(k + 1) % 3];
    const double s = side(a, b, p);
    if (s < 0.0) return false;
    // Of the texels on an edge those of rising and of leftward edges count.
    if (s == 0.0 && !(b.y() > a.y() || (b.y() == a.y() && b.x() < a.x()))) return false;
  }
  return true;
}

double squared_distance(const Corners& c, const Vec2& p) {
  double least = kInfinity;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 edge = c[(k + 1) % 3] - c[k];
    const double t = std::clamp((p - c[k]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - c[k] - t * edge).squaredNorm());
  }
  return least;
}

// Calls visit(x, y) for the texels within `margin` of the box around a face.
template <class Visit>
void for_each_texel_near(const Corners& c, int margin, int size, Visit&& visit) {
  const Vec2 low = c[0].cwiseMin(c[1]).cwiseMin(c[2]), high = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
  const auto first = [&](double x) { return std::max(0, int(std::ceil(x)) - margin); };
  const auto last = [&](double x) { return std::min(size - 1, int(std::floor(x)) + margin); };
  for (int y = first(low.y()); y <= last(high.y()); ++y)
    for (int x = first(low.x()); x <= last(high.x()); ++x) visit(x, y);
}

// In texels, turned to have rows from the bottom: counter-clockwise where the face is not flipped.
Corners corners_of(const CornerValues<2>& values, Index f, int size) {
  Corners c;
  for (int k = 0; k < 3; ++k) {
    const auto& uv = *values.at_corner(f, k);
    c[at(k)] = size * Vec2(double(uv[0]), double(uv[1])) - Vec2::Constant(0.5);
  }
  return c;
}

void check(const TriangleMesh& mesh) {
  if (!mesh.attributes() || mesh.attributes()->texcoords.empty())
    throw Error(ErrorKind::invalid_input,
                "texture coordinates: the mesh has none; take the atlas 'cells'");
  const CornerValues<2>& values = mesh.attributes()->texcoords;
  Fault missing, outside, flipped, flat;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (repeats_corner(mesh.face(f))) continue;
    bool has_all = true, inside = true;
    for (int k = 0; k < 3; ++k) {
      const auto* uv = values.at_corner(f, k);
      has_all = has_all && uv;
      for (std::size_t i = 0; uv && i < 2; ++i)
        inside = inside && double((*uv)[i]) >= -kOutside && double((*uv)[i]) <= 1.0 + kOutside;
    }
    if (!has_all) missing.add(f);
    if (!inside) outside.add(f);
    if (!has_all || !inside) continue;
    const Corners c = corners_of(values, f, 1);
    const double area = side(c[0], c[1], c[2]);
    if (area < 0.0) flipped.add(f);
    if (area == 0.0 && mesh.area_vector(f).norm() > 0.0) flat.add(f);
  }
  missing.refuse_if_any("have none");
  outside.refuse_if_any("leave 0 to 1");
  flipped.refuse_if_any("are flipped");
  flat.refuse_if_any("have no area");
}

// #texels, rows from the bottom: the face whose texel it is, kNone for none.
std::vector<Index> owners(const TriangleMesh& mesh, int size) {
  const CornerValues<2>& values = mesh.attributes()->texcoords;
  std::vector<Index> owner(at(size) * at(size), kNone);
  const auto index = [size](int x, int y) { return at(y) * at(size) + at(x); };
  std::size_t overlaps = 0;
  std::pair<Index, Index> first;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (repeats_corner(mesh.face(f))) continue;
    const Corners c = corners_of(values, f, size);
    for_each_texel_near(c, 0, size, [&](int x, int y) {
      if (!holds(c, Vec2(x, y))) return;
      Index& o = owner[index(x, y)];
      if (o != kNone && overlaps++ == 0) first = {o, f};
      o = f;
    });
  }
  if (overlaps > 0)
    refuse("faces overlap on " + std::to_string(overlaps) + " texels of " + std::to_string(size) +
           " x " + std::to_string(size) + " (first: faces " + std::to_string(first.first) +
           " and " + std::to_string(first.second) + ")");
  // The gutter: what samples inside a face read beside its own texels; of several faces the
  // nearest.
  std::vector<float> distance(owner.size(), 2.0f);
  for (std::size_t i = 0; i < owner.size(); ++i)
    if (owner[i] != kNone) distance[i] = -1.0f;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (repeats_corner(mesh.face(f))) continue;
    const Corners c = corners_of(values, f, size);
    for_each_texel_near(c, 1, size, [&](int x, int y) {
      float& known = distance[index(x, y)];
      if (known < 0.0f) return;
      const auto d = static_cast<float>(squared_distance(c, Vec2(x, y)));
      if (!(d < known)) return;
      known = d;
      owner[index(x, y)] = f;
    });
  }
  return owner;
}

}  // namespace

PaintAtlas PaintAtlas::of_mesh(const Surface& surface, int size) {
  PaintAtlas atlas = begun(surface, size);
  const TriangleMesh& mesh = surface.mesh();
  check(mesh);
  atlas.own_ = true;
  atlas.fine_size_ = size;
  const std::vector<Index> owner = owners(mesh, size);
  const std::size_t faces = at(mesh.face_count());
  std::vector<std::uint32_t>& first = atlas.first_run_;
  first.assign(faces + 1, 0);
  for (int y = 0; y < size; ++y) {
    const Index* row = owner.data() + at(size - 1 - y) * at(size);
    for (int x = 0; x < size;) {
      const int begin = x;
      while (x < size && row[x] == row[begin]) ++x;
      if (row[begin] == kNone) continue;
      atlas.runs_.push_back({{y, begin, x}, row[begin]});
      atlas.used_ += at(x - begin);
      ++first[at(row[begin]) + 1];
    }
  }
  for (std::size_t f = 0; f < faces; ++f) first[f + 1] += first[f];
  std::vector<std::uint32_t> fill(first.begin(), first.end() - 1);
  atlas.face_runs_.resize(atlas.runs_.size());
  for (std::size_t i = 0; i < atlas.runs_.size(); ++i)
    atlas.face_runs_[fill[at(atlas.runs_[i].face)]++] = static_cast<std::uint32_t>(i);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (repeats_corner(mesh.face(f))) continue;
    const TexelFrame frame = atlas.frame(f);
    const auto step = [&](const Vec3& b) {
      return (b[0] * mesh.corner(f, 0) + b[1] * mesh.corner(f, 1) + b[2] * mesh.corner(f, 2))
          .norm();
    };
    atlas.lengths_[at(f)] = std::max(step(frame.along_x), step(frame.along_y));
  }
  return atlas;
}

}  // namespace mimicry
