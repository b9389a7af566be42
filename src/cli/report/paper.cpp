#include "cli/report/paper.h"

namespace mimicry::cli {

const std::array<PaperMeasure, 10>& paper_table() {
  static constexpr std::array<PaperMeasure, 10> kTable = {{
      {"D_ep_mm",
       "D<sub>ep</sub>",
       "D_ep (mm)",
       "mm",
       {2.31, 2.64, 1.13, 1.11, 8.36, "<.001"},
       {2.34, 2.49, 2.24, 23.32, 8.63, "<.001"}},
      {"D_sym_mm",
       "D<sub>sym</sub>",
       "D_sym (mm)",
       "mm",
       {0.64, 0.66, 0.56, 0.44, -0.09, ">.05"},
       {0.75, 0.65, 1.12, 11.51, 0.55, ">.05"}},
      {"K_E",
       "K<sub>E</sub>",
       "K_E (rad/m)",
       "rad/m",
       {280, 262, 174, 162, 15.59, "<.001"},
       {254, 236, 155, 127, 14.70, "<.001"}},
      {"K_g",
       "K<sub>g</sub>",
       "K_g (rad/m)",
       "rad/m",
       {249, 245, 152, 157, 15.42, "<.001"},
       {223, 219, 132, 123, 14.95, "<.001"}},
      {"F_g",
       "F<sub>g</sub>",
       "F_g (rad/m)",
       "rad/m",
       {394, 413, 248, 285, 14.82, "<.001"},
       {348, 371, 215, 227, 14.11, "<.001"}},
      {"T_h",
       "T<sub>h</sub>",
       "T_h (m/m)",
       "m/m",
       {0.81, 0.70, 0.58, 0.40, 7.93, "<.001"},
       {0.72, 0.54, 0.54, 0.35, 6.78, "<.001"}},
      {"R_h",
       "R<sub>h</sub>",
       "R_h (rad/m)",
       "rad/m",
       {1.63, 2.18, 1.18, 1.63, 4.82, "<.001"},
       {1.50, 2.19, 1.32, 1.99, 3.07, ".002"}},
      {"T_c",
       "T<sub>c</sub>",
       "T_c (m/m)",
       "m/m",
       {1.05, 0.36, 1.10, 0.29, -3.36, "<.001"},
       {1.05, 0.37, 1.11, 0.23, -5.94, "<.001"}},
      {"R_c",
       "R<sub>c</sub>",
       "R_c (rad/m)",
       "rad/m",
       {5.12, 5.88, 3.79, 4.84, 5.51, "<.001"},
       {5.23, 6.36, 3.63, 5.13, 4.00, "<.001"}},
      {"tau_s",
       "τ",
       "τ (s)",
       "s",
       {4.69, 1.85, 5.29, 2.17, -7.32, "<.001"},
       {4.33, 1.57, 4.92, 1.89, -7.12, "<.001"}},
  }};
  return kTable;
}

const PaperMeasure* paper_measure(std::string_view column) {
  for (const PaperMeasure& measure : paper_table())
    if (measure.column == column) return &measure;
  return nullptr;
}

}  // namespace mimicry::cli
