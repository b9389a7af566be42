#pragma once

#include <string>
#include <vector>

#include "cli/report/gallery.h"
#include "lab/measured_rows.h"
#include "lab/summary.h"

namespace mimicry::cli {

struct PageOptions {
  std::string title;
  double level = 0.95;  ///< of the intervals
};

/// The report as one HTML page that needs no other file and no network: tables and pictures stand
/// in it, the plots are drawn from `figure_data` by the script that it carries.
std::string write_page(const lab::Summary& summary,
                       const std::vector<lab::RejectedStroke>& rejected, const Gallery& gallery,
                       const GalleryOptions& gallery_options, const std::string& figure_data,
                       const PageOptions& options);

}  // namespace mimicry::cli
