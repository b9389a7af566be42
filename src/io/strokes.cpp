#include <optional>
#include <utility>

#include <mimicry/io/strokes.h>

#include "io/json.h"
#include "io/json_document.h"
#include "io/json_text.h"
#include "io/stroke_splitter.h"
#include "io/text.h"

namespace mimicry {
namespace {

constexpr const char* kStrokesFormat = "mimicry-strokes";

Pose read_pose(const Json& value, const std::string& where) {
  return {vector<3>(member(value, "position", where), where + ": position"),
          quaternion(member(value, "orientation", where), where + ": orientation")};
}

Frame read_frame(const Json& value, const std::string& where) {
  Frame frame;
  frame.time_s = number(member(value, "time_s", where), where + ": time_s");
  frame.head = read_pose(member(value, "head", where), where + ": head");
  frame.controller = read_pose(member(value, "controller", where), where + ": controller");
  frame.trigger = number(member(value, "trigger", where), where + ": trigger");
  if (value.contains("pressure")) frame.pressure = number(value["pressure"], where + ": pressure");
  return frame;
}

Similarity read_placement(const Json& value, const std::string& where) {
  return {quaternion(member(value, "rotation", where), where + ": rotation"),
          vector<3>(member(value, "translation", where), where + ": translation"),
          number(member(value, "scale", where), where + ": scale")};
}

Intention read_intention(const Json& value, const std::string& where) {
  Intention intention;
  intention.name = text(member(value, "name", where), where + ": name");
  const Json& closed = member(value, "closed", where);
  if (!closed.is_boolean()) json_fail(where, "'closed' is not true or false");
  intention.closed = closed.get<bool>();
  const Json& faces = member(value, "face", where);
  const Json& bary = member(value, "bary", where);
  if (!faces.is_array() || !bary.is_array() || faces.size() != bary.size())
    json_fail(where, "'face' and 'bary' are not arrays of the same length");
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::string point = where + ": point " + std::to_string(i);
    intention.points.push_back({index(faces[i], point), barycentrics(bary[i], point)});
  }
  return intention;
}

void read_fields(const Json& value, Stroke& stroke, std::string where) {
  stroke.id = text(member(value, "id", where), where + ": id");
  where += ": stroke '" + stroke.id + "'";
  stroke.target = text(member(value, "target", where), where + ": target");
  stroke.model_to_world =
      read_placement(member(value, "model_to_world", where), where + ": model_to_world");
  if (value.contains("intended"))
    stroke.intended = read_intention(value["intended"], where + ": intended");
  if (value.contains("simulated"))
    stroke.simulated = read_simulation(value["simulated"], where + ": simulated");
  const Json& frames = array(value, "frames", where);
  stroke.frames.reserve(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
    stroke.frames.push_back(read_frame(frames[i], where + ": frame " + std::to_string(i)));
}

// The rotation of a placement is checked before it is converted, which would hide its length.
Stroke read_stroke(const Json& value, const CoordinateConvention& convention,
                   const std::string& where) {
  Stroke stroke;
  try {
    read_fields(value, stroke, where);
  } catch (const Error& error) {
    throw Error(error.kind(),
                std::string(error.what()) + "; correct it or record the stroke again");
  }
  try {
    require_usable(stroke);
  } catch (const Error& error) {
    throw Error(error.kind(), where + ": " + error.what());
  }
  stroke.model_to_world = convention.placement_in(stroke.model_to_world);
  for (Frame& frame : stroke.frames) frame = convention.frame_in(frame);
  return stroke;
}

// What stands before the strokes: the parser hands the members over one by one.
struct StrokesHeader {
  std::string name;
  std::string format;
  std::int64_t version = 0;
  const CoordinateConvention* convention = nullptr;

  void set(const std::string& key, const Json& value) {
    if (key == "format") {
      format = value.is_string() ? value.get<std::string>() : "";
      if (format != kStrokesFormat)
        throw Error(ErrorKind::invalid_input,
                    name + ": is not a " + kStrokesFormat + " file ('format' says otherwise)");
    } else if (key == "version") {
      version = value.is_number_integer() ? value.get<std::int64_t>() : -1;
      if (version != kStrokesVersion)
        throw Error(ErrorKind::unsupported,
                    name + ": version " + value.dump() + " of " + kStrokesFormat +
                        " is not known (this program reads " + std::to_string(kStrokesVersion) +
                        "); update the program or export the strokes again");
    } else if (key == "convention") {
      const std::string wanted = value.is_string() ? value.get<std::string>() : value.dump();
      convention = find_convention(wanted);
      if (convention == nullptr)
        throw Error(ErrorKind::invalid_input, name + ": convention '" + wanted +
                                                  "' is not known; use openxr, unity, unreal or "
                                                  "paper");
    }
  }
  void require_complete() const {
    if (format.empty() || version == 0 || convention == nullptr)
      throw Error(ErrorKind::invalid_input,
                  name + ": 'format', 'version' and 'convention' must stand before 'strokes'");
  }
};

void write_value(JsonText& out, const Pose& pose) {
  out.begin('{').member("position", pose.position);
  out.member("orientation", pose.orientation).end('}');
}

void write_value(JsonText& out, const Frame& frame) {
  out.begin('{').member("time_s", frame.time_s);
  write_value(out.key("head"), frame.head);
  write_value(out.key("controller"), frame.controller);
  out.member("trigger", frame.trigger);
  if (frame.pressure) out.member("pressure", *frame.pressure);
  out.end('}');
}

void write_value(JsonText& out, const Intention& intention) {
  out.begin('{').member("name", intention.name).member("closed", intention.closed);
  out.key("face").begin('[');
  for (const SurfacePoint& p : intention.points) out.value(p.face);
  out.end(']').key("bary").begin('[');
  for (const SurfacePoint& p : intention.points) out.value(p.bary);
  out.end(']').end('}');
}

// What a text holds of a file: a header of `head` bytes, and what stands in the file at `begin`.
struct StrokesPart {
  std::string name;
  std::size_t first = 0;  // number of the first stroke
  std::size_t head = 0;
  std::size_t begin = 0;
};

void read_part(std::string_view bytes, const StrokesPart& part,
               const std::function<void(Stroke&&)>& visit) {
  StrokesHeader header;
  header.name = part.name;
  std::string key;
  std::size_t count = part.first;
  std::size_t frames = 0;  // of the stroke that is being read
  bool has_strokes = false;
  // Where a byte of the part stands in the file.
  const auto place = [&](std::size_t byte) {
    return byte > part.head ? byte - part.head + part.begin : byte;
  };
  const auto event = [&](int depth, Json::parse_event_t kind, Json& value) {
    using Event = Json::parse_event_t;
    if (depth == 1 && kind == Event::key) key = value.get<std::string>();
    if (depth == 1 && kind == Event::value) header.set(key, value);
    if (depth == 1 && kind == Event::array_start && key == "strokes") {
      header.require_complete();
      has_strokes = true;
    }
    if (key == "strokes" && depth == 2 && kind == Event::object_start) frames = 0;
    if (key == "strokes" && depth == 4 && kind == Event::object_end) ++frames;
    if (key == "strokes" && depth == 2 && (kind == Event::value || kind == Event::array_start))
      json_fail(header.name + ": stroke " + std::to_string(count), "is not an object");
    if (depth == 2 && kind == Event::object_end && key == "strokes") {
      visit(read_stroke(value, *header.convention,
                        header.name + ": stroke " + std::to_string(count++)));
      return false;  // the value is not kept
    }
    return true;
  };
  try {
    const JsonDocument rest(text_of(bytes, header.name), header.name, event);
  } catch (const Json::parse_error& error) {
    throw Error(ErrorKind::invalid_input,
                header.name + ": stroke " + std::to_string(count) + ": frame " +
                    std::to_string(frames) + ": the text ends early or is not JSON at byte " +
                    std::to_string(place(error.byte)) + "; export the strokes again");
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::invalid_input,
                header.name + ": stroke " + std::to_string(count) + ": " + error.what());
  }
  if (!has_strokes)
    throw Error(ErrorKind::invalid_input, header.name + ": is not a " + kStrokesFormat +
                                              " file (there is no array 'strokes')");
}

}  // namespace

