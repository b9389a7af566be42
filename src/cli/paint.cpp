#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>
#include <mimicry/io/curves.h>
#include <mimicry/io/meshes.h>
#include <mimicry/mesh/attributes.h>
#include <mimicry/paint/atlas.h>
#include <mimicry/paint/brush.h>
#include <mimicry/paint/layers.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "files/file.h"
#include "files/names.h"
#include "render/png.h"

namespace mimicry::cli {
namespace {

// Of the mesh's diagonal: where a curve's points may lie beside where the file says.
constexpr double kSamePlace = 1e-3;

struct PaintArguments {
  std::string mesh, curves, out, png;
  std::string color = "#aa3311", base;
  std::string blend = "build", atlas = "cells";
  int size = 2048;
  double radius = 0.01;
  bool model_units = false;
  Brush brush;
  std::string stamp, ribbon, align = "tangent";  // images
  Stamp stamping;
  double rotation_deg = 0.0, rotation_jitter_deg = 0.0;
  TargetOptions target;
  bool json = false;
};

Rgb8 parse_color(const std::string& text, const char* option) {
  const bool is_hex = text.size() == 7 && text[0] == '#' &&
                      text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!is_hex)
    throw Error(ErrorKind::invalid_input,
                std::string(option) + ": '" + text + "' is not a colour; write #rrggbb");
  const auto rgb = static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16));
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 0xff),
          static_cast<std::uint8_t>(rgb & 0xff)};
}

CurveSet load_curves(const std::string& path, const TriangleMesh& surface) {
  const std::string bytes = read_file(path), name = to_text(to_path(path).filename());
  CurveSet set = is_packed_curves(bytes) ? read_curves_packed(bytes, name, surface)
                                         : read_curves_json(bytes, name, surface);
  const double far = kSamePlace * diagonal(surface);
  for (std::size_t c = 0; c < set.curves.size(); ++c)
    for (std::size_t i = 0; i < set.curves[c].curve.points.size(); ++i) {
      const CurvePoint& p = set.curves[c].curve.points[i];
      if ((surface.position(p.surface) - p.position).norm() > far)
        throw Error(ErrorKind::invalid_input,
                    name + ": curve " + std::to_string(c) + ": point " + std::to_string(i) +
                        " lies elsewhere on this mesh; paint on the mesh that the curves were "
                        "drawn on");
    }
  return set;
}

// What the mesh looks like before: the colours that it carries, else one.
void lay_base(const PaintAtlas& atlas, PaintLayers& layers) {
  const auto& attributes = atlas.surface().mesh().attributes();
  if (!attributes || attributes->colors.empty()) return;
  std::vector<Rgba8> texels(layers.pixels().begin(), layers.pixels().end());
  for (int y = 0; y < atlas.size(); ++y)
    for (int x = 0; x < atlas.size(); ++x) {
      const SurfacePoint p = atlas.point(x, y);
      if (p.face == kNone) continue;
      const auto color = attributes->colors.interpolated(p.face, p.bary);
      if (std::isnan(color[0])) continue;
      for (std::size_t k = 0; k < 3; ++k)
        texels[std::size_t(y) * std::size_t(atlas.size()) + std::size_t(x)][k] =
            static_cast<std::uint8_t>(
                std::round(255.0 * std::clamp(srgb_from_linear(double(color[k])), 0.0, 1.0)));
    }
  layers.set_base(texels);
}

std::string png_of(const PaintLayers& layers) {
  render::Image image;
  image.width = image.height = layers.size();
  image.rgb.reserve(3 * layers.pixels().size());
  for (const Rgba8& pixel : layers.pixels())
    image.rgb.insert(image.rgb.end(), pixel.begin(), pixel.begin() + 3);
  return render::write_png(image);
}

