#include <numeric>

#include <mimicry/io/embedding_file.h>

#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

namespace {

// The file's name goes before messages of what does not know it.
template <class Body>
auto named(const std::string& name, Body&& body) {
  try {
    return body();
  } catch (const Error& error) {
    const std::string message = error.what();
    if (name.empty() || message.starts_with(name)) throw;
    throw Error(error.kind(), name + ": " + message);
  }
}

// Of the caller's vertices, where they are others than the surface's.
void take_normals(const Target& target, mimicry_target_view& view) {
  const MeshSource* source = target.mesh().source();
  if (!source) return;
  const std::span<const Vec3> normals = target.vertex_normals();
  view.normals.resize(source->surface_vertex.size(), Vec3::Zero());
  for (std::size_t v = 0; v < view.normals.size(); ++v)
    if (const Index s = source->surface_vertex[v]; s != kNone) view.normals[v] = normals[at(s)];
}

std::shared_ptr<mimicry_target_view> view_of(const Target& target, const std::string& name) {
  auto view = std::make_shared<mimicry_target_view>();
  view->name = name;
  for (const std::string& sentence : target.connection().sentences())
    view->notes += (view->notes.empty() ? "" : "\n") + sentence;
  take_normals(target, *view);
  if (const MeshSource* source = target.mesh().source()) {
    view->surface_sources = source->vertex;
    view->surface_vertices = source->surface_vertex;
  } else {
    view->surface_sources.resize(target.vertex_normals().size());
    std::iota(view->surface_sources.begin(), view->surface_sources.end(), 0);
    view->surface_vertices = view->surface_sources;
  }
  return view;
}

}  // namespace

mimicry_target_options mimicry_default_target_options(void) {
  return {1, 0};
}

mimicry_status mimicry_target_make(const mimicry_mesh* mesh, const mimicry_target_options* options,
                                   mimicry_target** out) {
  return made(out, [&] {
    require(mesh, "mesh");
    return named(mesh->name, [&] {
      const mimicry_target_options o = options ? *options : mimicry_default_target_options();
      auto target = std::make_shared<Target>(
          mesh->mesh, TargetOptions{.join = o.join != 0, .strict = o.strict != 0});
      auto view = view_of(*target, mesh->name);
      return mimicry_target{std::move(target), std::move(view), nullptr};
    });
  });
}

mimicry_status mimicry_target_create(const mimicry_mesh* mesh, int32_t, mimicry_target** out) {
  return mimicry_target_make(mesh, nullptr, out);
}

const char* mimicry_target_notes(const mimicry_target* target) {
  return target ? target->view->notes.c_str() : "";
}
size_t mimicry_target_surface_vertex_count(const mimicry_target* target) {
  return target ? target->view->surface_sources.size() : 0;
}
const int32_t* mimicry_target_surface_sources(const mimicry_target* target) {
  return target ? target->view->surface_sources.data() : nullptr;
}
const int32_t* mimicry_target_surface_faces(const mimicry_target* target) {
  return target ? target->target->mesh().faces()[0].data() : nullptr;
}
const int32_t* mimicry_target_surface_vertices(const mimicry_target* target) {
  return target ? target->view->surface_vertices.data() : nullptr;
}

void mimicry_target_destroy(mimicry_target* target) {
  delete target;
}

const double* mimicry_target_vertex_normals(const mimicry_target* target) {
  if (!target) return nullptr;
  const std::vector<Vec3>& own = target->view->normals;
  return own.empty() ? target->target->vertex_normals()[0].data() : own[0].data();
}
double mimicry_target_diagonal(const mimicry_target* target) {
  return target ? target->target->diagonal() : 0.0;
}

mimicry_status mimicry_target_closest_point(const mimicry_target* target, const double y[3],
                                            double upper_bound, int32_t hint,
                                            mimicry_surface_point* out) {
  return guarded([&] {
    require(target, "target");
    require(y, "y");
    require(out, "out");
    const auto found = target->target->closest_point(vec3(y), upper_bound, hint);
    *out = from_found(*target->target, found);
  });
}

mimicry_status mimicry_target_first_hit(const mimicry_target* target, const double origin[3],
                                        const double direction[3], mimicry_surface_point* out) {
  return guarded([&] {
    require(target, "target");
    require(origin, "origin");
    require(direction, "direction");
    require(out, "out");
    const auto found = target->target->first_hit(vec3(origin), vec3(direction));
    *out = from_found(*target->target, found);
  });
}

mimicry_status mimicry_target_update_positions(mimicry_target* target, const double* positions,
                                               size_t vertex_count) {
  return guarded([&] {
    require(target, "target");
    require(positions, "positions");
    if (target->view->is_baked)
      throw Error(
          ErrorKind::invalid_input,
          "the target has been given a bake, which is of one shape; make a target of its own "
          "for the mesh that moves");
    // #V by 3 doubles are #V positions.
    static_assert(sizeof(Vec3) == 3 * sizeof(double) && alignof(Vec3) == alignof(double));
    target->target->update_positions({reinterpret_cast<const Vec3*>(positions), vertex_count});
    take_normals(*target->target, *target->view);
    ++target->view->moves;
  });
}

mimicry_status mimicry_target_with_embedding(const mimicry_target* target, const void* data,
                                             size_t size, const char* name, mimicry_target** out) {
  return made(out, [&] {
    require(target, "target");
    const std::string file(text(name, "name"));
    return named(file, [&] {
      // The projector refers to the target: both are kept together.
      struct Pair {
        std::shared_ptr<const Target> target;
        SmoothProjector projector;
      };
      const std::shared_ptr<Pair> pair(
          new Pair{target->target, {read_embedding(content(data, size), file), *target->target}});
      target->view->is_baked = true;
      return mimicry_target{target->target, target->view, {pair, &pair->projector}};
    });
  });
}

int32_t mimicry_target_has_embedding(const mimicry_target* target) {
  return target && target->projector;
}
