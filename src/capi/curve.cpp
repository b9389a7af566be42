#include <cmath>
#include <cstddef>

#include <mimicry/curve/edit.h>

#include "capi/handles.h"
#include "io/tube_mesh.h"

using namespace mimicry;
using namespace mimicry::capi;

struct mimicry_tube {
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<uint32_t> faces;
};

namespace {

mimicry_ink ink_vertex(const Vec3& position, const Vec3& normal, Index frame, bool starts) {
  mimicry_ink v{};
  for (int k = 0; k < 3; ++k) {
    v.position[k] = static_cast<float>(position[k]);
    v.normal[k] = static_cast<float>(normal[k]);
  }
  v.frame = frame;
  v.starts = starts;
  return v;
}

// An edit's result, with the record of what was edited.
template <class Edit>
mimicry_status edited(const mimicry_curve* curve, mimicry_curve** out, Edit&& edit) {
  return made(out, [&] {
    require(curve, "curve");
    CurveRecord record = curve->record;
    record.curve = edit(record.curve, *curve->target);
    if (record.radii.size() != record.curve.points.size()) record.radii.clear();
    return make_curve(curve->target, std::move(record));
  });
}

void append_tube(mimicry_tube& tube, const std::vector<Vec3>& points, const TubeOptions& options) {
  const TubeMesh part = tube_mesh(points, options);
  const auto first = static_cast<uint32_t>(tube.positions.size() / 3);
  for (const Vec3& x : part.mesh.positions())
    for (int k = 0; k < 3; ++k) tube.positions.push_back(static_cast<float>(x[k]));
  for (const Vec3& n : part.normals)
    for (int k = 0; k < 3; ++k) tube.normals.push_back(static_cast<float>(n[k]));
  for (const Face& face : part.mesh.faces())
    for (const Index v : face) tube.faces.push_back(first + static_cast<uint32_t>(v));
}

// The ink between gaps, raised along the surface's normals.
std::vector<std::vector<Vec3>> raised_polylines(const mimicry_curve& curve, double lift) {
  std::vector<std::vector<Vec3>> parts;
  for (const mimicry_ink& v : curve.ink) {
    if (v.starts) parts.emplace_back();
    parts.back().emplace_back(v.position[0] + lift * v.normal[0],
                              v.position[1] + lift * v.normal[1],
                              v.position[2] + lift * v.normal[2]);
  }
  return parts;
}

}  // namespace

namespace mimicry::capi {

void append_ink(std::vector<mimicry_ink>& ink, const ProjectedCurve& curve, std::size_t point,
                const Target& target) {
  const CurvePoint& p = curve.points[point];
  const bool starts = point == 0 || curve.pieces[point - 1].kind == PieceKind::gap;
  if (!starts)
    for (const Crossing& c : curve.piece_crossings(point - 1))
      ink.push_back(
          ink_vertex(position(target.mesh(), c), target.normal(surface_point(c)), p.frame, false));
  ink.push_back(ink_vertex(p.position, p.normal, p.frame, starts));
}

mimicry_curve make_curve(std::shared_ptr<const Target> target, CurveRecord record) {
  mimicry_curve made{std::move(target), std::move(record), {}};
  for (std::size_t i = 0; i < made.record.curve.points.size(); ++i)
    append_ink(made.ink, made.record.curve, i, *made.target);
  return made;
}

}  // namespace mimicry::capi

mimicry_status mimicry_curve_follow(const mimicry_curve* curve, mimicry_curve** out) {
  return edited(curve, out, [](ProjectedCurve moved, const Target& target) {
    follow(moved, target.mesh(), target.vertex_normals());
    return moved;
  });
}

void mimicry_curve_destroy(mimicry_curve* curve) {
  delete curve;
}
size_t mimicry_curve_point_count(const mimicry_curve* curve) {
  return curve ? curve->record.curve.points.size() : 0;
}

mimicry_status mimicry_curve_point_at(const mimicry_curve* curve, size_t number,
                                      mimicry_curve_point* out) {
  return guarded([&] {
    require(curve, "curve");
    require(out, "out");
    const auto& points = curve->record.curve.points;
    if (number >= points.size())
      throw Error(ErrorKind::invalid_input, "point " + std::to_string(number) + " of a curve of " +
                                                std::to_string(points.size()));
    const CurvePoint& p = points[number];
    put(out->position, p.position);
    put(out->normal, p.normal);
    put(out->barycentric, source_point(curve->target->mesh(), p.surface).bary);
    out->time_s = p.time_s;
    out->pen_distance = p.pen_distance;
    out->face = p.surface.face;
    out->frame = p.frame;
  });
}

double mimicry_curve_length(const mimicry_curve* curve) {
  return curve ? length(curve->record.curve) : 0.0;
}
int32_t mimicry_curve_is_closed(const mimicry_curve* curve) {
  return curve && curve->record.curve.closed;
}
const char* mimicry_curve_stroke(const mimicry_curve* curve) {
  return curve ? curve->record.stroke.c_str() : "";
}
const char* mimicry_curve_technique(const mimicry_curve* curve) {
  return curve ? curve->record.technique.c_str() : "";
}
const mimicry_ink* mimicry_curve_ink(const mimicry_curve* curve) {
  return curve ? curve->ink.data() : nullptr;
}
size_t mimicry_curve_ink_count(const mimicry_curve* curve) {
  return curve ? curve->ink.size() : 0;
}

mimicry_status mimicry_curve_with_stroke(const mimicry_curve* curve, const char* id,
                                         mimicry_curve** out) {
  return made(out, [&] {
    require(curve, "curve");
    mimicry_curve copy = *curve;
    copy.record.stroke = text(id, "id");
    return copy;
  });
}