// The caller's mesh, its corners in its own order, with the atlas's coordinates or with colours.
TriangleMesh painted_mesh(const TriangleMesh& mesh, const PaintAtlas& atlas,
                          const PaintLayers& layers, bool by_vertex) {
  const TriangleMesh& surface = atlas.surface().mesh();
  MeshAttributes attributes = mesh.attributes() ? *mesh.attributes() : MeshAttributes{};
  attributes.colors = {};
  MeshAttributes own;  // in the surface's order
  own.texcoords = atlas.texcoords();
  if (by_vertex) {
    for (Index f = 0; f < surface.face_count(); ++f)
      for (int k = 0; k < 3; ++k) {
        SurfacePoint p{f, Vec3::Zero()};
        p.bary[k] = 1.0;
        const Vec2 texel = atlas.place(p);
        const auto coordinate = [&](double x) {
          return std::clamp(static_cast<int>(std::lround(x)), 0, atlas.size() - 1);
        };
        const Rgba8& pixel =
            layers.pixels()[std::size_t(coordinate(texel.y())) * std::size_t(atlas.size()) +
                            std::size_t(coordinate(texel.x()))];
        std::array<float, 4> color = {0, 0, 0, 1};
        for (std::size_t c = 0; c < 3; ++c)
          color[c] = static_cast<float>(linear_from_srgb(double(pixel[c]) / 255.0));
        own.colors.corners.push_back(static_cast<Index>(own.colors.values.size()));
        own.colors.values.push_back(color);
      }
  }
  if (surface.source()) own.turn_faces(surface.source()->turned);
  if (by_vertex) {
    // One colour a vertex: that of its first corner with texels, which faces that repeat a corner
    // have not.
    std::vector<Index> of_vertex(std::size_t(mesh.vertex_count()), kNone);
    for (const bool has_texels : {true, false})
      for (std::size_t c = 0; c < own.colors.corners.size(); ++c) {
        const auto f = static_cast<Index>(c / 3);
        Index& first = of_vertex[std::size_t(mesh.face(f)[c % 3])];
        if (first == kNone && repeats_corner(surface.face(f)) != has_texels)
          first = own.colors.corners[c];
      }
    for (std::size_t c = 0; c < own.colors.corners.size(); ++c)
      own.colors.corners[c] = of_vertex[std::size_t(mesh.face(static_cast<Index>(c / 3))[c % 3])];
    attributes.colors = std::move(own.colors);
    attributes.texcoords = {};
  } else {
    attributes.texcoords = std::move(own.texcoords);
  }
  TriangleMesh painted = mesh;
  painted.set_attributes(std::make_shared<const MeshAttributes>(std::move(attributes)));
  return painted;
}

// Writes what the names ask for, and returns them: images first, so that no mesh names one that is
// not there.
std::vector<std::string> write_outputs(const PaintArguments& args, const TriangleMesh& mesh,
                                       const PaintAtlas& atlas, const PaintLayers& layers) {
  std::vector<std::string> written;
  const auto write = [&](const std::string& path, const std::string& bytes) {
    write_file_atomically(path, bytes);
    written.push_back(path);
  };
  const std::string png = png_of(layers);
  if (args.out.empty()) {
    write(args.png, png);
    return written;
  }
  const MeshFormat format = mesh_format_of(args.out);
  MeshWriteOptions options;
  options.note = [](const std::string& sentence) { complain(sentence); };
  std::filesystem::path beside = to_path(args.out);
  if (format == MeshFormat::glb) options.texture_png = png;
  const std::string material = to_text(beside.filename().replace_extension(".mtl"));
  if (format == MeshFormat::obj) options.material_file = material;
  const std::string bytes =
      write_mesh(painted_mesh(mesh, atlas, layers, format == MeshFormat::ply), format, options);
  if (!args.png.empty()) write(args.png, png);
  if (format == MeshFormat::obj) {
    const std::filesystem::path image = beside.replace_extension(".png");
    if (to_text(image) != args.png) write(to_text(image), png);
    write(to_text(beside.replace_extension(".mtl")), write_mtl(to_text(image.filename())));
  }
  write(args.out, bytes);
  return written;
}

std::optional<StampImage> load_image(const std::string& path) {
  if (path.empty()) return std::nullopt;
  const render::RgbaImage image =
      render::read_png(read_file(path), to_text(to_path(path).filename()), StampImage::kMostPixels);
  return StampImage(image.width, image.height, image.pixels);
}

