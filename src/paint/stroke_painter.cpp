#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/paint/brush.h>

#include "base/float_traps.h"
#include "geodesic/site.h"
#include "paint/footprint.h"
#include "paint/near_map.h"
#include "paint/surface_path.h"

namespace mimicry {
namespace {

// Pieces longer than this many radii are cut: distances in a map are good near its centre.
constexpr double kLongestPiece = 1.0;
// How far a map's centre is moved into its face, as a part of the way to the middle and at most of
// the brush's radius: at corners and on edges there are no directions of the other faces there.
constexpr double kInward = 0.02;
constexpr double kInwardOfRadius = 0.05;
// Two pieces of a ribbon have maps of their own, in which their joint does not lie quite the same.
// A piece goes on under the last one by this part of the distance from the curve, and a texel.
constexpr double kJoint = 0.1;
// Of the nearness of what lies under.
constexpr double kUnder = 1e-3;

}  // namespace

struct StrokePainter::State {
  explicit State(const PaintAtlas& a) : atlas(a), map(a) {
    const FloatTrapMask mask;  // of coordinates whose squares are no numbers
    const TriangleMesh& mesh = a.surface().mesh();
    double area = 0.0, longest = 0.0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      area += 0.5 * mesh.area_vector(f).norm();
      for (int k = 0; k < 3; ++k) {
        const double edge = (mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k)).norm();
        all_edges += edge;
        longest = std::max(longest, edge);
      }
    }
    if (!std::isfinite(all_edges)) all_edges = longest = 1e100;
    // Of needles, which have hardly an area, no more texels than fit along them.
    mean_texel = std::max(std::sqrt(area / double(std::max<std::size_t>(a.used_texels(), 1))),
                          longest / kMostTextureSize);
  }

  const PaintAtlas& atlas;
  NearMap map;
  SurfacePath path;
  std::vector<Dab> dabs;
  std::vector<Falloff> falloffs;  // of the dabs on one face
  std::vector<double> dab_lengths;
  PaintLayers* layers = nullptr;
  Brush brush;
  Stamp stamp;
  Ribbon ribbon;
  const StampImage* image = nullptr;
  enum class Kind { round, stamp, ribbon } kind = Kind::round;
  Random random{1};
  bool has_point = false;
  bool has_piece = false;  // since the last part started
  double travelled = 0.0;  // length of the part so far
  SurfacePoint behind;     // of a ribbon: a point of the last piece near its end
  SurfacePoint last;
  double last_pressure = 1.0;
  double to_next_dab = 0.0;  // along the curve
  double all_edges = 0.0;    // the sum of their lengths: no way on the surface is longer
  double mean_texel = 0.0;   // its length; what is much narrower need not be cut or placed finer

  double radius_at(double pressure) const {
    return brush.radius * (1.0 - brush.pressure_size * (1.0 - pressure));
  }
  double flow_at(double pressure) const {
    return brush.flow * (1.0 - brush.pressure_flow * (1.0 - pressure));
  }
  double step_at(double pressure) const {
    if (kind == Kind::stamp) return std::max(stamp.spacing * stamp.size, 0.1 * mean_texel);
    // Pressure may leave nothing of the brush; dabs then stay countable.
    const double radius = std::max(radius_at(pressure), 0.01 * brush.radius);
    return std::max(2.0 * brush.spacing * radius, 0.1 * mean_texel);
  }

  void check(const SurfacePoint& point, double pressure) const;
  void set_centre(const SurfacePoint& point, double reach);
  void paint_piece(double begin, double end, double pressure_begin, double pressure_end);
  void paint_dabs(const Vec2& from, const Vec2& to, double begin, double end, double pressure_begin,
                  double pressure_end);
  void paint_capsule(const Capsule& capsule);
  void paint_point(const SurfacePoint& point, double pressure);
  void open(PaintLayers& to, Kind what, double radius);
  void place_dabs(double begin, double end, double pressure_begin, double pressure_end);
  void paint_stamp(const SurfacePoint& point, double along_path);
  void paint_ribbon(double begin, double end);
  void finish_part();
};

