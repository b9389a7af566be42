#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mimicry {

/// The double nearest to a decimal text that is a number from its first to its last character:
/// "-1.5e3", ".5", "1.", "+2", "nan", "-inf", "Infinity", and as programs on Windows write them:
/// "-nan(ind)", "1.#QNAN", "-1.#INF". Nothing where it is not. Too large a number is infinite. The
/// locale plays no part. O(length).
std::optional<double> parse_double(std::string_view text);

/// The whole number that the text holds ("-12", "+3"); nothing where it is not one or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Appends the fewest of 15, 16 or 17 significant digits that read back as the same double,
/// without trailing zeros ("0.1", "-0", "1e-07", "nan", "-inf"). The locale plays no part.
void append_double(std::string& out, double value);
std::string format_double(double value);

}  // namespace mimicry