// Opens strokes of a curve, whose lengths in metres are `scale` times those of the mesh.
class Strokes {
 public:
  explicit Strokes(const PaintArguments& args)
      : brush_(args.brush),
        stamp_(args.stamping),
        stamp_image_(load_image(args.stamp)),
        ribbon_image_(load_image(args.ribbon)) {
    brush_.radius = args.radius;
    brush_.color = parse_color(args.color, "--color");
    brush_.blend = args.blend == "max" ? BrushBlend::max : BrushBlend::build;
    require_valid(brush_);
    constexpr double kDegree = std::numbers::pi / 180.0;
    stamp_.size = 2.0 * args.radius;
    stamp_.opacity = brush_.opacity;
    stamp_.follow = args.align == "tangent";
    stamp_.rotation_rad = kDegree * args.rotation_deg;
    stamp_.rotation_jitter_rad = kDegree * args.rotation_jitter_deg;
    if (stamp_image_) require_valid(stamp_);
    if (ribbon_image_) require_valid(Ribbon{2.0 * args.radius, brush_.opacity});
  }

  void begin(StrokePainter& painter, PaintLayers& layers, double scale) const {
    if (stamp_image_) {
      Stamp stamp = stamp_;
      stamp.size /= scale;
      return painter.begin(layers, 0, stamp, *stamp_image_);
    }
    Brush brush = brush_;
    brush.radius /= scale;
    if (ribbon_image_)
      return painter.begin(layers, 0, Ribbon{2.0 * brush.radius, brush.opacity}, *ribbon_image_);
    painter.begin(layers, 0, brush);
  }

 private:
  Brush brush_;
  Stamp stamp_;
  std::optional<StampImage> stamp_image_, ribbon_image_;
};

void check_outputs(const PaintArguments& args) {
  if (args.out.empty() && args.png.empty())
    throw CLI::ValidationError("--out", "nothing is to be written; give --out or --png");
  if (args.out.empty()) return;
  if (to_path(args.png).lexically_normal() == to_path(args.out).lexically_normal())
    throw CLI::ValidationError("--png", "names the file of --out; give another");
  const MeshFormat format = mesh_format_of(args.out);
  if (format != MeshFormat::glb && format != MeshFormat::obj && format != MeshFormat::ply)
    throw CLI::ValidationError("--out",
                               "paint is written as .glb, .obj (with .mtl and .png) and "
                               ".ply (colours of vertices)");
}

void run_paint(const PaintArguments& args, int&) {
  check_outputs(args);
  const Strokes strokes(args);
  const Rgb8 base = parse_color(args.base.empty() ? "#ffffff" : args.base, "--base");

  const NamedMesh named = load_mesh(args.mesh, terminal_monitor());
  const Target target = make_target(named, args.target, terminal_monitor());
  const CurveSet set = load_curves(args.curves, target.mesh());
  const PaintAtlas atlas = args.atlas == "mesh" ? PaintAtlas::of_mesh(target.surface(), args.size)
                                                : PaintAtlas::cells(target.surface(), args.size);
  if (atlas.is_coarse())
    complain("texture: " + std::to_string(args.size) + " x " + std::to_string(args.size) +
             " texels have room for one a face; " +
             (atlas.fine_size() > 0 ? "give --size " + std::to_string(atlas.fine_size())
                                    : std::string("join faces")) +
             " for more");
  PaintLayers layers(args.size, base, 0);
  if (args.base.empty()) lay_base(atlas, layers);

  StrokePainter painter(atlas);
  const Monitor monitor = terminal_monitor();
  std::size_t painted = 0;
  for (const CurveRecord& record : set.curves) {
    monitor.report("painting", painted, set.curves.size());
    if (record.curve.points.empty()) continue;
    strokes.begin(painter, layers, args.model_units ? 1.0 : record.model_to_world.scale);
    follow_curve(painter, record.curve);
    painter.end();
    ++painted;
  }
  std::size_t texels = 0;
  for (int y = 0; y < args.size; ++y)
    for (int x = 0; x < args.size; ++x) texels += layers.layer_texel(0, x, y)[3] > 0;
  const std::vector<std::string> written = write_outputs(args, named.mesh, atlas, layers);
  if (args.json) {
    const nlohmann::ordered_json summary = {
        {"mesh", named.name},       {"faces", named.mesh.face_count()},
        {"curves", painted},        {"atlas", args.atlas},
        {"size", args.size},        {"texels_of_faces", atlas.used_texels()},
        {"texels_painted", texels}, {"files", written}};
    std::printf("%s\n", json_text(summary).c_str());
    return;
  }
  for (const std::string& file : written)
    std::printf("%s: %zu curves, %zu of %zu texels painted\n", file.c_str(), painted, texels,
                atlas.used_texels());
}

}  // namespace

