// Our own reader: tinyobjloader takes text that is no number for 0 without a word and tells no line
// number for it, and keeps single precision unless all who link it agree on a macro. It is the
// independent reader of the tests.

#include <algorithm>
#include <array>
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
    else if (keyword == "vt")
      texcoord(text);
    else if (keyword == "g")
      label(mesh_.attributes().groups, text);
    else if (keyword == "usemtl")
      label(mesh_.attributes().materials, text);
    else if (keyword == "o")
      label(mesh_.attributes().objects, text);
    // All else (normals, lines, free-form surfaces) says nothing of the triangles.
  }

  void finish() {
    if (farthest_ >= static_cast<Index>(mesh_.vertex_count()))
      fail_at_line(mesh_.name(), farthest_line_,
                   "the face refers to vertex " + std::to_string(farthest_ + 1) +
                       ", but the file holds " + std::to_string(mesh_.vertex_count()) +
                       " vertices; it is cut short or its faces are wrong");
    if (!unread_.empty()) tell_of_unread_vertices();
    tell_of_lost_texcoords();
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

  // A weight may follow the position, and is passed over, or a colour. A vertex that cannot be read
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
    const Index vertex = mesh_.add_vertex(position);
    if (!text.empty()) color(vertex, text);
  }

  // Three numbers behind the position; a single one is a weight.
  void color(Index vertex, std::string_view text) {
    double rgb[3];
    for (double& component : rgb) {
      const auto value = parse_double(take_word(text));
      if (!value) return;
      component = *value;
    }
    mesh_.attributes().colors.set_of_vertex(vertex, color_from_srgb(rgb[0], rgb[1], rgb[2]));
  }

  // One that cannot be read counts: corners that name it have none.
  void texcoord(std::string_view text) {
    std::array<float, 2> uv = {0.0f, 0.0f};
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string_view word = take_word(text);
      if (k == 1 && (word.empty() || word[0] == '#')) break;  // on a line
      const auto value = parse_double(word);
      uv[k] = value ? static_cast<float>(*value) : std::numeric_limits<float>::quiet_NaN();
    }
    mesh_.attributes().texcoords.add(uv);
  }

  // The rest of the line, blanks within it included; none: faces that follow have no name.
  void label(FaceLabelBuilder& labels, std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    labels.begin(mesh_.face_count(), text.empty() ? kNone : labels.number(text));
  }

  void tell_of_lost_texcoords() {
    const Index count = mesh_.attributes().texcoords.count();
    if (farthest_texcoord_ >= count) {
      lost_texcoord_line_ = lost_texcoord_line_ == 0
                                ? farthest_texcoord_line_
                                : std::min(lost_texcoord_line_, farthest_texcoord_line_);
    }
    if (lost_texcoord_line_ == 0) return;
    mesh_.note("faces name texture coordinates that the file does not hold (it has " +
               std::to_string(count) + "); those corners have none (for example line " +
               std::to_string(lost_texcoord_line_) + ")");
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
    texcoords_.clear();
    for (std::string_view word = take_word(text); !word.empty() && word[0] != '#';
         word = take_word(text)) {
      if (corners_.size() >= 3 && is_word(word)) {
        if (faces_with_more_++ == 0) more_line_ = line_;
        break;
      }
      const std::size_t slash = word.find('/');
      corners_.push_back(corner(word.substr(0, slash)));
      if (slash != std::string_view::npos) corner_texcoord(word.substr(slash + 1));
    }
    if (!texcoords_.empty()) texcoords_.resize(corners_.size(), kNone);
    mesh_.add_polygon(corners_, texcoords_, {});
  }

  static bool is_word(std::string_view word) {
    return !(word[0] >= '0' && word[0] <= '9') && word[0] != '-' && word[0] != '+';
  }

  // Of v, v/vt, v//vn or v/vt/vn the number of the vertex, counted from 1, or backwards from -1. A
  // face may stand before its vertices, so that the upper end is checked last.
  Index corner(std::string_view word) {
    const auto number = parse_integer(word);
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

  // What follows the first slash of the last corner. It cannot make a file unreadable.
  void corner_texcoord(std::string_view word) {
    word = word.substr(0, word.find('/'));
    if (word.empty()) return;
    const auto number = parse_integer(word);
    const auto count = static_cast<std::int64_t>(mesh_.attributes().texcoords.count());
    texcoords_.resize(corners_.size(), kNone);
    if (!number || *number == 0 || *number < -count ||
        *number > std::numeric_limits<Index>::max()) {
      if (lost_texcoord_line_ == 0) lost_texcoord_line_ = line_;
      return;
    }
    const auto texcoord = static_cast<Index>(*number < 0 ? count + *number : *number - 1);
    if (texcoord > farthest_texcoord_) {
      farthest_texcoord_ = texcoord;
      farthest_texcoord_line_ = line_;
    }
    texcoords_.back() = texcoord;
  }

  MeshBuilder& mesh_;
  std::size_t line_ = 0;
  std::vector<Index> corners_, texcoords_;  // of a face; texcoords_ empty: none has some
  Index farthest_ = kNone;
  std::size_t farthest_line_ = 0;
  Index farthest_texcoord_ = kNone;
  std::size_t farthest_texcoord_line_ = 0;
  std::size_t lost_texcoord_line_ = 0;  // 0: none is lost as far as is known
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
