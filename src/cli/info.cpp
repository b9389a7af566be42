#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>
#include <mimicry/mesh/validation.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "io/text.h"

namespace mimicry::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InfoArguments {
  std::string mesh;
  bool json = false;
  TargetOptions target;
};

Json array_of(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Json optional_json(const std::optional<Index>& value) {
  return value ? Json(*value) : Json();
}

template <class Finding>
Json first_json(const Finding& finding) {
  return {{"count", finding.count}, {"first", finding.count > 0 ? Json(finding.first) : Json()}};
}

Json first_json(const EdgeFinding& finding) {
  return {{"count", finding.count},
          {"first", finding.count > 0 ? Json{finding.first_tail, finding.first_head} : Json()}};
}

Json component_json(const ComponentReport& c) {
  return {{"first_face", c.first_face},
          {"vertices", c.vertices},
          {"edges", c.edges},
          {"faces", c.faces},
          {"boundary_loops", c.boundary_loops},
          {"euler", c.euler},
          {"manifold", c.manifold},
          {"closed", c.closed},
          {"orientable", c.orientable},
          {"genus", optional_json(c.genus)}};
}

Json surface_json(const MeshReport& surface, const ConnectReport& c) {
  Json doubled = first_json(c.doubled_faces);
  if (c.doubled_faces.count > 0) doubled["copy_of"] = c.doubled_faces.first_copy_of;
  return {{"vertices", surface.vertices},
          {"faces", surface.faces - surface.repeated_corners.count},
          {"unused_vertices", first_json(c.unused_vertices)},
          {"joined_vertices", first_json(c.joined_vertices)},
          {"joined_edges", first_json(c.joined_edges)},
          {"seam_edges", first_json(c.seam_edges)},
          {"split_vertices", first_json(c.split_vertices)},
          {"split_edges", first_json(c.split_edges)},
          {"one_sided_edges", first_json(c.one_sided_edges)},
          {"collapsed_faces", first_json(c.repeated_corners)},
          {"doubled_faces", doubled},
          {"turned_faces", first_json(c.turned_faces)},
          {"notes", c.sentences()}};
}

template <std::size_t N>
Index corners_with(const CornerValues<N>& values) {
  return static_cast<Index>(values.corners.size()) -
         static_cast<Index>(std::count(values.corners.begin(), values.corners.end(), kNone));
}

Json attributes_json(const MeshAttributes& a) {
  return {{"texcoord_corners", corners_with(a.texcoords)},
          {"texcoords", a.texcoords.empty() ? std::size_t{0} : a.texcoords.values.size()},
          {"color_corners", corners_with(a.colors)},
          {"colors", a.colors.empty() ? std::size_t{0} : a.colors.values.size()},
          {"groups", a.groups.names},
          {"materials", a.materials.names},
          {"objects", a.objects.names}};
}

const MeshAttributes& attributes_of(const TriangleMesh& mesh) {
  static const MeshAttributes none;
  return mesh.attributes() ? *mesh.attributes() : none;
}

Json report_json(const std::string& name, const MeshReport& r, const MeshReport& surface,
                 const ConnectReport& connection, const MeshAttributes& attributes,
                 const std::string& refusal) {
  Json components = Json::array();
  for (const ComponentReport& c : r.components) components.push_back(component_json(c));
  Json duplicate = first_json(r.duplicate_faces);
  if (r.duplicate_faces.count > 0) duplicate["copy_of"] = r.duplicate_faces.first_copy_of;
  return {{"name", name},
          {"vertices", r.vertices},
          {"edges", r.edges},
          {"faces", r.faces},
          {"euler", r.euler},
          {"genus", optional_json(r.genus)},
          {"manifold", surface.is_manifold()},
          {"closed", surface.is_closed()},
          {"drawable", refusal.empty()},
          {"refusal", refusal.empty() ? Json() : Json(refusal)},
          {"box", r.box.isEmpty() ? Json() : Json{array_of(r.box.min()), array_of(r.box.max())}},
          {"diagonal", r.diagonal},
          {"area", r.area},
          {"volume", r.volume ? Json(*r.volume) : Json()},
          {"shortest_edge", r.shortest_edge},
          {"mean_edge", r.mean_edge},
          {"longest_edge", r.longest_edge},
          {"invalid_vertices", first_json(r.invalid_vertices)},
          {"isolated_vertices", first_json(r.isolated_vertices)},
          {"nonmanifold_edges", first_json(r.nonmanifold_edges)},
          {"nonmanifold_vertices", first_json(r.nonmanifold_vertices)},
          {"inconsistent_edges", first_json(r.inconsistent_edges)},
          {"boundary_loops", r.boundary.loops},
          {"boundary_edges", first_json(r.boundary.edges)},
          {"repeated_corners", first_json(r.repeated_corners)},
          {"degenerate_faces", first_json(r.degenerate_faces)},
          {"duplicate_faces", duplicate},
          {"attributes", attributes_json(attributes)},
          {"surface", surface_json(surface, connection)},
          {"components", components}};
}

void print_finding(const char* what, Index count, const std::string& first) {
  if (count > 0)
    std::printf("  %-34s %d (first: %s)\n", what, count, first.c_str());
  else
    std::printf("  %-34s none\n", what);
}

std::string name_of(const char* kind, Index i) {
  return std::string(kind) + " " + std::to_string(i);
}

std::string name_of(const EdgeFinding& e) {
  return "vertices " + std::to_string(e.first_tail) + "-" + std::to_string(e.first_head);
}

template <std::size_t N>
void print_values(const char* what, const CornerValues<N>& values) {
  if (!values.empty())
    std::printf("  %-34s %zu, at %d corners of %zu\n", what, values.values.size(),
                corners_with(values), values.corners.size());
}

// A name's first letters, of one that fills the screen.
std::string shortened(std::string name) {
  constexpr std::size_t kMost = 60;
  if (name.size() <= kMost) return name;
  std::size_t end = kMost;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) --end;  // within one
  return name.substr(0, end) + "...";
}

