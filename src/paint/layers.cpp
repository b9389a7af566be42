#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/base/types.h>
#include <mimicry/paint/atlas.h>
#include <mimicry/paint/layers.h>

#include "paint/srgb.h"

namespace mimicry {
namespace {

constexpr Rgba8 kNothing = {0, 0, 0, 0};

[[noreturn]] void fail(const std::string& why) {
  throw Error(ErrorKind::invalid_input, "paint: " + why);
}

void require_opacity(double opacity) {
  if (std::isnan(opacity) || opacity < 0.0 || opacity > 1.0)
    fail("an opacity is not between 0 and 1; give 0 to 1");
}

std::uint8_t byte(float x) {
  return static_cast<std::uint8_t>(std::lrint(255.0f * x));
}

}  // namespace

PaintLayers::PaintLayers(int size, const Rgb8& base, std::size_t undo_bytes)
    : size_(size), base_color_(base), srgb_(&srgb_tables()), undo_limit_(undo_bytes) {
  if (size < kLeastTextureSize || size > kMostTextureSize)
    fail("a texture of " + std::to_string(size) + " texels; give " +
         std::to_string(kLeastTextureSize) + " to " + std::to_string(kMostTextureSize));
  tiles_per_row_ = (size + kTileSize - 1) / kTileSize;
  const std::size_t tiles = at(tiles_per_row_) * at(tiles_per_row_);
  pixels_.assign(at(size) * at(size), {base[0], base[1], base[2], 255});
  stroke_.resize(tiles);
  is_changed_.assign(tiles, 0);
  changed_.reserve(tiles);
  stroke_tiles_.reserve(tiles);
  add_layer();
  refresh_all();
}

PaintLayers::PaintLayers(PaintLayers&&) noexcept = default;
PaintLayers& PaintLayers::operator=(PaintLayers&&) noexcept = default;
PaintLayers::~PaintLayers() = default;

PaintLayers::Layer& PaintLayers::layer_at(int layer) {
  return const_cast<Layer&>(std::as_const(*this).layer_at(layer));
}

const PaintLayers::Layer& PaintLayers::layer_at(int layer) const {
  if (layer < 0 || layer >= layer_count())
    fail("there is no layer " + std::to_string(layer) + " among " + std::to_string(layer_count()) +
         "; give 0 to " + std::to_string(layer_count() - 1));
  return layers_[at(layer)];
}

void PaintLayers::require_no_stroke() const {
  if (has_stroke()) fail("a stroke is open; end or cancel it first");
}

void PaintLayers::set_base(std::span<const Rgba8> texels) {
  require_no_stroke();
  if (texels.size() != pixels_.size())
    fail("a base of " + std::to_string(texels.size()) + " texels; give " +
         std::to_string(pixels_.size()));
  base_.assign(texels.begin(), texels.end());
  refresh_all();
}

int PaintLayers::add_layer() {
  require_no_stroke();
  layers_.push_back({next_id_++, 1.0, {}});
  layers_.back().tiles.resize(stroke_.size());
  return layer_count() - 1;
}

void PaintLayers::remove_layer(int layer) {
  require_no_stroke();
  const int id = layer_at(layer).id;
  if (layer_count() == 1) fail("the last layer cannot be removed; erase it");
  for (std::deque<Step>* steps : {&undo_, &redo_})
    for (std::size_t i = steps->size(); i-- > 0;)
      if ((*steps)[i].layer_id == id) drop(*steps, i);
  layers_.erase(layers_.begin() + layer);
  refresh_all();
}

void PaintLayers::move_layer(int layer, int to) {
  require_no_stroke();
  layer_at(to);
  Layer moved = std::move(layer_at(layer));
  layers_.erase(layers_.begin() + layer);
  layers_.insert(layers_.begin() + to, std::move(moved));
  refresh_all();
}

double PaintLayers::opacity(int layer) const {
  return layer_at(layer).opacity;
}

void PaintLayers::set_opacity(int layer, double opacity) {
  require_no_stroke();
  require_opacity(opacity);
  layer_at(layer).opacity = opacity;
  refresh_all();
}

Rgba8 PaintLayers::layer_texel(int layer, int x, int y) const {
  const auto& tile = layer_at(layer).tiles[tile_of(x, y)];
  return tile ? (*tile)[texel_of(x, y)] : kNothing;
}

void PaintLayers::set_layer(int layer, std::span<const Rgba8> texels) {
  require_no_stroke();
  Layer& to = layer_at(layer);
  if (texels.size() != pixels_.size())
    fail("a layer of " + std::to_string(texels.size()) + " texels; give " +
         std::to_string(pixels_.size()));
  for (auto& tile : to.tiles) tile.reset();
  for (int y = 0; y < size_; ++y)
    for (int x = 0; x < size_; ++x) {
      const Rgba8& texel = texels[at(y) * at(size_) + at(x)];
      if (texel[3] == 0) continue;
      auto& tile = to.tiles[tile_of(x, y)];
      if (!tile) tile = std::make_unique<Tile>(Tile{});
      (*tile)[texel_of(x, y)] = texel;
    }
  for (std::deque<Step>* steps : {&undo_, &redo_})
    for (std::size_t i = steps->size(); i-- > 0;)
      if ((*steps)[i].layer_id == to.id) drop(*steps, i);
  refresh_all();
}

void PaintLayers::begin_stroke(int layer, const StrokeInk& ink) {
  require_no_stroke();
  layer_at(layer);
  require_opacity(ink.opacity);
  stroke_layer_ = layer;
  ink_ = ink;
  stroke_channels_ = 1;
  for (std::size_t k = 0; k < 3; ++k) ink_linear_[k] = srgb_tables().linear[ink.color[k]];
}

float* PaintLayers::stroke_texel(int x, int y) {
  const std::size_t t = tile_of(x, y);
  StrokeTile& tile = stroke_[t];
  if (tile.empty()) {
    if (!free_tiles_.empty()) {
      tile = std::move(free_tiles_.back());
      free_tiles_.pop_back();
    }
    tile.assign(kTileTexels * at(stroke_channels_), 0.0f);
    stroke_tiles_.push_back(static_cast<int>(t));
  }
  return tile.data() + texel_of(x, y) * at(stroke_channels_);
}

void PaintLayers::cover(int x, int y, float alpha) {
  float& a = *stroke_texel(x, y);
  if (a >= 1.0f) return;  // as most of a stroke is under its brush
  a = 1.0f - (1.0f - a) * (1.0f - alpha);
  refresh(x, y);
}

void PaintLayers::cover_at_least(int x, int y, float alpha) {
  float& a = *stroke_texel(x, y);
  if (alpha <= a) return;
  a = alpha;
  refresh(x, y);
}

void PaintLayers::use_channels(int count) {
  if (stroke_channels_ == count) return;
  if (!stroke_tiles_.empty())
    fail("a stroke has one ink, or images laid over each other or by nearness; begin another");
  stroke_channels_ = count;
}

void PaintLayers::lay_over(int x, int y, const std::array<float, 4>& color) {
  use_channels(4);
  float* texel = stroke_texel(x, y);
  const float rest = 1.0f - color[3];
  for (std::size_t k = 0; k < 4; ++k) texel[k] = color[k] + rest * texel[k];
  refresh(x, y);
}

void PaintLayers::lay_nearest(int x, int y, const std::array<float, 4>& color, float nearness) {
  use_channels(5);
  float* texel = stroke_texel(x, y);
  if (nearness <= texel[4]) return;
  std::copy(color.begin(), color.end(), texel);
  texel[4] = nearness;
  refresh(x, y);
}

float PaintLayers::coverage(int x, int y) const {
  const StrokeTile& tile = stroke_[tile_of(x, y)];
  return tile.empty() ? 0.0f : tile[texel_of(x, y) * at(stroke_channels_) + coverage_channel()];
}

// What the layer has at a texel when the stroke is on it.
Rgba8 PaintLayers::with_stroke(const Rgba8& below, const float* stroke) const {
  const float a = stroke[coverage_channel()];
  if (!(a > 0.0f)) return below;
  const float add = static_cast<float>(ink_.opacity) * a;
  const float under = static_cast<float>(below[3]) / 255.0f * (1.0f - add);
  Rgba8 result = below;
  if (ink_.erase) {
    result[3] = byte(under);
    return result;
  }
  const float sum = add + under;
  if (!(sum > 0.0f)) return below;
  result[3] = byte(sum);
  if (stroke_channels_ == 1 && !(under > 0.0f)) {
    std::copy(ink_.color.begin(), ink_.color.end(), result.begin());
    return result;
  }
  const SrgbTables& srgb = *srgb_;
  for (std::size_t k = 0; k < 3; ++k) {
    const float color = stroke_channels_ == 1 ? ink_linear_[k] : stroke[k] / a;
    result[k] = srgb.encode((add * color + under * srgb.linear[below[k]]) / sum);
  }
  return result;
}

void PaintLayers::refresh(int x, int y) {
  const std::size_t t = tile_of(x, y), i = texel_of(x, y);
  const std::size_t pixel = at(y) * at(size_) + at(x);
  const SrgbTables& srgb = *srgb_;
  const Rgba8 base =
      base_.empty() ? Rgba8{base_color_[0], base_color_[1], base_color_[2], 255} : base_[pixel];
  Rgba8 only = base;  // what shows where one thing alone does: its bytes, with nothing to mix
  bool is_mixed = false;
  std::array<float, 3> mixed = {};
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    const auto& tile = layers_[l].tiles[t];
    Rgba8 paint = tile ? (*tile)[i] : kNothing;
    if (static_cast<int>(l) == stroke_layer_ && !stroke_[t].empty())
      paint = with_stroke(paint, stroke_[t].data() + i * at(stroke_channels_));
    const float a = static_cast<float>(layers_[l].opacity) * static_cast<float>(paint[3]) / 255.0f;
    if (!(a > 0.0f)) continue;
    if (a >= 1.0f) {
      only = paint;
      is_mixed = false;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k)
      mixed[k] =
          a * srgb.linear[paint[k]] + (1.0f - a) * (is_mixed ? mixed[k] : srgb.linear[only[k]]);
    is_mixed = true;
  }
  mark(t);
  if (!is_mixed) {
    pixels_[pixel] = {only[0], only[1], only[2], base[3]};
    return;
  }
  pixels_[pixel] = {srgb.encode(mixed[0]), srgb.encode(mixed[1]), srgb.encode(mixed[2]), base[3]};
}