void StrokePainter::State::check(const SurfacePoint& point, double pressure) const {
  if (!layers) throw Error(ErrorKind::invalid_input, "brush: no stroke is open; begin one first");
  check_surface_point(atlas.surface().mesh(), point, "point of the stroke");
  if (std::isnan(pressure) || pressure < 0.0 || pressure > 1.0)
    throw Error(ErrorKind::invalid_input, "brush: a pressure is not between 0 and 1; give 0 to 1");
}

void StrokePainter::State::set_centre(const SurfacePoint& point, double reach) {
  const Vec3 middle = Vec3::Constant(1.0 / 3.0);
  const TriangleMesh& mesh = atlas.surface().mesh();
  const double way =
      (mesh.position(SurfacePoint{point.face, middle}) - mesh.position(point)).norm();
  const double most = kInwardOfRadius * brush.radius;
  const double inward = kInward * way <= most ? kInward : most / way;
  map.compute({point.face, point.bary + inward * (middle - point.bary)}, reach + inward * way);
}

// Dabs whose lengths are in `dab_lengths`, between the piece's ends.
void StrokePainter::State::paint_dabs(const Vec2& from, const Vec2& to, double begin, double end,
                                      double pressure_begin, double pressure_end) {
  dabs.clear();
  double largest = 0.0;
  for (const double s : dab_lengths) {
    const double t = end > begin ? (s - begin) / (end - begin) : 0.0;
    const double pressure = pressure_begin + t * (pressure_end - pressure_begin);
    const double alpha = dab_alpha(flow_at(pressure), brush.spacing);
    const double radius = radius_at(pressure);
    if (!(alpha > 0.0 && radius > 0.0)) continue;
    dabs.push_back({from + t * (to - from), radius, static_cast<float>(alpha)});
    largest = std::max(largest, radius);
  }
  if (dabs.empty()) return;
  const Vec2 middle = 0.5 * (dabs.front().place + dabs.back().place);
  const double half = (dabs.front().place - middle).norm();
  for (const Index f : map.faces()) {
    const double texel = atlas.texel_length(f);
    const TexelPlaces places(atlas.frame(f), map.corners(f));
    falloffs.clear();
    for (const Dab& dab : dabs) falloffs.emplace_back(dab.radius, brush.hardness, texel);
    for_each_texel_within(
        atlas, f, places, middle, half + largest + 0.5 * texel,
        [&](int x, int y, const Vec2& place) {
          float rest = 1.0f;
          for (std::size_t i = 0; i < dabs.size(); ++i) {
            const double square = (place - dabs[i].place).squaredNorm();
            if (square < falloffs[i].high_square)
              rest *= 1.0f - dabs[i].alpha * static_cast<float>(falloffs[i].at_square(square));
          }
          if (rest < 1.0f) layers->cover(x, y, 1.0f - rest);
        });
  }
}

void StrokePainter::State::paint_capsule(const Capsule& c) {
  const Vec2 middle = 0.5 * (c.from + c.to);
  const Vec2 along = c.to - c.from;
  const double square = along.squaredNorm();
  const double per_square = square > 0.0 ? 1.0 / square : 0.0;
  const double widest = std::max(c.from_radius, c.to_radius);
  const bool is_even = c.from_radius == c.to_radius;
  if (!(widest > 0.0)) return;
  for (const Index f : map.faces()) {
    const double texel = atlas.texel_length(f);
    const TexelPlaces places(atlas.frame(f), map.corners(f));
    const Falloff widest_falloff(widest, brush.hardness, texel);
    for_each_texel_within(atlas, f, places, middle, 0.5 * std::sqrt(square) + widest + 0.5 * texel,
                          [&](int x, int y, const Vec2& place) {
                            const Vec2 way = place - c.from;
                            const double t = std::clamp(way.dot(along) * per_square, 0.0, 1.0);
                            const double d = (way - t * along).squaredNorm();
                            if (d >= widest_falloff.high_square) return;
                            const Falloff falloff =
                                is_even ? widest_falloff
                                        : Falloff(c.from_radius + t * (c.to_radius - c.from_radius),
                                                  brush.hardness, texel);
                            const double k = falloff.at_square(d);
                            const double flow = c.from_flow + t * (c.to_flow - c.from_flow);
                            if (k > 0.0) layers->cover_at_least(x, y, static_cast<float>(flow * k));
                          });
  }
}

