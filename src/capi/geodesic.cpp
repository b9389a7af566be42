#include <algorithm>
#include <cmath>

#include <mimicry/geodesic/exact.h>
#include <mimicry/geodesic/exponential_map.h>
#include <mimicry/geodesic/paths.h>

#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

struct mimicry_geodesics {
  mimicry_target target;  // kept alive
  std::uint64_t moves;    // of the target when the distances were computed
  std::vector<Source> sources;
  ExactGeodesics exact;
  std::vector<mimicry_path_point> path;
};

struct mimicry_path_finder {
  mimicry_target target;
  LocalPathFinder finder;
  std::vector<Crossing> crossings;
  std::vector<mimicry_path_point> path;
};

struct mimicry_exponential_map {
  mimicry_target target;
  DiscreteExponentialMap map;
  std::vector<int32_t> vertices;
  std::vector<double> coordinates;
};

namespace {

// The path's vertices from end to end.
void put_path(std::vector<mimicry_path_point>& path, const TriangleMesh& mesh,
              const SurfacePoint& from, std::span<const Crossing> crossings,
              const SurfacePoint& to) {
  path.clear();
  const auto add = [&](const Vec3& position, Index half_edge, double t) {
    mimicry_path_point& point = path.emplace_back();
    point = {};
    put(point.position, position);
    point.half_edge = half_edge;
    point.t = t;
  };
  add(mesh.position(from), kNone, 0.0);
  for (const Crossing& crossing : crossings) {
    const Crossing c = source_crossing(mesh, crossing);
    add(position(mesh, crossing), c.half_edge, c.t);
  }
  add(mesh.position(to), kNone, 0.0);
}

void require_radius(double radius) {
  if (std::isnan(radius) || radius <= 0.0)
    throw Error(ErrorKind::invalid_input,
                "radius is " + std::to_string(radius) + "; give more than 0, or INFINITY for all");
}

void require_unmoved(const mimicry_geodesics& geodesics) {
  if (geodesics.moves != geodesics.target.view->moves)
    throw Error(ErrorKind::invalid_input,
                "the target has moved since its distances were computed; compute them anew "
                "(mimicry_geodesics_create)");
}

}  // namespace

mimicry_status mimicry_geodesics_create(const mimicry_target* target,
                                        const mimicry_surface_point* sources, size_t count,
                                        double radius, mimicry_progress progress, void* user,
                                        mimicry_geodesics** out) {
  return made(out, [&] {
    require(target, "target");
    require_radius(radius);
    if (count == 0)
      throw Error(ErrorKind::invalid_input, "there are no sources; give one at least");
    mimicry_geodesics g{
        *target, target->view->moves, {}, ExactGeodesics(target->target->surface()), {}};
    for (const SurfacePoint& p : to_points(*target->target, sources, count, "source"))
      g.sources.push_back({p});
    ExactOptions options;
    options.radius = radius;
    options.progress = to_callback(progress, user);
    g.exact.compute(g.sources, options);
    return g;
  });
}

void mimicry_geodesics_destroy(mimicry_geodesics* geodesics) {
  delete geodesics;
}

int32_t mimicry_geodesics_are_exact(const mimicry_geodesics* geodesics) {
  return geodesics && geodesics->exact.exact();
}

mimicry_status mimicry_geodesics_distances(const mimicry_geodesics* geodesics,
                                           const mimicry_surface_point* points, size_t count,
                                           double* distances) {
  return guarded([&] {
    require(geodesics, "geodesics");
    require_unmoved(*geodesics);
    if (count > 0) require(distances, "distances");
    const auto wanted = to_points(*geodesics->target.target, points, count, "point");
    for (size_t i = 0; i < count; ++i) distances[i] = geodesics->exact.distance(wanted[i]);
  });
}

mimicry_status mimicry_geodesics_vertex_distances(const mimicry_geodesics* geodesics,
                                                  double* distances, size_t vertex_count) {
  return guarded([&] {
    require(geodesics, "geodesics");
    require(distances, "distances");
    require_unmoved(*geodesics);
    const TriangleMesh& mesh = geodesics->target.target->mesh();
    const auto count = at(source_vertex_count(mesh));
    if (vertex_count != count)
      throw Error(ErrorKind::invalid_input, "there is room for " + std::to_string(vertex_count) +
                                                " distances; the mesh has " +
                                                std::to_string(count) + " vertices");
    std::fill_n(distances, count, kInfinity);
    const auto reach = [&](Index vertex, Index surface_vertex) {
      distances[at(vertex)] =
          std::min(distances[at(vertex)], geodesics->exact.distance(surface_vertex));
    };
    // One of the mesh's vertices may be several of the surface's: the nearest counts.
    for (Index f = 0; f < mesh.face_count(); ++f) {
      if (repeats_corner(mesh.face(f))) continue;
      for (int k = 0; k < 3; ++k) reach(source_vertex(mesh, f, k), mesh.face(f)[at(k)]);
    }
    if (const MeshSource* source = mesh.source())
      for (std::size_t v = 0; v < count; ++v)
        if (source->surface_vertex[v] != kNone)
          reach(static_cast<Index>(v), source->surface_vertex[v]);
  });
}

