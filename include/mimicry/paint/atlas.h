#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/mesh/attributes.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

/// Sizes of square textures, texels.
inline constexpr int kLeastTextureSize = 256;
inline constexpr int kMostTextureSize = 8192;

/// Texels of one row that belong to one face: x from `begin` to `end`, exclusive.
struct TexelRun {
  int y = 0, begin = 0, end = 0;
};

/// Barycentric coordinates of a face's texels, linear in the texel's numbers. Texels beyond the
/// face's edges (the gutter) have negative ones: the face's plane goes on over the edge.
struct TexelFrame {
  Vec3 origin = Vec3::Zero();  ///< of texel (0, 0)
  Vec3 along_x = Vec3::Zero();
  Vec3 along_y = Vec3::Zero();

  Vec3 bary(int x, int y) const { return origin + x * along_x + y * along_y; }
};

/// Where each face of a surface lies in a square texture. Rows are counted from the top; the centre
/// of texel (x, y) has the texture coordinates u = (x + 1/2) / size, v = 1 - (y + 1/2) / size. Each
/// texel belongs to one face or to none; bilinear samples inside a face read texels of that face
/// alone, so that neighbours in the texture never show. Immutable; safe to read from many threads.
/// Same surface and size, same atlas.
class PaintAtlas {
 public:
  /// For any surface, with nothing unwrapped: each face is half of a rectangle of texels, a right
  /// angle at its largest angle, its legs sized by the root of its area (of slivers by half of
  /// their longest edge) at one density over the surface, at least one texel step. Beyond the
  /// longest edge lies a gutter of one texel; the two other edges pass through texels. A surface of
  /// too many faces for that (`is_coarse`) gets one texel a face. Throws Error(invalid_input) for a
  /// size out of range, and with fewer texels than faces, naming the size that would do.
  /// O(#F log size).
  static PaintAtlas cells(const Surface& surface, int size);
  /// By the texture coordinates that the mesh carries. Around each face's texels lies a gutter of
  /// those that bilinear samples inside it read. Throws Error(invalid_input), with the count and
  /// the first of the faces, where coordinates are missing, leave 0 to 1, are flipped or without
  /// area, or where faces lie on the same texel. O(#F + texels); 8 bytes a texel while it is made.
  static PaintAtlas of_mesh(const Surface& surface, int size);

  int size() const { return size_; }
  std::size_t texel_count() const { return std::size_t(size_) * std::size_t(size_); }
  /// One texel a face: there was no room for more.
  bool is_coarse() const { return coarse_; }
  /// The least size (a power of two) at which every face has three texels and more; 0: beyond the
  /// largest size.
  int fine_size() const { return fine_size_; }
  /// Texels that belong to a face, gutters included.
  std::size_t used_texels() const { return used_; }

  /// Calls visit(run) for the texels of a face, gutter included, from the top.
  template <class Visit>
  void for_each_run(Index face, Visit&& visit) const;
  TexelFrame frame(Index face) const;
  /// About the length of a texel step on the face, model units; its coarser direction.
  double texel_length(Index face) const { return lengths_[at(face)]; }

  /// The face that a texel belongs to; kNone for none.
  Index face_at(int x, int y) const;
  /// The point of the surface that a texel shows; of a gutter's the point beyond the edge, straight
  /// over unfolded faces, or at the boundary. face kNone where the texel belongs to none.
  SurfacePoint point(int x, int y) const;
  /// Where a point of the surface lies, in texels: the centre of texel (x, y) is at (x, y).
  Vec2 place(const SurfacePoint& p) const;

  /// For export: of each corner of each face, v up. A face that repeats a corner has (0, 0).
  CornerValues<2> texcoords() const;

  const Surface& surface() const { return surface_; }
  std::size_t memory_bytes() const;

 private:
  // Half of a rectangle of steps + 3 by steps + 2 texels: of a face the corner with the right angle
  // lies at (x, y), the next `steps` below, the one before `steps` to the right; all turned by half
  // a turn in the upper half.
  struct Cell {
    std::uint16_t x = 0, y = 0, steps = 0;
    std::uint8_t corner = 3;  // the one at (x, y); 3: the face is no part of the surface
    bool upper = false;
  };
  // Rectangles of one size side by side.
  struct Shelf {
    int y, x, steps;
    std::size_t first, end;  // of order_
  };
  struct OwnedRun {
    TexelRun run;
    Index face;
  };

  static PaintAtlas begun(const Surface& surface, int size);
  void place_cells(std::span<const int> steps);
  void place_single_texels();
  Index cell_face_at(int x, int y) const;

  Surface surface_;
  int size_ = 0;
  int fine_size_ = 0;
  bool coarse_ = false;
  bool own_ = false;  // by the mesh's own coordinates
  std::size_t used_ = 0;
  std::vector<double> lengths_;                       // #F
  std::vector<Cell> cells_;                           // #F, of `cells`
  std::vector<Index> order_;                          // faces as their cells lie, two for each
  std::vector<Shelf> shelves_;                        // by y, then x
  std::vector<OwnedRun> runs_;                        // of `of_mesh`: by y, then x
  std::vector<std::uint32_t> face_runs_, first_run_;  // of each face, #F + 1
};

template <class Visit>
void PaintAtlas::for_each_run(Index face, Visit&& visit) const {
  if (own_) {
    for (std::uint32_t i = first_run_[at(face)]; i < first_run_[at(face) + 1]; ++i)
      visit(runs_[face_runs_[i]].run);
    return;
  }
  const Cell& c = cells_[at(face)];
  if (c.corner > 2) return;
  const int x = c.x, y = c.y, steps = c.steps;
  if (steps == 0) return visit(TexelRun{y, x, x + 1});
  for (int j = 0; j <= steps + 1; ++j)
    if (c.upper)
      visit(TexelRun{y - steps - 1 + j, x - j, x + 1});
    else
      visit(TexelRun{y + j, x, x + steps + 2 - j});
}

}  // namespace mimicry