void StrokePainter::State::paint_point(const SurfacePoint& point, double pressure) {
  if (repeats_corner(atlas.surface().mesh().face(point.face))) return;
  set_centre(point, radius_at(pressure));
  Vec2 place = Vec2::Zero();
  map.place(point, place);
  if (brush.blend == BrushBlend::max) {
    const double radius = radius_at(pressure), flow = flow_at(pressure);
    return paint_capsule({place, place, radius, radius, flow, flow});
  }
  dab_lengths.assign(1, 0.0);
  paint_dabs(place, place, 0.0, 0.0, pressure, pressure);
}

// Where dabs lie between two lengths of `path`.
void StrokePainter::State::place_dabs(double begin, double end, double pressure_begin,
                                      double pressure_end) {
  dab_lengths.clear();
  double s = begin + to_next_dab;
  while (s <= end) {
    dab_lengths.push_back(s);
    s += step_at(pressure_begin + (s - begin) / (end - begin) * (pressure_end - pressure_begin));
  }
  to_next_dab = s - end;
}

// along_path: the point's length on `path`; negative where there is none yet.
void StrokePainter::State::paint_stamp(const SurfacePoint& point, double along_path) {
  const double size = stamp.size * (1.0 + stamp.size_jitter * (2.0 * random.uniform() - 1.0));
  const double turn =
      stamp.rotation_rad + stamp.rotation_jitter_rad * (2.0 * random.uniform() - 1.0);
  const double longer = std::max(image->width(), image->height());
  const Vec2 extent(size * image->width() / longer, size * image->height() / longer);
  const double reach = 0.5 * extent.norm();
  set_centre(point, reach);
  Vec2 middle = Vec2::Zero(), from = Vec2::Zero(), to = Vec2::Zero();
  map.place(point, middle);
  Vec2 right = Vec2::Zero();
  if (stamp.follow && along_path >= 0.0) {
    // Over a little of the way to both sides: the faces' own directions differ.
    const double aside = 0.25 * size;
    if (map.place(path.point_at(std::max(along_path - aside, 0.0)), from) &&
        map.place(path.point_at(std::min(along_path + aside, path.length())), to))
      right = to - from;
  } else {
    const Vec2 up = map.in_plane(stamp.up);
    right = Vec2(up.y(), -up.x());
  }
  if (right.squaredNorm() > 0.0)
    right.normalize();
  else
    right = Vec2::UnitX();
  right = Vec2(std::cos(turn) * right.x() - std::sin(turn) * right.y(),
               std::sin(turn) * right.x() + std::cos(turn) * right.y());
  const Vec2 up(-right.y(), right.x());
  for (const Index f : map.faces()) {
    const double texel = atlas.texel_length(f);
    const double footprint = texel / size * longer;
    const TexelPlaces places(atlas.frame(f), map.corners(f));
    for_each_texel_within(
        atlas, f, places, middle, reach + texel, [&](int x, int y, const Vec2& place) {
          const Vec2 from_middle = place - middle;
          const auto color = image->sample(0.5 + from_middle.dot(right) / extent.x(),
                                           0.5 - from_middle.dot(up) / extent.y(), footprint);
          if (color[3] > 0.0f) layers->lay_over(x, y, color);
        });
  }
}

