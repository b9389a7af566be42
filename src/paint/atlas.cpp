#include <algorithm>
#include <cmath>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/paint/atlas.h>

#include "base/float_traps.h"
#include "paint/cell_sizes.h"
#include "paint/over_edges.h"

namespace mimicry {

PaintAtlas PaintAtlas::begun(const Surface& surface, int size) {
  if (!surface)
    throw Error(ErrorKind::invalid_input, "atlas: the surface is empty; give it a mesh");
  if (size < kLeastTextureSize || size > kMostTextureSize)
    throw Error(ErrorKind::invalid_input,
                "texture: " + std::to_string(size) + " texels wide; give " +
                    std::to_string(kLeastTextureSize) + " to " + std::to_string(kMostTextureSize));
  PaintAtlas atlas;
  atlas.surface_ = surface;
  atlas.size_ = size;
  atlas.lengths_.assign(at(surface.mesh().face_count()), 0.0);
  return atlas;
}

PaintAtlas PaintAtlas::cells(const Surface& surface, int size) {
  const FloatTrapMask mask;  // of coordinates whose squares are no numbers
  PaintAtlas atlas = begun(surface, size);
  const TriangleMesh& mesh = surface.mesh();
  const auto faces = static_cast<int>(std::count_if(
      mesh.faces().begin(), mesh.faces().end(), [](const Face& f) { return !repeats_corner(f); }));
  for (int s = kLeastTextureSize; s <= kMostTextureSize && atlas.fine_size_ == 0; s *= 2)
    if (has_room(faces, s)) atlas.fine_size_ = s;
  if (at(faces) > atlas.texel_count()) {
    std::string remedy = "; join faces";
    for (std::size_t s = kLeastTextureSize; s <= kMostTextureSize; s *= 2)
      if (s * s >= at(faces)) {
        remedy = "; give a size of " + std::to_string(s);
        if (atlas.fine_size_ > 0)
          remedy +=
              ", or of " + std::to_string(atlas.fine_size_) + " for more than one texel a face";
        break;
      }
    throw Error(ErrorKind::invalid_input, "texture: " + std::to_string(size) + " x " +
                                              std::to_string(size) +
                                              " texels have no room for one on each of " +
                                              std::to_string(faces) + " faces" + remedy);
  }
  atlas.cells_.resize(at(mesh.face_count()));
  const std::vector<int> steps = cell_steps(mesh, size);
  if (steps.empty() && faces > 0)
    atlas.place_single_texels();
  else
    atlas.place_cells(steps);
  return atlas;
}

void PaintAtlas::place_single_texels() {
  coarse_ = true;
  const TriangleMesh& mesh = surface_.mesh();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (repeats_corner(mesh.face(f))) continue;
    const auto n = static_cast<int>(order_.size());
    cells_[at(f)] = {static_cast<std::uint16_t>(n % size_), static_cast<std::uint16_t>(n / size_),
                     0, 0, false};
    lengths_[at(f)] = std::sqrt(0.5 * mesh.area_vector(f).norm());
    order_.push_back(f);
  }
  used_ = order_.size();
}

void PaintAtlas::place_cells(std::span<const int> steps) {
  std::vector<int> counts(at(size_));
  for (const int s : steps) ++counts[at(s)];
  counts[0] = 0;
  // By their steps, largest first, then by number.
  std::vector<std::size_t> next(counts.size(), 0);
  std::size_t sum = 0;
  for (std::size_t s = counts.size(); s-- > 1;) {
    next[s] = sum;
    sum += at(counts[s]);
  }
  std::vector<std::size_t> end = next;
  for (std::size_t s = 1; s < counts.size(); ++s) end[s] += at(counts[s]);
  std::vector<std::size_t> fill = next;
  order_.resize(sum);
  for (std::size_t f = 0; f < steps.size(); ++f)
    if (steps[f] > 0) order_[fill[at(steps[f])]++] = static_cast<Index>(f);

  for (const CellRow& row : place_rows(counts, size_)) {
    std::size_t& first = next[at(row.steps)];
    const std::size_t last = std::min(first + 2 * at(row.count), end[at(row.steps)]);
    shelves_.push_back({row.y, row.x, row.steps, first, last});
    for (std::size_t i = first; i < last; ++i) {
      const Index f = order_[i];
      const int x = row.x + static_cast<int>((i - first) / 2) * (row.steps + 3);
      const bool upper = (i - first) % 2 != 0;
      const TriangleMesh& mesh = surface_.mesh();
      const int corner = corner_of_largest_angle(mesh, f);
      cells_[at(f)] = {static_cast<std::uint16_t>(upper ? x + row.steps + 2 : x),
                       static_cast<std::uint16_t>(upper ? row.y + row.steps + 1 : row.y),
                       static_cast<std::uint16_t>(row.steps), static_cast<std::uint8_t>(corner),
                       upper};
      const double leg =
          std::max((mesh.corner(f, (corner + 1) % 3) - mesh.corner(f, corner)).norm(),
                   (mesh.corner(f, (corner + 2) % 3) - mesh.corner(f, corner)).norm());
      lengths_[at(f)] = leg / row.steps;
      used_ += at((row.steps + 2) * (row.steps + 3) / 2);
    }
    first = last;
  }
}

