#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>

#include <mimicry/io/study.h>

#include "io/json.h"
#include "io/json_document.h"
#include "io/json_text.h"
#include "io/text.h"

namespace mimicry {
namespace {

// Writers of other languages put bare NaN and Infinity into JSON, which has no word for them.
std::string without_nan(std::string_view text) {
  std::string clean;
  clean.reserve(text.size());
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\' && i + 1 < text.size()) {
      clean += c;
      clean += text[++i];
      continue;
    }
    if (c == '"') quoted = !quoted;
    bool replaced = false;
    if (!quoted && (c == 'N' || c == 'I' || c == '-'))
      for (const std::string_view word : {"NaN", "Infinity", "-Infinity", "-NaN"})
        if (text.substr(i, word.size()) == word) {
          clean += "null";
          i += word.size() - 1;
          replaced = true;
          break;
        }
    if (!replaced) clean += c;
  }
  return clean;
}

// null stands for what is not a number.
double value_of(const Json& value, const std::string& where) {
  if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
  return number(value, where);
}

Vec3 xyz(const Json& object, const char* key, const std::string& where) {
  const Json& v = member(object, key, where);
  const std::string place = where + ": " + key;
  return {value_of(member(v, "x", place), place), value_of(member(v, "y", place), place),
          value_of(member(v, "z", place), place)};
}

Index one_based(const Json& value, const std::string& where) {
  const double n = number(value, where);
  if (!(n >= 1.0 && n <= std::numeric_limits<Index>::max()) || n != std::floor(n))
    json_fail(where, "is not the number of a face, which count from 1");
  return static_cast<Index>(n) - 1;
}

RecordedFrame read_recorded_frame(const Json& value, const std::string& where) {
  RecordedFrame frame;
  frame.point = xyz(value, "PT", where);
  frame.normal = xyz(value, "N", where);
  frame.surface = {one_based(member(value, "TI", where), where + ": TI"), xyz(value, "B", where)};
  frame.pen_distance = value_of(member(value, "D", where), where + ": D");
  const Json& device = member(value, "DF", where);
  const std::string place = where + ": DF";
  frame.time_ms = value_of(member(device, "T", place), place + ": T");
  frame.head = xyz(device, "HP", place);
  frame.pen = xyz(device, "PP", place);
  frame.head_up = xyz(device, "HU", place);
  frame.head_forward = xyz(device, "HF", place);
  frame.pen_up = xyz(device, "CU", place);
  frame.pen_forward = xyz(device, "CF", place);
  frame.spray = xyz(device, "SD", place);
  return frame;
}

Eigen::Matrix4d read_matrix(const Json& value, const std::string& where) {
  const Json& data = member(value, "data", where);
  if (!data.is_array() || data.size() != 16) json_fail(where, "'data' is not 16 numbers");
  Eigen::Matrix4d matrix;  // column-major, as the file
  for (std::size_t i = 0; i < 16; ++i) matrix.data()[i] = value_of(data[i], where + ": data");
  return matrix;
}

RecordedPiece read_piece(const Json& value, const std::string& where) {
  RecordedPiece piece;
  const Json& frames = member(value, "F", where);
  if (!frames.is_array()) json_fail(where, "'F' is not an array");
  piece.frames.reserve(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
    piece.frames.push_back(read_recorded_frame(frames[i], where + ": frame " + std::to_string(i)));
  piece.method = text(member(value, "M", where), where + ": M");
  piece.model_to_world = read_matrix(member(value, "ModelMatrix", where), where + ": ModelMatrix");
  return piece;
}

RecordedStroke read_stroke(const Json& value) {
  RecordedStroke stroke;
  try {
    if (!value.is_array()) json_fail("the stroke", "is not an array of pieces");
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string where = "piece " + std::to_string(i);
      stroke.pieces.push_back(read_piece(value[i], where));
      if (!stroke.simulated && value[i].contains("Simulated"))
        stroke.simulated = read_simulation(value[i]["Simulated"], where + ": Simulated");
    }
  } catch (const Error& error) {
    stroke.problem = error.what();
  }
  return stroke;
}

void write_xyz(JsonText& out, const Vec3& v) {
  out.begin('{').member("x", v.x()).member("y", v.y()).member("z", v.z()).end('}');
}

void write(JsonText& out, const RecordedFrame& f) {
  write_xyz(out.begin('{').key("PT"), f.point);
  write_xyz(out.key("N"), f.normal);
  write_xyz(out.member("TI", f.surface.face + 1).key("B"), f.surface.bary);
  out.member("D", f.pen_distance).key("DF").begin('{').member("T", f.time_ms);
  for (const auto& [name, v] :
       std::initializer_list<std::pair<const char*, const Vec3&>>{{"HP", f.head},
                                                                  {"PP", f.pen},
                                                                  {"HU", f.head_up},
                                                                  {"HF", f.head_forward},
                                                                  {"CU", f.pen_up},
                                                                  {"CF", f.pen_forward},
                                                                  {"SD", f.spray}})
    write_xyz(out.key(name), v);
  out.end('}').end('}');
}

void write(JsonText& out, const RecordedPiece& piece, const RecordedStroke& stroke) {
  out.begin('{').key("P").begin('[');
  for (const RecordedFrame& f : piece.frames) write_xyz(out, f.point);
  out.end(']').key("F").begin('[');
  for (const RecordedFrame& f : piece.frames) write(out, f);
  out.end(']').member("M", piece.method).key("ModelMatrix").begin('{');
  out.member("data", std::span<const double>(piece.model_to_world.data(), 16)).end('}');
  if (stroke.simulated) write_simulation(out.key("Simulated"), *stroke.simulated);
  out.end('}');
}

}  // namespace

std::vector<RecordedStroke> read_recording(std::string_view bytes, std::string_view name) {
  const std::string file(name);
  bytes = text_of(bytes, name);
  std::vector<RecordedStroke> strokes;
  // The parser hands the strokes over one by one, so that only one is held as a tree.
  const auto event = [&](int depth, Json::parse_event_t kind, Json& value) {
    using Event = Json::parse_event_t;
    const bool ends = kind == Event::array_end || kind == Event::object_end;
    if (depth == 0 && (kind == Event::object_start || kind == Event::value))
      json_fail(file, "is not an array of strokes");
    if (depth == 1 && (ends || kind == Event::value)) {
      strokes.push_back(read_stroke(value));
      return false;  // the value is not kept
    }
    return true;
  };
  const bool has_nan = bytes.find("NaN") != std::string_view::npos ||
                       bytes.find("Infinity") != std::string_view::npos;
  try {
    const std::string clean = has_nan ? without_nan(bytes) : std::string();
    const JsonDocument rest(has_nan ? std::string_view(clean) : bytes, name, event);
  } catch (const Json::parse_error& error) {
    json_fail(file, "the text ends early or is not JSON at byte " + std::to_string(error.byte));
  } catch (const Json::exception& error) {
    json_fail(file, error.what());
  }
  return strokes;
}

std::string write_recording(std::span<const RecordedStroke> strokes) {
  std::string out = "[";
  const char* separator = "\n";
  for (const RecordedStroke& stroke : strokes) {
    JsonText pieces;
    pieces.begin('[');
    for (const RecordedPiece& piece : stroke.pieces) write(pieces, piece, stroke);
    pieces.end(']');
    out += separator;
    out += pieces.text();
    separator = ",\n";
  }
  out += "\n]\n";
  return out;
}

}  // namespace mimicry
