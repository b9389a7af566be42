#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mimicry {

/// A field of a table: nothing, a whole number, a number (NaN and infinities count as nothing) or
/// text.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

/// One line of CSV with its end: text is quoted where it has to be (RFC 4180), nothing is an empty
/// field, doubles read back to the same bits.
std::string csv_line(std::span<const Cell> cells);
/// The heading of such a file.
std::string csv_heading(std::span<const std::string> columns);
/// The same row as a JSON object on one line with its end; nothing is null. As many cells as
/// columns.
std::string json_line(std::span<const std::string> columns, std::span<const Cell> cells);

/// A table as text: every row has as many fields as there are columns.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> lines;  ///< of the file, from 1, where each row begins

  /// Where the column of this name stands.
  std::optional<std::size_t> find(std::string_view column) const;
};

/// Reads CSV (RFC 4180; lines end in LF or CRLF, empty lines are passed over; the first line names
/// the columns). Throws Error(invalid_input) with name and line where a row has another number of
/// fields, a quote is not closed or is followed by text, two columns have one name, or there is no
/// heading. O(bytes).
CsvTable read_csv(std::string_view bytes, std::string_view name);

}  // namespace mimicry
