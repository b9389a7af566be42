#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/paint/atlas.h>

#include "messy/messy_meshes.h"
#include "paint/support.h"

namespace mimicry {
namespace {

using test::shape_surface;
using testing::HasSubstr;

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

// Every texel is of the face that runs say, and of no other; all faces of the surface have some.
void expect_sound(const PaintAtlas& atlas) {
  const TriangleMesh& mesh = atlas.surface().mesh();
  std::vector<Index> owner(atlas.texel_count(), kNone);
  std::size_t used = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    int count = 0;
    atlas.for_each_run(f, [&](const TexelRun& run) {
      ASSERT_TRUE(run.y >= 0 && run.y < atlas.size() && run.begin >= 0 && run.end <= atlas.size());
      for (int x = run.begin; x < run.end; ++x, ++count) {
        Index& o = owner[at(run.y) * at(atlas.size()) + at(x)];
        ASSERT_EQ(o, kNone) << "faces " << o << " and " << f;
        o = f;
      }
    });
    ASSERT_EQ(count > 0, !repeats_corner(mesh.face(f))) << "face " << f;
    used += at(count);
  }
  EXPECT_EQ(used, atlas.used_texels());
  for (int y = 0; y < atlas.size(); ++y)
    for (int x = 0; x < atlas.size(); ++x)
      ASSERT_EQ(atlas.face_at(x, y), owner[at(y) * at(atlas.size()) + at(x)]) << x << ", " << y;
}

// Counter-clockwise as u to the right and v up are seen, within the texture.
void expect_unflipped(const PaintAtlas& atlas) {
  const CornerValues<2> uv = atlas.texcoords();
  const TriangleMesh& mesh = atlas.surface().mesh();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (repeats_corner(mesh.face(f))) continue;
    Vec2 c[3];
    for (int k = 0; k < 3; ++k) {
      const auto& value = *uv.at_corner(f, k);
      c[k] = Vec2(double(value[0]), double(value[1]));
      ASSERT_TRUE(c[k].minCoeff() >= 0.0 && c[k].maxCoeff() <= 1.0) << "face " << f;
    }
    const Vec2 a = c[1] - c[0], b = c[2] - c[0];
    ASSERT_GT(a.x() * b.y() - a.y() * b.x(), 0.0) << "face " << f;
  }
}

TEST(CellAtlas, EveryTexelIsOfOneFaceAndNoFaceIsFlipped) {
  for (const char* name : {"torus", "hand", "cube", "plate"}) {
    SCOPED_TRACE(name);
    for (const int size : {256, 600}) {
      const PaintAtlas atlas = PaintAtlas::cells(shape_surface(name, 0), size);
      if (atlas.is_coarse()) continue;
      expect_sound(atlas);
      expect_unflipped(atlas);
    }
  }
}

TEST(CellAtlas, MessyMeshesHaveOne) {
  int count = 0;
  for (const messy::Family& family : messy::families()) {
    SCOPED_TRACE(family.name);
    expect_sound(PaintAtlas::cells(Surface(family.make(500, 3)), 256));
    ++count;
  }
  EXPECT_GT(count, 3);
}

TEST(CellAtlas, FacesWithoutSizeHaveTexels) {
  // A needle, a point of three vertices, and a face of huge numbers beside a common one.
  const TriangleMesh mesh(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1e150, 0, 0}, {0, 1e150, 0}},
      {{0, 1, 2}, {0, 1, 3}, {0, 4, 5}});
  expect_sound(PaintAtlas::cells(Surface::as_given(mesh), 256));
}

TEST(CellAtlas, MostTexelsAreUsedAndDensityIsEven) {
  const PaintAtlas atlas = PaintAtlas::cells(shape_surface("torus", 40), 2048);
  EXPECT_GT(double(atlas.used_texels()), 0.9 * double(atlas.texel_count()));
  double least = kInfinity, most = 0.0;
  for (Index f = 0; f < atlas.surface().mesh().face_count(); ++f) {
    least = std::min(least, atlas.texel_length(f));
    most = std::max(most, atlas.texel_length(f));
  }
  EXPECT_LT(most, 2.0 * least);
}

