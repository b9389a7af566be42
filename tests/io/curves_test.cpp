#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>
#include <tiny_obj_loader.h>

#include <mimicry/base/error.h>
#include <mimicry/io/curves.h>
#include <mimicry/io/meshes.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/surface.h>

#include "curve/curve_builder.h"

namespace mimicry {
namespace {

using testing::HasSubstr;

constexpr std::array<std::array<unsigned char, 3>, 2> kColors = {{{255, 0, 0}, {0, 128, 255}}};

struct Sample {
  TriangleMesh mesh = make_torus(24, 10);
  CurveSet set;

  Sample() {
    const Surface surface = Surface::as_given(mesh);
    const auto normals = angle_weighted_normals(mesh);
    set.target = "a, \"torus\"\nof two lines";
    for (const int step : {7, 11}) {
      CurveBuilder builder(surface);
      for (Index k = 0; k < 40; ++k) {
        const Index face = (k * step) % mesh.face_count();
        const SurfacePoint p{face, Vec3(0.2, 0.5, 0.3)};
        if (k == 17) builder.break_here();
        builder.append(
            {p, mesh.position(p), interpolated_normal(mesh, normals, p), k, k / 90.0, 0.05});
      }
      if (step == 11) builder.append(CurvePoint(builder.curve().points.front()));
      CurveRecord record;
      record.stroke = "s" + std::to_string(step);
      record.technique = "snap";
      record.options["nozzle"] = {0, 0, -1};
      record.model_to_world.scale = 0.4;
      record.curve = builder.curve();
      record.curve.closed = step == 11;
      set.curves.push_back(record);
    }
  }
};

bool has_python() {
  return std::system("python3 --version > /dev/null 2>&1") == 0;
}

struct Measured {
  std::size_t parts, vertices;
  double length;
};

// What the independent reader finds in the file.
std::vector<Measured> read_independently(const std::string& format, const std::string& bytes,
                                         const TriangleMesh& mesh) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("mimicry_curves_" + format + std::to_string(std::random_device()()));
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "curves").string();
  const std::string mesh_file = (folder / "mesh.obj").string();
  std::ofstream(file, std::ios::binary) << bytes;
  std::ofstream(mesh_file, std::ios::binary) << write_mesh(mesh, MeshFormat::obj);
  const std::string command = "python3 " MIMICRY_CURVE_READER " " + format + " " + file +
                              (format == "json" ? " " + mesh_file : "");
  std::vector<Measured> measured;
  {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    Measured m{};
    while (pipe && std::fscanf(pipe.get(), "%zu %zu %la", &m.parts, &m.vertices, &m.length) == 3)
      measured.push_back(m);
  }
  std::filesystem::remove_all(folder);
  return measured;
}

TEST(Curves, AnIndependentReaderFindsTheSameCurvesInEveryTextFormat) {
  if (!has_python()) GTEST_SKIP() << "python3 is not installed";
  const Sample sample;
  const std::pair<std::string, std::string> files[] = {
      {"json", write_curves_json(sample.set, sample.mesh)},
      {"obj", write_curves_obj(sample.set, sample.mesh)},
      {"obj", write_curves_obj(sample.set, sample.mesh, ObjLines::polylines)},
      {"csv", write_curves_csv(sample.set, sample.mesh)},
      {"ply", write_curves_ply_lines(sample.set, sample.mesh, kColors)}};
  for (const auto& [format, bytes] : files) {
    SCOPED_TRACE(format);
    const auto measured = read_independently(format, bytes, sample.mesh);
    ASSERT_EQ(measured.size(), sample.set.curves.size());
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const ProjectedCurve& curve = sample.set.curves[i].curve;
      EXPECT_EQ(measured[i].parts, 2u);
      EXPECT_EQ(measured[i].vertices, curve.points.size() + curve.crossings.size());
      // The same sum in another order: a few roundings of a length of some units.
      EXPECT_NEAR(measured[i].length, length(curve), 1e-12);
    }
  }
}