void read_strokes(std::string_view bytes, std::string_view name,
                  const std::function<void(Stroke&&)>& visit, std::size_t first) {
  read_part(bytes, {.name = std::string(name), .first = first}, visit);
}

StrokesFile read_strokes(std::string_view bytes, std::string_view name) {
  StrokesFile file;
  StrokesPart part{.name = std::string(name)};
  const auto keep = [&](Stroke&& stroke) {
    file.strokes.push_back(std::move(stroke));
    file.numbers.push_back(part.first);
  };
  const std::string_view whole = text_of(bytes, name);
  std::size_t at = 0;
  StrokeSplitter splitter([&](char* buffer, std::size_t size) {
    const std::size_t count = whole.copy(buffer, size, at);
    at += count;
    return count;
  });
  std::optional<std::string> text = splitter.next();
  const std::string head(splitter.head());
  if (head.empty()) {  // there is no array, or its key is written in another way
    read_part(whole, part, [&](Stroke&& stroke) {
      keep(std::move(stroke));
      ++part.first;
    });
    return file;
  }
  // The file's own faults are told once, before any stroke is read.
  read_part(head + "]}", part, keep);
  const std::size_t mark = bytes.size() - whole.size();
  part.head = head.size();
  for (; text; text = splitter.next(), ++part.first) {
    part.begin = mark + splitter.begin();
    try {
      read_part(*text, part, keep);
    } catch (const Error& error) {
      file.left_out.emplace_back(error.what());
    }
  }
  if (splitter.closed()) try {
      read_part(head + "]" + std::string(whole.substr(splitter.used())), part, keep);
    } catch (const Error&) {
      file.left_out.push_back(part.name +
                              ": what follows the strokes is cut short or not JSON; export them "
                              "again");
    }
  if (file.strokes.empty() && !file.left_out.empty())
    throw Error(ErrorKind::invalid_input, file.left_out.front());
  return file;
}

