#pragma once

#include <string>

#include <mimicry/study/comparison.h>

namespace mimicry::cli {

/// About three digits; "-" for what is not a number.
std::string significant(double value);
/// "<.001", ".042"; "-" for what is not a number.
std::string probability(double p);

/// p of the test over participants; "-" where there are not two of them.
std::string participants_probability(const Comparison& c);

}  // namespace mimicry::cli
