#include <mimicry/stroke/stroke.h>

#include "base/comma_list.h"
#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

namespace {

const CoordinateConvention& convention_of(const char* given) {
  const std::string_view name = text(given, "convention");
  if (const auto* found = find_convention(name)) return *found;
  const std::string names = comma_list(conventions(), [](const auto& c) { return c.name; });
  throw Error(ErrorKind::invalid_input,
              "convention '" + std::string(name) + "' does not exist; choose one of " + names);
}

// to[i] = convert(from[i]); one place may be the other.
template <class Convert>
mimicry_status vectors(const char* convention, const double* from, size_t count, double* to,
                       Convert&& convert) {
  return guarded([&] {
    const CoordinateConvention& c = convention_of(convention);
    if (count > 0) {
      require(from, "from");
      require(to, "to");
    }
    for (size_t i = 0; i < count; ++i) put(to + 3 * i, convert(c, vec3(from + 3 * i)));
  });
}

template <class Convert>
mimicry_status frames(const char* convention, const mimicry_frame* from, size_t count,
                      mimicry_frame* to, Convert&& convert) {
  return guarded([&] {
    const CoordinateConvention& c = convention_of(convention);
    if (count > 0) {
      require(from, "from");
      require(to, "to");
    }
    for (size_t i = 0; i < count; ++i) to[i] = from_frame(convert(c, to_frame(from[i])));
  });
}

template <class Convert>
mimicry_status placement(const char* convention, const mimicry_similarity* from,
                         mimicry_similarity* to, Convert&& convert) {
  return guarded([&] {
    const CoordinateConvention& c = convention_of(convention);
    require(to, "to");
    *to = from_similarity(convert(c, to_similarity(from)));
  });
}

template <class Convert>
mimicry_status mesh(const char* convention, const mimicry_mesh* from, mimicry_mesh** out,
                    Convert&& convert) {
  return made(out, [&] {
    const CoordinateConvention& c = convention_of(convention);
    require(from, "mesh");
    std::vector<Vec3> positions;
    for (const Vec3& x : from->mesh.positions()) positions.push_back(convert(c, x));
    std::vector<Face> faces(from->mesh.faces().begin(), from->mesh.faces().end());
    const bool mirrors = c.world_axes.determinant() < 0.0;
    if (mirrors)
      for (Face& face : faces) std::swap(face[1], face[2]);
    TriangleMesh mesh(std::move(positions), std::move(faces));
    std::shared_ptr<const MeshAttributes> attributes = from->mesh.attributes();
    if (attributes && mirrors) {
      auto turned = std::make_shared<MeshAttributes>(*attributes);
      turned->turn_faces(std::vector<bool>(at(mesh.face_count()), true));
      attributes = std::move(turned);
    }
    mesh.set_attributes(std::move(attributes));
    return mimicry_mesh{from->name, std::move(mesh), from->metres_per_unit};
  });
}

using Convention = CoordinateConvention;

}  // namespace

int32_t mimicry_convention_count(void) {
  return static_cast<int32_t>(conventions().size());
}

const char* mimicry_convention(int32_t number) {
  const auto all = conventions();
  // Their names are literals.
  return number < 0 || at(number) >= all.size() ? nullptr : all[at(number)].name.data();
}

mimicry_status mimicry_frames_in(const char* convention, const mimicry_frame* from, size_t count,
                                 mimicry_frame* to) {
  return frames(convention, from, count, to,
                [](const Convention& c, const Frame& f) { return c.frame_in(f); });
}
mimicry_status mimicry_frames_out(const char* convention, const mimicry_frame* from, size_t count,
                                  mimicry_frame* to) {
  return frames(convention, from, count, to,
                [](const Convention& c, const Frame& f) { return c.frame_out(f); });
}

mimicry_status mimicry_placement_in(const char* convention, const mimicry_similarity* from,
                                    mimicry_similarity* to) {
  return placement(convention, from, to,
                   [](const Convention& c, const Similarity& s) { return c.placement_in(s); });
}
mimicry_status mimicry_placement_out(const char* convention, const mimicry_similarity* from,
                                     mimicry_similarity* to) {
  return placement(convention, from, to,
                   [](const Convention& c, const Similarity& s) { return c.placement_out(s); });
}

mimicry_status mimicry_positions_in(const char* convention, const double* from, size_t count,
                                    double* to) {
  return vectors(convention, from, count, to,
                 [](const Convention& c, const Vec3& x) { return c.position_in(x); });
}
mimicry_status mimicry_positions_out(const char* convention, const double* from, size_t count,
                                     double* to) {
  return vectors(convention, from, count, to,
                 [](const Convention& c, const Vec3& x) { return c.position_out(x); });
}
mimicry_status mimicry_axes_in(const char* convention, const double* from, size_t count,
                               double* to) {
  return vectors(convention, from, count, to,
                 [](const Convention& c, const Vec3& x) { return c.direction_in(x); });
}
mimicry_status mimicry_axes_out(const char* convention, const double* from, size_t count,
                                double* to) {
  return vectors(convention, from, count, to,
                 [](const Convention& c, const Vec3& x) { return c.direction_out(x); });
}

mimicry_status mimicry_mesh_in(const char* convention, const mimicry_mesh* from,
                               mimicry_mesh** out) {
  return mesh(convention, from, out,
              [](const Convention& c, const Vec3& x) { return c.direction_in(x); });
}
mimicry_status mimicry_mesh_out(const char* convention, const mimicry_mesh* from,
                                mimicry_mesh** out) {
  return mesh(convention, from, out,
              [](const Convention& c, const Vec3& x) { return c.direction_out(x); });
}
