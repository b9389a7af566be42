#include <gtest/gtest.h>
#include <png.h>

#include <mimicry/base/error.h>

#include "render/figure.h"
#include "render/palette.h"
#include "render/png.h"
#include "render/scenes.h"
#include "render/text.h"

namespace mimicry::render {
namespace {

constexpr Color kWhite{1.0, 1.0, 1.0};

int inked(const Image& image, int x0, int y0, int x1, int y1) {
  int count = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) count += brightness(image, x, y) < 128.0 ? 1 : 0;
  }
  return count;
}

TEST(Png, DecodesToTheSamePixels) {
  Image image(37, 23, kWhite);
  std::uint32_t state = 1;
  for (std::uint8_t& byte : image.rgb) {
    state = state * 1664525U + 1013904223U;
    byte = static_cast<std::uint8_t>(state >> 24);
  }
  const std::string bytes = write_png(image);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()), 0);
  png.format = PNG_FORMAT_RGB;
  ASSERT_EQ(png.width, 37U);
  ASSERT_EQ(png.height, 23U);
  std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(png));
  ASSERT_NE(png_image_finish_read(&png, nullptr, read.data(), 0, nullptr), 0);
  EXPECT_EQ(read, image.rgb);
}

TEST(Png, RefusesAnImageThatIsNone) {
  EXPECT_THROW(write_png(Image{}), Error);
  Image image(4, 4, kWhite);
  image.rgb.pop_back();
  EXPECT_THROW(write_png(image), Error);
}

TEST(Image, PasteAndBlendCutOffWhatLiesOutside) {
  Image image(8, 6, kWhite);
  const Image black(5, 5, Color{});
  image.paste(black, -3, -3);
  image.paste(black, 6, 4);
  image.paste(black, 100, 100);
  image.blend(-1, 0, Color{}, 1.0);
  image.blend(0, 6, Color{}, 1.0);
  EXPECT_EQ(inked(image, 0, 0, 8, 6), 4 + 4);
  EXPECT_EQ(brightness(image, 1, 1), 0.0);
  EXPECT_EQ(brightness(image, 6, 4), 0.0);
  EXPECT_EQ(brightness(image, 2, 1), 255.0);
}

TEST(Text, WidthGrowsWithTextAndSize) {
  EXPECT_EQ(text_width("", 20.0), 0.0);
  const double one = text_width("mimicry", 20.0);
  EXPECT_GT(one, 40.0);
  EXPECT_NEAR(text_width("mimicry", 40.0), 2.0 * one, 1e-3);
  EXPECT_NEAR(text_width("mm", 20.0), 2.0 * text_width("m", 20.0), 1e-3);  // no kerning here
}

TEST(Text, InkStandsOnTheBaselineWithinTheWidth) {
  Image image(120, 40, kWhite);
  draw_text(image, "Hxm", 10.0, 30.0, 24.0, kInkColor);
  const int end = 10 + static_cast<int>(text_width("Hxm", 24.0)) + 1;
  EXPECT_GT(inked(image, 10, 10, end, 30), 60);
  EXPECT_EQ(inked(image, 0, 0, 120, 40), inked(image, 10, 10, end, 30));
}

TEST(Text, LettersOutsideAsciiAreDrawnAndBrokenBytesDoNoHarm) {
  const double size = 24.0;
  EXPECT_GT(text_width("\xc3\xa9", size), 5.0);  // e acute
  EXPECT_LT(text_width("\xc3\xa9", size), 1.5 * text_width("e", size));
  EXPECT_GT(text_width("\xe2\x89\xa4", size), 5.0);  // less than or equal
  for (const char* broken : {"\xff", "\xc3", "\xe2\x89", "a\xf0\x9f", "\x80\x80"}) {
    Image image(60, 40, kWhite);
    draw_text(image, broken, 5.0, 30.0, size, kInkColor);
    EXPECT_GT(inked(image, 0, 0, 60, 40), 0);
  }
  Image image(20, 20, kWhite);
  draw_text(image, "far outside", -300.0, 500.0, size, kInkColor);
  EXPECT_EQ(inked(image, 0, 0, 20, 20), 0);
}

Scene scene_with(const TriangleMesh& mesh, const std::string& label, const Color& color) {
  Scene scene;
  scene.surfaces.push_back({});
  scene.surfaces[0].mesh = &mesh;
  Tube tube;
  tube.points = {Vec3(-0.5, 0, 1), Vec3(0.5, 0, 1)};
  tube.radius = 0.05;
  tube.label = label;
  tube.color = color;
  scene.tubes.push_back(tube);
  return scene;
}

TEST(Picture, LegendHasASwatchAndALabelOncePerName) {
  const TriangleMesh mesh = ball(8);
  const Color color{0.0, 0.0, 0.0};
  Scene scene = scene_with(mesh, "snap", color);
  const RenderOptions options = small(200, 160);
  const Image one = picture(scene, from(0, 0), options);
  EXPECT_EQ(one.width, 200);
  EXPECT_EQ(one.height, 160);
  EXPECT_GT(inked(one, 0, 135, 200, 160), 60);
  scene.tubes.push_back(scene.tubes[0]);  // the same label again
  const Image two = picture(scene, from(0, 0), options);
  EXPECT_EQ(inked(two, 0, 135, 200, 160), inked(one, 0, 135, 200, 160));
  scene.tubes[1].label = "occlude";
  EXPECT_GT(inked(picture(scene, from(0, 0), options), 0, 135, 200, 160),
            inked(one, 0, 135, 200, 160));
}

TEST(Picture, TooLowForItsLegendIsRefused) {
  const TriangleMesh mesh = ball(4);
  EXPECT_THROW(picture(scene_with(mesh, "snap", {}), from(0, 0), small(60, 12)), Error);
}

TEST(Figure, PanelsStandInAGridUnderOneCamera) {
  const TriangleMesh mesh = ball(8);
  std::vector<Scene> panels;
  for (const char* name : {"snap", "occlude", "mimicry"}) {
    panels.push_back(scene_with(mesh, name, technique_color(name)));
    panels.back().caption = name;
    panels.back().caption_color = technique_color(name);
    panels.back().caption_swatch = true;
  }
  FigureOptions options;
  options.panel = small(90, 70);
  options.columns = 2;
  options.gap = 6;
  const Image image = figure(panels, from(0, 0), options);
  EXPECT_EQ(image.width, 2 * 90 + 6);
  const int panel_height = (image.height - 6) / 2;
  EXPECT_GT(panel_height, 70 + 13);
  // The tube crosses the middle of each panel in its technique's colour.
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const int x = static_cast<int>(i % 2) * 96 + 45;
    const int y = static_cast<int>(i / 2) * (panel_height + 6) + 35;
    const Color want = technique_color(panels[i].caption);
    const std::uint8_t* p = image.pixel(x, y);
    EXPECT_NEAR(p[0] / 255.0, want.r, 0.2);
    EXPECT_NEAR(p[1] / 255.0, want.g, 0.2);
    EXPECT_NEAR(p[2] / 255.0, want.b, 0.2);
    EXPECT_GT(inked(image, x - 45, y + 35, x + 45, y + 35 + panel_height - 70), 20) << "caption";
  }
  // Where a fourth panel would be there is nothing.
  EXPECT_TRUE(is_background(image, 96 + 45, panel_height + 6 + 35, options.panel));
}

TEST(Figure, WithoutPanelsIsRefused) {
  EXPECT_THROW(figure({}, CameraOptions{}), Error);
}

}  // namespace
}  // namespace mimicry::render
