#include "paint/srgb.h"

#include <cmath>

#include <mimicry/mesh/attributes.h>

namespace mimicry {

const SrgbTables& srgb_tables() {
  static const SrgbTables tables = [] {
    SrgbTables t;
    for (std::size_t i = 0; i < t.linear.size(); ++i)
      t.linear[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / 255.0));
    for (std::size_t i = 0; i < t.encoded.size(); ++i)
      t.encoded[i] = static_cast<std::uint8_t>(
          std::round(255.0 * srgb_from_linear(static_cast<double>(i) / 65535.0)));
    return t;
  }();
  return tables;
}

}  // namespace mimicry
