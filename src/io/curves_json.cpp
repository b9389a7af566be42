#include <array>
#include <utility>

#include <mimicry/io/curves.h>
#include <mimicry/mesh/connect.h>

#include "io/json.h"
#include "io/json_document.h"
#include "io/json_text.h"
#include "io/text.h"

namespace mimicry {
namespace {

constexpr const char* kCurvesFormat = "mimicry-curves";

constexpr std::array<std::pair<PieceKind, const char*>, 5> kKinds = {
    {{PieceKind::same_face, "same-face"},
     {PieceKind::shortest, "shortest"},
     {PieceKind::locally_shortest, "locally-shortest"},
     {PieceKind::chord, "chord"},
     {PieceKind::gap, "gap"}}};

const char* kind_name(PieceKind kind) {
  for (const auto& [value, name] : kKinds)
    if (value == kind) return name;
  return "";
}

void write(JsonText& out, const CurvePoint& p, const TriangleMesh& mesh) {
  out.begin('{')
      .member("face", p.surface.face)
      .member("bary", source_point(mesh, p.surface).bary)
      .member("position", p.position)
      .member("normal", p.normal)
      .member("frame", p.frame)
      .member("time_s", p.time_s)
      .member("pen_distance", p.pen_distance)
      .end('}');
}

void write_piece(JsonText& out, const ProjectedCurve& curve, std::size_t i,
                 const TriangleMesh& mesh) {
  out.begin('{').member("kind", kind_name(curve.pieces[i].kind));
  out.member("length", curve.pieces[i].length).key("crossings").begin('[');
  for (const Crossing& crossing : curve.piece_crossings(i)) {
    const Index f = HalfEdges::face(crossing.half_edge);
    const Crossing c = source_crossing(mesh, crossing);
    const int k = HalfEdges::corner(c.half_edge);
    const auto own = [&](int corner) { return source_corner(mesh, f, corner); };
    out.begin('{').member("half_edge", c.half_edge);
    out.member("edge", std::array{own(k), own((k + 1) % 3)}).member("t", c.t).end('}');
  }
  out.end(']').end('}');
}

void write(JsonText& out, const CurveRecord& record, const TriangleMesh& mesh) {
  const Similarity& placed = record.model_to_world;
  out.begin('{').member("stroke", record.stroke).member("technique", record.technique);
  out.key("options").begin('{');
  for (const auto& [name, values] : record.options) out.member(name, values);
  out.end('}').key("model_to_world").begin('{');
  out.member("rotation", placed.rotation).member("translation", placed.translation);
  out.member("scale", placed.scale).end('}');
  out.member("length", length(record.curve)).member("closed", record.curve.closed);
  out.key("points").begin('[');
  for (const CurvePoint& p : record.curve.points) write(out, p, mesh);
  out.end(']').key("pieces").begin('[');
  for (std::size_t i = 0; i < record.curve.pieces.size(); ++i)
    write_piece(out, record.curve, i, mesh);
  out.end(']').end('}');
}

Index bounded(const Json& value, Index count, const std::string& where) {
  const Index i = index(value, where);
  if (i >= count)
    json_fail(where,
              std::to_string(i) + " is beyond the mesh; it is not the mesh that was drawn on");
  return i;
}

CurvePoint read_point(const Json& value, const TriangleMesh& mesh, const std::string& where) {
  CurvePoint p;
  p.surface.face = bounded(member(value, "face", where), mesh.face_count(), where + ": face");
  p.surface.bary = barycentrics(member(value, "bary", where), where);
  p.surface = source_point(mesh, p.surface);
  p.position = vector<3>(member(value, "position", where), where + ": position");
  p.normal = vector<3>(member(value, "normal", where), where + ": normal");
  p.frame = index(member(value, "frame", where), where + ": frame");
  p.time_s = number(member(value, "time_s", where), where + ": time_s");
  p.pen_distance = number(member(value, "pen_distance", where), where + ": pen_distance");
  return p;
}

Piece read_piece(const Json& value, const TriangleMesh& mesh, std::vector<Crossing>& crossings,
                 const std::string& where) {
  Piece piece;
  const std::string kind = text(member(value, "kind", where), where + ": kind");
  bool known = false;
  for (const auto& [candidate, name] : kKinds)
    if (kind == name) piece.kind = candidate, known = true;
  if (!known) json_fail(where, "kind '" + kind + "' is not known");
  piece.length = number(member(value, "length", where), where + ": length");
  piece.first_crossing = static_cast<std::uint32_t>(crossings.size());
  const Json& list = member(value, "crossings", where);
  if (!list.is_array()) json_fail(where, "'crossings' is not an array");
  for (const Json& c : list) {
    const Index h =
        bounded(member(c, "half_edge", where), 3 * mesh.face_count(), where + ": half_edge");
    const double t = number(member(c, "t", where), where + ": t");
    if (!(t >= 0.0 && t <= 1.0)) json_fail(where, "'t' is not between 0 and 1");
    crossings.push_back(source_crossing(mesh, {h, t}));
  }
  piece.crossing_count = static_cast<std::uint32_t>(list.size());
  return piece;
}

CurveRecord read_record(const Json& value, const TriangleMesh& mesh, const std::string& where) {
  CurveRecord record;
  record.stroke = text(member(value, "stroke", where), where + ": stroke");
  record.technique = text(member(value, "technique", where), where + ": technique");
  const Json& options = member(value, "options", where);
  if (!options.is_object()) json_fail(where, "'options' is not an object");
  for (const auto& [name, values] : options.items()) {
    if (!values.is_array()) json_fail(where, "option '" + name + "' is not an array");
    for (const Json& v : values) record.options[name].push_back(number(v, where + ": " + name));
  }
  const Json& placed = member(value, "model_to_world", where);
  record.model_to_world = {quaternion(member(placed, "rotation", where), where + ": rotation"),
                           vector<3>(member(placed, "translation", where), where + ": translation"),
                           number(member(placed, "scale", where), where + ": scale")};
  const Json& closed = member(value, "closed", where);
  if (!closed.is_boolean()) json_fail(where, "'closed' is not true or false");
  record.curve.closed = closed.get<bool>();
  const Json& points = member(value, "points", where);
  const Json& pieces = member(value, "pieces", where);
  if (!points.is_array() || !pieces.is_array() ||
      pieces.size() + 1 != std::max<std::size_t>(points.size(), 1))
    json_fail(where, "'pieces' is not one fewer than 'points'");
  for (std::size_t i = 0; i < points.size(); ++i)
    record.curve.points.push_back(
        read_point(points[i], mesh, where + ": point " + std::to_string(i)));
  for (std::size_t i = 0; i < pieces.size(); ++i)
    record.curve.pieces.push_back(read_piece(pieces[i], mesh, record.curve.crossings,
                                             where + ": piece " + std::to_string(i)));
  if (record.curve.closed && !points.empty()) {
    const SurfacePoint& first = record.curve.points.front().surface;
    const SurfacePoint& last = record.curve.points.back().surface;
    if (first.face != last.face || first.bary != last.bary)
      json_fail(where, "is closed and does not end in its first point");
  }
  return record;
}

}  // namespace

std::string write_curves_json(const CurveSet& set, const TriangleMesh& mesh) {
  JsonText target;
  target.begin('{').member("name", set.target).member("vertices", source_vertex_count(mesh));
  target.member("faces", mesh.face_count()).end('}');
  std::string out = "{\"format\":\"" + std::string(kCurvesFormat) +
                    "\",\"version\":" + std::to_string(kCurvesVersion) +
                    ",\"target\":" + target.text() + ",\"curves\":[";
  const char* separator = "\n";
  for (const CurveRecord& record : set.curves) {
    JsonText curve;
    write(curve, record, mesh);
    out += separator;
    out += curve.text();
    separator = ",\n";
  }
  out += "\n]}\n";
  return out;
}

CurveSet read_curves_json(std::string_view bytes, std::string_view name, const TriangleMesh& mesh) {
  const std::string file(name);
  JsonDocument parsed;
  try {
    parsed = JsonDocument(text_of(bytes, name), name);
  } catch (const Json::parse_error& error) {
    json_fail(file, "the text ends early or is not JSON at byte " + std::to_string(error.byte));
  } catch (const Json::exception& error) {
    json_fail(file, error.what());
  }
  const Json& document = parsed.root();
  if (text(member(document, "format", file), file + ": format") != kCurvesFormat)
    json_fail(file, "is not a " + std::string(kCurvesFormat) + " file");
  const Json& version = member(document, "version", file);
  if (version != kCurvesVersion)
    throw Error(ErrorKind::unsupported, file + ": version " + version.dump() + " of " +
                                            kCurvesFormat + " is not known; update the program");
  CurveSet set;
  const Json& target = member(document, "target", file);
  set.target = text(member(target, "name", file), file + ": target: name");
  const Index vertices = index(member(target, "vertices", file), file + ": target: vertices");
  const Index faces = index(member(target, "faces", file), file + ": target: faces");
  if (vertices != source_vertex_count(mesh) || faces != mesh.face_count())
    json_fail(file, "was drawn on a mesh of " + std::to_string(vertices) + " vertices and " +
                        std::to_string(faces) + " faces; this one has " +
                        std::to_string(source_vertex_count(mesh)) + " and " +
                        std::to_string(mesh.face_count()));
  const Json& curves = member(document, "curves", file);
  if (!curves.is_array()) json_fail(file, "'curves' is not an array");
  for (std::size_t i = 0; i < curves.size(); ++i)
    set.curves.push_back(read_record(curves[i], mesh, file + ": curve " + std::to_string(i)));
  return set;
}

}  // namespace mimicry