StrokeWriter::StrokeWriter(Sink sink, const CoordinateConvention& convention)
    : sink_(std::move(sink)), convention_(&convention) {
  sink_("{\"format\":\"" + std::string(kStrokesFormat) +
        "\",\"version\":" + std::to_string(kStrokesVersion) + ",\"convention\":\"" +
        std::string(convention.name) + "\",\"strokes\":[");
}

void StrokeWriter::write(const Stroke& stroke) {
  require_usable(stroke);
  const Similarity placed = convention_->placement_out(stroke.model_to_world);
  JsonText out;
  out.begin('{').member("id", stroke.id).member("target", stroke.target);
  out.key("model_to_world").begin('{').member("rotation", placed.rotation);
  out.member("translation", placed.translation).member("scale", placed.scale).end('}');
  if (stroke.intended) write_value(out.key("intended"), *stroke.intended);
  if (stroke.simulated) write_simulation(out.key("simulated"), *stroke.simulated);
  out.key("frames").begin('[');
  for (const Frame& frame : stroke.frames) write_value(out, convention_->frame_out(frame));
  out.end(']').end('}');
  sink_((first_ ? "\n" : ",\n") + out.text());
  first_ = false;
}

void StrokeWriter::finish() {
  sink_("\n]}\n");
}

std::string write_strokes(std::span<const Stroke> strokes, const CoordinateConvention& convention) {
  std::string text;
  StrokeWriter writer([&](std::string_view piece) { text += piece; }, convention);
  for (const Stroke& stroke : strokes) writer.write(stroke);
  writer.finish();
  return text;
}

}  // namespace mimicry
