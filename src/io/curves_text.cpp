#include <mimicry/io/curves.h>
#include <mimicry/io/number.h>
#include <mimicry/mesh/mesh_source.h>

#include "io/text.h"

namespace mimicry::io {
namespace {

using curve::CurvePoint;
using curve::PieceKind;

void append_position(std::string& out, const Vec3& x, char separator) {
  append_double(out, x.x());
  out += separator;
  append_double(out, x.y());
  out += separator;
  append_double(out, x.z());
}

std::string one_line(std::string name) {
  for (char& c : name)
    if (c == '\n' || c == '\r') c = ' ';
  return name;
}

void append_csv_place(std::string& row, const Vec3& position, const SurfacePoint& surface) {
  append_position(row, position, ',');
  row += ',' + std::to_string(surface.face) + ',';
  append_position(row, surface.bary, ',');
}

}  // namespace

std::string write_curves_obj(const CurveSet& set, const TriangleMesh& mesh) {
  std::string out = "# curves on " + one_line(set.target) + "\n";
  std::size_t vertex = 1;  // OBJ counts from 1 through the whole file
  for (const CurveRecord& record : set.curves) {
    out += "o " + one_line(record.stroke + " " + record.technique) + "\n";
    for (const auto& part : curve::polylines(record.curve, mesh)) {
      for (const Vec3& x : part) {
        out += "v ";
        append_position(out, x, ' ');
        out += '\n';
      }
      // A lone point has no line.
      if (part.size() > 1) {
        out += 'l';
        for (std::size_t i = 0; i < part.size(); ++i) out += ' ' + std::to_string(vertex + i);
        out += '\n';
      }
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

std::string write_curves_ply(const CurveSet& set, const TriangleMesh& mesh,
                             std::span<const std::array<unsigned char, 3>> colors) {
  std::string vertices;
  std::string edges;
  std::size_t vertex_count = 0;
  std::size_t edge_count = 0;
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    std::string tail;
    for (const unsigned char channel : colors[c]) tail += ' ' + std::to_string(channel);
    tail += ' ' + std::to_string(c) + '\n';
    for (const auto& part : curve::polylines(set.curves[c].curve, mesh)) {
      for (std::size_t i = 0; i < part.size(); ++i) {
        append_position(vertices, part[i], ' ');
        vertices += tail;
        if (i > 0) {
          edges += std::to_string(vertex_count - 1) + ' ' + std::to_string(vertex_count) + '\n';
          ++edge_count;
        }
        ++vertex_count;
      }
    }
  }
  return "ply\nformat ascii 1.0\ncomment curves on " + one_line(set.target) + "\nelement vertex " +
         std::to_string(vertex_count) +
         "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\n"
         "property uchar green\nproperty uchar blue\nproperty int curve\nelement edge " +
         std::to_string(edge_count) + "\nproperty int vertex1\nproperty int vertex2\nend_header\n" +
         vertices + edges;
}

}  // namespace mimicry::io
