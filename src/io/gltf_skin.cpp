#include "io/gltf_skin.h"

namespace mimicry {

std::vector<GltfTransform> joint_matrices(const GltfJson& gltf, GltfBuffers& buffers,
                                          const GltfNodes& nodes, std::size_t skin,
                                          const std::string& user) {
  const Json& object = gltf.item("skins", skin, user);
  const std::string place = "skin " + std::to_string(skin);
  const auto joints = gltf.numbers_of(object, "joints", gltf.array("nodes").size(), place, "node");
  if (joints.empty()) gltf.fail(place, "has no joints; export the file again");
  std::vector<GltfTransform> out;
  out.reserve(joints.size());
  for (const std::size_t joint : joints) out.push_back(nodes.world(joint));
  if (!GltfJson::find(object, "inverseBindMatrices")) return out;
  const GltfAccessor inverse_bind(gltf, buffers, gltf.whole(object, "inverseBindMatrices", place),
                                  "MAT4", place);
  if (inverse_bind.count() < joints.size())
    gltf.fail(place, "has " + std::to_string(joints.size()) + " joints and " +
                         std::to_string(inverse_bind.count()) +
                         " inverse bind matrices; export the file again");
  for (std::size_t j = 0; j < joints.size(); ++j) {
    GltfTransform from_model;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        from_model.matrix()(row, column) =
            inverse_bind.at(j, static_cast<std::size_t>(4 * column + row));
    out[j] = out[j] * from_model;
  }
  return out;
}

GltfTransform skinned(const GltfJson& gltf, const GltfVertices& vertices, std::size_t v,
                      const std::vector<GltfTransform>& joints, const std::string& place) {
  const auto joint = [&](const GltfVertices::Influence& influence, std::size_t k) -> const auto& {
    const double j = influence.joints.at(v, k);
    if (!(j >= 0.0 && j < static_cast<double>(joints.size())))
      gltf.fail(place, "vertex " + std::to_string(v) + " refers to joint " +
                           std::to_string(static_cast<long long>(j)) + ", but the skin has " +
                           std::to_string(joints.size()) + "; export the file again");
    return joints[static_cast<std::size_t>(j)];
  };
  GltfTransform sum;
  sum.matrix().setZero();
  double total = 0.0;
  for (const auto& influence : vertices.influences)
    for (std::size_t k = 0; k < 4; ++k) {
      const double weight = influence.weights.at(v, k);
      if (weight == 0.0) continue;
      total += weight;
      sum.matrix() += weight * joint(influence, k).matrix();
    }
  if (total == 0.0) return joint(vertices.influences.front(), 0);
  if (total != 1.0) sum.matrix() /= total;
  return sum;
}

}  // namespace mimicry
