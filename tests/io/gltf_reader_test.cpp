#include <cstring>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>

namespace mimicry {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Makes files with tinygltf, the independent writer.
class Scene {
 public:
  Scene() {
    model_.asset.version = "2.0";
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
  }

  template <class T>
  int accessor(const std::vector<T>& values, int type, int component_type,
               bool normalized = false) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = values.size() * sizeof(T);
    data.resize(data.size() + view.byteLength);
    std::memcpy(data.data() + view.byteOffset, values.data(), view.byteLength);
    model_.bufferViews.push_back(view);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = values.size() / (type == TINYGLTF_TYPE_VEC3 ? 3 : 1);
    accessor.normalized = normalized;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }
  int positions(const std::vector<float>& values) {
    return accessor(values, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT);
  }

  int mesh(int positions, int indices = -1, int mode = TINYGLTF_MODE_TRIANGLES) {
    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = positions;
    primitive.indices = indices;
    primitive.mode = mode;
    model_.meshes.emplace_back();
    model_.meshes.back().primitives.push_back(primitive);
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  /// parent -1: a root of the scene.
  tinygltf::Node& node(int mesh, int parent = -1) {
    const int number = static_cast<int>(model_.nodes.size());
    model_.nodes.emplace_back();
    model_.nodes.back().mesh = mesh;
    if (parent < 0)
      model_.scenes[0].nodes.push_back(number);
    else
      model_.nodes[static_cast<std::size_t>(parent)].children.push_back(number);
    return model_.nodes.back();
  }

  std::string bytes(bool binary) {
    std::stringstream out;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, out, true, binary);
    return out.str();
  }
  /// The mesh, which both forms must hold.
  TriangleMesh read() {
    const TriangleMesh mesh = read_mesh(bytes(true), MeshFormat::glb, "name");
    const TriangleMesh other = read_mesh(bytes(false), MeshFormat::gltf, "name");
    EXPECT_THAT(mesh.positions(), testing::ElementsAreArray(other.positions()));
    EXPECT_THAT(mesh.faces(), testing::ElementsAreArray(other.faces()));
    return mesh;
  }

  tinygltf::Model model_;
};

const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST(GltfReader, NodeTransformsAreAppliedFromTheRootDown) {
  Scene scene;
  const int mesh = scene.mesh(scene.positions(kTriangle));
  tinygltf::Node& parent = scene.node(-1);
  parent.translation = {10, 0, 0};
  // A quarter turn about z.
  parent.rotation = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};
  scene.node(mesh, 0).scale = {2, 3, 4};
  // Column-major: y and z change places and the origin moves.
  scene.node(mesh).matrix = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 7, 1};
  const TriangleMesh got = scene.read();
  ASSERT_EQ(got.vertex_count(), 6);
  const Vec3 wanted[] = {Vec3(10, 0, 0), Vec3(10, 2, 0), Vec3(7, 0, 0),
                         Vec3(0, 0, 7),  Vec3(1, 0, 7),  Vec3(0, 0, 8)};
  // A few roundings of numbers of 10.
  for (Index v = 0; v < 6; ++v) EXPECT_LT((got.position(v) - wanted[v]).norm(), 1e-14) << v;
  EXPECT_THAT(got.faces(), ElementsAre(Face{0, 1, 2}, Face{3, 4, 5}));
}

TEST(GltfReader, MirroringTransformKeepsTheOutsideOutside) {
  Scene scene;
  scene.node(scene.mesh(scene.positions(kTriangle))).scale = {-1, 1, 1};
  const TriangleMesh got = scene.read();
  EXPECT_EQ(got.area_vector(0), Vec3(0, 0, 1));
}

TEST(GltfReader, StripsAndFansBecomeTrianglesOfOneSense) {
  Scene scene;
  const int positions = scene.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  const int fan_positions = scene.positions({0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1});
  // Vertex 4 twice: a strip's join.
  const int indices = scene.accessor<unsigned char>({0, 1, 2, 3, 4, 4}, TINYGLTF_TYPE_SCALAR,
                                                    TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE);
  scene.node(scene.mesh(positions, indices, TINYGLTF_MODE_TRIANGLE_STRIP));
  scene.node(scene.mesh(fan_positions, -1, TINYGLTF_MODE_TRIANGLE_FAN));
  const TriangleMesh got = scene.read();
  ASSERT_EQ(got.face_count(), 5);
  for (Index f = 0; f < 5; ++f) EXPECT_EQ(got.area_vector(f), Vec3(0, 0, 1)) << f;
}

