#include <array>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/io/strokes.h>

#include "io/csv.h"
#include "io/text.h"

namespace mimicry {
namespace {

std::string_view trimmed(std::string_view cell) {
  while (!cell.empty() && is_blank(cell.front())) cell.remove_prefix(1);
  while (!cell.empty() && is_blank(cell.back())) cell.remove_suffix(1);
  return cell;
}

const char* label_of(ScpLabel label) {
  switch (label) {
    case ScpLabel::smooth:
      return "smooth";
    case ScpLabel::outside_shell:
      return "outside-shell";
    case ScpLabel::no_phong_solution:
      return "no-phong-solution";
    case ScpLabel::replaced:
      return "replaced";
  }
  return "";
}

}  // namespace

PointRows read_points_csv(std::string_view bytes, std::string_view name) {
  CsvTable table = read_csv(bytes, name);
  for (std::string& column : table.columns) column = std::string(trimmed(column));
  constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  std::array<std::size_t, 3> column = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto found = table.find(kAxes[k]);
    if (!found)
      throw Error(ErrorKind::invalid_input, std::string(name) + ": the heading has no column " +
                                                in_quotes(kAxes[k]) +
                                                "; begin the file with x,y,z");
    column[k] = *found;
  }
  PointRows rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    Vec3 point;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string_view cell = trimmed(table.rows[i][column[k]]);
      const auto value = parse_double(cell);
      if (!value)
        fail_at_line(name, table.lines[i],
                     in_quotes(cell) + " is not a number, for " + std::string(kAxes[k]) +
                         "; correct the row");
      point[static_cast<Eigen::Index>(k)] = *value;
    }
    rows.points.push_back(point);
  }
  rows.lines = std::move(table.lines);
  return rows;
}

std::string write_smooth_points_csv(std::span<const std::optional<SmoothPoint>> points) {
  std::string out = "face,b0,b1,b2,x,y,z,label\n";
  for (const auto& point : points) {
    if (!point) {
      out += "-1,nan,nan,nan,nan,nan,nan,not-finite\n";
      continue;
    }
    out += std::to_string(point->surface.face);
    for (const Vec3* numbers : {&point->surface.bary, &point->position})
      for (const double x : *numbers) {
        out += ',';
        append_double(out, x);
      }
    out += ',';
    out += label_of(point->label);
    out += '\n';
  }
  return out;
}

}  // namespace mimicry