TEST(CellAtlas, TexelsAndPointsAreEachOthersInverse) {
  const Surface surface = shape_surface("hand", 0);
  const PaintAtlas atlas = PaintAtlas::cells(surface, 1024);
  int gutters = 0, own = 0;
  for (int y = 0; y < atlas.size(); y += 3)
    for (int x = 0; x < atlas.size(); x += 3) {
      const Index f = atlas.face_at(x, y);
      const SurfacePoint p = atlas.point(x, y);
      ASSERT_EQ(p.face == kNone, f == kNone);
      if (f == kNone) continue;
      const Vec3 bary = atlas.frame(f).bary(x, y);
      ASSERT_NEAR(bary.sum(), 1.0, 1e-12);
      ASSERT_GE(p.bary.minCoeff(), 0.0);
      if (bary.minCoeff() >= -1e-9) {
        ASSERT_EQ(p.face, f);
        ASSERT_LT((atlas.place(p) - Vec2(x, y)).norm(), 1e-9);
        ++own;
      } else {
        // Beyond the edge, as far as a texel step is long.
        const TriangleMesh& mesh = surface.mesh();
        const Vec3 plane =
            bary[0] * mesh.corner(f, 0) + bary[1] * mesh.corner(f, 1) + bary[2] * mesh.corner(f, 2);
        ASSERT_NE(p.face, f);
        ASSERT_LT((surface.position(p) - plane).norm(), 2.0 * atlas.texel_length(f));
        ++gutters;
      }
    }
  EXPECT_GT(own, 10000);
  EXPECT_GT(gutters, 1000);
}

TEST(CellAtlas, PointsOfAGutterLieStraightBeyondTheEdge) {
  // A sheet bent by a right angle: what lies beyond the fold keeps its distance from it.
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 3}}, {{0, 1, 2}, {2, 1, 3}});
  const Surface surface(mesh);
  const PaintAtlas atlas = PaintAtlas::cells(surface, 256);
  int count = 0;
  atlas.for_each_run(0, [&](const TexelRun& run) {
    for (int x = run.begin; x < run.end; ++x) {
      const Vec3 bary = atlas.frame(0).bary(x, run.y);
      if (bary[0] > -1e-9 || bary[1] < 0.02 || bary[2] < 0.02) continue;
      const Vec3 p = surface.position(atlas.point(x, run.y));
      EXPECT_NEAR(p.z(), -bary[0] * std::sqrt(0.5), 1e-9);
      EXPECT_NEAR(p.x() + p.y(), 1.0, 1e-9);
      ++count;
    }
  });
  EXPECT_GT(count, 10);
}

// What a smooth function shows on both sides of every edge, in steps of 1/255.
TEST(CellAtlas, SeamsDoNotShow) {
  const Surface surface = shape_surface("torus", 24);
  const PaintAtlas atlas = PaintAtlas::cells(surface, 1024);
  const TriangleMesh& mesh = surface.mesh();
  double texel = 0.0;
  for (Index f = 0; f < mesh.face_count(); ++f) texel = std::max(texel, atlas.texel_length(f));
  // A falloff of eight texels from 0 to 1 around a ring of the torus.
  const auto value = [&](const Vec3& x) {
    const double t = std::clamp(0.5 + x.y() / (8.0 * texel), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
  };
  std::vector<double> texels(atlas.texel_count());
  for (int y = 0; y < atlas.size(); ++y)
    for (int x = 0; x < atlas.size(); ++x) {
      const SurfacePoint p = atlas.point(x, y);
      if (p.face != kNone)
        texels[at(y) * at(atlas.size()) + at(x)] =
            std::round(255.0 * value(surface.position(p))) / 255.0;
    }
  const auto sample = [&](const SurfacePoint& p) {
    return test::bilinear(atlas, atlas.place(p), [&](int x, int y) {
      EXPECT_EQ(atlas.face_at(x, y), p.face);
      return texels[at(y) * at(atlas.size()) + at(x)];
    });
  };
  double sum = 0.0, largest = 0.0;
  int count = 0;
  const HalfEdges& edges = surface.half_edges();
  for (Index h = 0; h < edges.count(); ++h) {
    if (edges.edge(h) != h || !edges.has_twin(h)) continue;
    for (int i = 0; i <= 20; ++i) {
      const double t = i / 20.0;
      const double difference = std::abs(sample(surface_point(Crossing{h, t})) -
                                         sample(surface_point(Crossing{edges.twin(h), 1.0 - t})));
      const double v = value(position(mesh, Crossing{h, t}));
      if (v < 0.01 || v > 0.99) continue;  // where nothing changes nothing can differ
      sum += difference;
      largest = std::max(largest, difference);
      ++count;
    }
  }
  ASSERT_GT(count, 1000);
  EXPECT_LE(255.0 * sum / count, 1.0);
  EXPECT_LE(255.0 * largest, 6.0);
}

TEST(CellAtlas, TooManyFacesGetATexelEachOrAreRefusedWithTheSizeThatWouldDo) {
  const PaintAtlas coarse = PaintAtlas::cells(shape_surface("torus", 60), 256);  // 21,600 faces
  EXPECT_TRUE(coarse.is_coarse());
  EXPECT_EQ(coarse.fine_size(), 512);
  expect_sound(coarse);
  EXPECT_FALSE(PaintAtlas::cells(coarse.surface(), coarse.fine_size()).is_coarse());
  const Surface large = shape_surface("torus", kLargeTorusResolution);  // 86,400 faces
  EXPECT_THAT(refusal([&] { PaintAtlas::cells(large, 256); }),
              HasSubstr("86400 faces; give a size of 512, or of 1024 for more"));
}

TEST(CellAtlas, SizesOutOfRangeAreRefused) {
  const Surface cube = shape_surface("cube", 2);
  for (const int size : {-1, 0, 255, 8193, 1000000})
    EXPECT_THAT(refusal([&] { PaintAtlas::cells(cube, size); }), HasSubstr("give 256 to 8192"));
  EXPECT_THAT(refusal([&] { PaintAtlas::cells(Surface(), 256); }), HasSubstr("give it a mesh"));
}

// A grid in the plane with texture coordinates by corner.
Surface grid_with(const std::function<std::array<float, 2>(Index, const Vec3&)>& uv) {
  TriangleMesh mesh = make_grid(6);
  auto attributes = std::make_shared<MeshAttributes>();
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      attributes->texcoords.corners.push_back(
          static_cast<Index>(attributes->texcoords.values.size()));
      attributes->texcoords.values.push_back(uv(f, mesh.corner(f, k)));
    }
  mesh.set_attributes(attributes);
  return Surface(mesh);
}

