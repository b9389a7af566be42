// Our own reader: tinyobjloader takes text that is no number for 0 without a word and tells no line
// number for it, and keeps single precision unless all who link it agree on a macro. It is the
// independent reader of the tests.

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/mesh_builder.h"
#include "io/text.h"

namespace mimicry {
namespace {

class ObjReader {
 public:
  explicit ObjReader(MeshBuilder& mesh) : mesh_(mesh) {}

  void statement(std::string_view text, std::size_t line) {
    line_ = line;
    const std::string_view keyword = take_word(text);
    if (keyword == "v")
      vertex(text);
    else if (keyword == "f" || keyword == "fo")
      face(text);
    // All else (normals, texture coordinates, groups, materials, lines, free-form surfaces) says
    // nothing of the triangles.
  }

  void finish() {
    if (farthest_ >= static_cast<Index>(mesh_.vertex_count()))
      fail_at_line(mesh_.name(), farthest_line_,
                   "the face refers to vertex " + std::to_string(farthest_ + 1) +
                       ", but the file holds " + std::to_string(mesh_.vertex_count()) +
                       " vertices; it is cut short or its faces are wrong");
    if (!unread_.empty()) tell_of_unread_vertices();
    if (faces_with_more_ > 0)
      mesh_.note(std::to_string(faces_with_more_) +
                 (faces_with_more_ == 1 ? " face is" : " faces are") +
                 " followed by text, which is passed over (first: line " +
                 std::to_string(more_line_) + ")");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { fail_at_line(mesh_.name(), line_, what); }

  struct Unread {
    Index vertex;
    std::size_t line;
    std::string what;
  };

  // A weight or a colour may follow the position, and is passed over. A vertex that cannot be read
  // counts: only a face that uses it is refused.
  void vertex(std::string_view text) {
    Vec3 position;
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = take_word(text);
      if (word.empty() || word[0] == '#')
        return unread("a vertex with " + std::to_string(k) +
                      " coordinates where three are needed; the line is cut short");
      const auto value = parse_double(word);
      if (!value)
        return unread(in_quotes(word) +
                      " is not a number, for a vertex; correct it or export the file again");
      position[k] = *value;
    }
    mesh_.add_vertex(position);
  }

  void unread(const std::string& what) {
    const Index vertex = mesh_.add_vertex(Vec3::Constant(std::nan("")));
    // Messages of the first ones only: a file may hold nothing else.
    unread_.push_back({vertex, line_, unread_.size() < 64 ? what : "the vertex cannot be read"});
  }

  void tell_of_unread_vertices() const {
    std::vector<bool> used(mesh_.vertex_count(), mesh_.faces().empty());
    for (const Face& face : mesh_.faces())
      for (const Index v : face) used[static_cast<std::size_t>(v)] = true;
    for (const Unread& u : unread_)
      if (used[static_cast<std::size_t>(u.vertex)]) fail_at_line(mesh_.name(), u.line, u.what);
    mesh_.note(std::to_string(unread_.size()) + (unread_.size() == 1 ? " vertex" : " vertices") +
               " without readable coordinates, which no face uses (first: line " +
               std::to_string(unread_[0].line) + ")");
  }

  void face(std::string_view text) {
    corners_.clear();
    for (std::string_view word = take_word(text); !word.empty() && word[0] != '#';
         word = take_word(text)) {
      if (corners_.size() >= 3 && is_word(word)) {
        if (faces_with_more_++ == 0) more_line_ = line_;
        break;
      }
      corners_.push_back(corner(word));
    }
    mesh_.add_polygon(corners_);
  }

  static bool is_word(std::string_view word) {
    return !(word[0] >= '0' && word[0] <= '9') && word[0] != '-' && word[0] != '+';
  }

  // v, v/vt, v//vn or v/vt/vn, counted from 1, or backwards from -1. What follows the first slash
  // says nothing of the triangles. A face may stand before its vertices, so that the upper end is
  // checked last.
  Index corner(std::string_view word) {
    const auto number = parse_integer(word.substr(0, word.find('/')));
    if (!number)
      fail(in_quotes(word) +
           " is not a face's corner (7, 7/1, 7//1 or 7/1/1); correct it or export "
           "the file again");
    const auto count = static_cast<std::int64_t>(mesh_.vertex_count());
    if (*number == 0 || *number < -count || *number > std::numeric_limits<Index>::max())
      fail("the face refers to vertex " + std::to_string(*number) + ", but " +
           std::to_string(count) + " vertices stand before it, counted from 1; correct the face");
    const auto vertex = static_cast<Index>(*number < 0 ? count + *number : *number - 1);
    if (vertex > farthest_) {
      farthest_ = vertex;
      farthest_line_ = line_;
    }
    return vertex;
  }

  MeshBuilder& mesh_;
  std::size_t line_ = 0;
  std::vector<Index> corners_;
  Index farthest_ = kNone;
  std::size_t farthest_line_ = 0;
  std::vector<Unread> unread_;
  std::size_t faces_with_more_ = 0;
  std::size_t more_line_ = 0;
};

// Where the backslash is that joins the next line to this one; npos: nowhere.
std::size_t continuation(std::string_view line) {
  std::size_t end = line.size();
  while (end > 0 && is_blank(line[end - 1])) --end;
  return end > 0 && line[end - 1] == '\\' ? end - 1 : std::string_view::npos;
}

// Of other lines, names and comments may end in a backslash that is a path's.
bool may_continue(std::string_view line) {
  const std::string_view keyword = take_word(line);
  return keyword == "v" || keyword == "f" || keyword == "fo";
}

}  // namespace

void read_obj(std::string_view bytes, MeshBuilder& mesh) {
  ObjReader reader(mesh);
  Lines lines(bytes);
  std::string_view line;
  std::string joined;
  while (lines.next(line)) {
    const std::size_t first = lines.line();
    if (continuation(line) != std::string_view::npos && may_continue(line)) {
      joined.clear();
      for (std::size_t at; (at = continuation(line)) != std::string_view::npos;) {
        joined += line.substr(0, at);
        joined += ' ';
        if (!lines.next(line)) line = {};
      }
      joined += line;
      line = joined;
    }
    reader.statement(line, first);
  }
  reader.finish();
}

}  // namespace mimicry