TexelFrame PaintAtlas::frame(Index face) const {
  TexelFrame frame;
  if (own_) {
    Vec2 corners[3];
    for (int k = 0; k < 3; ++k) {
      SurfacePoint p{face, Vec3::Zero()};
      p.bary[k] = 1.0;
      corners[k] = place(p);
    }
    const Vec2 b = corners[1] - corners[0], c = corners[2] - corners[0];
    const double area = b.x() * c.y() - b.y() * c.x();
    if (area == 0.0) return frame;
    frame.along_x = Vec3(b.y() - c.y(), c.y(), -b.y()) / area;
    frame.along_y = Vec3(c.x() - b.x(), -c.x(), b.x()) / area;
    frame.origin =
        Vec3(1.0, 0.0, 0.0) - corners[0].x() * frame.along_x - corners[0].y() * frame.along_y;
    return frame;
  }
  const Cell& c = cells_[at(face)];
  if (c.corner > 2 || c.steps == 0) {
    frame.origin = Vec3::Constant(1.0 / 3.0);
    return frame;
  }
  const double step = (c.upper ? -1.0 : 1.0) / c.steps;
  const int k = c.corner;
  frame.along_x[(k + 2) % 3] = frame.along_y[(k + 1) % 3] = step;
  frame.along_x[k] = frame.along_y[k] = -step;
  frame.origin[k] = 1.0;
  frame.origin -= c.x * frame.along_x + c.y * frame.along_y;
  return frame;
}

Vec2 PaintAtlas::place(const SurfacePoint& p) const {
  if (own_) {
    const auto uv = [&](int k) {
      const auto* value = surface_.mesh().attributes()->texcoords.at_corner(p.face, k);
      // Faces that repeat a corner may have none.
      return value ? Vec2(double((*value)[0]), 1.0 - double((*value)[1])) : Vec2(Vec2::Zero());
    };
    const Vec2 sum = p.bary[0] * uv(0) + p.bary[1] * uv(1) + p.bary[2] * uv(2);
    return size_ * sum - Vec2::Constant(0.5);
  }
  const Cell& c = cells_[at(p.face)];
  const double step = c.upper ? -double(c.steps) : double(c.steps);
  const int k = c.corner % 3;
  return {c.x + step * p.bary[(k + 2) % 3], c.y + step * p.bary[(k + 1) % 3]};
}

Index PaintAtlas::cell_face_at(int x, int y) const {
  if (coarse_) {
    const std::size_t i = at(y) * at(size_) + at(x);
    return i < order_.size() ? order_[i] : kNone;
  }
  // The last shelf that begins above and to the left; shelves side by side share their y.
  const auto above = std::upper_bound(shelves_.begin(), shelves_.end(), y,
                                      [](int row, const Shelf& s) { return row < s.y; });
  if (above == shelves_.begin()) return kNone;
  const int top = std::prev(above)->y;
  const auto left = std::upper_bound(shelves_.begin(), above, x, [top](int column, const Shelf& s) {
    return s.y == top && column < s.x;
  });
  if (left == shelves_.begin() || std::prev(left)->y != top) return kNone;
  const Shelf& shelf = *std::prev(left);
  const int i = (x - shelf.x) % (shelf.steps + 3), j = y - shelf.y;
  if (j >= shelf.steps + 2) return kNone;
  const std::size_t n =
      shelf.first + 2 * at((x - shelf.x) / (shelf.steps + 3)) + (i + j > shelf.steps + 1 ? 1 : 0);
  return n < shelf.end ? order_[n] : kNone;
}

Index PaintAtlas::face_at(int x, int y) const {
  if (x < 0 || y < 0 || x >= size_ || y >= size_) return kNone;
  if (!own_) return cell_face_at(x, y);
  const auto after =
      std::upper_bound(runs_.begin(), runs_.end(), x, [y](int column, const OwnedRun& r) {
        return y != r.run.y ? y < r.run.y : column < r.run.begin;
      });
  if (after == runs_.begin()) return kNone;
  const OwnedRun& owned = *std::prev(after);
  return owned.run.y == y && x < owned.run.end ? owned.face : kNone;
}

SurfacePoint PaintAtlas::point(int x, int y) const {
  const Index f = face_at(x, y);
  if (f == kNone) return {};
  return over_edges(surface_, f, frame(f).bary(x, y));
}

CornerValues<2> PaintAtlas::texcoords() const {
  if (own_) return surface_.mesh().attributes()->texcoords;
  CornerValues<2> result;
  const std::size_t corners = 3 * at(surface_.mesh().face_count());
  result.values.resize(corners);
  result.corners.resize(corners);
  for (std::size_t i = 0; i < corners; ++i) {
    result.corners[i] = static_cast<Index>(i);
    SurfacePoint p{static_cast<Index>(i / 3), Vec3::Zero()};
    if (cells_[at(p.face)].corner > 2) continue;
    p.bary[static_cast<Eigen::Index>(i % 3)] = 1.0;
    const Vec2 texel = place(p);
    result.values[i] = {static_cast<float>((texel.x() + 0.5) / size_),
                        static_cast<float>(1.0 - (texel.y() + 0.5) / size_)};
  }
  return result;
}

std::size_t PaintAtlas::memory_bytes() const {
  return lengths_.capacity() * sizeof(double) + cells_.capacity() * sizeof(Cell) +
         order_.capacity() * sizeof(Index) + shelves_.capacity() * sizeof(Shelf) +
         runs_.capacity() * sizeof(OwnedRun) +
         (face_runs_.capacity() + first_run_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace mimicry
