#include "lab/columns.h"

namespace mimicry::lab {

std::span<const PaperMeasure> paper_measures() {
  static constexpr PaperMeasure kMeasures[] = {
      {column::kDistance, "D<sub>ep</sub>", "D_ep (mm)", "mm"},
      {"D_sym_mm", "D<sub>sym</sub>", "D_sym (mm)", "mm"},
      {column::kEuclideanCurvature, "K<sub>E</sub>", "K_E (rad/m)", "rad/m"},
      {column::kGeodesicCurvature, "K<sub>g</sub>", "K_g (rad/m)", "rad/m"},
      {column::kFairness, "F<sub>g</sub>", "F_g (rad/m)", "rad/m"},
      {"T_h", "T<sub>h</sub>", "T_h (m/m)", "m/m"},
      {"R_h", "R<sub>h</sub>", "R_h (rad/m)", "rad/m"},
      {"T_c", "T<sub>c</sub>", "T_c (m/m)", "m/m"},
      {"R_c", "R<sub>c</sub>", "R_c (rad/m)", "rad/m"},
      {"tau_s", "τ", "τ (s)", "s"},
  };
  return kMeasures;
}

const PaperMeasure* paper_measure(std::string_view column) {
  for (const PaperMeasure& measure : paper_measures())
    if (measure.column == column) return &measure;
  return nullptr;
}

}  // namespace mimicry::lab
