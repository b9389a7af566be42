#include <cstdint>

#include <mimicry/io/measure_cells.h>

namespace mimicry::io {
namespace {

Cell yes(bool is) {
  return std::int64_t{is};
}
Cell count(std::size_t n) {
  return static_cast<std::int64_t>(n);
}

}  // namespace

std::span<const std::string> measure_columns() {
  static const std::vector<std::string> columns = {
      "D_ep_mm", "D_sym_mm", "K_E",   "K_g",   "F_g",   "T_h",      "R_h",
      "T_c",     "R_c",      "tau_s", "short", "noisy", "inverted", "mimicry_violation",
      "L_X_m"};
  return columns;
}

std::vector<Cell> measure_cells(const study::Measures& m) {
  return {1e3 * m.d_ep_m,
          1e3 * m.d_sym_m,
          m.k_e_rad_per_m,
          m.k_g_rad_per_m,
          m.f_g_rad_per_m,
          m.t_h,
          m.r_h_rad_per_m,
          m.t_c,
          m.r_c_rad_per_m,
          m.tau_s,
          yes(m.filters.too_short),
          yes(m.filters.noisy),
          yes(m.filters.inverted),
          m.mimicry_violation,
          m.l_x_m};
}

std::span<const std::string> more_measure_columns() {
  static const std::vector<std::string> columns = {
      "K_g_normalised", "largest_jump", "share_jumping",  "gaps",           "frechet_mm",
      "end_lag_mm",     "length_ratio", "boundary_nodes", "undefined_nodes"};
  return columns;
}

std::vector<Cell> more_measure_cells(const study::Measures& m) {
  return {m.k_g_normalised_rad_per_m, m.largest_jump,    m.share_jumping, count(m.gaps),
          1e3 * m.frechet_m,          1e3 * m.end_lag_m, m.length_ratio,  count(m.boundary_nodes),
          count(m.undefined_nodes)};
}

}  // namespace mimicry::io