void print_labels(const char* what, const FaceLabels& labels) {
  constexpr std::size_t kMost = 20;  // of a file with thousands
  if (labels.empty()) return;
  std::printf("  %-34s %zu: ", what, labels.names.size());
  for (std::size_t n = 0; n < std::min(labels.names.size(), kMost); ++n)
    std::printf("%s%s", n > 0 ? ", " : "", shortened(one_line(labels.names[n])).c_str());
  std::printf("%s\n", labels.names.size() > kMost ? ", ..." : "");
}

void print_attributes(const MeshAttributes& a) {
  print_values("texture coordinates", a.texcoords);
  print_values("colours", a.colors);
  print_labels("groups", a.groups);
  print_labels("materials", a.materials);
  print_labels("objects", a.objects);
}

void print_report(const std::string& name, const MeshReport& r, const MeshReport& surface,
                  const ConnectReport& connection, const MeshAttributes& attributes,
                  const std::string& refusal) {
  std::printf("%s\n", name.c_str());
  std::printf("  %-34s %d, %d\n", "vertices, faces of the file", r.vertices, r.faces);
  std::printf("  %-34s %d, %d, %d\n", "vertices, edges, faces drawn on", surface.vertices,
              surface.edges, surface.faces - surface.repeated_corners.count);
  if (!r.box.isEmpty()) {
    const Vec3 size = r.box.sizes();
    std::printf("  %-34s %.6g x %.6g x %.6g, diagonal %.6g\n", "size", size.x(), size.y(), size.z(),
                r.diagonal);
  }
  std::printf("  %-34s %.6g", "area", r.area);
  if (r.volume) std::printf(", volume %.6g", *r.volume);
  std::printf("\n  %-34s %.6g, %.6g, %.6g\n", "edge length: least, mean, most", r.shortest_edge,
              r.mean_edge, r.longest_edge);
  std::printf("  %-34s %zu", "components", r.components.size());
  if (r.genus) std::printf(", genus %d", *r.genus);
  std::printf(", Euler characteristic %d\n", r.euler);
  print_finding("boundary loops", r.boundary.loops,
                std::to_string(r.boundary.edges.count) + " edges, " + name_of(r.boundary.edges));
  print_finding("non-manifold edges", r.nonmanifold_edges.count, name_of(r.nonmanifold_edges));
  print_finding("non-manifold vertices", r.nonmanifold_vertices.count,
                name_of("vertex", r.nonmanifold_vertices.first));
  print_finding("edges of inconsistent orientation", r.inconsistent_edges.count,
                name_of(r.inconsistent_edges));
  print_finding("faces that name a vertex twice", r.repeated_corners.count,
                name_of("face", r.repeated_corners.first));
  print_finding("faces without area", r.degenerate_faces.count,
                name_of("face", r.degenerate_faces.first));
  print_finding("duplicate faces", r.duplicate_faces.count,
                name_of("face", r.duplicate_faces.first) + " repeats " +
                    std::to_string(r.duplicate_faces.first_copy_of));
  print_finding("isolated vertices", r.isolated_vertices.count,
                name_of("vertex", r.isolated_vertices.first));
  print_finding("vertices that are not finite", r.invalid_vertices.count,
                name_of("vertex", r.invalid_vertices.first));
  print_attributes(attributes);
  for (const std::string& sentence : connection.sentences())
    std::printf("  %s\n", sentence.c_str());
  if (refusal.empty())
    std::printf("  can be drawn on\n");
  else
    std::printf("  cannot be drawn on: %s\n", refusal.c_str());
}

void run_info(const InfoArguments& args, int& status) {
  const NamedMesh named = load_mesh(args.mesh, terminal_monitor());
  const Connected connected = connect(named.mesh, {.join = args.target.join});
  const MeshReport surface = validate(connected.mesh);
  const MeshReport report = report_as_drawn(named.mesh, surface);
  const MeshAttributes& attributes = attributes_of(named.mesh);
  std::string refusal;
  try {
    (void)make_target(named, args.target);
  } catch (const Error& error) {
    refusal = error.what();
    status = kBadInput;
  }
  if (args.json)
    std::printf("%s\n", json_text(report_json(named.name, report, surface, connected.report,
                                              attributes, refusal))
                            .c_str());
  else
    print_report(named.name, report, surface, connected.report, attributes, refusal);
}

}  // namespace

void add_info(CLI::App& app, int& status) {
  auto* command = app.add_subcommand("info", "Say what a mesh is, and whether it can be drawn on");
  auto args = std::make_shared<InfoArguments>();
  command->add_option("mesh", args->mesh, kMeshHelp)->required();
  command->add_flag("--json", args->json, "For programs");
  add_target_options(*command, args->target);
  command->callback([args, &status] { run_info(*args, status); });
}

}  // namespace mimicry::cli
