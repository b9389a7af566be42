#include "io/csv.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <mimicry/base/error.h>

#include "io/json.h"
#include "io/number.h"
#include "io/text.h"

namespace mimicry {
namespace {

struct CsvField {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const {
    return std::isfinite(value) ? format_double(value) : "";
  }
  std::string operator()(const std::string& value) const { return csv_field(value); }
};

struct JsonField {
  std::string operator()(std::monostate) const { return "null"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const {
    return std::isfinite(value) ? format_double(value) : "null";
  }
  std::string operator()(const std::string& value) const {
    return Json(value).dump(-1, ' ', false, Json::error_handler_t::replace);
  }
};

// Cuts one record off `rest`. False at the end.
bool take_record(std::string_view& rest, std::size_t& line, std::string_view name,
                 std::vector<std::string>& fields) {
  fields.clear();
  if (rest.empty()) return false;
  const std::size_t first_line = line;
  std::string field;
  for (;;) {
    field.clear();
    if (!rest.empty() && rest.front() == '"') {
      rest.remove_prefix(1);
      for (;;) {
        const std::size_t quote = rest.find('"');
        if (quote == std::string_view::npos)
          fail_at_line(name, first_line, "a quoted field is not closed");
        field += rest.substr(0, quote);
        rest.remove_prefix(quote + 1);
        if (rest.empty() || rest.front() != '"') break;
        field += '"';
        rest.remove_prefix(1);
      }
      line += static_cast<std::size_t>(std::count(field.begin(), field.end(), '\n'));
      if (!rest.empty() && rest.find_first_of(",\r\n") != 0)
        fail_at_line(name, line, "there is text behind a quoted field");
    } else {
      const std::size_t end = std::min(rest.find_first_of(",\r\n"), rest.size());
      field = rest.substr(0, end);
      rest.remove_prefix(end);
    }
    fields.push_back(field);
    if (rest.empty()) return true;
    const char next = rest.front();
    rest.remove_prefix(1);
    if (next == ',') continue;
    if (next == '\r' && !rest.empty() && rest.front() == '\n') rest.remove_prefix(1);
    ++line;
    return true;
  }
}

}  // namespace

std::string csv_line(std::span<const Cell> cells) {
  std::string out;
  for (const Cell& cell : cells) out += std::visit(CsvField{}, cell) + ',';
  if (!out.empty()) out.pop_back();
  return out + '\n';
}

std::string csv_heading(std::span<const std::string> columns) {
  std::vector<Cell> cells(columns.begin(), columns.end());
  return csv_line(cells);
}

std::string json_line(std::span<const std::string> columns, std::span<const Cell> cells) {
  std::string out = "{";
  for (std::size_t i = 0; i < columns.size(); ++i)
    out += (i > 0 ? ", " : "") + JsonField{}(columns[i]) + ": " + std::visit(JsonField{}, cells[i]);
  return out + "}\n";
}

std::optional<std::size_t> CsvTable::find(std::string_view column) const {
  const auto at = std::find(columns.begin(), columns.end(), column);
  if (at == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(at - columns.begin());
}

CsvTable read_csv(std::string_view bytes, std::string_view name) {
  bytes = text_of(bytes, name);
  CsvTable table;
  std::size_t line = 1;
  std::vector<std::string> fields;
  for (std::size_t at = line; take_record(bytes, line, name, fields); at = line) {
    if (fields.size() == 1 && fields[0].empty()) continue;
    if (table.columns.empty()) {
      table.columns = std::move(fields);
      std::set<std::string_view> seen;
      for (const std::string& column : table.columns)
        if (!seen.insert(column).second)
          fail_at_line(name, at, "two columns are named " + in_quotes(column));
      continue;
    }
    if (fields.size() != table.columns.size())
      fail_at_line(name, at,
                   "has " + std::to_string(fields.size()) + " fields, the heading has " +
                       std::to_string(table.columns.size()));
    table.rows.push_back(std::move(fields));
    table.lines.push_back(at);
  }
  if (table.columns.empty())
    throw Error(ErrorKind::invalid_input,
                std::string(name) + ": is empty; a table starts with the names of its columns");
  return table;
}

}  // namespace mimicry
