#include "render/scene.h"

#include <cmath>

#include "render/checks.h"

namespace mimicry::render {
namespace {

void check(const Surface& surface, const std::string& name) {
  if (surface.mesh == nullptr) refuse(name + ": no mesh");
  const TriangleMesh& mesh = *surface.mesh;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (const Index v : mesh.face(f)) {
      if (!finite(mesh.position(v))) {
        refuse(name + ": vertex " + std::to_string(v) + " of face " + std::to_string(f) +
               " is not finite; repair the mesh");
      }
    }
  }
  if (surface.iso_values.empty()) return;
  if (surface.iso_values.size() != mesh.positions().size()) {
    refuse(name + ": " + std::to_string(surface.iso_values.size()) + " iso values for " +
           std::to_string(mesh.vertex_count()) + " vertices; give one per vertex");
  }
  for (std::size_t v = 0; v < surface.iso_values.size(); ++v) {
    if (!std::isfinite(surface.iso_values[v])) {
      refuse(name + ": iso value of vertex " + std::to_string(v) + " is not finite");
    }
  }
  if (!positive(surface.iso_spacing)) {
    refuse(name + ": iso spacing must be positive and finite");
  }
}

void check(const Tube& tube, const std::string& name) {
  if (!positive(tube.radius)) {
    refuse(name + ": the radius must be positive and finite");
  }
  if (!std::isfinite(tube.camera_weight) || tube.camera_weight < 0.0) {
    refuse(name + ": the camera weight must be finite and not negative");
  }
  for (std::size_t i = 0; i < tube.points.size(); ++i) {
    if (!finite(tube.points[i])) {
      refuse(name + ": point " + std::to_string(i) + " is not finite; leave misses out");
    }
  }
}

}  // namespace

std::string tube_name(const Scene& scene, std::size_t t) {
  const std::string& label = scene.tubes[t].label;
  return "tube " + std::to_string(t) + (label.empty() ? "" : " (" + label + ")");
}

void check(const Scene& scene) {
  if (!finite(scene.up) || std::abs(scene.up.norm() - 1.0) > 1e-6)
    refuse("scene: up must be a unit vector");
  bool anything = false;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    check(scene.surfaces[s], "surface " + std::to_string(s));
    anything = anything || scene.surfaces[s].mesh->face_count() > 0;
  }
  for (std::size_t t = 0; t < scene.tubes.size(); ++t) {
    check(scene.tubes[t], tube_name(scene, t));
    anything = anything || !scene.tubes[t].points.empty();
  }
  if (!anything) refuse("scene: nothing to draw; give a mesh with faces or a tube with points");
}

Eigen::AlignedBox3d bounds(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for_each_point(scene, [&](const Vec3& p, double radius) {
    box.extend(p - Vec3::Constant(radius));
    box.extend(p + Vec3::Constant(radius));
  });
  return box;
}

}  // namespace mimicry::render