mimicry_status mimicry_curve_with_radii(const mimicry_curve* curve, const double* radii,
                                        mimicry_curve** out) {
  return made(out, [&] {
    require(curve, "curve");
    mimicry_curve copy = *curve;
    copy.record.radii.clear();
    if (radii) copy.record.radii.assign(radii, radii + copy.record.curve.points.size());
    for (std::size_t i = 0; i < copy.record.radii.size(); ++i)
      if (!std::isfinite(radii[i]) || radii[i] <= 0.0)
        throw Error(ErrorKind::invalid_input,
                    "radius " + std::to_string(i) + " is not above 0; give one for each point");
    return copy;
  });
}

mimicry_status mimicry_curve_with_lift(const mimicry_curve* curve, double lift,
                                       mimicry_curve** out) {
  return made(out, [&] {
    require(curve, "curve");
    if (!std::isfinite(lift)) throw Error(ErrorKind::invalid_input, "the lift is not finite");
    mimicry_curve copy = *curve;
    copy.record.lift = lift;
    return copy;
  });
}

mimicry_status mimicry_curve_slice(const mimicry_curve* curve, size_t first, size_t end,
                                   mimicry_curve** out) {
  return made(out, [&] {
    require(curve, "curve");
    CurveRecord record = curve->record;
    record.curve = slice(record.curve, first, end);
    if (!record.radii.empty())
      record.radii = {curve->record.radii.begin() + static_cast<std::ptrdiff_t>(first),
                      curve->record.radii.begin() + static_cast<std::ptrdiff_t>(end)};
    return make_curve(curve->target, std::move(record));
  });
}

mimicry_status mimicry_curve_resample_with_progress(const mimicry_curve* curve, size_t count,
                                                    mimicry_progress progress, void* user,
                                                    mimicry_curve** out) {
  return edited(curve, out, [&](const ProjectedCurve& c, const Target& t) {
    return resampled(c, t.surface(), count, to_callback(progress, user));
  });
}

mimicry_status mimicry_curve_resample(const mimicry_curve* curve, size_t count,
                                      mimicry_curve** out) {
  return mimicry_curve_resample_with_progress(curve, count, nullptr, nullptr, out);
}

mimicry_status mimicry_curve_smooth_with_progress(const mimicry_curve* curve, double strength,
                                                  int32_t iterations, mimicry_progress progress,
                                                  void* user, mimicry_curve** out) {
  return edited(curve, out, [&](const ProjectedCurve& c, const Target& t) {
    return smooth(c, t.surface(), {strength, iterations}, to_callback(progress, user));
  });
}

mimicry_status mimicry_curve_smooth(const mimicry_curve* curve, double strength, int32_t iterations,
                                    mimicry_curve** out) {
  return mimicry_curve_smooth_with_progress(curve, strength, iterations, nullptr, nullptr, out);
}

mimicry_status mimicry_curve_simplify_with_progress(const mimicry_curve* curve, double tolerance,
                                                    mimicry_progress progress, void* user,
                                                    mimicry_curve** out) {
  return edited(curve, out, [&](const ProjectedCurve& c, const Target& t) {
    return simplify(c, t.surface(), tolerance, to_callback(progress, user));
  });
}

mimicry_status mimicry_curve_simplify(const mimicry_curve* curve, double tolerance,
                                      mimicry_curve** out) {
  return mimicry_curve_simplify_with_progress(curve, tolerance, nullptr, nullptr, out);
}

mimicry_status mimicry_curve_close(const mimicry_curve* curve, mimicry_curve** out) {
  return edited(curve, out, [&](ProjectedCurve c, const Target& t) {
    if (!c.closed && !close(c, t.surface()).closed)
      throw Error(ErrorKind::invalid_input,
                  "the curve cannot be closed: it has fewer than two points, or the surface does "
                  "not join its ends");
    return c;
  });
}

mimicry_status mimicry_curve_tube(const mimicry_curve* curve, double radius, int32_t sides,
                                  double lift, mimicry_tube** out) {
  return made(out, [&] {
    require(curve, "curve");
    mimicry_tube tube;
    std::vector<std::vector<double>> radii;
    if (!curve->record.radii.empty()) radii = polyline_radii(curve->record, curve->target->mesh());
    const auto parts = raised_polylines(*curve, lift);
    for (std::size_t part = 0; part < parts.size(); ++part) {
      // A closed curve's last point is its first again.
      TubeOptions options{radius, sides, curve->record.curve.closed && parts.size() == 1};
      std::vector<Vec3> points = parts[part];
      if (!radii.empty()) options.radii = radii[part];
      if (options.closed && points.size() > 1) {
        points.pop_back();
        if (!radii.empty()) options.radii = options.radii.first(points.size());
      }
      append_tube(tube, points, options);
    }
    return tube;
  });
}

void mimicry_tube_destroy(mimicry_tube* tube) {
  delete tube;
}
size_t mimicry_tube_vertex_count(const mimicry_tube* tube) {
  return tube ? tube->positions.size() / 3 : 0;
}
size_t mimicry_tube_face_count(const mimicry_tube* tube) {
  return tube ? tube->faces.size() / 3 : 0;
}
const float* mimicry_tube_positions(const mimicry_tube* tube) {
  return tube ? tube->positions.data() : nullptr;
}
const float* mimicry_tube_normals(const mimicry_tube* tube) {
  return tube ? tube->normals.data() : nullptr;
}
const uint32_t* mimicry_tube_faces(const mimicry_tube* tube) {
  return tube ? tube->faces.data() : nullptr;
}
