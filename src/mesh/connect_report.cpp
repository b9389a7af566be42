#include <string>

#include <mimicry/mesh/connect.h>

namespace mimicry {
namespace {

std::string counted(Index count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string first(const VertexFinding& found) {
  return " (first: vertex " + std::to_string(found.first) + ")";
}

std::string first_face(Index face) {
  return " (first: face " + std::to_string(face) + ")";
}

std::string first(const EdgeFinding& found) {
  return " (first: vertices " + std::to_string(found.first_tail) + "-" +
         std::to_string(found.first_head) + ")";
}

}  // namespace

MeshReport report_as_drawn(const TriangleMesh& mesh, const MeshReport& surface) {
  const MeshReport found = validate(mesh);
  MeshReport report = surface;
  report.vertices = found.vertices;
  report.faces = found.faces;
  report.invalid_vertices = found.invalid_vertices;
  report.isolated_vertices = found.isolated_vertices;
  report.nonmanifold_edges = found.nonmanifold_edges;
  report.nonmanifold_vertices = found.nonmanifold_vertices;
  report.inconsistent_edges = found.inconsistent_edges;
  report.repeated_corners = found.repeated_corners;
  report.degenerate_faces = found.degenerate_faces;
  report.duplicate_faces = found.duplicate_faces;
  return report;
}

std::vector<std::string> ConnectReport::sentences() const {
  std::vector<std::string> list;
  if (joined_vertices.count > 0)
    list.push_back(counted(joined_edges.count, "seam edge was closed, joining ",
                           "seam edges were closed, joining ") +
                   counted(joined_vertices.count, "vertex to another at its position",
                           "vertices to others at their positions") +
                   first(joined_vertices));
  if (split_edges.count > 0)
    list.push_back(counted(split_edges.count, "edge of three or more faces was split",
                           "edges of three or more faces were split") +
                   first(split_edges));
  if (split_vertices.count > 0)
    list.push_back(counted(split_vertices.count, "vertex where sheets meet was split",
                           "vertices where sheets meet were split") +
                   first(split_vertices));
  if (repeated_corners.count > 0)
    list.push_back(counted(repeated_corners.count,
                           "face with two corners at one place was left out",
                           "faces with two corners at one place were left out") +
                   first_face(repeated_corners.first));
  if (doubled_faces.count > 0)
    list.push_back(counted(doubled_faces.count, "face that lies on another was left out",
                           "faces that lie on others were left out") +
                   " (first: face " + std::to_string(doubled_faces.first) + " on " +
                   std::to_string(doubled_faces.first_copy_of) + ")");
  if (turned_faces.count > 0)
    list.push_back(counted(turned_faces.count,
                           "face was turned to the side of its neighbours or outward",
                           "faces were turned to the side of their neighbours or outward") +
                   first_face(turned_faces.first));
  if (one_sided_edges.count > 0)
    list.push_back(counted(one_sided_edges.count,
                           "edge was opened, because the surface there has one side only",
                           "edges were opened, because the surface there has one side only") +
                   first(one_sided_edges));
  if (unused_vertices.count > 0)
    list.push_back(counted(unused_vertices.count, "vertex that no face uses was left out",
                           "vertices that no face uses were left out") +
                   first(unused_vertices));
  if (seam_edges.count > 0)
    list.push_back(
        counted(seam_edges.count, "seam edge is not joined", "seam edges are not joined") +
        first(seam_edges) + ": curves stop there or run round the object");
  return list;
}

}  // namespace mimicry
