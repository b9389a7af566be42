#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/assets/files.h>
#include <mimicry/base/error.h>
#include <mimicry/io/curves.h>
#include <mimicry/session/stroke_session.h>

#include "assets/canvas.h"
#include "assets/curve_files.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "cli/project_table.h"
#include "cli/strokes_input.h"
#include "files/file.h"
#include "files/names.h"
#include "files/output_lock.h"
#include "io/number.h"
#include "io/tube_mesh.h"
#include "study/polyline.h"

namespace mimicry::cli {
namespace {

struct ProjectArguments {
  std::string mesh;
  std::string strokes;
  std::vector<std::string> techniques;
  std::vector<std::string> options;  // NAME=NUMBER[,NUMBER...]
  std::string out = "out";
  std::vector<std::string> formats = {"json", "obj", "csv", "glb", "ply"};
  std::string misses = "connect";
  std::string embedding;  // file; empty: baked when needed
  BakeSettings bake;
  std::string beside;  // a second strokes file, for the table only
  std::string obj_lines = "segments";
  std::string curves_as = "tubes";
  std::string tube_width = "pressure";
  double minimum_motion_mm = 0.0;
  double tube_radius = 0.0;  // model units; 0: a fraction of the diagonal
  TargetOptions target;
  bool json = false;
};

// A stroke that saw a technique's ink belongs to that technique, unless techniques were named.
bool draws(const TechniqueInfo& info, const Stroke& stroke, const ProjectArguments& args) {
  return !args.techniques.empty() || !stroke.simulated || stroke.simulated->technique.empty() ||
         stroke.simulated->technique == info.name;
}

struct OptionValue {
  std::string name;
  std::vector<double> values;
};

OptionValue parse_option(const std::string& text) {
  const std::size_t equals = text.find('=');
  OptionValue option{text.substr(0, equals), {}};
  std::string rest = equals == std::string::npos ? "" : text.substr(equals + 1);
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    const auto value = parse_double(rest.substr(0, comma));
    if (!value) break;
    option.values.push_back(*value);
    rest = comma == std::string::npos ? "" : rest.substr(comma + 1);
  }
  if (option.values.empty() || !rest.empty())
    throw Error(ErrorKind::invalid_input,
                "--option " + text + ": write NAME=NUMBER or NAME=NUMBER,NUMBER,NUMBER");
  return option;
}

// Options go to the chosen techniques that have them; one that none has is an error.
TechniqueOptions options_for(const TechniqueInfo& info, const std::vector<OptionValue>& given) {
  TechniqueOptions options;
  for (const OptionValue& option : given)
    for (const OptionInfo& known : info.options)
      if (known.name == option.name) set_option(info, options, option.name, option.values);
  return options;
}

void require_known(const std::vector<OptionValue>& given,
                   const std::vector<const TechniqueInfo*>& chosen) {
  for (const OptionValue& option : given) {
    bool known = false;
    for (const TechniqueInfo* info : chosen)
      for (const OptionInfo& o : info->options) known = known || o.name == option.name;
    if (!known)
      throw Error(ErrorKind::invalid_input, "--option " + option.name +
                                                ": none of the chosen techniques has it; "
                                                "see mimicry techniques");
  }
}

std::vector<Vec3> world_points(const std::vector<std::vector<Vec3>>& parts,
                               const Similarity& placed) {
  std::vector<Vec3> points;
  for (const auto& part : parts)
    for (const Vec3& x : part) points.push_back(placed.point(x));
  return points;
}

/// Why the stroke cannot have been made for this mesh; empty where it can.
std::string misfit(const Stroke& stroke, const NamedMesh& named) {
  if (!stroke.intended) return "";
  for (const SurfacePoint& p : stroke.intended->points)
    if (p.face >= named.mesh.face_count())
      return "stroke '" + stroke.id + "': its intended curve names face " + std::to_string(p.face) +
             ", but " + named.name + " has " + std::to_string(named.mesh.face_count()) +
             " faces; give the mesh that the stroke was made for";
  return "";
}

// Those that can be projected on this mesh; throws where none is left.
std::vector<Stroke> fitting_strokes(std::vector<Stroke> strokes, const NamedMesh& named,
                                    int& status) {
  std::vector<Stroke> fitting;
  std::vector<std::string> misfits;
  for (Stroke& stroke : strokes) {
    const std::string problem = misfit(stroke, named);
    if (!problem.empty()) {
      misfits.push_back(problem);
      continue;
    }
    if (stroke.target != named.name)
      complain("stroke '" + stroke.id + "' was drawn on '" + stroke.target +
               "'; it is projected on '" + named.name + "'");
    fitting.push_back(std::move(stroke));
  }
  if (fitting.empty() && !misfits.empty()) throw Error(ErrorKind::invalid_input, misfits.front());
  for (const std::string& problem : misfits) tell_left_out(problem, status);
  return fitting;
}

std::vector<Vec3> intended_world_points(const Stroke& stroke, const TriangleMesh& mesh) {
  std::vector<Vec3> points;
  for (const SurfacePoint& p : stroke.intended->points)
    points.push_back(stroke.model_to_world.point(mesh.position(p)));
  return points;
}

CurveRecord draw(const Canvas& canvas, const TechniqueInfo& info, const Stroke& stroke,
                 const SessionOptions& options, TechniqueRow& row) {
  const Target& target = canvas.target;
  const auto start = std::chrono::steady_clock::now();
  ProjectedStroke drawn = mimicry::project(canvas, info, stroke, options);
  row.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const ProjectedCurve& curve = drawn.curve;
  row.frames += stroke.frames.size();
  row.points += curve.points.size();
  row.missed += static_cast<std::size_t>(drawn.counts[FrameStatus::missed]);
  row.strokes.push_back({stroke.id, curve.points.size(), drawn.answers});
  row.measures.add(target, stroke, curve);
  row.length_m += stroke.model_to_world.scale * length(curve);
  if (stroke.intended && !stroke.intended->points.empty() && !curve.points.empty()) {
    row.distance_sum_m += mean_corresponding_distance(
        world_points(polylines(curve, target.mesh()), stroke.model_to_world),
        intended_world_points(stroke, target.mesh()));
    ++row.distances;
  }
  return curve_record(stroke, info, std::move(drawn.curve), options.technique);
}

// A format by its name, in the form that was asked for.
CurveFormat format_of(const std::string& name, const ProjectArguments& args) {
  const CurveFormat format = curve_format_of(name).value();  // the option takes no other
  const bool lines = args.curves_as == "lines";
  if (format == CurveFormat::obj && args.obj_lines == "polylines")
    return CurveFormat::obj_polylines;
  if (format == CurveFormat::glb && lines) return CurveFormat::glb_lines;
  if (format == CurveFormat::ply && lines) return CurveFormat::ply_lines;
  return format;
}

// As thick as the pen was pressed; none for a device without pressure.
std::vector<double> radii_of(const Stroke& stroke, const ProjectedCurve& curve,
                             double tube_radius) {
  std::vector<double> radii;
  const auto& frames = stroke.frames;
  if (std::none_of(frames.begin(), frames.end(), [](const auto& f) { return f.pressure; }))
    return radii;
  for (const CurvePoint& p : curve.points)
    radii.push_back(tube_radius *
                    width_of_pressure(frames[static_cast<std::size_t>(p.frame)].pressure));
  return radii;
}

void run_project(const ProjectArguments& args, int& status) {
  const NamedMesh named = load_mesh(args.mesh, terminal_monitor());
  const Target target = make_target(named, args.target, terminal_monitor());
  const std::vector<Stroke> strokes =
      fitting_strokes(load_strokes(args.strokes, status), named, status);
  std::vector<Stroke> beside;
  if (!args.beside.empty())
    beside = fitting_strokes(load_strokes(args.beside, status), named, status);
  auto chosen = chosen_techniques(args.techniques);
  if (!strokes.empty())
    std::erase_if(chosen, [&](const TechniqueInfo* info) {
      return std::none_of(strokes.begin(), strokes.end(),
                          [&](const Stroke& stroke) { return draws(*info, stroke, args); });
    });
  std::vector<OptionValue> given;
  for (const std::string& text : args.options) given.push_back(parse_option(text));
  require_known(given, chosen);

  SessionOptions options;
  options.misses = args.misses == "split" ? MissPolicy::split : MissPolicy::connect;
  options.minimum_motion_m = 1e-3 * args.minimum_motion_mm;

  const auto output_lock = OutputLock::of_folder(args.out);
  const Canvas canvas = make_canvas(target, chosen, terminal_monitor(), args.embedding, args.bake);

  const double radius = args.tube_radius > 0.0 ? args.tube_radius : kTubeRadius * target.diagonal();
  CurveSet set{named.name, {}};
  std::vector<TechniqueRow> rows;
  {
    ProgressLine progress("projecting");
    for (const TechniqueInfo* info : chosen) {
      options.technique = options_for(*info, given);
      rows.push_back({.technique = info});
      for (const Stroke& stroke : strokes) {
        if (!draws(*info, stroke, args)) continue;
        CurveRecord record = draw(canvas, *info, stroke, options, rows.back());
        if (args.tube_width == "pressure") record.radii = radii_of(stroke, record.curve, radius);
        set.curves.push_back(std::move(record));
      }
      TechniqueRow other;
      for (const Stroke& stroke : beside)
        if (draws(*info, stroke, args)) draw(canvas, *info, stroke, options, other);
      rows.back().beside = other.measures;
      progress.update(rows.size(), chosen.size());
    }
  }

  // All bytes are made before the first file is written.
  const auto colors = curve_colors(set);
  std::vector<std::string> bytes;
  for (const std::string& format : args.formats)
    bytes.push_back(write_curves(format_of(format, args), set, target.mesh(), {colors, radius}));
  std::vector<std::string> written;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    written.push_back(join_path(args.out, "curves." + args.formats[i]));
    write_file_atomically(written.back(), bytes[i]);
  }
  if (args.json) return print_rows_json(rows, written);
  TableTitles titles{drawers_of(strokes), {}};
  if (!args.beside.empty()) titles.beside = drawers_of(beside);
  print_rows(rows, titles);
  for (const std::string& file : written) std::printf("%s\n", file.c_str());
}

}  // namespace