TEST(Curves, JsonReadsBackToTheSameBits) {
  const Sample sample;
  const std::string bytes = write_curves_json(sample.set, sample.mesh);
  const CurveSet read = read_curves_json(bytes, "c.json", sample.mesh);
  EXPECT_EQ(write_curves_json(read, sample.mesh), bytes);
  ASSERT_EQ(read.curves.size(), 2u);
  EXPECT_EQ(read.target, sample.set.target);
  EXPECT_EQ(read.curves[1].options, sample.set.curves[1].options);
  const auto& a = read.curves[1].curve;
  const auto& b = sample.set.curves[1].curve;
  EXPECT_FALSE(read.curves[0].curve.closed);
  EXPECT_TRUE(a.closed);
  ASSERT_EQ(a.crossings.size(), b.crossings.size());
  for (std::size_t i = 0; i < a.crossings.size(); ++i)
    EXPECT_EQ(a.crossings[i].t, b.crossings[i].t);
  EXPECT_EQ(length(a), length(b));
}

TEST(Curves, PackedReadsBackToTheSameBits) {
  const Sample sample;
  const std::string bytes = write_curves_packed(sample.set, sample.mesh);
  EXPECT_TRUE(is_packed_curves(bytes));
  const CurveSet read = read_curves_packed(bytes, "c", sample.mesh);
  // JSON keeps every bit (above), so that equal texts are equal curves.
  EXPECT_EQ(write_curves_json(read, sample.mesh), write_curves_json(sample.set, sample.mesh));
  EXPECT_FALSE(is_packed_curves(write_curves_json(sample.set, sample.mesh)));
}

