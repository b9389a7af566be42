#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/stroke/stroke.h>

namespace mimicry {

/// The version of `mimicry-strokes` that is written and read (docs/formats.md).
inline constexpr int kStrokesVersion = 1;

/// Reads a `mimicry-strokes` file and hands over its strokes one by one, converted to the internal
/// convention and checked; only one stroke is held at a time. `name` stands for the file in
/// messages. Throws Error naming file, stroke and frame: JSON that is cut off or malformed (with
/// the byte), another format, a version that is unknown (unsupported), a field that is missing or
/// of the wrong kind, a frame that cannot be used (`frame_problem`). Strokes before the
/// fault have been handed over by then. `first`: the number of the first stroke, for messages.
void read_strokes(std::string_view bytes, std::string_view name,
                  const std::function<void(Stroke&&)>& visit, std::size_t first = 0);

/// A file's sound strokes, and what was left out of it.
struct StrokesFile {
  std::vector<Stroke> strokes;
  std::vector<std::size_t> numbers;   ///< of each of these in the file, from 0
  std::vector<std::string> left_out;  ///< a sentence each: file, stroke, frame, fault and remedy
};

/// The same, but a stroke with a fault does not refuse the others: it is left out as a whole, since
/// a stroke that lacks a frame would be another one. Throws where the fault is the file's (format,
/// version, convention, not JSON before the first stroke), or no stroke is sound and some were left
/// out. O(bytes).
StrokesFile read_strokes(std::string_view bytes, std::string_view name);

/// Writes a `mimicry-strokes` file piece by piece into `sink`, in the convention asked for. The
/// text is whole after `finish`. Numbers read back to the same bits.
class StrokeWriter {
 public:
  using Sink = std::function<void(std::string_view)>;
  explicit StrokeWriter(Sink sink, const CoordinateConvention& convention = conventions().front());
  /// Throws where the stroke is not usable; nothing of it is written then.
  void write(const Stroke& stroke);
  void finish();

 private:
  Sink sink_;
  const CoordinateConvention* convention_;
  bool first_ = true;
};

std::string write_strokes(std::span<const Stroke> strokes,
                          const CoordinateConvention& convention = conventions().front());

struct PointRows {
  std::vector<Vec3> points;
  std::vector<std::size_t> lines;  ///< of the file, from 1, of each point
};

/// The points of a CSV text: a heading that names the columns x, y and z, in any order
/// and among others, which are passed over; then a row a point. `nan` and `inf` are numbers. `name`
/// stands in the error messages. Throws Error(invalid_input) where the text is no CSV, a column
/// is missing or, with the line, a cell is not a number. O(size).
PointRows read_points_csv(std::string_view bytes, std::string_view name);

/// `face,b0,b1,b2,x,y,z,label` and a row for each point, in order. Labels: smooth, outside-shell,
/// no-phong-solution, replaced (`ScpLabel`), and not-finite for a point that has none:
/// its face is -1 and its numbers are nan.
std::string write_smooth_points_csv(std::span<const std::optional<SmoothPoint>> points);

}  // namespace mimicry