void add_paint(CLI::App& app, int& status) {
  auto* command = app.add_subcommand("paint", "Paint a texture along curves");
  auto args = std::make_shared<PaintArguments>();
  Brush& brush = args->brush;
  command->add_option("mesh", args->mesh, kMeshHelp)->required();
  command->add_option("curves", args->curves, "Curves on it, as `mimicry project` writes (.json)")
      ->required();
  command->add_option("--radius", args->radius, "Of the brush, metres")->capture_default_str();
  command->add_flag("--model-units", args->model_units,
                    "The radius is in the mesh's own units, not in metres");
  command->add_option("--hardness", brush.hardness, "Part of the radius with full paint, 0 to 1")
      ->capture_default_str();
  command->add_option("--flow", brush.flow, "What one pass covers in its middle, 0 to 1")
      ->capture_default_str();
  command->add_option("--opacity", brush.opacity, "What a stroke covers at most, 0 to 1")
      ->capture_default_str();
  command->add_option("--spacing", brush.spacing, "Of dabs, in diameters, 0.01 to 1")
      ->capture_default_str();
  command->add_option("--color", args->color, "sRGB, #rrggbb")->capture_default_str();
  command->add_option("--base", args->base,
                      "Colour of the surface without paint, #rrggbb (default: the colours that "
                      "the mesh carries, else white)");
  command->add_option("--blend", args->blend, "build: dabs add up; max: the largest counts")
      ->check(CLI::IsMember({"build", "max"}))
      ->capture_default_str();
  auto* stamp = command->add_option("--stamp", args->stamp,
                                    "A PNG in place of the round brush, as wide as that");
  command->add_option("--ribbon", args->ribbon, "A PNG along the stroke, as wide as the brush")
      ->excludes(stamp);
  command->add_option("--align", args->align, "Stamps: along the curve's tangent, or with y up")
      ->check(CLI::IsMember({"tangent", "fixed"}))
      ->capture_default_str();
  command->add_option("--stamp-spacing", args->stamping.spacing, "Of stamps, in sizes")
      ->capture_default_str();
  command->add_option("--rotation", args->rotation_deg, "Of stamps, degrees")
      ->capture_default_str();
  command
      ->add_option("--size-jitter", args->stamping.size_jitter,
                   "Of stamps at random, part of the size, 0 to 0.9")
      ->capture_default_str();
  command
      ->add_option("--rotation-jitter", args->rotation_jitter_deg, "Of stamps at random, degrees")
      ->capture_default_str();
  command->add_option("--seed", args->stamping.seed, "Of the jitter")->capture_default_str();
  command
      ->add_option("--atlas", args->atlas,
                   "cells: for any mesh; mesh: the file's own texture coordinates")
      ->check(CLI::IsMember({"cells", "mesh"}))
      ->capture_default_str();
  command->add_option("--size", args->size, "Of the texture, texels")->capture_default_str();
  command->add_option("-o,--out", args->out,
                      "The painted mesh: .glb, .obj (with .mtl and .png), .ply (vertex colours)");
  command->add_option("--png", args->png, "The texture");
  command->add_flag("--json", args->json, "A summary for programs");
  add_target_options(*command, args->target);
  command->callback([args, &status] { run_paint(*args, status); });
}

}  // namespace mimicry::cli
