#include "cli/report/measure_text.h"

namespace mimicry::cli {

const MeasureText* measure_text(std::string_view column) {
  static constexpr MeasureText kTexts[] = {
      {"D_ep_mm", "D<sub>ep</sub>", "D_ep (mm)", "mm"},
      {"D_sym_mm", "D<sub>sym</sub>", "D_sym (mm)", "mm"},
      {"K_E", "K<sub>E</sub>", "K_E (rad/m)", "rad/m"},
      {"K_g", "K<sub>g</sub>", "K_g (rad/m)", "rad/m"},
      {"F_g", "F<sub>g</sub>", "F_g (rad/m)", "rad/m"},
      {"T_h", "T<sub>h</sub>", "T_h (m/m)", "m/m"},
      {"R_h", "R<sub>h</sub>", "R_h (rad/m)", "rad/m"},
      {"T_c", "T<sub>c</sub>", "T_c (m/m)", "m/m"},
      {"R_c", "R<sub>c</sub>", "R_c (rad/m)", "rad/m"},
      {"tau_s", "τ", "τ (s)", "s"},
  };
  for (const MeasureText& text : kTexts)
    if (text.column == column) return &text;
  return nullptr;
}

}  // namespace mimicry::cli