// The image along the part of `path` between two lengths: u by the nearest point of the curve, v by
// the distance from it. At a bend the outer side is a fan around its point.
void StrokePainter::State::paint_ribbon(double begin, double end) {
  const double half = 0.5 * ribbon.width;
  const double middle_length = 0.5 * (begin + end);
  set_centre(path.point_at(middle_length), half + 0.5 * (end - begin));
  Vec2 from = Vec2::Zero(), to = Vec2::Zero(), back = Vec2::Zero();
  map.place(path.point_at(begin), from);
  map.place(path.point_at(end), to);
  const Vec2 along = to - from;
  const double square = along.squaredNorm();
  // A place of the last piece gives the side of the joint that it has covered.
  const bool joins = has_piece && map.place(behind, back);
  const double last_length = (from - back).norm();
  const Vec2 last_way = last_length > 0.0 ? Vec2((from - back) / last_length) : Vec2(Vec2::Zero());
  const double period = ribbon.width * image->width() / image->height();
  if (square > 0.0) {
    const Vec2 left = Vec2(-along.y(), along.x()) / std::sqrt(square);
    const Vec2 middle = 0.5 * (from + to);
    for (const Index f : map.faces()) {
      const double texel = atlas.texel_length(f);
      const TexelPlaces places(atlas.frame(f), map.corners(f));
      for_each_texel_within(
          atlas, f, places, middle, 0.5 * std::sqrt(square) + half + 0.5 * texel,
          [&](int x, int y, const Vec2& place) {
            const Vec2 way = place - from;
            double t = way.dot(along) / square;
            if (t > 1.0 || (t < 0.0 && !joins)) return;
            const double into_last = t < 0.0 ? -way.dot(last_way) : 0.0;
            t = std::max(t, 0.0);
            const double distance = (way - t * along).norm();
            if (distance >= half + 0.5 * texel) return;
            if (into_last > std::min(last_length, kJoint * distance + texel)) return;
            const double side = way.dot(left) < 0.0 ? -distance : distance;
            const auto color =
                image->sample((travelled + t * (end - begin)) / period, 0.5 - side / ribbon.width,
                              texel / ribbon.width * image->height(), true);
            const double nearness = 1.0 - distance / (half + texel);
            layers->lay_nearest(x, y, color,
                                static_cast<float>(into_last > 0.0 ? kUnder * nearness : nearness));
          });
    }
  }
  has_piece = true;
  travelled += end - begin;
  behind = path.point_at(std::max(begin, end - 0.25 * ribbon.width));
}

// A stamp that waited for the curve's way.
void StrokePainter::State::finish_part() {
  if (kind == Kind::stamp && has_point && !has_piece) paint_stamp(last, -1.0);
  has_point = false;
}

// The part of `path` between two lengths.
void StrokePainter::State::paint_piece(double begin, double end, double pressure_begin,
                                       double pressure_end) {
  if (kind == Kind::ribbon) return paint_ribbon(begin, end);
  if (kind == Kind::stamp || brush.blend == BrushBlend::build) {
    place_dabs(begin, end, pressure_begin, pressure_end);
    if (dab_lengths.empty()) return;
  }
  if (kind == Kind::stamp) {
    for (const double s : dab_lengths) paint_stamp(path.point_at(s), s);
    return;
  }
  const double half = 0.5 * (end - begin);
  set_centre(path.point_at(begin + half),
             std::max(radius_at(pressure_begin), radius_at(pressure_end)) + half);
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  map.place(path.point_at(begin), from);
  map.place(path.point_at(end), to);
  if (brush.blend == BrushBlend::build)
    paint_dabs(from, to, begin, end, pressure_begin, pressure_end);
  else
    paint_capsule({from, to, radius_at(pressure_begin), radius_at(pressure_end),
                   flow_at(pressure_begin), flow_at(pressure_end)});
}

StrokePainter::StrokePainter(const PaintAtlas& atlas) : state_(std::make_unique<State>(atlas)) {}
StrokePainter::~StrokePainter() = default;
StrokePainter::StrokePainter(StrokePainter&&) noexcept = default;
StrokePainter& StrokePainter::operator=(StrokePainter&&) noexcept = default;

void StrokePainter::State::open(PaintLayers& to, Kind what, double radius) {
  layers = &to;
  kind = what;
  // A larger one covers no more; infinity is no number to reckon with.
  brush.radius = std::min(radius, 100.0 * all_edges);
  has_point = has_piece = false;
}

namespace {

void require_size(const PaintLayers& layers, const PaintAtlas& atlas) {
  if (layers.size() != atlas.size())
    throw Error(ErrorKind::invalid_input, "brush: the layers are " + std::to_string(layers.size()) +
                                              " texels wide and the atlas " +
                                              std::to_string(atlas.size()) +
                                              "; make both of one size");
}

}  // namespace

void StrokePainter::begin(PaintLayers& layers, int layer, const Brush& brush) {
  require_valid(brush);
  require_size(layers, state_->atlas);
  layers.begin_stroke(layer, {brush.color, brush.opacity, brush.erase});
  state_->brush = brush;
  state_->open(layers, State::Kind::round, brush.radius);
}

