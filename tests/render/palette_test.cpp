#include "render/palette.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/types.h>
#include <mimicry/technique/technique.h>

namespace mimicry::render {
namespace {

double linear(double s) {
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

/// CIE L*a*b* (D65) of linear sRGB.
Vec3 lab(const Vec3& rgb) {
  Mat3 to_xyz;
  to_xyz << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Vec3 white(0.9505, 1.0, 1.089);
  const Vec3 t = (to_xyz * rgb.cwiseMax(0.0).cwiseMin(1.0)).cwiseQuotient(white);
  const auto f = [](double x) { return x > 0.008856 ? std::cbrt(x) : 7.787 * x + 16.0 / 116.0; };
  return {116.0 * f(t[1]) - 16.0, 500.0 * (f(t[0]) - f(t[1])), 200.0 * (f(t[1]) - f(t[2]))};
}

TEST(Palette, UnknownTechniquesAreGrey) {
  EXPECT_EQ(technique_color("spraycan").r, 0xd5 / 255.0);
  const Color unknown = technique_color("no such technique");
  EXPECT_EQ(unknown.r, unknown.g);
  EXPECT_EQ(unknown.g, unknown.b);
}

TEST(Palette, ColorsDifferAlsoWithRedGreenBlindness) {
  // Machado, Oliveira and Fernandes 2009, severity 1: nothing, protanopia, deuteranopia.
  Mat3 none = Mat3::Identity();
  Mat3 protan, deutan;
  protan << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116,
      1.051998;
  deutan << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940,
      0.968881;
  struct Entry {
    std::string name;
    Color color;
  };
  std::vector<Entry> colors;
  for (const TechniqueInfo& info : techniques())
    colors.push_back({info.name, color_of(info.color)});
  ASSERT_GE(colors.size(), 13u);
  for (const Mat3& eye : {none, protan, deutan}) {
    const auto seen = [&](const Color& c) {
      return lab(eye * Vec3(linear(c.r), linear(c.g), linear(c.b)));
    };
    for (std::size_t i = 0; i < colors.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        // 2.3 is a just noticeable difference; thin lines need several.
        EXPECT_GT((seen(colors[i].color) - seen(colors[j].color)).norm(), 15.0)
            << colors[i].name << " and " << colors[j].name;
      }
      // From the surface's grey and from the strokes' black.
      EXPECT_GT((seen(colors[i].color) - seen({0.8, 0.8, 0.815})).norm(), 20.0) << colors[i].name;
      EXPECT_GT((seen(colors[i].color) - seen(kStrokeColor)).norm(), 20.0) << colors[i].name;
    }
  }
}

}  // namespace
}  // namespace mimicry::render