TEST(Curves, PackedThatIsBrokenOrOfAnotherMeshIsRefusedByName) {
  const Sample sample;
  const std::string bytes = write_curves_packed(sample.set, sample.mesh);
  const auto error_of = [&](const std::string& content, const TriangleMesh& mesh) -> std::string {
    try {
      read_curves_packed(content, "kept", mesh);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(error_of(bytes, make_torus(24, 11)),
              HasSubstr("was drawn on a mesh of 240 vertices"));
  EXPECT_THAT(error_of(bytes + "x", sample.mesh), HasSubstr("follows"));
  std::string other = bytes;
  other[15] = 2;
  EXPECT_THAT(error_of(other, sample.mesh), HasSubstr("another version"));
  for (std::size_t n = 0; n < bytes.size(); n += 97)
    ASSERT_THAT(error_of(bytes.substr(0, n), sample.mesh), HasSubstr("kept")) << n;
  // Whatever byte is changed: refused by name, or a curve that every writer can go through.
  for (std::size_t n = 0; n < bytes.size(); n += 31) {
    std::string changed = bytes;
    changed[n] = static_cast<char>(changed[n] ^ 0xA5);
    try {
      const CurveSet read = read_curves_packed(changed, "kept", sample.mesh);
      ASSERT_NO_THROW(write_curves_csv(read, sample.mesh)) << n;
    } catch (const Error& error) {
      ASSERT_THAT(error.what(), HasSubstr("kept")) << n;
    }
  }
}

TEST(Curves, ForeignMeshAndBrokenFilesAreRefusedByName) {
  const Sample sample;
  const std::string bytes = write_curves_json(sample.set, sample.mesh);
  const auto error_of = [&](const std::string& text, const TriangleMesh& mesh) -> std::string {
    try {
      read_curves_json(text, "c.json", mesh);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(error_of(bytes, make_torus(24, 11)),
              HasSubstr("was drawn on a mesh of 240 vertices"));
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = bytes;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(error_of(replaced("\"version\":1", "\"version\":2"), sample.mesh),
              HasSubstr("version 2"));
  EXPECT_THAT(error_of(replaced("\"face\":7", "\"face\":777777"), sample.mesh),
              HasSubstr("beyond the mesh"));
  EXPECT_THAT(error_of(replaced("\"bary\":[0.2", "\"bary\":[0.4"), sample.mesh),
              HasSubstr("'bary'"));
  EXPECT_THAT(error_of(replaced("\"kind\":\"shortest\"", "\"kind\":\"line\""), sample.mesh),
              HasSubstr("'line'"));
  EXPECT_THAT(error_of(replaced("\"closed\":false", "\"closed\":0"), sample.mesh),
              HasSubstr("'closed'"));
  EXPECT_THAT(error_of(replaced("\"closed\":false", "\"closed\":true"), sample.mesh),
              HasSubstr("does not end in its first point"));
  for (std::size_t n = 0; n + 3 < bytes.size(); n += 97)
    ASSERT_THAT(error_of(bytes.substr(0, n), sample.mesh), HasSubstr("c.json")) << n;
}

TEST(Curves, NoCurvesAndCurvesWithoutPointsAreFiles) {
  const TriangleMesh mesh = make_sphere(2);
  CurveSet set;
  set.curves.resize(1);
  for (const CurveSet& s : {CurveSet{}, set}) {
    EXPECT_EQ(read_curves_json(write_curves_json(s, mesh), "c", mesh).curves.size(),
              s.curves.size());
    EXPECT_NO_THROW(write_curves_obj(s, mesh));
    EXPECT_NO_THROW(write_curves_csv(s, mesh));
    EXPECT_NO_THROW(write_curves_ply(s, mesh, kColors, 0.01));
    EXPECT_NO_THROW(write_curves_ply_lines(s, mesh, kColors));
    EXPECT_NO_THROW(write_curves_glb(s, mesh, kColors, 0.01));
    EXPECT_NO_THROW(write_curves_glb_lines(s, mesh, kColors));
  }
}

TEST(Curves, TinyobjFindsASegmentALineUnlessPolylinesAreAskedFor) {
  const Sample sample;
  for (const ObjLines form : {ObjLines::segments, ObjLines::polylines}) {
    tinyobj::ObjReader reader;
    ASSERT_TRUE(reader.ParseFromString(write_curves_obj(sample.set, sample.mesh, form), "",
                                       tinyobj::ObjReaderConfig()));
    EXPECT_EQ(reader.Warning() + reader.Error(), "");
    ASSERT_EQ(reader.GetShapes().size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      const tinyobj::shape_t& shape = reader.GetShapes()[i];
      EXPECT_EQ(shape.name, sample.set.curves[i].stroke + " snap");
      std::vector<int> expected;
      for (const auto& part : polylines(sample.set.curves[i].curve, sample.mesh))
        if (form == ObjLines::polylines)
          expected.push_back(static_cast<int>(part.size()));
        else
          expected.insert(expected.end(), part.size() - 1, 2);
      EXPECT_EQ(shape.lines.num_line_vertices, expected);
    }
  }
}

// Each point's own, from thin to thick.
std::vector<double> growing_radii(const ProjectedCurve& curve) {
  std::vector<double> radii;
  for (std::size_t i = 0; i < curve.points.size(); ++i)
    radii.push_back(1e-4 * (1.0 + 2.0 * double(i) / double(curve.points.size() - 1)));
  return radii;
}

TEST(Curves, PlyHoldsClosedTubesAsThickAsAsked) {
  if (!has_python()) GTEST_SKIP() << "python3 is not installed";
  Sample sample;
  sample.set.curves[1].radii = growing_radii(sample.set.curves[1].curve);
  const double radius = 1e-4;
  const std::string bytes = write_curves_ply(sample.set, sample.mesh, kColors, radius);
  const auto measured = read_independently("ply-tubes", bytes, sample.mesh);
  ASSERT_EQ(measured.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const CurveRecord& record = sample.set.curves[i];
    EXPECT_EQ(measured[i].parts, 2u);
    // Frustums between the points, whose ends are regular 12-gons.
    const double twelve = 12.0 * std::sin(std::acos(-1.0) / 6.0) / 2.0;
    double expected = 0.0;
    for (std::size_t p = 0; p < record.curve.pieces.size(); ++p) {
      if (record.curve.pieces[p].kind == PieceKind::gap) continue;
      const double a = record.radii.empty() ? radius : record.radii[p];
      const double b = record.radii.empty() ? radius : record.radii[p + 1];
      expected += twelve * record.curve.pieces[p].length * (a * a + a * b + b * b) / 3.0;
    }
    // Bends up to 15 degrees thin the tube by 0.9 %, rounder ones are a radius long at most.
    EXPECT_NEAR(measured[i].length / expected, 1.0, 0.02) << i;
  }
  // What reads surfaces reads it.
  const TriangleMesh mesh = read_mesh(bytes, MeshFormat::ply, "curves.ply");
  EXPECT_EQ(std::size_t(mesh.vertex_count()), measured[0].vertices + measured[1].vertices);
}

TEST(Curves, RadiiThatAreNotOneAPointAreRefusedByName) {
  Sample sample;
  sample.set.curves[1].radii = {0.1, 0.2};
  try {
    write_curves_ply(sample.set, sample.mesh, kColors, 0.1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("'s11': 2 radii for 41 points"));
  }
}

tinygltf::Model load_glb(const std::string& bytes) {
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(loader.LoadBinaryFromMemory(
      &model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
      static_cast<unsigned>(bytes.size()), "", tinygltf::REQUIRE_ALL));
  EXPECT_EQ(warning + error, "");
  return model;
}

std::vector<Vec3> vectors_of(const tinygltf::Model& model, int number) {
  const auto& accessor = model.accessors.at(std::size_t(number));
  const auto& view = model.bufferViews.at(std::size_t(accessor.bufferView));
  const auto& data = model.buffers.at(std::size_t(view.buffer)).data;
  std::vector<Vec3> positions;
  for (std::size_t i = 0; i < accessor.count; ++i) {
    float x[3];
    std::memcpy(x, data.data() + view.byteOffset + accessor.byteOffset + 12 * i, 12);
    positions.emplace_back(x[0], x[1], x[2]);
  }
  return positions;
}

std::vector<Vec3> positions_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  return vectors_of(model, primitive.attributes.at("POSITION"));
}

TEST(Curves, TinygltfFindsTheCurvesAsLineStrips) {
  const Sample sample;
  const tinygltf::Model model = load_glb(write_curves_glb_lines(sample.set, sample.mesh, kColors));
  ASSERT_EQ(model.nodes.size(), 3u);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto parts = polylines(sample.set.curves[i].curve, sample.mesh);
    const auto& primitives = model.meshes[i + 1].primitives;
    ASSERT_EQ(primitives.size(), parts.size());
    for (std::size_t p = 0; p < parts.size(); ++p) {
      EXPECT_EQ(primitives[p].mode, TINYGLTF_MODE_LINE_STRIP);
      EXPECT_EQ(primitives[p].material, int(i) + 1);
      const auto positions = positions_of(model, primitives[p]);
      ASSERT_EQ(positions.size(), parts[p].size());
      for (std::size_t k = 0; k < positions.size(); ++k)
        EXPECT_LT((positions[k] - parts[p][k]).norm(), 1e-6);  // single precision
    }
  }
}

TEST(Curves, TinygltfFindsTubesAsThickAsTheirPoints) {
  Sample sample;
  for (CurveRecord& record : sample.set.curves) record.radii = growing_radii(record.curve);
  const tinygltf::Model model = load_glb(write_curves_glb(sample.set, sample.mesh, kColors, 1.0));
  for (std::size_t i = 0; i < 2; ++i) {
    const CurveRecord& record = sample.set.curves[i];
    const auto positions = positions_of(model, model.meshes[i + 1].primitives.at(0));
    const auto off = [&](const Vec3& x) {
      double nearest = kInfinity;
      for (const Vec3& p : positions) nearest = std::min(nearest, (p - x).norm());
      return nearest;
    };
    // Rings at bends lean: their nearest vertex is at the radius or closer, by 0.9 % at most.
    const double rounding = 3e-7;
    for (std::size_t k = 0; k < record.curve.points.size(); ++k) {
      if (record.curve.closed && (k == 0 || k + 1 == record.curve.points.size())) continue;
      EXPECT_LT(off(record.curve.points[k].position), record.radii[k] + rounding) << i << " " << k;
      EXPECT_GT(off(record.curve.points[k].position), 0.99 * record.radii[k] - rounding);
    }
  }
}

TEST(Curves, TinygltfFindsRaisedTubesAroundTheRaisedPoints) {
  Sample sample;
  const double lift = 0.05, radius = 0.01;
  for (CurveRecord& record : sample.set.curves) record.lift = lift;
  const tinygltf::Model model =
      load_glb(write_curves_glb(sample.set, sample.mesh, kColors, radius));
  for (std::size_t i = 0; i < 2; ++i) {
    const auto positions = positions_of(model, model.meshes[i + 1].primitives.at(0));
    for (const CurvePoint& p : sample.set.curves[i].curve.points) {
      const Vec3 raised = p.position + lift * p.normal;
      double nearest = kInfinity;
      for (const Vec3& x : positions) nearest = std::min(nearest, (x - raised).norm());
      EXPECT_LT(nearest, radius + 3e-7);  // single precision
    }
  }
}

TEST(Curves, TinygltfFindsNormalsOfTheTargetThatTurnAtItsEdgesOnly) {
  CurveSet set;
  set.target = "cube";
  const TriangleMesh cube = make_shape("cube", {.resolution = 4});
  const tinygltf::Model model = load_glb(write_curves_glb(set, cube, {}, 0.01));
  const tinygltf::Primitive& target = model.meshes.at(0).primitives.at(0);
  const auto positions = positions_of(model, target);
  const auto normals = vectors_of(model, target.attributes.at("NORMAL"));
  ASSERT_EQ(positions.size(), normals.size());
  // Flat sides, and three normals at each of eight corners.
  std::map<std::array<double, 3>, std::set<std::array<double, 3>>> at;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    EXPECT_NEAR(normals[v].cwiseAbs().maxCoeff(), 1.0, 1e-6);
    EXPECT_NEAR(normals[v].norm(), 1.0, 1e-6);
    const auto& [x, n] = std::pair(positions[v], normals[v]);
    EXPECT_TRUE((at[{x[0], x[1], x[2]}].insert({n[0], n[1], n[2]}).second)) << "a vertex twice";
  }
  EXPECT_EQ(std::count_if(at.begin(), at.end(), [](const auto& p) { return p.second.size() == 3; }),
            8);
}

TEST(Curves, NormalsOfAMessyTargetAreOfUnitLength) {
  // A face on a line, one in a point, one and its back, and more faces around a vertex than are
  // compared with each other.
  std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 3, 0}, {1, 3, 0}, {0, 4, 0}};
  std::vector<Face> faces = {{0, 1, 2}, {0, 0, 0}, {3, 4, 5}, {3, 5, 4}};
  const Index middle = static_cast<Index>(positions.size());
  constexpr Index kAround = 300;
  positions.emplace_back(0, 0, 9);
  for (Index k = 0; k < kAround; ++k) {
    const double a = 2.0 * 3.14159265358979323846 * k / kAround;
    positions.emplace_back(std::cos(a), std::sin(a), k % 2 == 0 ? 8.0 : 7.9);
    faces.push_back({middle, middle + 1 + k, middle + 1 + (k + 1) % kAround});
  }
  const TriangleMesh mesh(positions, faces);
  CurveSet set;
  set.target = "messy";
  const tinygltf::Model model = load_glb(write_curves_glb(set, mesh, {}, 0.01));
  const tinygltf::Primitive& target = model.meshes.at(0).primitives.at(0);
  const auto places = positions_of(model, target);
  const auto normals = vectors_of(model, target.attributes.at("NORMAL"));
  ASSERT_EQ(places.size(), normals.size());
  ASSERT_GT(normals.size(), positions.size());
  int at_middle = 0;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    EXPECT_NEAR(normals[v].norm(), 1.0, 1e-6) << places[v].transpose();
    if (places[v] != positions[at(middle)]) continue;
    ++at_middle;
    EXPECT_GT(normals[v].z(), 0.9);
  }
  EXPECT_EQ(at_middle, 1);
}