void StrokePainter::begin(PaintLayers& layers, int layer, const Stamp& stamp,
                          const StampImage& image) {
  require_valid(stamp);
  require_size(layers, state_->atlas);
  layers.begin_stroke(layer, {{}, stamp.opacity, false});
  state_->brush = {};
  state_->stamp = stamp;
  state_->image = &image;
  state_->random = Random(stamp.seed);
  state_->open(layers, State::Kind::stamp, stamp.size);
}

void StrokePainter::begin(PaintLayers& layers, int layer, const Ribbon& ribbon,
                          const StampImage& image) {
  require_valid(ribbon);
  require_size(layers, state_->atlas);
  layers.begin_stroke(layer, {{}, ribbon.opacity, false});
  state_->brush = {};
  state_->ribbon = ribbon;
  state_->image = &image;
  state_->open(layers, State::Kind::ribbon, 0.5 * ribbon.width);
}

void StrokePainter::move_to(const SurfacePoint& point, double pressure) {
  State& s = *state_;
  s.check(point, pressure);
  s.finish_part();
  s.last = normalised(point);
  s.last_pressure = pressure;
  s.has_point = true;
  s.has_piece = false;
  s.travelled = 0.0;
  s.to_next_dab = s.kind == State::Kind::stamp ? 0.0 : s.step_at(pressure);
  if (s.kind == State::Kind::round) s.paint_point(s.last, pressure);
}

void StrokePainter::line_to(std::span<const Crossing> crossings, const SurfacePoint& point,
                            double pressure) {
  State& s = *state_;
  s.check(point, pressure);
  if (!s.has_point) return move_to(point, pressure);
  const SurfacePoint to = normalised(point);
  s.path.set(s.atlas.surface(), s.last, crossings, to);
  const double length = s.path.length();
  const double from_pressure = s.last_pressure;
  if (length > 0.0) {
    const double smallest = std::max({std::min(s.radius_at(from_pressure), s.radius_at(pressure)),
                                      0.1 * s.brush.radius, s.mean_texel});
    const int parts = std::max(1, static_cast<int>(std::ceil(length / (kLongestPiece * smallest))));
    for (int i = 0; i < parts; ++i) {
      const double t0 = double(i) / parts, t1 = double(i + 1) / parts;
      s.paint_piece(t0 * length, t1 * length, from_pressure + t0 * (pressure - from_pressure),
                    from_pressure + t1 * (pressure - from_pressure));
    }
  }
  if (length > 0.0) s.has_piece = true;
  s.last = to;
  s.last_pressure = pressure;
}

void StrokePainter::end() {
  if (!state_->layers) return;
  state_->finish_part();
  state_->layers->end_stroke();
  state_->layers = nullptr;
}

void StrokePainter::cancel() {
  if (!state_->layers) return;
  state_->layers->cancel_stroke();
  state_->layers = nullptr;
}

std::size_t StrokePainter::memory_bytes() const {
  return sizeof(State) + state_->map.memory_bytes();
}

void follow_curve(StrokePainter& painter, const ProjectedCurve& curve,
                  std::span<const double> pressures) {
  if (!pressures.empty() && pressures.size() != curve.points.size())
    throw Error(ErrorKind::invalid_input,
                "brush: " + std::to_string(pressures.size()) + " pressures for " +
                    std::to_string(curve.points.size()) + " points; give one for each");
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const SurfacePoint& p = curve.points[i].surface;
    const double pressure = pressures.empty() ? 1.0 : pressures[i];
    const bool starts = i == 0 || curve.pieces[i - 1].kind == PieceKind::gap ||
                        curve.pieces[i - 1].kind == PieceKind::chord;
    if (starts)
      painter.move_to(p, pressure);
    else
      painter.line_to(curve.piece_crossings(i - 1), p, pressure);
  }
}

void paint_curve(StrokePainter& painter, PaintLayers& layers, int layer, const Brush& brush,
                 const ProjectedCurve& curve, std::span<const double> pressures) {
  painter.begin(layers, layer, brush);
  try {
    follow_curve(painter, curve, pressures);
  } catch (...) {
    painter.cancel();
    throw;
  }
  painter.end();
}

}  // namespace mimicry
