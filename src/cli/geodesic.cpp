#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>
#include <mimicry/geodesic/exact.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "files/file.h"
#include "geodesic/site.h"
#include "io/number.h"

namespace mimicry::cli {
namespace {

struct GeodesicArguments {
  std::string mesh;
  std::vector<std::string> from;
  std::optional<std::string> to;
  std::string out;
  double radius = kInfinity;
  TargetOptions target;
};

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw Error(ErrorKind::invalid_input, "point '" + text + "': " + why +
                                            "; write v17 (a vertex) or 3,0.2,0.3,0.5 (a face and "
                                            "its barycentric coordinates)");
}

// The surface's vertices that one of the file's became: several where sheets met in it.
std::vector<SurfacePoint> vertex_points(const Target& target, Index v) {
  std::set<Index> found;
  for (Index f = 0; f < target.mesh().face_count(); ++f) {
    if (repeats_corner(target.mesh().face(f))) continue;
    for (int k = 0; k < 3; ++k)
      if (source_vertex(target.mesh(), f, k) == v) found.insert(target.mesh().face(f)[at(k)]);
  }
  const MeshSource* source = target.mesh().source();
  if (found.empty() && source && source->surface_vertex[at(v)] != kNone)
    found.insert(source->surface_vertex[at(v)]);
  std::vector<SurfacePoint> points;
  for (const Index s : found) points.push_back(vertex_point(target.half_edges(), s));
  return points;
}

// v17, or face,b0,b1,b2; of the file.
std::vector<SurfacePoint> parse_points(const std::string& text, const Target& target) {
  if (text.starts_with('v')) {
    const auto vertex = parse_integer(text.substr(1));
    const Index count = source_vertex_count(target.mesh());
    if (!vertex || *vertex < 0 || *vertex >= count)
      refuse(text, "the mesh has vertices 0 to " + std::to_string(count - 1));
    std::vector<SurfacePoint> points = vertex_points(target, static_cast<Index>(*vertex));
    if (points.empty()) refuse(text, "no face has this vertex");
    return points;
  }
  std::vector<double> numbers;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const auto value = parse_double(text.substr(start, comma - start));
    if (!value) refuse(text, "it is not a point");
    numbers.push_back(*value);
    start = comma + 1;
  }
  if (numbers.size() != 4) refuse(text, "it is not a point");
  if (!std::isfinite(numbers[0]) || numbers[0] != std::floor(numbers[0]) || numbers[0] < 0 ||
      numbers[0] >= target.mesh().face_count())
    refuse(text, "the mesh has faces 0 to " + std::to_string(target.mesh().face_count() - 1));
  const SurfacePoint p{static_cast<Index>(numbers[0]), Vec3(numbers[1], numbers[2], numbers[3])};
  check_surface_point(target.mesh(), p, "point '" + text + "'");
  if (repeats_corner(target.mesh().face(p.face)))
    refuse(text, "this face was left out of the surface: it is collapsed, or lies on another");
  return {source_point(target.mesh(), p)};
}

nlohmann::ordered_json point_json(const SurfacePoint& p, const TriangleMesh& mesh) {
  const Vec3 x = mesh.position(p), bary = source_point(mesh, p).bary;
  return {
      {"face", p.face}, {"bary", {bary[0], bary[1], bary[2]}}, {"position", {x[0], x[1], x[2]}}};
}

std::string path_json(const ExactPath& path, const std::vector<Source>& sources,
                      const SurfacePoint& to, const TriangleMesh& mesh) {
  nlohmann::ordered_json crossings = nlohmann::ordered_json::array();
  for (const Crossing& crossing : path.crossings) {
    const Index f = HalfEdges::face(crossing.half_edge);
    const Crossing c = source_crossing(mesh, crossing);
    const int k = HalfEdges::corner(c.half_edge);
    const Vec3 x = position(mesh, crossing);
    crossings.push_back({{"half_edge", c.half_edge},
                         {"edge", {source_corner(mesh, f, k), source_corner(mesh, f, (k + 1) % 3)}},
                         {"t", c.t},
                         {"position", {x[0], x[1], x[2]}}});
  }
  const nlohmann::ordered_json document = {
      {"format", "mimicry-path"},   {"version", 1},
      {"length", path.length},      {"from", point_json(sources[path.source].point, mesh)},
      {"to", point_json(to, mesh)}, {"crossings", crossings}};
  return json_text(document, 1) + "\n";
}

