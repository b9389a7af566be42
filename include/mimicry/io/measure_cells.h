#pragma once

#include <span>
#include <string>
#include <vector>

#include <mimicry/io/csv.h>
#include <mimicry/study/measures.h>

namespace mimicry::io {

/// The paper's measures and filters as columns of a table (docs/formats.md): D_ep_mm ... tau_s,
/// short, noisy, inverted (1 or 0), mimicry_violation, L_X_m.
std::span<const std::string> measure_columns();
std::vector<Cell> measure_cells(const study::Measures& measures);

/// Ours: K_g_normalised, largest_jump, share_jumping, gaps, frechet_mm, end_lag_mm, length_ratio,
/// boundary_nodes, undefined_nodes.
std::span<const std::string> more_measure_columns();
std::vector<Cell> more_measure_cells(const study::Measures& measures);

}  // namespace mimicry::io