mimicry_status mimicry_geodesics_find_path(mimicry_geodesics* geodesics,
                                           const mimicry_surface_point* to, double* length,
                                           int32_t* source) {
  return guarded([&] {
    require(geodesics, "geodesics");
    require(to, "to");
    require(length, "length");
    require_unmoved(*geodesics);
    const SurfacePoint end = to_point(*geodesics->target.target, *to, "the path's end");
    const ExactPath path = geodesics->exact.path_to(end);
    geodesics->path.clear();
    *length = path.found ? path.length : kInfinity;
    if (source) *source = path.found ? static_cast<int32_t>(path.source) : kNone;
    if (path.found)
      put_path(geodesics->path, geodesics->target.target->mesh(),
               geodesics->sources[path.source].point, path.crossings, end);
  });
}

const mimicry_path_point* mimicry_geodesics_path(const mimicry_geodesics* geodesics) {
  return geodesics ? geodesics->path.data() : nullptr;
}
size_t mimicry_geodesics_path_count(const mimicry_geodesics* geodesics) {
  return geodesics ? geodesics->path.size() : 0;
}

mimicry_status mimicry_path_finder_create(const mimicry_target* target, mimicry_path_finder** out) {
  return made(out, [&] {
    require(target, "target");
    return mimicry_path_finder{*target, LocalPathFinder(target->target->surface()), {}, {}};
  });
}

void mimicry_path_finder_destroy(mimicry_path_finder* finder) {
  delete finder;
}

mimicry_status mimicry_path_finder_find(mimicry_path_finder* finder,
                                        const mimicry_surface_point* from,
                                        const mimicry_surface_point* to, double* length,
                                        int32_t* is_shortest) {
  return guarded([&] {
    require(finder, "finder");
    require(from, "from");
    require(to, "to");
    require(length, "length");
    const Target& target = *finder->target.target;
    const SurfacePoint start = to_point(target, *from, "from"), end = to_point(target, *to, "to");
    finder->crossings.clear();
    finder->path.clear();
    const LocalPath path = finder->finder.find(start, end, finder->crossings);
    *length = path.length;
    if (is_shortest) *is_shortest = path.label != PathLabel::locally_shortest;
    if (path.label != PathLabel::disconnected)
      put_path(finder->path, target.mesh(), start, finder->crossings, end);
  });
}

mimicry_status mimicry_path_finder_trace(mimicry_path_finder* finder,
                                         const mimicry_surface_point* from,
                                         const double direction[3], double length,
                                         mimicry_surface_point* end, double* walked) {
  return guarded([&] {
    require(finder, "finder");
    require(from, "from");
    require(direction, "direction");
    const Target& target = *finder->target.target;
    const SurfacePoint start = to_point(target, *from, "from");
    finder->crossings.clear();
    finder->path.clear();
    const Trace trace =
        trace_straightest(target.surface(), start, vec3(direction), length, &finder->crossings);
    put_path(finder->path, target.mesh(), start, finder->crossings, trace.end);
    if (end) *end = from_point(target, trace.end, target.position(trace.end), trace.length);
    if (walked) *walked = trace.length;
  });
}

const mimicry_path_point* mimicry_path_finder_path(const mimicry_path_finder* finder) {
  return finder ? finder->path.data() : nullptr;
}
size_t mimicry_path_finder_path_count(const mimicry_path_finder* finder) {
  return finder ? finder->path.size() : 0;
}

mimicry_status mimicry_exponential_map_create(const mimicry_target* target,
                                              mimicry_exponential_map** out) {
  return made(out, [&] {
    require(target, "target");
    return mimicry_exponential_map{
        *target, DiscreteExponentialMap(target->target->surface()), {}, {}};
  });
}

void mimicry_exponential_map_destroy(mimicry_exponential_map* map) {
  delete map;
}

mimicry_status mimicry_exponential_map_compute(mimicry_exponential_map* map,
                                               const mimicry_surface_point* centre, double radius,
                                               const double x_hint[3],
                                               mimicry_tangent_plane* plane) {
  return guarded([&] {
    require(map, "map");
    require(centre, "centre");
    require_radius(radius);
    const Vec3 hint = x_hint ? vec3(x_hint) : Vec3(Vec3::Zero());
    if (!hint.allFinite())
      throw Error(ErrorKind::invalid_input, "x_hint has a number that is not finite");
    const SurfacePoint p = to_point(*map->target.target, *centre, "centre");
    const ExponentialPatch& patch = map->map.compute(p, radius, hint);
    map->vertices.clear();
    map->coordinates.clear();
    for (std::size_t i = 0; i < patch.vertices.size(); ++i) {
      map->vertices.push_back(map->target.view->surface_sources[at(patch.vertices[i])]);
      map->coordinates.insert(map->coordinates.end(), patch.coordinates[i].begin(),
                              patch.coordinates[i].end());
    }
    if (!plane) return;
    put(plane->origin, patch.origin);
    put(plane->x_axis, patch.x_axis);
    put(plane->y_axis, patch.y_axis);
    put(plane->normal, patch.normal);
  });
}

size_t mimicry_exponential_map_count(const mimicry_exponential_map* map) {
  return map ? map->vertices.size() : 0;
}
const int32_t* mimicry_exponential_map_vertices(const mimicry_exponential_map* map) {
  return map ? map->vertices.data() : nullptr;
}
const double* mimicry_exponential_map_coordinates(const mimicry_exponential_map* map) {
  return map ? map->coordinates.data() : nullptr;
}
