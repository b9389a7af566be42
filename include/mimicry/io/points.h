#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/embedding/smooth_projector.h>

namespace mimicry {

struct PointRows {
  std::vector<Vec3> points;
  std::vector<std::size_t> lines;  ///< of the file, from 1, of each point
};

/// The points of a CSV text (`read_csv`): a heading that names the columns x, y and z, in any order
/// and among others, which are passed over; then a row a point. `nan` and `inf` are numbers. `name`
/// stands in the error messages. Throws as `read_csv` does, and Error(invalid_input) where a column
/// is missing or, with the line, a cell is not a number. O(size).
PointRows read_points_csv(std::string_view bytes, std::string_view name);

/// `face,b0,b1,b2,x,y,z,label` and a row for each point, in order. Labels: smooth, outside-shell,
/// no-phong-solution, replaced (`ScpLabel`), and not-finite for a point that has none:
/// its face is -1 and its numbers are nan.
std::string write_smooth_points_csv(std::span<const std::optional<SmoothPoint>> points);

}  // namespace mimicry
