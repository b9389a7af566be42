#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>
#include <mimicry/io/curves.h>
#include <mimicry/mesh/connect.h>
#include <mimicry/technique/technique.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "cli/strokes_input.h"
#include "files/file.h"
#include "files/names.h"
#include "io/csv.h"
#include "io/number.h"
#include "render/figure.h"
#include "render/palette.h"
#include "render/png.h"

namespace mimicry::cli {
namespace {

struct RenderArguments {
  std::string mesh;
  std::string strokes;
  std::string curves;
  std::string out = "out/picture.png";
  std::vector<std::string> techniques;
  std::string stroke;  // only this one
  std::string distances;
  double iso_spacing = 0.0;
  bool side_by_side = false;
  bool intended = false;
  std::optional<double> azimuth;
  std::optional<double> elevation;
  double zoom = 1.0;
  std::string up = "y";
  double tube_radius = 0.0;
  int columns = 0;
  int width = 0;
  int height = 0;
};

constexpr render::Color kIntendedColor{0.98, 0.98, 0.94};

std::string name_of(const std::string& path) {
  return file_name(path);
}

// Strokes are shown where they were drawn, in the mesh's coordinates.
render::Tube stroke_tube(const Stroke& stroke, double radius) {
  render::Tube tube;
  for (const Frame& frame : stroke.frames)
    tube.points.push_back(stroke.model_to_world.inverse_point(frame.controller.position));
  tube.radius = 0.6 * radius;
  tube.color = render::kStrokeColor;
  tube.label = "stroke in mid-air";
  tube.camera_weight = 0.3;
  return tube;
}

render::Tube intended_tube(const Intention& intended, const TriangleMesh& mesh, double radius) {
  render::Tube tube;
  for (const SurfacePoint& p : intended.points) {
    if (p.face >= mesh.face_count())
      throw Error(ErrorKind::invalid_input, "intended curve '" + intended.name + "': names face " +
                                                std::to_string(p.face) + ", beyond the mesh");
    tube.points.push_back(mesh.position(p));
  }
  tube.radius = 0.75 * radius;  // hidden where the curve is right
  tube.color = kIntendedColor;
  tube.label = "intended";
  return tube;
}

// The column of a `vertex,distance` file; what is unreachable gets the largest distance, so that no
// line runs through it.
std::vector<double> read_distances(const std::string& path, Index vertices) {
  const CsvTable table = read_csv(read_file(path), name_of(path));
  const auto vertex_at = table.find("vertex"), distance_at = table.find("distance");
  if (!vertex_at || !distance_at)
    throw Error(ErrorKind::invalid_input, name_of(path) +
                                              ": the heading is not vertex,distance; write it with "
                                              "mimicry geodesic");
  std::vector<double> distances(static_cast<std::size_t>(vertices), kInfinity);
  double largest = 0.0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto vertex = parse_integer(table.rows[i][*vertex_at]);
    const auto distance = parse_double(table.rows[i][*distance_at]);
    if (!vertex || *vertex < 0 || *vertex >= vertices || !distance || std::isnan(*distance))
      throw Error(ErrorKind::invalid_input,
                  name_of(path) + ": line " + std::to_string(table.lines[i]) +
                      ": is not vertex,distance of this mesh; write it with mimicry geodesic");
    distances[static_cast<std::size_t>(*vertex)] = *distance;
    if (std::isfinite(*distance)) largest = std::max(largest, *distance);
  }
  for (double& d : distances) d = std::min(d, largest);
  return distances;
}

void add_curve(render::Scene& scene, const CurveRecord& record, const TriangleMesh& mesh,
               double radius) {
  for (auto& part : polylines(record.curve, mesh)) {
    render::Tube tube;
    tube.points = std::move(part);
    tube.radius = radius;
    tube.color = render::technique_color(record.technique);
    tube.label = record.technique;
    scene.tubes.push_back(std::move(tube));
  }
}

bool came_from(const CurveRecord& record, const Stroke& stroke) {
  return record.stroke == stroke.id;
}

// The strokes that these curves came from; all where they came from none of them.
std::vector<Stroke> strokes_of(const std::vector<Stroke>& strokes,
                               const std::vector<CurveRecord>& curves) {
  std::vector<Stroke> some;
  for (const Stroke& stroke : strokes)
    if (std::any_of(curves.begin(), curves.end(),
                    [&](const CurveRecord& record) { return came_from(record, stroke); }))
      some.push_back(stroke);
  return some.empty() ? strokes : some;
}

void add_strokes(render::Scene& scene, const std::vector<Stroke>& strokes, bool intended,
                 const TriangleMesh& mesh, double radius) {
  for (const Stroke& stroke : strokes) {
    scene.tubes.push_back(stroke_tube(stroke, radius));
    if (intended && stroke.intended)
      scene.tubes.push_back(intended_tube(*stroke.intended, mesh, radius));
  }
}

// One panel for each technique, in the order of the curve file, with the strokes that it drew.
template <class ShowStrokes>
std::vector<render::Scene> panels_of(const render::Scene& base, const CurveSet& set,
                                     const TriangleMesh& mesh, double radius,
                                     ShowStrokes&& show_strokes) {
  std::vector<render::Scene> panels;
  std::map<std::string, std::vector<CurveRecord>> by_technique;
  for (const CurveRecord& record : set.curves) by_technique[record.technique].push_back(record);
  for (const CurveRecord& record : set.curves) {
    render::Scene* panel = nullptr;
    for (render::Scene& p : panels)
      if (p.caption == record.technique) panel = &p;
    if (panel == nullptr) {
      panels.push_back(base);
      panel = &panels.back();
      panel->caption = record.technique;
      panel->caption_color = render::technique_color(record.technique);
      panel->caption_swatch = true;
      show_strokes(*panel, by_technique[record.technique]);
    }
    add_curve(*panel, record, mesh, radius);
  }
  return panels;
}

void run_render(const RenderArguments& args, int& status) {
  const NamedMesh named = load_mesh(args.mesh, terminal_monitor());
  // Intended curves are on the surface, whose faces may be turned.
  const TriangleMesh drawn_on = connect(named.mesh).mesh;
  const double size = diagonal(drawn_on);
  const double radius = args.tube_radius > 0.0 ? args.tube_radius : 0.004 * size;
  render::Scene scene;
  scene.up = args.up == "z" ? Vec3::UnitZ() : Vec3::UnitY();
  scene.surfaces.emplace_back().mesh = &named.mesh;
  if (!args.distances.empty()) {
    render::Surface& surface = scene.surfaces.front();
    surface.iso_values = read_distances(args.distances, named.mesh.vertex_count());
    surface.iso_spacing = args.iso_spacing > 0.0 ? args.iso_spacing : 0.04 * size;
  }
  std::vector<Stroke> strokes;
  if (!args.strokes.empty()) strokes = load_strokes(args.strokes, status);
  if (!args.stroke.empty())
    std::erase_if(strokes, [&](const Stroke& s) { return s.id != args.stroke; });
  CurveSet set;
  if (!args.curves.empty())
    set = read_curves_json(read_file(args.curves), name_of(args.curves), named.mesh);
  for (const std::string& name : args.techniques) (void)find_technique(name);
  std::erase_if(set.curves, [&](const CurveRecord& record) {
    return (!args.stroke.empty() && record.stroke != args.stroke) ||
           (!args.techniques.empty() && std::find(args.techniques.begin(), args.techniques.end(),
                                                  record.technique) == args.techniques.end());
  });

  if (!args.stroke.empty() && set.curves.empty() && strokes.empty())
    throw Error(ErrorKind::invalid_input, "render: no stroke or curve has the id '" + args.stroke +
                                              "'; give one of the file's");

  render::CameraOptions camera;
  camera.azimuth_deg = args.azimuth;
  camera.elevation_deg = args.elevation;
  camera.zoom = args.zoom;
  render::Image image;
  const auto show_strokes = [&](render::Scene& to, const std::vector<CurveRecord>& curves) {
    add_strokes(to, strokes_of(strokes, curves), args.intended, drawn_on, radius);
  };
  if (args.side_by_side) {
    const auto panels = panels_of(scene, set, named.mesh, radius, show_strokes);
    if (panels.empty())
      throw Error(ErrorKind::invalid_input,
                  "render: --side-by-side has nothing to show; give --curves a file with curves");
    render::FigureOptions options;
    options.columns = args.columns;
    if (args.width > 0) options.panel.width = args.width;
    if (args.height > 0) options.panel.height = args.height;
    image = render::figure(panels, camera, options);
  } else {
    show_strokes(scene, set.curves);
    for (const CurveRecord& record : set.curves) add_curve(scene, record, named.mesh, radius);
    render::RenderOptions options;
    if (args.width > 0) options.width = args.width;
    if (args.height > 0) options.height = args.height;
    image = render::picture(scene, camera, options);
  }
  const std::filesystem::path folder = to_path(args.out).parent_path();
  std::error_code trouble;
  if (!folder.empty()) std::filesystem::create_directories(folder, trouble);
  write_file_atomically(args.out, render::write_png(image));
  std::printf("%s\n", args.out.c_str());
}

}  // namespace