TEST(GltfReader, NormalizedWholeNumbersArePositions) {
  Scene scene;
  scene.node(
      scene.mesh(scene.accessor<short>({-32768, 0, 0, 32767, 0, 0, 0, 32767, 0}, TINYGLTF_TYPE_VEC3,
                                       TINYGLTF_COMPONENT_TYPE_SHORT, true)));
  const TriangleMesh got = scene.read();
  EXPECT_THAT(got.positions(), ElementsAre(Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)));
}

TEST(GltfReader, OnlyTheDefaultSceneIsRead) {
  Scene scene;
  const int mesh = scene.mesh(scene.positions(kTriangle));
  scene.node(mesh);
  scene.node(mesh).translation = {0, 0, 5};
  scene.model_.scenes.emplace_back();
  scene.model_.scenes[0].nodes = {0};
  scene.model_.scenes[1].nodes = {1};
  scene.model_.defaultScene = 1;
  EXPECT_EQ(scene.read().position(0), Vec3(0, 0, 5));
}

std::string error_of(Scene& scene) {
  try {
    read_mesh(scene.bytes(true), MeshFormat::glb, "name");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(GltfReader, ErrorsTellThePlace) {
  const auto broken = [](auto&& change) {
    Scene scene;
    const int indices = scene.accessor<unsigned short>({0, 1, 2}, TINYGLTF_TYPE_SCALAR,
                                                       TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    scene.node(scene.mesh(scene.positions(kTriangle), indices));
    scene.node(-1, 0);
    change(scene.model_);
    return error_of(scene);
  };
  using Model = tinygltf::Model;
  EXPECT_EQ(broken([](Model&) {}), "no error");
  EXPECT_THAT(broken([](Model& m) { m.buffers[0].data[0] = 9; }),
              HasSubstr("name: mesh 0 primitive 0: index 0 refers to vertex 9"));
  EXPECT_THAT(broken([](Model& m) { m.accessors[1].count = 4; }),
              HasSubstr("name: accessor 1: 4 elements reach beyond bufferView 1"));
  EXPECT_THAT(broken([](Model& m) { m.accessors[1].count = std::size_t{1} << 60; }),
              HasSubstr("reach beyond"));
  EXPECT_THAT(broken([](Model& m) { m.bufferViews[1].byteOffset = 1000; }),
              HasSubstr("bufferView 1: begins beyond its buffer"));
  EXPECT_THAT(broken([](Model& m) { m.bufferViews[1].byteStride = 4; }), HasSubstr("reach beyond"));
  EXPECT_THAT(broken([](Model& m) { m.accessors[1].type = TINYGLTF_TYPE_VEC2; }),
              HasSubstr("accessor 1: is not of type VEC3"));
  EXPECT_THAT(broken([](Model& m) { m.nodes[1].children = {0}; }),
              HasSubstr("node 0: stands below itself, in a ring"));
  EXPECT_THAT(broken([](Model& m) {
                m.nodes.emplace_back();
                m.nodes[2].children = {1};
              }),
              HasSubstr("node 1: is a child of node 0 and of node 2"));
  EXPECT_THAT(broken([](Model& m) { m.nodes[0].mesh = 5; }),
              HasSubstr("node 0: refers to meshes 5, but there are 1"));
  EXPECT_THAT(broken([](Model& m) { m.asset.version = "1.0"; }), HasSubstr("version '1.0'"));
}

/// The z of each triangle, and what the reader told.
struct Shown {
  std::vector<double> heights;
  std::vector<std::string> notes;
};
Shown shown(Scene& scene) {
  Shown out;
  MeshReadOptions options;
  options.note = [&](const std::string& sentence) { out.notes.push_back(sentence); };
  const TriangleMesh mesh = read_mesh(scene.bytes(false), MeshFormat::gltf, "name", options);
  for (Index f = 0; f < mesh.face_count(); ++f) out.heights.push_back(mesh.corner(f, 0).z());
  return out;
}

/// Triangles at heights 0, 1, 2, roots all.
Scene three_heights() {
  Scene scene;
  const int mesh = scene.mesh(scene.positions(kTriangle));
  for (const double z : {0.0, 1.0, 2.0}) scene.node(mesh).translation = {0, 0, z};
  return scene;
}

TEST(GltfScenes, WithoutOneAllNodesAreShown) {
  Scene scene = three_heights();
  scene.model_.scenes.clear();
  scene.model_.defaultScene = -1;
  EXPECT_THAT(shown(scene).heights, ElementsAre(0, 1, 2));
  EXPECT_THAT(shown(scene).notes, testing::IsEmpty());
  scene.model_.nodes.clear();  // and without nodes all meshes
  EXPECT_THAT(shown(scene).heights, ElementsAre(0));
  EXPECT_THAT(shown(scene).notes, ElementsAre(HasSubstr("no node shows a mesh")));
}

TEST(GltfScenes, AnEmptyOneIsPassedOver) {
  Scene scene = three_heights();
  scene.model_.scenes[0].nodes.clear();
  EXPECT_THAT(shown(scene).heights, ElementsAre(0, 1, 2));
  EXPECT_THAT(shown(scene).notes, ElementsAre(HasSubstr("the default scene shows no mesh")));
}

TEST(GltfScenes, OneThatDoesNotExistIsTheFirst) {
  Scene scene = three_heights();
  scene.model_.defaultScene = 9;
  scene.model_.scenes[0].nodes = {1};
  EXPECT_THAT(shown(scene).heights, ElementsAre(1));
  EXPECT_THAT(shown(scene).notes, ElementsAre("there is no scene 9; scene 0 was read"));
}

TEST(GltfScenes, NodesThatAreListedTwiceOrBelowOthersAreShownOnce) {
  Scene scene = three_heights();
  scene.model_.nodes[0].children = {1};
  scene.model_.nodes[0].translation = {0, 0, 10};
  scene.model_.scenes[0].nodes = {1, 0, 1, 2, 2};
  EXPECT_THAT(shown(scene).heights, ElementsAre(10, 11, 2));
  scene.model_.scenes[0].nodes = {1};  // though its parent is not shown
  EXPECT_THAT(shown(scene).heights, ElementsAre(11));
}

TEST(GltfNodes, RotationsThatAreNoneAreReadAsSuch) {
  Scene scene = three_heights();
  scene.model_.nodes[0].rotation = {0, 0, 0, 0};
  scene.model_.nodes[1].rotation = {0, 0, 0, 5};
  EXPECT_THAT(shown(scene).heights, ElementsAre(0, 1, 2));
  EXPECT_THAT(shown(scene).notes,
              ElementsAre("node 0: 'rotation' is no quaternion; taken for none",
                          "node 1: 'rotation' is no unit quaternion; made one"));
}

TEST(GltfPrimitives, PointsAndLinesArePassedOver) {
  Scene scene = three_heights();
  scene.node(scene.mesh(0, -1, TINYGLTF_MODE_LINE));
  EXPECT_THAT(shown(scene).heights, ElementsAre(0, 1, 2));
  EXPECT_THAT(shown(scene).notes, ElementsAre(HasSubstr("mesh 1 primitive 0 has points or lines")));
}

TEST(GltfPrimitives, CornersThatMakeNoTriangleArePassedOver) {
  Scene scene;
  scene.node(scene.mesh(scene.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 9})));
  EXPECT_THAT(shown(scene).heights, ElementsAre(0));
  EXPECT_THAT(shown(scene).notes, ElementsAre(HasSubstr("4 corners do not make whole triangles")));
}

TEST(GltfExtensions, ThoseThatSayNothingOfGeometryAreNoted) {
  for (const char* name :
       {"KHR_materials_unlit", "KHR_texture_transform", "KHR_texture_basisu", "EXT_texture_webp",
        "KHR_lights_punctual", "EXT_lights_image_based", "KHR_materials_pbrSpecularGlossiness",
        "KHR_xmp_json_ld", "KHR_animation_pointer", "EXT_structural_metadata", "EXT_mesh_features",
        "KHR_techniques_webgl", "KHR_audio_emitter", "VENDOR_look"}) {
    Scene scene = three_heights();
    scene.model_.extensionsRequired = {name};
    scene.model_.materials.emplace_back();
    scene.model_.materials[0].extensions[name] = tinygltf::Value(tinygltf::Value::Object());
    EXPECT_THAT(shown(scene).heights, ElementsAre(0, 1, 2)) << name;
    EXPECT_THAT(shown(scene).notes, ElementsAre(HasSubstr("says nothing of geometry"))) << name;
  }
}

TEST(GltfExtensions, UnknownOnesThatCouldChangeItAreRefusedByName) {
  const auto refusal = [](auto&& change) {
    Scene scene = three_heights();
    scene.model_.extensionsRequired = {"VENDOR_shape"};
    change(scene.model_);
    return error_of(scene);
  };
  const tinygltf::Value something{tinygltf::Value::Object()};
  EXPECT_THAT(refusal([](auto&) {}),
              HasSubstr("extensionsRequired: 'VENDOR_shape' is not handled"));
  EXPECT_THAT(refusal([&](auto& m) {
                m.meshes[0].primitives[0].extensions["VENDOR_shape"] = something;
                m.materials.emplace_back();
                m.materials[0].extensions["VENDOR_shape"] = something;
              }),
              HasSubstr("'VENDOR_shape' is not handled"));
  EXPECT_EQ(refusal([](auto& m) { m.extensionsUsed = std::move(m.extensionsRequired); }),
            "no error");
}

}  // namespace
}  // namespace mimicry