void PaintLayers::mark(std::size_t tile) {
  if (is_changed_[tile]) return;
  is_changed_[tile] = 1;
  changed_.push_back(static_cast<int>(tile));
}

void PaintLayers::refresh_tile(int tile) {
  const int x0 = tile % tiles_per_row_ * kTileSize, y0 = tile / tiles_per_row_ * kTileSize;
  for (int y = y0; y < std::min(y0 + kTileSize, size_); ++y)
    for (int x = x0; x < std::min(x0 + kTileSize, size_); ++x) refresh(x, y);
}

void PaintLayers::refresh_all() {
  for (int t = 0; t < static_cast<int>(stroke_.size()); ++t) refresh_tile(t);
}

void PaintLayers::clear_changes() {
  for (const int t : changed_) is_changed_[at(t)] = 0;
  changed_.clear();
}

void PaintLayers::release_stroke() {
  for (const int t : stroke_tiles_) {
    free_tiles_.push_back(std::move(stroke_[at(t)]));
    stroke_[at(t)] = {};
  }
  stroke_tiles_.clear();
  stroke_layer_ = -1;
}

void PaintLayers::end_stroke() {
  if (!has_stroke()) return;
  Layer& layer = layers_[at(stroke_layer_)];
  Step step{layer.id, {}};
  for (const int t : stroke_tiles_) {
    auto after = layer.tiles[at(t)] ? std::make_unique<Tile>(*layer.tiles[at(t)])
                                    : std::make_unique<Tile>(Tile{});
    bool differs = false;
    for (std::size_t i = 0; i < kTileTexels; ++i) {
      const Rgba8 below = (*after)[i];
      (*after)[i] = with_stroke(below, stroke_[at(t)].data() + i * at(stroke_channels_));
      differs = differs || (*after)[i] != below;
    }
    if (!differs) continue;
    std::swap(layer.tiles[at(t)], after);
    step.changes.push_back({t, std::move(after)});
  }
  release_stroke();
  if (step.changes.empty()) return;
  while (!redo_.empty()) drop(redo_, redo_.size() - 1);
  held_bytes_ += step.changes.size() * sizeof(Tile);
  undo_.push_back(std::move(step));
  while (held_bytes_ > undo_limit_) drop(undo_, 0);
}

