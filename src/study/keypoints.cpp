#include <algorithm>
#include <cmath>
#include <cstddef>

#include <mimicry/base/error.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/study/targets.h>

#include "curve/curve_builder.h"

namespace mimicry {
namespace {

// A straight curve turns by rounding only; no bend is that small.
constexpr double kLeastTurn_rad = 1e-6;

// A curve's points along its length in metres, and how it bends at each.
struct Profile {
  std::vector<double> places;
  std::vector<double> bending;  // rad per metre, >= 0
  double mean = 0.0;            // of the bending, along the length
};

Profile profile_of(const Surface& surface, std::span<const SurfacePoint> points,
                   double metres_per_unit, double part) {
  CurveBuilder builder(surface);
  for (const SurfacePoint& p : points)
    builder.append({p, surface.position(p), Vec3::Zero(), kNone, 0.0, 0.0});
  const RefinedCurve refined = refine(builder.curve(), surface);
  const CurveCurvature bends = curvature(refined, surface);

  const std::size_t nodes = refined.nodes.size();
  std::vector<double> along(nodes);
  std::vector<double> turned(nodes + 1, 0.0);  // before each node
  for (std::size_t i = 0; i < nodes; ++i) {
    along[i] = metres_per_unit * refined.nodes[i].length;
    turned[i + 1] = turned[i] + bends.deviation[i];
  }
  const double length = along.back();
  const double window = part * length;
  Profile profile;
  for (const std::size_t node : refined.point_nodes) {
    const double s = along[node];
    const double from = std::max(0.0, s - 0.5 * window);
    const double to = std::min(length, s + 0.5 * window);
    const bool is_whole = s >= 0.5 * window && s <= length - 0.5 * window;
    const auto first = std::lower_bound(along.begin(), along.end(), from) - along.begin();
    const auto last = std::upper_bound(along.begin(), along.end(), to) - along.begin();
    const double turn =
        std::abs(turned[static_cast<std::size_t>(last)] - turned[static_cast<std::size_t>(first)]);
    const double width = is_whole ? window : to - from;
    profile.places.push_back(s);
    profile.bending.push_back(width > 0.0 && turn > kLeastTurn_rad ? turn / width : 0.0);
  }
  for (std::size_t i = 1; i < profile.places.size(); ++i)
    profile.mean += 0.5 * (profile.bending[i - 1] + profile.bending[i]) *
                    (profile.places[i] - profile.places[i - 1]);
  if (length > 0.0) profile.mean /= length;
  return profile;
}

// Peaks above the mean, the middle of flat ones, strongest first.
std::vector<std::size_t> peaks_of(const Profile& profile) {
  const std::vector<double>& k = profile.bending;
  std::vector<std::size_t> peaks;
  for (std::size_t i = 1; i + 1 < k.size();) {
    if (!(k[i] > k[i - 1])) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end + 1 < k.size() && k[end + 1] == k[i]) ++end;
    if (end + 1 < k.size() && k[end + 1] < k[i] && k[i] > profile.mean)
      peaks.push_back((i + end) / 2);
    i = end + 1;
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [&](std::size_t a, std::size_t b) { return k[a] > k[b]; });
  return peaks;
}

std::size_t nearest_point(const std::vector<double>& places, double place) {
  const auto after = std::lower_bound(places.begin(), places.end(), place);
  if (after == places.begin()) return 0;
  const auto i = static_cast<std::size_t>(after - places.begin());
  if (i == places.size()) return i - 1;
  return place - places[i - 1] <= places[i] - place ? i - 1 : i;
}

void require_sound(const KeypointOptions& options, double metres_per_unit) {
  const auto refuse = [](const char* what) {
    throw Error(ErrorKind::invalid_input, std::string("keypoints: ") + what);
  };
  if (!(metres_per_unit > 0.0) || !std::isfinite(metres_per_unit))
    refuse("the scale is not a number above 0");
  if (!(options.window > 0.0 && options.window <= 1.0)) refuse("the window is not in (0, 1]");
  if (!(options.least_gap_m >= 0.0) || !(options.least_gap_part >= 0.0))
    refuse("a least gap is below 0");
  if (!(options.longest_gap_m > 0.0)) refuse("the longest gap is not above 0");
}

}  // namespace

std::vector<Index> keypoints(const Surface& surface, std::span<const SurfacePoint> points,
                             double metres_per_unit, const KeypointOptions& options) {
  require_sound(options, metres_per_unit);
  if (points.empty()) return {};
  const Profile profile = profile_of(surface, points, metres_per_unit, options.window);
  const std::vector<double>& s = profile.places;
  const double least = std::max(options.least_gap_m, options.least_gap_part * s.back());

  std::vector<std::size_t> chosen = {0, points.size() - 1};
  for (const std::size_t peak : peaks_of(profile))
    if (std::all_of(chosen.begin(), chosen.end(),
                    [&](std::size_t other) { return std::abs(s[peak] - s[other]) >= least; }))
      chosen.push_back(peak);
  std::sort(chosen.begin(), chosen.end());

  std::vector<Index> result = {0};
  const auto add = [&](std::size_t point) {
    if (static_cast<Index>(point) > result.back()) result.push_back(static_cast<Index>(point));
  };
  for (std::size_t i = 1; i < chosen.size(); ++i) {
    const double from = s[chosen[i - 1]];
    const double gap = s[chosen[i]] - from;
    // The margin keeps a section of just this length whole.
    const double parts = std::ceil(gap / options.longest_gap_m - 1e-9);
    for (double k = 1.0; k < parts && k < static_cast<double>(points.size()); k += 1.0)
      add(std::min(nearest_point(s, from + gap * k / parts), chosen[i]));
    add(chosen[i]);
  }
  return result;
}

}  // namespace mimicry