void add_render(CLI::App& app, int& status) {
  auto* command = app.add_subcommand("render", "Make a picture of a mesh, strokes and curves");
  auto args = std::make_shared<RenderArguments>();
  command->add_option("mesh", args->mesh, kMeshHelp)->required();
  command->add_option(
      "--strokes", args->strokes,
      "A mimicry-strokes file, drawn in black: the strokes of the curves that are shown");
  command->add_option("--curves", args->curves, "A mimicry-curves file, one colour a technique");
  command->add_option(
      "--distances", args->distances,
      "A vertex,distance file (mimicry geodesic), shown by lines of equal distance");
  command
      ->add_option("--iso-spacing", args->iso_spacing,
                   "Between these lines, mesh units (default 4 % of the diagonal)")
      ->check(number_between(1e-12, 1e12));
  command->add_option("-t,--techniques", args->techniques, "Only curves of these")->delimiter(',');
  command->add_option("--stroke", args->stroke, "Only the stroke of this id");
  command->add_flag("--intended", args->intended,
                    "Show the strokes' intended curves too, in white");
  command->add_option("-o,--out", args->out, "The PNG file")
      ->check(CLI::Validator(
          [](std::string& name) -> std::string {
            return name.ends_with(".png") ? "" : "'" + name + "' does not end in .png";
          },
          "FILE.png"))
      ->capture_default_str();
  command->add_flag("--side-by-side", args->side_by_side,
                    "A panel for each technique, with captions");
  command->add_option("--columns", args->columns, "Panels in a row, 0: chosen")
      ->check(CLI::Range(0, 100));
  command->add_option(
      "--azimuth", args->azimuth,
      "Where the viewer stands, degrees; 0 is +z, 90 is +x (default: sees the curves)");
  command->add_option("--elevation", args->elevation, "Degrees above the horizon");
  command->add_option("--up", args->up, "The axis that points up in the mesh file: y or z")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
  command->add_option("--zoom", args->zoom, "2 shows the middle twice as large")
      ->check(number_between(0.01, 100))
      ->capture_default_str();
  command
      ->add_option("--tube-radius", args->tube_radius,
                   "Of curves, mesh units (default 0.4 % of the diagonal)")
      ->check(number_between(1e-12, 1e12));
  command->add_option("--width", args->width, "Pixels, of a panel where there are several")
      ->check(CLI::Range(1, 16384));
  command->add_option("--height", args->height, "Pixels")->check(CLI::Range(1, 16384));
  command->callback([args, &status] { run_render(*args, status); });
}

}  // namespace mimicry::cli
