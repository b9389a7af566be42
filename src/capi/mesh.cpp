#include <limits>

#include <mimicry/io/meshes.h>
#include <mimicry/mesh/connect.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/validation.h>

#include "capi/handles.h"
#include "mesh/shown_size.h"

using namespace mimicry;
using namespace mimicry::capi;

namespace {

mimicry_mesh shown(std::string name, TriangleMesh mesh) {
  const double metres_per_unit = shown_metres_per_unit(mesh);
  return {std::move(name), std::move(mesh), metres_per_unit};
}

void require_count(std::size_t count, std::size_t corners) {
  if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max()) / corners)
    throw Error(ErrorKind::unsupported,
                std::to_string(count) + " are more vertices or faces than are handled");
}

std::vector<mimicry_shape_info> shape_list() {
  std::vector<mimicry_shape_info> list;
  for (const ShapeInfo& s : builtin_shapes())
    list.push_back({s.name.data(), s.description.data(), s.default_resolution, s.least_resolution,
                    s.most_resolution});
  return list;
}

const std::vector<mimicry_shape_info>& shapes() {
  static const std::vector<mimicry_shape_info> list = shape_list();
  return list;
}

}  // namespace

mimicry_status mimicry_mesh_create(const double* positions, size_t vertex_count,
                                   const int32_t* faces, size_t face_count, const char* name,
                                   mimicry_mesh** out) {
  return made(out, [&] {
    if (vertex_count > 0) require(positions, "positions");
    if (face_count > 0) require(faces, "faces");
    require_count(vertex_count, 1);
    require_count(face_count, 3);
    std::vector<Vec3> points(vertex_count);
    for (size_t v = 0; v < vertex_count; ++v) points[v] = vec3(positions + 3 * v);
    std::vector<Face> triangles(face_count);
    for (size_t f = 0; f < face_count; ++f)
      triangles[f] = {faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]};
    return shown(name ? name : "", TriangleMesh(std::move(points), std::move(triangles)));
  });
}

mimicry_status mimicry_mesh_read(const void* data, size_t size, const char* name,
                                 mimicry_mesh** out) {
  return made(out, [&] {
    const std::string_view named = text(name, "name");
    return shown(std::string(named), read_mesh(content(data, size), mesh_format_of(named), named));
  });
}

mimicry_status mimicry_mesh_read_files(const mimicry_file* files, size_t count, const char* mesh,
                                       mimicry_mesh** out) {
  return made(out, [&] {
    if (count > 0) require(files, "files");
    std::vector<NamedBytes> named;
    for (size_t k = 0; k < count; ++k)
      named.push_back({text(files[k].name, "name"), content(files[k].data, files[k].size)});
    const size_t which = mesh_among(named, mesh ? mesh : "");
    return shown(std::string(named[which].name), read_mesh_files(named, which));
  });
}

mimicry_status mimicry_mesh_shape(const char* name, int32_t resolution, mimicry_mesh** out) {
  return made(out, [&] {
    const std::string_view named = text(name, "name");
    ShapeOptions options;
    options.resolution = resolution;
    TriangleMesh mesh = make_shape(named, options);
    return mimicry_mesh{std::string(named), std::move(mesh), find_shape(named)->metres_per_unit};
  });
}

void mimicry_mesh_destroy(mimicry_mesh* mesh) {
  delete mesh;
}

size_t mimicry_mesh_vertex_count(const mimicry_mesh* mesh) {
  return mesh ? static_cast<size_t>(mesh->mesh.vertex_count()) : 0;
}
size_t mimicry_mesh_face_count(const mimicry_mesh* mesh) {
  return mesh ? static_cast<size_t>(mesh->mesh.face_count()) : 0;
}
const double* mimicry_mesh_positions(const mimicry_mesh* mesh) {
  return mesh && mesh->mesh.vertex_count() > 0 ? mesh->mesh.positions()[0].data() : nullptr;
}
const int32_t* mimicry_mesh_faces(const mimicry_mesh* mesh) {
  return mesh && mesh->mesh.face_count() > 0 ? mesh->mesh.faces()[0].data() : nullptr;
}
double mimicry_mesh_metres_per_unit(const mimicry_mesh* mesh) {
  return mesh ? mesh->metres_per_unit : 1.0;
}

mimicry_status mimicry_mesh_validate(const mimicry_mesh* mesh, mimicry_mesh_report* report) {
  return guarded([&] {
    require(mesh, "mesh");
    require(report, "report");
    const MeshReport surface = validate(connect(mesh->mesh).mesh);
    const MeshReport r = report_as_drawn(mesh->mesh, surface);
    mimicry_mesh_report out{};
    if (!r.box.isEmpty()) {
      put(out.box_min, r.box.min());
      put(out.box_max, r.box.max());
    }
    out.diagonal = r.diagonal;
    out.area = r.area;
    out.volume = r.volume.value_or(std::numeric_limits<double>::quiet_NaN());
    out.vertices = r.vertices;
    out.edges = r.edges;
    out.faces = r.faces;
    out.components = static_cast<int32_t>(r.components.size());
    out.boundary_loops = r.boundary.loops;
    out.genus = r.genus.value_or(-1);
    out.manifold = surface.is_manifold();
    out.closed = surface.is_closed();
    out.invalid_vertices = r.invalid_vertices.count;
    out.nonmanifold_edges = r.nonmanifold_edges.count;
    out.nonmanifold_vertices = r.nonmanifold_vertices.count;
    out.inconsistent_edges = r.inconsistent_edges.count;
    out.degenerate_faces = r.degenerate_faces.count;
    out.duplicate_faces = r.duplicate_faces.count;
    *report = out;
  });
}

int32_t mimicry_shape_count(void) {
  return static_cast<int32_t>(builtin_shapes().size());
}

const mimicry_shape_info* mimicry_shape(int32_t number) {
  if (number < 0 || number >= mimicry_shape_count()) return nullptr;
  return &shapes()[static_cast<size_t>(number)];
}