TEST(Curves, TinygltfFindsTheTargetAndATubeForEachCurve) {
  const Sample sample;
  const tinygltf::Model model = load_glb(write_curves_glb(sample.set, sample.mesh, kColors, 0.01));
  ASSERT_EQ(model.nodes.size(), 3u);
  EXPECT_EQ(model.nodes[1].name, "s7 snap");
  ASSERT_EQ(model.materials.size(), 3u);
  EXPECT_EQ(model.materials[1].pbrMetallicRoughness.baseColorFactor,
            (std::vector<double>{1, 0, 0, 1}));
  // sRGB 128 is 0.2159 linear (IEC 61966-2-1).
  EXPECT_NEAR(model.materials[2].pbrMetallicRoughness.baseColorFactor[1], 0.2159, 1e-4);
  for (std::size_t i = 0; i < 2; ++i) {
    const tinygltf::Primitive& tube = model.meshes[i + 1].primitives.at(0);
    const auto& positions = model.accessors.at(std::size_t(tube.attributes.at("POSITION")));
    EXPECT_EQ(positions.count, model.accessors.at(std::size_t(tube.attributes.at("NORMAL"))).count);
    // The tube is as large as the curve with its radius around.
    Eigen::AlignedBox3d box;
    for (const auto& part : polylines(sample.set.curves[i].curve, sample.mesh))
      for (const Vec3& x : part) box.extend(x);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(positions.minValues[std::size_t(k)], box.min()[k], 0.0101);
      EXPECT_NEAR(positions.maxValues[std::size_t(k)], box.max()[k], 0.0101);
    }
  }
}

}  // namespace
}  // namespace mimicry
