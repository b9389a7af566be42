#pragma once

#include <string>
#include <string_view>

#include <mimicry/base/types.h>

namespace mimicry::lab {

/// The study's number of a technique or shape (study/recording.h); kNone where it has none.
Index number_of_method(std::string_view name);
Index number_of_shape(std::string_view name);

/// The shape of a study's number; empty for another.
std::string_view shape_of_number(Index number);

/// The technique or shape of a study's number in a table's cell; other names as they are.
std::string name_of_method(std::string_view cell);
std::string name_of_shape(std::string_view cell);

}  // namespace mimicry::lab