void PaintLayers::cancel_stroke() {
  if (!has_stroke()) return;
  const std::vector<int> tiles = stroke_tiles_;
  release_stroke();
  for (const int t : tiles) refresh_tile(t);
}

void PaintLayers::drop(std::deque<Step>& steps, std::size_t index) {
  held_bytes_ -= steps[index].changes.size() * sizeof(Tile);
  steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(index));
}

// Tiles and those that they replaced change places, so that every bit comes back.
bool PaintLayers::exchange(std::deque<Step>& from, std::deque<Step>& to) {
  if (from.empty() || has_stroke()) return false;
  Step step = std::move(from.back());
  from.pop_back();
  const auto layer = std::find_if(layers_.begin(), layers_.end(),
                                  [&](const Layer& l) { return l.id == step.layer_id; });
  for (Change& change : step.changes) {
    std::swap(layer->tiles[at(change.tile)], change.before);
    refresh_tile(change.tile);
  }
  to.push_back(std::move(step));
  return true;
}

bool PaintLayers::undo() {
  return exchange(undo_, redo_);
}

bool PaintLayers::redo() {
  return exchange(redo_, undo_);
}

std::size_t PaintLayers::memory_bytes() const {
  std::size_t tiles = 0, floats = 0;
  for (const Layer& layer : layers_)
    tiles += at(static_cast<int>(std::count_if(layer.tiles.begin(), layer.tiles.end(),
                                               [](const auto& t) { return t != nullptr; })));
  for (const StrokeTile& t : stroke_) floats += t.capacity();
  for (const StrokeTile& t : free_tiles_) floats += t.capacity();
  return (pixels_.capacity() + base_.capacity()) * sizeof(Rgba8) + tiles * sizeof(Tile) +
         floats * sizeof(float) + held_bytes_;
}

}  // namespace mimicry
