#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>
#include <tiny_obj_loader.h>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>

#include "io/mesh_fixtures.h"

namespace mimicry {
namespace {

using testing::ElementsAreArray;

struct Form {
  MeshFormat format;
  bool text;
  bool single;
  const char* name;
};

constexpr Form kForms[] = {
    {MeshFormat::obj, false, false, "obj"}, {MeshFormat::ply, true, false, "ply"},
    {MeshFormat::ply, false, false, "ply"}, {MeshFormat::off, false, false, "off"},
    {MeshFormat::stl, true, true, "stl"},   {MeshFormat::stl, false, true, "stl"},
    {MeshFormat::glb, false, true, "glb"},
};

void expect_same(const TriangleMesh& got, const TriangleMesh& wanted) {
  EXPECT_THAT(got.positions(), ElementsAreArray(wanted.positions()));
  EXPECT_THAT(got.faces(), ElementsAreArray(wanted.faces()));
}

/// One vertex per corner, as STL holds a mesh.
TriangleMesh corners_apart(const TriangleMesh& mesh) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    for (int k = 0; k < 3; ++k) positions.push_back(mesh.corner(f, k));
  }
  return {std::move(positions), std::move(faces)};
}

TEST(MeshWriter, EveryFormatReadsBackWithEveryBitItHolds) {
  for (const Form& form : kForms) {
    SCOPED_TRACE(form.name);
    const TriangleMesh mesh = rough_grid(12, 3, form.single);
    const TriangleMesh back =
        read_mesh(write_mesh(mesh, form.format, {.text = form.text}), form.format, form.name);
    if (form.format == MeshFormat::stl) {
      // Vertices are numbered anew by first appearance.
      expect_same(corners_apart(back), corners_apart(mesh));
      EXPECT_EQ(back.vertex_count(), mesh.vertex_count());
    } else {
      expect_same(back, mesh);
    }
  }
}

TEST(MeshWriter, NumbersOutsideSinglePrecisionAreRefusedWhereTheFormatCannotHoldThem) {
  const TriangleMesh mesh({Vec3(1e39, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}});
  for (const Form& form : kForms) {
    SCOPED_TRACE(form.name);
    if (form.single)
      EXPECT_THROW(write_mesh(mesh, form.format, {.text = form.text}), Error);
    else
      expect_same(read_mesh(write_mesh(mesh, form.format, {.text = form.text}), form.format, "x"),
                  mesh);
  }
  EXPECT_THROW(write_mesh(tetrahedron(), MeshFormat::gltf), Error);
}

TEST(MeshWriter, PythonReadsPlyStlAndOffTheSame) {
  if (std::system("python3 --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "python3 is not installed";
  for (const Form& form : kForms) {
    if (form.format == MeshFormat::obj || form.format == MeshFormat::glb) continue;
    SCOPED_TRACE(std::string(form.name) + (form.text ? " text" : ""));
    TriangleMesh mesh = rough_grid(12, 5, form.single);
    const std::string path = testing::TempDir() + "mimicry_writer_test." + form.name;
    std::ofstream(path, std::ios::binary) << write_mesh(mesh, form.format, {.text = form.text});
    const std::string command =
        std::string("python3 " MIMICRY_INDEPENDENT_READER " ") + form.name + " " + path;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::vector<Vec3> positions;
    std::vector<Face> faces;
    char line[256];
    while (std::fgets(line, sizeof(line), pipe.get())) {
      Vec3 p;
      Face f;
      if (std::sscanf(line, "v %la %la %la", &p[0], &p[1], &p[2]) == 3) positions.push_back(p);
      if (std::sscanf(line, "f %d %d %d", &f[0], &f[1], &f[2]) == 3) faces.push_back(f);
    }
    std::remove(path.c_str());
    if (form.format == MeshFormat::stl) mesh = corners_apart(mesh);
    expect_same({std::move(positions), std::move(faces)}, mesh);
  }
}

TEST(MeshWriter, TinyobjloaderReadsObjTheSame) {
  const TriangleMesh mesh = rough_grid(12, 7, false);
  std::istringstream stream(write_mesh(mesh, MeshFormat::obj));
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  ASSERT_TRUE(
      tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, nullptr));
  EXPECT_EQ(warning + error, "");
  ASSERT_EQ(shapes.size(), 1u);
  std::vector<Vec3> positions;
  for (std::size_t k = 0; k < attributes.vertices.size(); k += 3)
    positions.emplace_back(attributes.vertices[k], attributes.vertices[k + 1],
                           attributes.vertices[k + 2]);
  std::vector<Face> faces;
  const auto& indices = shapes[0].mesh.indices;
  for (std::size_t k = 0; k < indices.size(); k += 3)
    faces.push_back(
        {indices[k].vertex_index, indices[k + 1].vertex_index, indices[k + 2].vertex_index});
  // tinyobjloader's own number parser is not exact to the last bits.
  ASSERT_EQ(positions.size(), static_cast<std::size_t>(mesh.vertex_count()));
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_LT((positions[static_cast<std::size_t>(v)] - mesh.position(v)).norm(), 1e-13) << v;
  EXPECT_THAT(faces, ElementsAreArray(mesh.faces()));
}

TEST(MeshWriter, TinygltfReadsGlbTheSame) {
  const TriangleMesh mesh = rough_grid(12, 9, true);
  const std::string bytes = write_mesh(mesh, MeshFormat::glb);
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  ASSERT_TRUE(loader.LoadBinaryFromMemory(
      &model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
      static_cast<unsigned>(bytes.size()), "", tinygltf::REQUIRE_ALL))
      << error;
  EXPECT_EQ(warning + error, "");
  ASSERT_EQ(model.meshes.size(), 1u);
  ASSERT_EQ(model.scenes.at(static_cast<std::size_t>(model.defaultScene)).nodes,
            std::vector<int>{0});
  EXPECT_EQ(model.nodes.at(0).mesh, 0);
  const tinygltf::Primitive& primitive = model.meshes[0].primitives.at(0);
  EXPECT_EQ(primitive.mode, TINYGLTF_MODE_TRIANGLES);
  const auto data = [&](int index, int type, int component) {
    const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(index));
    EXPECT_EQ(accessor.type, type);
    EXPECT_EQ(accessor.componentType, component);
    const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
    return std::pair(
        model.buffers.at(static_cast<std::size_t>(view.buffer)).data.data() + view.byteOffset,
        accessor.count);
  };
  const int position_index = primitive.attributes.at("POSITION");
  const auto [p, vertex_count] =
      data(position_index, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT);
  const auto [c, corner_count] =
      data(primitive.indices, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
  std::vector<float> coordinates(3 * vertex_count);
  std::memcpy(coordinates.data(), p, 12 * vertex_count);
  std::vector<Face> faces(corner_count / 3);
  std::memcpy(faces.data(), c, 4 * corner_count);
  std::vector<Vec3> positions;
  for (std::size_t v = 0; v < vertex_count; ++v)
    positions.push_back(Eigen::Map<Eigen::Vector3f>(&coordinates[3 * v]).cast<double>());
  expect_same({std::move(positions), std::move(faces)}, mesh);

  const Eigen::AlignedBox3d box = bounding_box(mesh);
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(position_index)];
  EXPECT_EQ(Vec3(accessor.minValues.data()), box.min());
  EXPECT_EQ(Vec3(accessor.maxValues.data()), box.max());
}

}  // namespace
}  // namespace mimicry
