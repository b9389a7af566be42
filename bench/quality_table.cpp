#include "quality_table.h"

#include <cmath>
#include <memory>
#include <utility>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/study/comparison.h>
#include <mimicry/study/measures.h>
#include <mimicry/study/simulate.h>
#include <mimicry/study/targets.h>

#include "io/csv.h"
#include "io/number.h"

namespace mimicry::bench {
namespace {

constexpr int kNumbers = 6;
QualityNumber QualityRow::*const kMembers[kNumbers] = {
    &QualityRow::d_ep_mm, &QualityRow::d_sym_mm,     &QualityRow::k_g,
    &QualityRow::jumps,   &QualityRow::length_ratio, &QualityRow::failed};
const char* const kNames[kNumbers] = {"D_ep_mm", "D_sym_mm",     "K_g",
                                      "jumps",   "length_ratio", "failed"};
// What a number may differ by where the seeds agree: rounding of what is printed and drawn.
constexpr double kLeast[kNumbers] = {0.05, 0.05, 2.0, 0.1, 0.005, 0.5};

struct Prepared {
  const QualityShape* shape;
  std::vector<IntendedCurve> intended;
  Similarity placed;
  Canvas canvas;
};

Prepared prepare(const QualityShape& shape, int threads) {
  Prepared p{&shape, {}, {}, {}};
  const Target target(shape.mesh);
  p.canvas.target = target;
  p.canvas.projector = SmoothProjector(mimicry::bake(target.mesh(), {}, threads), target);
  p.placed.scale = shape.metres_per_unit;
  p.placed.translation = Vec3(0, 1.2, 0) - shape.metres_per_unit * target.bounding_box().center();
  for (const Intention& curve : shape.curves) {
    TargetCurve meant;
    meant.points = curve.points;
    p.intended.push_back(intended_curve(target.mesh(), meant, shape.metres_per_unit));
  }
  return p;
}

SimulationOptions hand_of(const std::string& noise, double rate_hz) {
  SimulationOptions hand;  // "usual"
  hand.rate_hz = rate_hz;
  if (noise == "low") {
    hand.tremor_m = 0.05e-3;
    hand.noise_m = 0.02e-3;
  } else if (noise == "high") {
    hand.tremor_m = 0.3e-3;
    hand.noise_m = 0.3e-3;
  }
  return hand;
}

struct Sum {
  double total[kNumbers] = {};
  int measured = 0, drawn = 0;
};

void add(Sum& sum, const Prepared& p, std::size_t curve, const Stroke& stroke,
         const ProjectedCurve& drawn) {
  ++sum.drawn;
  try {
    const Measures m =
        measure(p.canvas.target.surface(), p.intended[curve], drawn, motion_of(stroke));
    const double numbers[] = {1e3 * m.d_ep_m, 1e3 * m.d_sym_m, m.k_g_rad_per_m,
                              100 * m.share_jumping, m.length_ratio};
    for (int i = 0; i < kNumbers - 1; ++i) sum.total[i] += numbers[i];
    ++sum.measured;
  } catch (const Error&) {
    // counted as failed
  }
}

// One stroke of every technique.
void draw(const Prepared& p, std::size_t curve, const std::string& noise, bool closed,
          double rate_hz, std::uint64_t seed, std::vector<Sum>& sums) {
  const SimulationOptions hand = hand_of(noise, rate_hz);
  const Intention& intended = p.shape->curves[curve];
  Stroke open;
  if (!closed) open = simulate(p.canvas.target, intended, p.placed, hand, seed);
  std::size_t t = 0;
  for (const TechniqueInfo& info : techniques()) {
    StrokeSession session(p.canvas, info);
    session.begin(p.placed);
    if (closed) {
      const Stroke stroke =
          simulate_closed_loop(p.canvas.target, intended, p.placed, hand, seed,
                               [&](const Frame& frame) -> std::optional<Vec3> {
                                 if (session.add(frame) != FrameStatus::inked) return std::nullopt;
                                 return p.placed.point(session.curve().points.back().position);
                               });
      add(sums[t++], p, curve, stroke, session.curve());
    } else {
      for (const Frame& frame : open.frames) session.add(frame);
      add(sums[t++], p, curve, open, session.curve());
    }
  }
}

}  // namespace

std::string QualityRow::key() const {
  return technique + "," + noise + "," + loop + "," + format_double(rate_hz);
}

std::vector<QualityRow> quality_table(const std::vector<QualityShape>& shapes,
                                      const QualityPlan& plan, Executor& executor) {
  std::vector<Prepared> prepared;
  for (const QualityShape& shape : shapes) prepared.push_back(prepare(shape, executor.threads()));

  struct Condition {
    std::string noise;
    bool closed;
    double rate_hz;
  };
  std::vector<Condition> conditions;
  for (const std::string& noise : plan.noises)
    for (const bool closed : plan.closed_loops)
      for (const double rate : plan.rates_hz) conditions.push_back({noise, closed, rate});
  const auto seeds = static_cast<std::size_t>(plan.seeds);
  const std::size_t technique_count = techniques().size();
  // [condition][seed][technique]
  std::vector<std::vector<Sum>> sums(conditions.size() * seeds, std::vector<Sum>(technique_count));
  executor.for_chunks(sums.size(), 1, [&](std::size_t job, std::size_t, int) {
    const Condition& c = conditions[job / seeds];
    const std::uint64_t seed = 1 + job % seeds;
    for (const Prepared& p : prepared)
      for (std::size_t curve = 0; curve < p.shape->curves.size(); ++curve)
        draw(p, curve, c.noise, c.closed, c.rate_hz, 1000 * seed + curve, sums[job]);
  });

  std::vector<QualityRow> rows;
  std::size_t t = 0;
  for (const TechniqueInfo& info : techniques()) {
    for (std::size_t c = 0; c < conditions.size(); ++c) {
      QualityRow row{std::string(info.name),
                     conditions[c].noise,
                     conditions[c].closed ? "closed" : "open",
                     conditions[c].rate_hz,
                     {},
                     {},
                     {},
                     {},
                     {},
                     {}};
      for (int k = 0; k < kNumbers; ++k) {
        std::vector<double> of_seeds;
        for (std::size_t s = 0; s < seeds; ++s) {
          const Sum& sum = sums[c * seeds + s][t];
          if (k == kNumbers - 1)
            of_seeds.push_back(100.0 * (sum.drawn - sum.measured) / sum.drawn);
          else if (sum.measured > 0)
            of_seeds.push_back(sum.total[k] / sum.measured);
        }
        (row.*kMembers[k]) = {of_seeds.empty() ? 0 : mean(of_seeds),
                              of_seeds.size() < 2 ? 0 : standard_deviation(of_seeds)};
      }
      rows.push_back(row);
    }
    ++t;
  }
  return rows;
}

std::vector<QualityShape> small_quality_shapes() {
  std::vector<QualityShape> shapes;
  for (const auto& [name, resolution] : {std::pair{"torus", 24}, {"rounded-cube", 8}}) {
    QualityShape shape{
        name, make_shape(name, {.resolution = resolution}), find_shape(name)->metres_per_unit, {}};
    const Target target(shape.mesh);
    shape.curves = intended_curves(name, target);
    shape.curves.resize(2);
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

QualityPlan small_quality_plan() {
  return {{"usual", "high"}, {false, true}, {30, 90, 240}, 3};
}

std::string write_quality(const std::vector<QualityRow>& rows) {
  std::vector<std::string> columns = {"technique", "noise", "loop", "rate_hz"};
  for (const char* name : kNames) {
    columns.emplace_back(name);
    columns.push_back(std::string(name) + "_spread");
  }
  std::string text = csv_heading(columns);
  for (const QualityRow& row : rows) {
    std::vector<Cell> cells = {row.technique, row.noise, row.loop, row.rate_hz};
    for (const auto member : kMembers) {
      // Six digits: the file is for comparing, and stays small.
      for (const double x : {(row.*member).mean, (row.*member).spread})
        cells.emplace_back(std::round(1e6 * x) / 1e6);
    }
    text += csv_line(cells);
  }
  return text;
}

std::vector<QualityRow> read_quality(const std::string& csv) {
  const CsvTable table = read_csv(csv, "quality table");
  std::vector<QualityRow> rows;
  for (const auto& fields : table.rows) {
    const auto number = [&](std::size_t i) { return parse_double(fields.at(i)).value(); };
    QualityRow row{fields.at(0), fields.at(1), fields.at(2), number(3), {}, {}, {}, {}, {}, {}};
    for (std::size_t k = 0; k < kNumbers; ++k)
      (row.*kMembers[k]) = {number(4 + 2 * k), number(5 + 2 * k)};
    rows.push_back(row);
  }
  return rows;
}

std::string worse(const QualityRow& row, const QualityRow& stored) {
  for (int k = 0; k < kNumbers; ++k) {
    const QualityNumber now = row.*kMembers[k], before = stored.*kMembers[k];
    const bool is_ratio = kMembers[k] == &QualityRow::length_ratio;
    const double bad_now = is_ratio ? std::abs(now.mean - 1) : now.mean;
    const double bad_before = is_ratio ? std::abs(before.mean - 1) : before.mean;
    if (bad_now > bad_before + before.spread + kLeast[k])
      return row.key() + ": " + kNames[k] + " is " + format_double(now.mean) + ", stored " +
             format_double(before.mean) + " with a spread of " + format_double(before.spread);
  }
  return {};
}

}  // namespace mimicry::bench
