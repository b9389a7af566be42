#include "cli/comparison_text.h"

#include <cmath>

#include "cli/console.h"

namespace mimicry::cli {
std::string significant(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size == 0) return "0";
  return fixed(value, size >= 100 ? 0 : size >= 10 ? 1 : size >= 0.1 ? 2 : size >= 0.01 ? 3 : 4);
}

std::string probability(double p) {
  if (!std::isfinite(p)) return "-";
  if (p < 0.001) return "<.001";
  const std::string text = fixed(p, 3);
  return text.front() == '0' ? text.substr(1) : text;
}

std::string participants_probability(const Comparison& c) {
  return c.participants > 1 ? probability(c.by_participant.p()) : "-";
}

}  // namespace mimicry::cli