void add_project(CLI::App& app, int& status) {
  auto* command = app.add_subcommand("project", "Project recorded strokes on a mesh");
  auto args = std::make_shared<ProjectArguments>();
  command->add_option("mesh", args->mesh, kMeshHelp)->required();
  command->add_option("strokes", args->strokes, "A mimicry-strokes file")->required();
  command
      ->add_option("-t,--techniques", args->techniques,
                   "Names, or all (mimicry techniques); without it all, and strokes of people who "
                   "saw one technique's ink that one alone")
      ->delimiter(',');
  command->add_option("--beside", args->beside,
                      "Another strokes file, whose measures stand beside in the table");
  command->add_option("--option", args->options,
                      "A technique's option, NAME=NUMBER[,NUMBER,NUMBER]");
  command->add_option(
      "--embedding", args->embedding,
      "The mesh's bake (mimicry bake); without it one is made when needed, and kept");
  add_cache_option(*command, args->bake);
  command->add_option("-o,--out", args->out, "Folder for the curve files")->capture_default_str();
  command->add_option("--formats", args->formats, "Which files")
      ->delimiter(',')
      ->check(CLI::IsMember({"json", "obj", "csv", "glb", "ply"}))
      ->capture_default_str();
  command->add_option("--misses", args->misses, "Where a point is undefined: connect or split")
      ->check(CLI::IsMember({"connect", "split"}))
      ->capture_default_str();
  command
      ->add_option("--minimum-motion-mm", args->minimum_motion_mm,
                   "Pass over frames whose pen moved less")
      ->check(number_between(0, 1e12));
  command
      ->add_option("--curves-as", args->curves_as,
                   "In GLB and PLY files: tubes of triangles, or lines, which fewer readers know")
      ->check(CLI::IsMember({"tubes", "lines"}))
      ->capture_default_str();
  command
      ->add_option("--tube-radius", args->tube_radius,
                   "Of these tubes, mesh units (default 0.3 % of the diagonal)")
      ->check(number_between(1e-12, 1e12));
  command
      ->add_option("--tube-width", args->tube_width,
                   "Where the pen's pressure is known: 0.35 to 1.65 radii by it, or constant")
      ->check(CLI::IsMember({"pressure", "constant"}))
      ->capture_default_str();
  command
      ->add_option(
          "--obj-lines", args->obj_lines,
          "In OBJ files: a line element for each of a curve's segments, or long polylines, "
          "of which some importers keep the ends alone")
      ->check(CLI::IsMember({"segments", "polylines"}))
      ->capture_default_str();
  add_target_options(*command, args->target);
  command->add_flag("--json", args->json, "The table for programs");
  command->callback([args, &status] { run_project(*args, status); });
}

}  // namespace mimicry::cli
