#include <mimicry/io/curves.h>
#include <mimicry/mesh/connect.h>

#include "io/number.h"
#include "io/text.h"

namespace mimicry {
namespace {

void append_position(std::string& out, const Vec3& x, char separator) {
  append_double(out, x.x());
  out += separator;
  append_double(out, x.y());
  out += separator;
  append_double(out, x.z());
}

// Vertices [first, end) of an OBJ file joined in their order.
void append_lines(std::string& out, std::size_t first, std::size_t end, ObjLines lines) {
  if (lines == ObjLines::segments) {
    for (std::size_t v = first; v + 1 < end; ++v)
      out += "l " + std::to_string(v) + ' ' + std::to_string(v + 1) + '\n';
    return;
  }
  out += 'l';
  for (std::size_t v = first; v < end; ++v) out += ' ' + std::to_string(v);
  out += '\n';
}

void append_csv_place(std::string& row, const Vec3& position, const SurfacePoint& surface) {
  append_position(row, position, ',');
  row += ',' + std::to_string(surface.face) + ',';
  append_position(row, surface.bary, ',');
}

}  // namespace

std::string write_curves_obj(const CurveSet& set, const TriangleMesh& mesh, ObjLines lines) {
  std::string out = "# curves on " + one_line(set.target) + "\n";
  std::size_t vertex = 1;  // OBJ counts from 1 through the whole file
  for (const CurveRecord& record : set.curves) {
    out += "o " + one_line(record.stroke + " " + record.technique) + "\n";
    for (const auto& part : polylines(record.curve, mesh)) {
      for (const Vec3& x : part) {
        out += "v ";
        append_position(out, x, ' ');
        out += '\n';
      }
      // A lone point has no line.
      if (part.size() > 1) append_lines(out, vertex, vertex + part.size(), lines);
      vertex += part.size();
    }
  }
  return out;
}

std::string write_curves_csv(const CurveSet& set, const TriangleMesh& mesh) {
  std::string out =
      "curve,stroke,technique,part,kind,frame,time_s,x,y,z,face,b0,b1,b2,nx,ny,nz,pen_distance\n";
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    const CurveRecord& record = set.curves[c];
    const std::string labels = std::to_string(c) + ',' + csv_field(record.stroke) + ',' +
                               csv_field(record.technique) + ',';
    int part = 0;
    for (std::size_t i = 0; i < record.curve.points.size(); ++i) {
      if (i > 0) {
        if (record.curve.pieces[i - 1].kind == PieceKind::gap) ++part;
        for (const Crossing& crossing : record.curve.piece_crossings(i - 1)) {
          out += labels + std::to_string(part) + ",crossing,,,";
          append_csv_place(out, position(mesh, crossing),
                           source_point(mesh, surface_point(crossing)));
          out += ",,,,\n";
        }
      }
      const CurvePoint& p = record.curve.points[i];
      out += labels + std::to_string(part) + ",point," + std::to_string(p.frame) + ',';
      append_double(out, p.time_s);
      out += ',';
      append_csv_place(out, p.position, source_point(mesh, p.surface));
      out += ',';
      append_position(out, p.normal, ',');
      out += ',';
      append_double(out, p.pen_distance);
      out += '\n';
    }
  }
  return out;
}

}  // namespace mimicry
