#include "io/gltf_nodes.h"

#include <cmath>

namespace mimicry {
namespace {

constexpr auto kNoParent = static_cast<std::size_t>(-1);

std::string node_place(std::size_t n) {
  return "node " + std::to_string(n);
}

}  // namespace

GltfTransform gltf_transform(const Vec3& translation, const Eigen::Vector4d& rotation,
                             const Vec3& scale) {
  GltfTransform out = GltfTransform::Identity();
  out.translation() = translation;
  const Quat q(rotation);
  out.linear() = q.normalized().toRotationMatrix() * scale.asDiagonal();
  return out;
}

GltfNodes::GltfNodes(const GltfJson& gltf) : gltf_(gltf), nodes_(&gltf.array("nodes")) {
  find_parents();
  place_all();
}

void GltfNodes::find_parents() {
  const std::size_t count = nodes_->size();
  children_.resize(count);
  parents_.assign(count, kNoParent);
  for (std::size_t n = 0; n < count; ++n) {
    children_[n] = gltf_.numbers_of(node(n), "children", count, node_place(n), "node");
    for (const std::size_t child : children_[n]) {
      if (parents_[child] != kNoParent)
        gltf_.fail(node_place(child), "is a child of node " + std::to_string(parents_[child]) +
                                          " and of node " + std::to_string(n) +
                                          "; export the file again");
      parents_[child] = n;
    }
  }
}

void GltfNodes::place_all() {
  const std::size_t count = nodes_->size();
  order_.reserve(count);
  world_.assign(count, GltfTransform::Identity());
  for (std::size_t n = 0; n < count; ++n)
    if (parents_[n] == kNoParent) order_.push_back(n);
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const std::size_t n = order_[k];
    order_.insert(order_.end(), children_[n].begin(), children_[n].end());
    world_[n] = parents_[n] == kNoParent ? local(n) : world_[parents_[n]] * local(n);
  }
  if (order_.size() == count) return;
  std::vector<bool> placed(count, false);
  for (const std::size_t n : order_) placed[n] = true;
  for (std::size_t n = 0; n < count; ++n)
    if (!placed[n])
      gltf_.fail(node_place(n), "stands below itself, in a ring; export the file again");
}

GltfTransform GltfNodes::local(std::size_t n) const {
  const std::string place = node_place(n);
  if (const auto m = gltf_.numbers<16>(node(n), "matrix", place)) {
    GltfTransform out;
    out.matrix() = Eigen::Map<const Eigen::Matrix4d>(m->data()).topRows<3>();
    return out;
  }
  const auto t = gltf_.numbers<3>(node(n), "translation", place);
  const auto r = gltf_.numbers<4>(node(n), "rotation", place);
  const auto s = gltf_.numbers<3>(node(n), "scale", place);
  Eigen::Vector4d rotation = r ? Eigen::Vector4d(r->data()) : Eigen::Vector4d::UnitW();
  const double norm = rotation.norm();
  if (!(norm > 0.0 && std::isfinite(norm))) {
    gltf_.note(place + ": 'rotation' is no quaternion; taken for none");
    rotation = Eigen::Vector4d::UnitW();
  } else if (std::abs(norm - 1.0) > 1e-2) {
    gltf_.note(place + ": 'rotation' is no unit quaternion; made one");
  }
  return gltf_transform(t ? Vec3(t->data()) : Vec3(0, 0, 0), rotation,
                        s ? Vec3(s->data()) : Vec3(1, 1, 1));
}

std::vector<std::size_t> GltfNodes::scene_roots() const {
  const Json& scenes = gltf_.array("scenes");
  if (scenes.empty()) return {};
  std::size_t index = gltf_.whole(gltf_.root(), "scene", "scene", 0);
  if (index >= scenes.size()) {
    gltf_.note("there is no scene " + std::to_string(index) + "; scene 0 was read");
    index = 0;
  }
  return gltf_.numbers_of(scenes[index], "nodes", nodes_->size(), "scene " + std::to_string(index),
                          "node");
}

std::vector<std::size_t> GltfNodes::with_mesh(const std::vector<std::size_t>& roots) const {
  std::vector<bool> listed(nodes_->size(), false);
  for (const std::size_t root : roots) listed[root] = true;
  std::vector<bool> below(nodes_->size(), false);  // below one that is listed
  for (const std::size_t n : order_) {
    const std::size_t parent = parents_[n];
    below[n] = parent != kNoParent && (listed[parent] || below[parent]);
  }
  std::vector<std::size_t> out;
  std::vector<std::size_t> stack;
  for (const std::size_t root : roots) {
    if (!listed[root] || below[root]) continue;
    listed[root] = false;  // once, however often the scene names it
    stack.assign(1, root);
    while (!stack.empty()) {
      const std::size_t n = stack.back();
      stack.pop_back();
      if (GltfJson::find(node(n), "mesh")) out.push_back(n);
      stack.insert(stack.end(), children_[n].rbegin(), children_[n].rend());
    }
  }
  return out;
}

std::vector<std::size_t> GltfNodes::shown() const {
  std::vector<std::size_t> out = with_mesh(scene_roots());
  if (out.empty()) {
    std::vector<std::size_t> roots;
    for (std::size_t n = 0; n < nodes_->size(); ++n)
      if (parents_[n] == kNoParent) roots.push_back(n);
    out = with_mesh(roots);
    if (!out.empty() && !gltf_.array("scenes").empty())
      gltf_.note("the default scene shows no mesh; all nodes of the file were read");
  } else if (gltf_.array("scenes").size() > 1) {
    gltf_.note("only the default one of " + std::to_string(gltf_.array("scenes").size()) +
               " scenes was read");
  }
  return out;
}

}  // namespace mimicry
