// Inputs to start from, small ones of every writer, into FOLDER/<target>/: the formats come along
// with what the writers make of them. make_seeds FOLDER

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/bake/bake.h>
#include <mimicry/base/random.h>
#include <mimicry/io/curves.h>
#include <mimicry/io/embedding_file.h>
#include <mimicry/io/meshes.h>
#include <mimicry/io/strokes.h>
#include <mimicry/io/study.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>

#include "messy/messy_meshes.h"

namespace {

using namespace mimicry;

std::filesystem::path folder;

void keep(std::string_view target, const std::string& name, std::string_view bytes) {
  const auto place = folder / target;
  std::filesystem::create_directories(place);
  std::ofstream out(place / name, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.exceptions(std::ios::failbit);
  out.close();
}

void meshes() {
  const struct {
    const char* name;
    TriangleMesh mesh;
  } kMeshes[] = {{"box", make_box(1, 1, 1, Vec3::Ones())},
                 {"sphere", make_sphere(1)},
                 {"soup", messy::families()[0].make(6, 1)}};
  for (const auto& [name, mesh] : kMeshes) {
    for (const auto& [target, format] : {std::pair{"obj", MeshFormat::obj},
                                         {"off", MeshFormat::off},
                                         {"ply", MeshFormat::ply},
                                         {"stl", MeshFormat::stl},
                                         {"glb", MeshFormat::glb}})
      keep(target, name, write_mesh(mesh, format));
    for (const auto& [target, format] :
         {std::pair{"ply", MeshFormat::ply}, {"stl", MeshFormat::stl}})
      keep(target, std::string(name) + "_text", write_mesh(mesh, format, {.text = true}));
  }
}

Stroke some_stroke() {
  Stroke s;
  s.id = "s1";
  s.target = "box";
  for (int i = 0; i < 6; ++i) {
    Frame f;
    f.time_s = 0.1 * i;
    f.head.position = Vec3(0, 1.6, 2.5);
    f.controller.position = Vec3(0.4 * i - 1.0, 0.2 * i, 1.3);
    if (i % 2 == 0) f.pressure = 0.5;
    s.frames.push_back(f);
  }
  s.intended = Intention{"i", true, {{0, Vec3(1, 0, 0)}, {1, Vec3(0.5, 0.25, 0.25)}}};
  return s;
}

void drawings() {
  // The mesh that curves_fuzz reads curves for.
  const TriangleMesh box = make_box(1, 1, 1, Vec3::Ones());
  const Target target(box);
  const Canvas canvas{target};
  const Stroke stroke = some_stroke();
  CurveSet set{"box", {}};
  for (const TechniqueInfo& technique : techniques())
    if (!technique.needs_bake) {
      CurveRecord record;
      record.stroke = stroke.id;
      record.technique = technique.name;
      record.curve = project(canvas, technique, stroke).curve;
      set.curves.push_back(std::move(record));
    }
  keep("curves", "all", write_curves_json(set, box));
  keep("curves", "packed", write_curves_packed(set, box));
  set.curves.resize(1);
  keep("curves", "one", write_curves_json(set, box));
  keep("csv", "curves", write_curves_csv(set, box));

  const std::vector<Stroke> strokes = {stroke, stroke};
  int number = 0;
  for (const CoordinateConvention& convention : conventions())
    keep("strokes", "convention" + std::to_string(number++), write_strokes(strokes, convention));
}

void studies() {
  TargetSet set;
  TargetCurve curve;
  curve.points = {{0, Vec3(1, 0, 0)}, {1, Vec3(0.25, 0.5, 0.25)}, {2, Vec3(0, 0, 1)}};
  curve.keypoints = {0, 2};
  curve.parameters = TargetParameters{};
  set.shapes.push_back({"torus", 0.4, {curve, curve}});
  keep("targets", "two", write_targets(set, "a note"));
  const std::string sequence = write_study_sequence({{1, 0}, {0}, {{0, 1, 2, 0}, {2, 1}}});
  keep("study_recording", "sequence", "s" + sequence);

  const Target target(make_box(1, 1, 1, Vec3::Ones()));
  const Canvas canvas{target};
  const Stroke drawn = some_stroke();
  std::vector<RecordedStroke> recorded;
  for (const char* name : {"spraycan", "head-centric", "snap"})
    recorded.push_back(record(drawn, project(canvas, find_technique(name), drawn).curve, "Spray"));
  const std::string recording = write_recording(recorded);
  keep("study_recording", "recording", "r" + recording);
  TargetCurve across;  // a face
  for (int step = 0; step <= 8; ++step)
    across.points.push_back({0, Vec3(1.0 - step / 8.0, step / 16.0, step / 16.0)});
  using namespace std::string_literals;
  keep("measure", "folder",
       write_study_sequence({{0}, {0}, {{0, 0, 0, 0}}}) + "\0"s + recording + "\0"s +
           write_targets({{{"box", 0.4, {across}}}}, ""));
}

void bakes() {
  const TriangleMesh tetrahedron({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                 {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  keep("embedding", "tetrahedron",
       write_embedding(mimicry::bake(tetrahedron, {.samples = 10, .offset = 0.5})));
}

// Where the bytes are choices and not a format: some of any kind, the same each time.
void choices() {
  for (const char* target : {"bake", "capi", "geodesic", "projector", "session"})
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      Random random(seed);
      std::string bytes(20 + random.below(400), '\0');
      for (char& b : bytes) b = static_cast<char>(random.bits());
      keep(target, "random" + std::to_string(seed), bytes);
    }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "make_seeds FOLDER\n");
    return 2;
  }
  folder = argv[1];
  meshes();
  drawings();
  studies();
  bakes();
  choices();
} catch (const std::exception& error) {
  std::fprintf(stderr, "make_seeds: %s\n", error.what());
  return 1;
}