std::array<float, 2> flat(Index, const Vec3& x) {
  return {static_cast<float>(0.5 + 0.45 * x.x()), static_cast<float>(0.5 + 0.41 * x.y())};
}

TEST(MeshAtlas, TexelsLieWhereTheFilesCoordinatesSay) {
  const PaintAtlas atlas = PaintAtlas::of_mesh(grid_with(flat), 300);
  expect_sound(atlas);
  EXPECT_EQ(atlas.texcoords(), atlas.surface().mesh().attributes()->texcoords);
  int inside = 0;
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x) {
      const SurfacePoint p = atlas.point(x, y);
      const double u = ((x + 0.5) / 300 - 0.5) / 0.45, v = (0.5 - (y + 0.5) / 300) / 0.41;
      if (std::max(std::abs(u), std::abs(v)) > 1.0) continue;
      ASSERT_NE(p.face, kNone);
      ASSERT_LT((atlas.surface().position(p) - Vec3(u, v, 0.0)).norm(), 1e-5);
      ++inside;
    }
  EXPECT_GT(inside, 50000);
  // Bilinear samples at the rim read the gutter.
  EXPECT_EQ(atlas.face_at(static_cast<int>(300 * 0.05 - 0.5), 150) != kNone, true);
}

TEST(MeshAtlas, CoordinatesThatCannotBePaintedOnAreRefused) {
  const auto of = [](const auto& uv) {
    return refusal([&] { PaintAtlas::of_mesh(grid_with(uv), 256); });
  };
  EXPECT_THAT(of([](Index, const Vec3& x) {
                return std::array<float, 2>{float(0.5 + 0.6 * x.x()), float(0.5 + 0.4 * x.y())};
              }),
              HasSubstr("24 faces leave 0 to 1 (first: face "));
  EXPECT_THAT(of([](Index f, const Vec3& x) {
                auto c = flat(f, x);
                if (f == 7) c[0] = 1.0f - c[0];
                return c;
              }),
              HasSubstr("1 faces are flipped (first: face 7); unwrap the mesh anew"));
  EXPECT_THAT(of([](Index f, const Vec3& x) {
                auto c = flat(f, x);
                if (x.x() > 0.9) c[0] -= 0.3f;
                return c;
              }),
              HasSubstr("flipped"));
  EXPECT_THAT(
      of([](Index f, const Vec3& x) { return flat(0, f == 70 ? Vec3(x - Vec3(0.3, 0, 0)) : x); }),
      HasSubstr("overlap on "));
  EXPECT_THAT(of([](Index, const Vec3&) {
                return std::array<float, 2>{0.5f, 0.5f};
              }),
              HasSubstr("have no area"));
  EXPECT_THAT(refusal([] { PaintAtlas::of_mesh(shape_surface("cube", 2), 256); }),
              HasSubstr("the mesh has none; take the atlas 'cells'"));
}

}  // namespace
}  // namespace mimicry
