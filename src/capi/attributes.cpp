#include "capi/handles.h"

using namespace mimicry;

namespace {

const MeshAttributes* attributes_of(const mimicry_mesh* mesh) {
  return mesh ? mesh->mesh.attributes().get() : nullptr;
}

template <std::size_t N>
mimicry_corner_values corner_values(const CornerValues<N>& values) {
  if (values.empty()) return {nullptr, 0, nullptr};
  return {values.values[0].data(), values.values.size(), values.corners.data()};
}

const FaceLabels& labels_of(const mimicry_mesh* mesh, mimicry_label_kind kind) {
  static const FaceLabels none;
  const MeshAttributes* attributes = attributes_of(mesh);
  if (!attributes) return none;
  switch (kind) {
    case MIMICRY_GROUPS:
      return attributes->groups;
    case MIMICRY_MATERIALS:
      return attributes->materials;
    case MIMICRY_OBJECTS:
      return attributes->objects;
  }
  return none;
}

}  // namespace

mimicry_corner_values mimicry_mesh_texcoords(const mimicry_mesh* mesh) {
  const MeshAttributes* attributes = attributes_of(mesh);
  return attributes ? corner_values(attributes->texcoords)
                    : mimicry_corner_values{nullptr, 0, nullptr};
}

mimicry_corner_values mimicry_mesh_colors(const mimicry_mesh* mesh) {
  const MeshAttributes* attributes = attributes_of(mesh);
  return attributes ? corner_values(attributes->colors)
                    : mimicry_corner_values{nullptr, 0, nullptr};
}

const int32_t* mimicry_mesh_face_labels(const mimicry_mesh* mesh, mimicry_label_kind kind) {
  const FaceLabels& labels = labels_of(mesh, kind);
  return labels.empty() ? nullptr : labels.of_face.data();
}

size_t mimicry_mesh_label_count(const mimicry_mesh* mesh, mimicry_label_kind kind) {
  return labels_of(mesh, kind).names.size();
}

const char* mimicry_mesh_label_name(const mimicry_mesh* mesh, mimicry_label_kind kind,
                                    size_t number) {
  const FaceLabels& labels = labels_of(mesh, kind);
  return number < labels.names.size() ? labels.names[number].c_str() : nullptr;
}
