#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

namespace mimicry {

struct SrgbTables;

/// sRGB as in image files, 0 to 255.
using Rgb8 = std::array<std::uint8_t, 3>;
/// sRGB and alpha, not multiplied by it.
using Rgba8 = std::array<std::uint8_t, 4>;

/// What a stroke does to the layer that it is on.
struct StrokeInk {
  Rgb8 color = {0, 0, 0};
  double opacity = 1.0;  ///< 0 to 1; the stroke covers no texel more than this
  bool erase = false;    ///< takes paint away; the colour is not used
};

/// A square texture of a base and layers of paint on it, in the order in which they lie, each with
/// an opacity. Layers are kept as sRGB with straight alpha, 8 bits each, in tiles that exist where
/// there is paint; they are mixed in linear light. A stroke is collected apart and put on its layer
/// once, when it ends, so that where it crosses itself it is not darker; until then `pixels` shows
/// what will be. Every change shows in `pixels` at once. Same calls, same bits.
class PaintLayers {
 public:
  static constexpr int kTileSize = 64;
  static constexpr std::size_t kTileTexels = std::size_t(kTileSize) * kTileSize;
  static constexpr std::size_t kDefaultUndoBytes = std::size_t(256) << 20;

  /// A base of one colour. undo_bytes: what tiles of layers that strokes have changed may take;
  /// the oldest strokes are forgotten beyond. Throws Error(invalid_input) for a size out of
  /// `kLeastTextureSize` to `kMostTextureSize`.
  PaintLayers(int size, const Rgb8& base, std::size_t undo_bytes = kDefaultUndoBytes);
  PaintLayers(PaintLayers&&) noexcept;
  PaintLayers& operator=(PaintLayers&&) noexcept;
  ~PaintLayers();

  int size() const { return size_; }
  int tiles_per_row() const { return tiles_per_row_; }

  /// An image as the base: #texels, rows from the top; its alpha stays that of `pixels`. Throws
  /// Error(invalid_input) for another count.
  void set_base(std::span<const Rgba8> texels);

  /// Layers are numbered from the lowest, 0. There is one at first.
  int layer_count() const { return static_cast<int>(layers_.size()); }
  /// An empty one on top; returns its number.
  int add_layer();
  /// Its strokes can no longer be undone. The last one cannot be removed.
  void remove_layer(int layer);
  /// Takes a layer out and puts it back with the number `to`.
  void move_layer(int layer, int to);
  double opacity(int layer) const;
  /// 0 to 1.
  void set_opacity(int layer, double opacity);
  /// The paint of one layer alone at a texel.
  Rgba8 layer_texel(int layer, int x, int y) const;
  /// Fills a layer: #texels, rows from the top, for reading files. It cannot be undone.
  void set_layer(int layer, std::span<const Rgba8> texels);
  // All of these throw Error(invalid_input) for a layer that does not exist, an opacity out of
  // range, and while a stroke is open.

  /// Throws Error(invalid_input) where a stroke is open, for a layer that does not exist and an
  /// opacity out of range.
  void begin_stroke(int layer, const StrokeInk& ink);
  bool has_stroke() const { return stroke_layer_ >= 0; }
  /// A = 1 - (1 - A)(1 - alpha): what a dab adds to the stroke. x, y inside the texture, alpha 0 to
  /// 1; a stroke is open. No allocation where the stroke has been, or earlier strokes were larger.
  void cover(int x, int y, float alpha);
  /// A = max(A, alpha).
  void cover_at_least(int x, int y, float alpha);
  /// The same with a colour at the texel in place of the ink's: linear light, premultiplied by its
  /// alpha, laid over what the stroke has there.
  void lay_over(int x, int y, const std::array<float, 4>& color);
  /// The same colour in place of what the stroke has there, where `nearness` (above 0) is larger
  /// than that which came with it.
  void lay_nearest(int x, int y, const std::array<float, 4>& color, float nearness);
  /// A of the open stroke.
  float coverage(int x, int y) const;
  /// Puts the stroke on its layer.
  void end_stroke();
  /// Forgets it.
  void cancel_stroke();

  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  /// Takes the last stroke back, or puts it on again, bit by bit. False where there is none, or one
  /// is open.
  bool undo();
  bool redo();
  std::size_t undo_bytes() const { return held_bytes_; }

  /// #texels by 4, sRGB and alpha, rows from the top: base and layers together.
  std::span<const Rgba8> pixels() const { return pixels_; }
  /// Tiles (y / 64 * tiles_per_row + x / 64) whose pixels have changed since `clear_changes`, in
  /// the order of their first change.
  std::span<const int> changed_tiles() const { return changed_; }
  void clear_changes();

  std::size_t memory_bytes() const;

 private:
  using Tile = std::array<Rgba8, kTileTexels>;
  struct Layer {
    int id;
    double opacity = 1.0;
    std::vector<std::unique_ptr<Tile>> tiles;  // null: nothing painted
  };
  struct Change {
    int tile;
    std::unique_ptr<Tile> before;
  };
  struct Step {
    int layer_id;
    std::vector<Change> changes;
  };
  // Coverage; or colour, coverage and, of ribbons, nearness.
  using StrokeTile = std::vector<float>;

  std::size_t tile_of(int x, int y) const {
    return std::size_t(y / kTileSize) * std::size_t(tiles_per_row_) + std::size_t(x / kTileSize);
  }
  static std::size_t texel_of(int x, int y) {
    return std::size_t(y % kTileSize) * kTileSize + std::size_t(x % kTileSize);
  }
  Layer& layer_at(int layer);
  const Layer& layer_at(int layer) const;
  void require_no_stroke() const;
  float* stroke_texel(int x, int y);
  void use_channels(int count);
  std::size_t coverage_channel() const { return stroke_channels_ == 1 ? 0 : 3; }
  Rgba8 with_stroke(const Rgba8& below, const float* stroke) const;
  void refresh(int x, int y);
  void refresh_tile(int tile);
  void refresh_all();
  void mark(std::size_t tile);
  void release_stroke();
  bool exchange(std::deque<Step>& from, std::deque<Step>& to);
  void drop(std::deque<Step>& steps, std::size_t index);

  int size_ = 0;
  int tiles_per_row_ = 0;
  int next_id_ = 0;
  std::vector<Layer> layers_;
  Rgb8 base_color_ = {};
  std::vector<Rgba8> base_;  // empty: the colour everywhere
  std::vector<Rgba8> pixels_;
  const SrgbTables* srgb_ = nullptr;

  int stroke_layer_ = -1;
  StrokeInk ink_;
  std::array<float, 3> ink_linear_ = {};
  int stroke_channels_ = 1;
  std::vector<int> stroke_tiles_;         // touched, in order
  std::vector<StrokeTile> stroke_;        // of each tile; empty: untouched
  std::vector<StrokeTile> free_tiles_;    // of earlier strokes
  std::vector<std::uint8_t> is_changed_;  // of each tile
  std::vector<int> changed_;

  std::deque<Step> undo_, redo_;
  std::size_t undo_limit_ = 0;
  std::size_t held_bytes_ = 0;
};

}  // namespace mimicry
