#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/mesh/attributes.h>
#include <mimicry/paint/layers.h>

#include "paint/srgb.h"

namespace mimicry {
namespace {

std::vector<Rgba8> copy(const PaintLayers& layers) {
  return {layers.pixels().begin(), layers.pixels().end()};
}

// A stroke of random texels with random coverage.
void scribble(PaintLayers& layers, int layer, std::uint64_t seed, StrokeInk ink) {
  Random random(seed);
  layers.begin_stroke(layer, ink);
  for (int i = 0; i < 3000; ++i)
    layers.cover(static_cast<int>(random.below(300)), static_cast<int>(random.below(300)),
                 static_cast<float>(random.uniform()));
  layers.end_stroke();
}

TEST(PaintLayers, EncodingKeepsEveryByte) {
  for (int c = 0; c < 256; ++c)
    EXPECT_EQ(srgb_tables().encode(srgb_tables().linear[static_cast<std::size_t>(c)]), c);
}

TEST(PaintLayers, ColoursAreMixedInLinearLight) {
  PaintLayers layers(256, {255, 255, 255});
  layers.begin_stroke(0, {{0, 0, 0}, 0.5, false});
  layers.cover(10, 20, 1.0f);
  const int expected = static_cast<int>(std::lround(255.0 * srgb_from_linear(0.5)));  // 188
  EXPECT_NEAR(int(layers.pixels()[20 * 256 + 10][0]), expected, 1);
  EXPECT_EQ(layers.pixels()[20 * 256 + 11], (Rgba8{255, 255, 255, 255}));
  const auto open = copy(layers);
  layers.end_stroke();
  EXPECT_EQ(copy(layers), open);  // what was shown is what is kept
}

TEST(PaintLayers, LayersLieInTheirOrderWithTheirOpacity) {
  PaintLayers layers(256, {0, 0, 0});
  EXPECT_EQ(layers.add_layer(), 1);
  for (const int l : {0, 1}) {
    layers.begin_stroke(l, {l == 0 ? Rgb8{255, 0, 0} : Rgb8{0, 255, 0}});
    layers.cover(0, 0, 1.0f);
    layers.end_stroke();
  }
  EXPECT_EQ(layers.pixels()[0], (Rgba8{0, 255, 0, 255}));
  layers.move_layer(0, 1);
  EXPECT_EQ(layers.pixels()[0], (Rgba8{255, 0, 0, 255}));
  layers.set_opacity(1, 0.5);
  EXPECT_EQ(layers.pixels()[0], (Rgba8{188, 188, 0, 255}));
  layers.remove_layer(0);
  EXPECT_EQ(layers.pixels()[0], (Rgba8{188, 0, 0, 255}));
  EXPECT_THROW(layers.remove_layer(0), Error);
  EXPECT_THROW(layers.set_opacity(1, 0.5), Error);
}

TEST(PaintLayers, TheEraserTakesPaintAndNotTheBase) {
  PaintLayers layers(256, {10, 20, 30});
  layers.begin_stroke(0, {{255, 255, 255}});
  layers.cover(5, 5, 1.0f);
  layers.end_stroke();
  layers.begin_stroke(0, {{0, 0, 0}, 1.0, true});
  layers.cover(5, 5, 1.0f);
  layers.cover(6, 5, 1.0f);
  layers.end_stroke();
  EXPECT_EQ(layers.pixels()[5 * 256 + 5], (Rgba8{10, 20, 30, 255}));
  EXPECT_EQ(layers.layer_texel(0, 5, 5)[3], 0);
}

TEST(PaintLayers, UndoAndRedoGiveTheSameBits) {
  PaintLayers layers(320, {200, 180, 160});
  layers.add_layer();
  std::vector<std::vector<Rgba8>> states = {copy(layers)};
  for (int i = 0; i < 12; ++i) {
    scribble(layers, i % 2, 100 + static_cast<std::uint64_t>(i),
             {{static_cast<std::uint8_t>(20 * i), 40, 90}, 0.3 + 0.05 * i, i % 5 == 4});
    states.push_back(copy(layers));
  }
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = states.size() - 1; i-- > 0;) {
      ASSERT_TRUE(layers.undo());
      ASSERT_EQ(copy(layers), states[i]);
    }
    EXPECT_FALSE(layers.undo());
    for (std::size_t i = 1; i < states.size(); ++i) {
      ASSERT_TRUE(layers.redo());
      ASSERT_EQ(copy(layers), states[i]);
    }
    EXPECT_FALSE(layers.redo());
  }
  layers.undo();
  scribble(layers, 0, 7, {{1, 2, 3}});
  EXPECT_FALSE(layers.can_redo());
}

TEST(PaintLayers, UndoForgetsTheOldestBeyondItsBytes) {
  const std::size_t tile = PaintLayers::kTileTexels * 4;
  PaintLayers layers(256, {255, 255, 255}, 3 * tile);
  for (int i = 0; i < 5; ++i) {
    layers.begin_stroke(0, {{0, 0, 0}, 0.1});
    layers.cover(3, 3, 1.0f);
    layers.end_stroke();
    EXPECT_LE(layers.undo_bytes(), 3 * tile);
  }
  int count = 0;
  while (layers.undo()) ++count;
  EXPECT_EQ(count, 3);
}

TEST(PaintLayers, ChangedTilesAreNamedOnce) {
  PaintLayers layers(256, {255, 255, 255});
  layers.clear_changes();
  layers.begin_stroke(0, {{0, 0, 0}});
  layers.cover(70, 130, 0.5f);
  layers.cover(71, 130, 0.5f);
  EXPECT_THAT(layers.changed_tiles(), testing::ElementsAre(2 * 4 + 1));
  layers.clear_changes();
  layers.cancel_stroke();
  EXPECT_THAT(layers.changed_tiles(), testing::ElementsAre(2 * 4 + 1));
  EXPECT_EQ(layers.pixels()[130 * 256 + 70], (Rgba8{255, 255, 255, 255}));
  EXPECT_FALSE(layers.undo());
}

TEST(PaintLayers, AnImageLiesUnderThePaint) {
  PaintLayers layers(256, {0, 0, 0});
  std::vector<Rgba8> image(256 * 256);
  for (std::size_t i = 0; i < image.size(); ++i)
    image[i] = {static_cast<std::uint8_t>(i % 256), static_cast<std::uint8_t>(i / 256), 7, 255};
  layers.set_base(image);
  EXPECT_EQ(copy(layers), image);
  image.pop_back();
  EXPECT_THROW(layers.set_base(image), Error);
}

TEST(PaintLayers, OpenStrokesAndWrongNumbersAreRefused) {
  PaintLayers layers(256, {0, 0, 0});
  EXPECT_THROW(layers.begin_stroke(1, {}), Error);
  EXPECT_THROW(layers.begin_stroke(0, {{0, 0, 0}, 1.5}), Error);
  layers.begin_stroke(0, {});
  EXPECT_THROW(layers.begin_stroke(0, {}), Error);
  EXPECT_THROW(layers.add_layer(), Error);
  EXPECT_FALSE(layers.undo());
  EXPECT_THROW(PaintLayers(100, {0, 0, 0}), Error);
  EXPECT_THROW(PaintLayers(1000000, {0, 0, 0}), Error);
}

}  // namespace
}  // namespace mimicry