// Of the file's vertices; of one that became several the nearest counts.
std::string distances_csv(const ExactGeodesics& geodesics, const TriangleMesh& surface) {
  std::vector<double> distances(at(source_vertex_count(surface)), kInfinity);
  for (Index f = 0; f < surface.face_count(); ++f) {
    if (repeats_corner(surface.face(f))) continue;
    for (int k = 0; k < 3; ++k) {
      double& distance = distances[at(source_vertex(surface, f, k))];
      distance = std::min(distance, geodesics.distance(surface.face(f)[at(k)]));
    }
  }
  // Of a vertex of faces that were left out alone: the one at its place.
  if (const MeshSource* source = surface.source())
    for (std::size_t v = 0; v < distances.size(); ++v)
      if (const Index s = source->surface_vertex[v]; s != kNone)
        distances[v] = std::min(distances[v], geodesics.distance(s));
  std::string out = "vertex,distance\n";
  for (std::size_t v = 0; v < distances.size(); ++v) {
    out += std::to_string(v) + ',';
    append_double(out, distances[v]);
    out += '\n';
  }
  return out;
}

// A path is no table and a table no path: whoever mixes up the names forgot --to or gave it too
// much.
void check_out(const GeodesicArguments& args) {
  if (args.to && args.out.ends_with(".csv"))
    throw CLI::ValidationError("--out", "with --to a path is written, as JSON; name a .json file");
  if (!args.to && args.out.ends_with(".json"))
    throw CLI::ValidationError(
        "--out", "without --to distances are written, as CSV; name a .csv file, or give --to");
}

void run_geodesic(const GeodesicArguments& args, int& status) {
  const NamedMesh named = load_mesh(args.mesh, terminal_monitor());
  const Target target = make_target(named, args.target, terminal_monitor());
  std::vector<Source> sources;
  for (const std::string& text : args.from)
    for (const SurfacePoint& p : parse_points(text, target)) sources.push_back({p});
  std::optional<SurfacePoint> to;
  if (args.to) to = parse_points(*args.to, target).front();

  ExactGeodesics geodesics(target.surface());
  check_out(args);
  ExactOptions options;
  options.radius = args.radius;
  if (to) options.targets = {&*to, 1};
  geodesics.compute(sources, options);
  if (!geodesics.exact()) {
    complain(named.name +
             ": too many windows; the search gave up, and distances are upper bounds; repair the "
             "mesh or give --radius");
    status = kPartly;
  }
  if (!to) {
    write_file_atomically(args.out, distances_csv(geodesics, target.mesh()));
    std::printf("%s: %d distances\n", args.out.c_str(), named.mesh.vertex_count());
    return;
  }
  const ExactPath path = geodesics.path_to(*to);
  if (!path.found) {
    std::printf("no path: the surface does not join the points%s\n",
                std::isfinite(args.radius) ? " within the radius" : "");
    status = kPartly;
    return;
  }
  write_file_atomically(args.out, path_json(path, sources, *to, target.mesh()));
  std::printf("%s: length %s, %zu crossings\n", args.out.c_str(),
              format_double(path.length).c_str(), path.crossings.size());
}

}  // namespace

void add_geodesic(CLI::App& app, int& status) {
  auto* command =
      app.add_subcommand("geodesic", "Exact shortest paths and distances on the surface");
  auto args = std::make_shared<GeodesicArguments>();
  command->add_option("mesh", args->mesh, kMeshHelp)->required();
  command
      ->add_option("--from", args->from,
                   "Where from: v17 (a vertex) or face,b0,b1,b2; repeated: the nearest counts")
      ->required()
      ->allow_extra_args(false);  // what follows may be the mesh
  command->add_option("--to", args->to,
                      "Where to: a path is written; without it all distances are");
  command->add_option("--radius", args->radius, "Look no farther, mesh units")
      ->check(number_between(1e-12, 1e12));
  command->add_option("-o,--out", args->out, "path.json (with --to) or distances.csv")->required();
  add_target_options(*command, args->target);
  command->callback([args, &status] { run_geodesic(*args, status); });
}

}  // namespace mimicry::cli
