#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <mimicry/base/error.h>

#include "geodesic/exact_state.h"
#include "geodesic/plane.h"
#include "geodesic/tolerances.h"

namespace mimicry {

// Relative differences of distances below this are rounding.
static constexpr double kSameWindow = 1e-12;
// A source nearer to an edge than this part of the edge's length all but lies on it.
static constexpr double kOnTheEdge = 1e-7;

// As numbers: vectors just written one by one are slow to read as a pair.
static double dot(const Vec2& a, const Vec2& b) {
  return a.x() * b.x() + a.y() * b.y();
}

static Vec2 between(const Vec2& from, const Vec2& to) {
  return {to.x() - from.x(), to.y() - from.y()};
}

static double angle_from_to(const Vec3& a, const Vec3& b) {
  const double cross = a.cross(b).norm();
  const double dot = a.dot(b);
  return cross == 0.0 && dot == 0.0 ? 0.0 : std::atan2(cross, dot);
}

void ExactGeodesics::State::push(double key, Index item) {
  heap.push_back({key, item});
  std::push_heap(heap.begin(), heap.end());
}

bool ExactGeodesics::State::reach_vertex(Index v, double distance, Index from) {
  const auto i = static_cast<std::size_t>(v);
  // Only what rounding cannot explain is nearer, or two vertices could improve each other forever.
  if (!(distance < distances[i] * (1.0 - 1e-14) - 1e-15 * surface.size)) return false;
  distances[i] = distance;
  arrived_from[i] = from;
  watched_changed = watched_changed || is_watched[i];
  if (surface.bends[i] != SurfaceFrames::never || from == kIsSource) push(distance, -1 - v);
  return true;
}

// A window on half-edge h whose source lies on the side of h's face; all in the frame of h.
void ExactGeodesics::State::add_window(Index h, double begin, double end, double x, double y,
                                       Index root) {
  if (!half_edges.has_twin(h)) return;
  const EdgeFrame& f = frame(h);
  begin = std::max(begin, 0.0);
  end = std::min(end, f.length);
  if (!(end - begin > kLeastWidth * f.length)) return;
  y = std::max(y, kLeastHeight * f.length);
  // Xin and Wang's filter: from an end of the edge everything behind the window is nearer.
  const double sigma = lists.sigma(root);
  const auto is_nearer = [&](double around, double place) {
    const double rest = around * (1.0 + kSameWindow) - sigma;
    return rest < 0.0 || rest * rest < (place - x) * (place - x) + y * y;
  };
  if (is_nearer(at(half_edges.tail(h)) + end, end)) return;
  if (is_nearer(at(half_edges.head(h)) + (f.length - begin), begin)) return;
  const Window w =
      f.forward ? Window{begin, end, x, y, root, false, true}
                : Window{f.length - end, f.length - begin, f.length - x, y, root, true, true};
  for (Batch& batch : batches)
    if (batch.edge == f.edge) {
      batch.windows.push(w);
      return;
    }
  strays.emplace_back(f.edge, w);
}

void ExactGeodesics::State::merge(Index edge, std::span<const Window> windows) {
  const double length = frame(surface.edge_half_edges[static_cast<std::size_t>(edge)]).length;
  const WindowLists::Merged merged = lists.merge(edge, length, windows);
  made += merged.pieces;
  double& key = edge_keys[static_cast<std::size_t>(edge)];
  if (merged.nearest < key) {
    key = merged.nearest;
    push(key, edge);
  }
}

void ExactGeodesics::State::merge_strays() {
  for (const auto& [edge, window] : strays) merge(edge, {&window, 1});
  strays.clear();
}

// Sends an edge's waiting windows across the faces that they look into.
void ExactGeodesics::State::send_on(Index edge) {
  const Index forward = surface.edge_half_edges[static_cast<std::size_t>(edge)];
  for (const Index h : {forward, half_edges.twin(forward)}) {
    const bool is_forward = h == forward;
    const auto goes_on = [&](const Window& w) { return w.waits && w.forward == is_forward; };
    const std::span<Window> windows = lists[edge];
    const auto first = std::find_if(windows.begin(), windows.end(), goes_on);
    if (first == windows.end()) continue;
    const Facet behind = facet(h);
    batches[0].edge = frame(behind.left.half_edge).edge;
    batches[1].edge = frame(behind.right.half_edge).edge;
    for (Window& w : windows.subspan(static_cast<std::size_t>(first - windows.begin()))) {
      if (!goes_on(w)) continue;
      w.waits = false;
      const double b0 = is_forward ? w.begin : behind.length - w.end;
      const double b1 = is_forward ? w.end : behind.length - w.begin;
      const double x = is_forward ? w.x : behind.length - w.x;
      spread(behind, {Vec2(x, -w.y), Vec2(b0 - x, w.y), Vec2(b1 - x, w.y), w.root, 0});
    }
    for (Batch& batch : batches) {
      const std::span<Window> made_here = batch.windows.windows();
      if (!made_here.empty()) {
        if (made_here.front().begin > made_here.back().begin)
          std::reverse(made_here.begin(), made_here.end());
        merge(batch.edge, made_here);
        batch.windows.clear();
      }
      batch.edge = kNone;
    }
  }
  merge_strays();
}

ExactGeodesics::State::Facet ExactGeodesics::State::facet(Index entered) const {
  const EdgeFrame& f = frame(entered);
  const Index left = HalfEdges::previous(entered);
  const Index right = HalfEdges::next(entered);
  const EdgeFrame& side = frame(right);
  const Vec2 apex(f.apex_x, f.apex_y);
  const Vec2 head(f.length, 0.0);
  const double left_length = frame(left).length;
  // From the edge's own frame: the difference of apex and head loses a short edge's direction.
  const Vec2 along = f.length > 0.0 ? Vec2(Vec2(-side.apex_x, side.apex_y) / f.length)
                                    : Vec2((apex - head).normalized());
  return {entered,
          f.length,
          apex,
          {left, left_length, apex, left_length > 0.0 ? Vec2(-apex / left_length) : Vec2(0.0, 0.0)},
          {right, side.length, head, along}};
}

void ExactGeodesics::State::spread(const Facet& facet, const Fan& fan) {
  const Index left = facet.left.half_edge;
  const Vec2& s = fan.source;
  const double sigma = lists.sigma(fan.root);
  const Vec2& c = facet.apex;
  const Vec2 to_apex = between(s, c);
  // > 0: the apex lies to the left of the ray.
  const double from_left = cross(fan.left, to_apex);
  const double from_right = cross(fan.right, to_apex);
  const bool reaches_left = from_left < 0.0;
  const bool reaches_right = from_right > 0.0;

  const Index apex = half_edges.tail(left);
  double reached = kInfinity;
  Vec2 seen_from = s;  // the point that the apex is reached from, in a straight line
  if (reaches_left && reaches_right) {
    reached = sigma + to_apex.norm();
  } else {
    // Just outside by rounding: around where the ray comes in, which is never too short.
    const Vec2& ray = reaches_left ? fan.right : fan.left;
    const double off = std::abs(reaches_left ? from_right : from_left);
    if (off <= 1e-6 * dot(ray, to_apex) && ray.y() > 0.0) {
      const double along = -s.y() / ray.y();
      seen_from = Vec2(std::clamp(s.x() + along * ray.x(), 0.0, facet.length), 0.0);
      reached = sigma + (seen_from - s).norm() + (c - seen_from).norm();
    }
  }
  if (reached < kInfinity && reach_vertex(apex, reached, kThroughFaces) &&
      surface.bends[static_cast<std::size_t>(apex)] == SurfaceFrames::outside)
    arrival_angles[static_cast<std::size_t>(apex)] =
        surface.start_angles[static_cast<std::size_t>(left)] +
        std::atan2(std::max(cross(-c, seen_from - c), 0.0), (-c).dot(seen_from - c));

  // Part of a side between the rays that meet it at `begin` and `end`.
  const auto pass_on = [&](const Facet::Side& side, double begin, double end, const Vec2& left_ray,
                           const Vec2& right_ray) {
    const double length = side.length;
    if (!(length > 0.0)) return;
    const Vec2& e = side.along;
    const Vec2 from_tail = between(side.tail, s);
    const double x = dot(e, from_tail);
    const double y = cross(e, from_tail);
    // A source that all but lies on the edge sees a wide fan through a narrow window: its rays go
    // on into the next face.
    if (y < kOnTheEdge * length && end - begin < kOnTheEdge * length && x > 0.0 && x < length) {
      constexpr int kDeepest = 16;
      const Index twin = half_edges.twin(side.half_edge);
      if (twin >= 0 && fan.depth < kDeepest)
        spread(this->facet(twin),
               {Vec2(length - x, -std::max(y, 0.0)), Vec2(-e.dot(left_ray), -cross(e, left_ray)),
                Vec2(-e.dot(right_ray), -cross(e, right_ray)), fan.root, fan.depth + 1});
    }
    add_window(side.half_edge, begin, end, x, y, fan.root);
  };
  if (reaches_left) {
    // Where a ray meets the edge, from 0 at the tail of `entered` to 1 at the apex.
    const auto hit = [&](const Vec2& ray) {
      const double run = cross(c, ray);
      return run > 0.0 ? std::clamp(cross(s, ray) / run, 0.0, 1.0) : 1.0;
    };
    const double length = facet.left.length;
    pass_on(facet.left, reaches_right ? 0.0 : length * (1.0 - hit(fan.right)),
            length * (1.0 - hit(fan.left)), fan.left, reaches_right ? to_apex : fan.right);
  }
  if (reaches_right) {
    const double length = facet.right.length;
    const auto hit = [&](const Vec2& ray) {
      const double run = length * cross(ray, facet.right.along);
      return run > 0.0 ? std::clamp(cross(ray, between(facet.right.tail, s)) / run, 0.0, 1.0) : 1.0;
    };
    pass_on(facet.right, length * hit(fan.right), reaches_left ? length : length * hit(fan.left),
            reaches_left ? to_apex : fan.left, fan.right);
  }
}

// A vertex where paths may bend is a source of its own: it sends windows to where paths that came
// as the shortest one did go on, at least pi away from it on both sides.
void ExactGeodesics::State::leave_vertex(Index v) {
  const auto i = static_cast<std::size_t>(v);
  const double d = distances[i];
  const bool everywhere =
      surface.bends[i] != SurfaceFrames::outside || arrived_from[i] == kIsSource;
  const bool is_boundary = half_edges.is_boundary_vertex(v);
  constexpr double kMargin = 1e-6;
  constexpr double kPi = std::numbers::pi;
  const double total = surface.total_angles[i];
  // Allowed directions, as angles from the start of the fan: interior [low, high], and the same a
  // turn away; boundary: below `below` or above `above`.
  const double arrival = arrival_angles[i];
  const Index root = lists.add_root(d);

  for (Index k = surface.fan_begin[i]; k < surface.fan_begin[i + 1]; ++k) {
    const Index h = surface.fan[static_cast<std::size_t>(k)];
    const Index opposite = HalfEdges::next(h);
    const EdgeFrame& f = frame(opposite);
    const double a0 = surface.start_angles[static_cast<std::size_t>(h)];
    const double a1 = a0 + surface.corner_angles[static_cast<std::size_t>(h)];

    // Neighbours along edges: exact where the edge is the path, an upper bound elsewhere.
    const Index ends[2] = {half_edges.tail(opposite), half_edges.head(opposite)};
    const double lengths[2] = {frame(h).length, frame(HalfEdges::previous(h)).length};
    for (int side = 0; side < 2; ++side) {
      const auto end = static_cast<std::size_t>(ends[side]);
      if (!reach_vertex(ends[side], d + lengths[side], v)) continue;
      if (surface.bends[end] != SurfaceFrames::outside) continue;
      const Index corner = side == 0 ? opposite : HalfEdges::previous(h);
      arrival_angles[end] =
          surface.start_angles[static_cast<std::size_t>(corner)] +
          (side == 0 ? surface.corner_angles[static_cast<std::size_t>(corner)] : 0.0);
    }

    const bool is_on_opposite = f.apex_y < kOnTheEdge * f.length && f.apex_x > 0.0 &&
                                f.apex_x < f.length && half_edges.has_twin(opposite);
    const auto send = [&](double from, double to) {
      from = std::max(from, a0);
      to = std::min(to, a1);
      if (!(to > from)) return;
      // Directions as places on the opposite edge, seen from the apex of its frame.
      const double foot = std::atan2(f.apex_x, f.apex_y);
      if (is_on_opposite) {
        const auto ray = [&](double angle) -> Vec2 {
          const double turn = angle - a0 - foot;
          return {-std::sin(turn), std::cos(turn)};
        };
        spread(facet(half_edges.twin(opposite)),
               {Vec2(f.length - f.apex_x, -f.apex_y), ray(to), ray(from), root, 1});
        add_window(opposite, 0.0, f.length, f.apex_x, f.apex_y, root);
        return;
      }
      const auto place = [&](double angle, double limit) {
        const double turn = angle - a0 - foot;
        return std::abs(turn) < 0.5 * kPi - 1e-9 ? f.apex_x + f.apex_y * std::tan(turn) : limit;
      };
      add_window(opposite, from > a0 ? place(from, 0.0) : 0.0,
                 to < a1 ? place(to, f.length) : f.length, f.apex_x, f.apex_y, root);
    };
    if (everywhere && !is_on_opposite) {
      add_window(opposite, 0.0, f.length, f.apex_x, f.apex_y, root);
    } else if (everywhere) {
      send(a0, a1);
    } else if (is_boundary) {
      send(a0, arrival - kPi + kMargin);
      send(arrival + kPi - kMargin, a1);
    } else {
      const double low = arrival + kPi - kMargin;
      const double high = arrival + total - kPi + kMargin;
      send(low, high);
      send(low - total, high - total);
    }
  }
  merge_strays();
}

void ExactGeodesics::State::start(Index number) {
  const Source& source = sources[static_cast<std::size_t>(number)];
  const Site site = site_of(mesh, source.point);
  if (site.kind == Site::Kind::vertex) {
    if (reach_vertex(site.index, source.distance, kIsSource))
      vertex_sources[static_cast<std::size_t>(site.index)] = number;
    return;
  }
  const Index root = lists.add_root(source.distance);
  const auto leave_into = [&](Index face, Index own_edge) {
    face_sources.emplace_back(face, number);
    for (int k = 0; k < 3; ++k) {
      const Index h = 3 * face + k;
      const Vec3 to_tail = mesh.position(source.point) - mesh.corner(face, k);
      if (reach_vertex(half_edges.tail(h), source.distance + to_tail.norm(), kThroughFaces)) {
        const Vec3 along = mesh.corner(face, (k + 1) % 3) - mesh.corner(face, k);
        arrival_angles[static_cast<std::size_t>(half_edges.tail(h))] =
            surface.start_angles[static_cast<std::size_t>(h)] + angle_from_to(along, to_tail);
      }
      if (h == own_edge || frame(h).length == 0.0) continue;
      const Vec3 along = (mesh.corner(face, (k + 1) % 3) - mesh.corner(face, k)) / frame(h).length;
      add_window(h, 0.0, frame(h).length, to_tail.dot(along), to_tail.cross(along).norm(), root);
    }
  };
  if (site.kind == Site::Kind::face) {
    leave_into(site.index, kNone);
  } else {
    leave_into(HalfEdges::face(site.index), site.index);
    const Index twin = half_edges.twin(site.index);
    if (twin >= 0) leave_into(HalfEdges::face(twin), twin);
  }
}

void ExactGeodesics::State::compute(std::span<const Source> new_sources,
                                    const ExactOptions& options) {
  sources.assign(new_sources.begin(), new_sources.end());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const std::string name = "source " + std::to_string(i);
    check_surface_point(mesh, sources[i].point, name);
    if (!std::isfinite(sources[i].distance) || sources[i].distance < 0.0 ||
        sources[i].distance > 1e70)
      throw Error(ErrorKind::invalid_input, name + ": its distance must be at least 0 and finite");
    sources[i].point = normalised(sources[i].point);
  }
  for (std::size_t i = 0; i < options.targets.size(); ++i)
    check_surface_point(mesh, options.targets[i], "target " + std::to_string(i));
  if (std::isnan(options.radius) || options.radius < 0.0)
    throw Error(ErrorKind::invalid_input,
                "radius " + std::to_string(options.radius) + ": it must be at least 0");

  const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
  lists.reset(surface.edge_half_edges.size());
  heap.clear();
  edge_keys.assign(surface.edge_half_edges.size(), kInfinity);
  face_sources.clear();
  distances.assign(vertices, kInfinity);
  arrival_angles.assign(vertices, 0.0);
  arrived_from.assign(vertices, kNone);
  vertex_sources.assign(vertices, kNone);
  is_watched.assign(vertices, 0);
  for (const SurfacePoint& t : options.targets)
    for (const Index v : mesh.face(t.face)) is_watched[static_cast<std::size_t>(v)] = 1;
  watched_changed = false;
  known = 0.0;
  made = 0;
  complete = true;

  for (std::size_t i = 0; i < sources.size(); ++i) start(static_cast<Index>(i));
  merge_strays();
  std::sort(face_sources.begin(), face_sources.end());

  const std::size_t most = options.most_windows != 0
                               ? options.most_windows
                               : 500 * static_cast<std::size_t>(mesh.face_count()) + 10000;
  // An upper bound of the farthest target's distance; the search ends when it is past.
  double stop = options.radius;
  const auto farthest_target = [&] {
    double farthest = 0.0;
    for (const SurfacePoint& t : options.targets) {
      double nearest = kInfinity;
      const Vec3 p = mesh.position(t);
      for (int k = 0; k < 3; ++k)
        nearest = std::min(nearest, at(mesh.face(t.face)[static_cast<std::size_t>(k)]) +
                                        (p - mesh.corner(t.face, k)).norm());
      farthest = std::max(farthest, nearest);
    }
    return farthest;
  };
  if (!options.targets.empty()) watched_changed = true;

  bool stopped = false;
  std::size_t turns = 0;
  // What a search usually takes; difficult meshes stay at the end for a while.
  const double usual = 20.0 * mesh.face_count();
  while (!heap.empty()) {
    if (options.progress && ++turns % 4096 == 0)
      report(options.progress, "distances", std::min(1.0, static_cast<double>(made) / usual));
    if (watched_changed) {
      stop = std::min(options.radius, farthest_target());
      watched_changed = false;
    }
    const Entry top = heap.front();
    if (top.key > stop) {
      stopped = true;
      break;
    }
    std::pop_heap(heap.begin(), heap.end());
    heap.pop_back();
    known = std::max(known, top.key);
    if (top.item < 0) {
      const Index v = -1 - top.item;
      if (top.key == at(v)) leave_vertex(v);
      continue;
    }
    double& key = edge_keys[static_cast<std::size_t>(top.item)];
    if (top.key != key) continue;
    key = kInfinity;
    if (made > most)
      complete = false;
    else
      send_on(top.item);
  }
  known = stopped ? stop : kInfinity;
}

}  // namespace mimicry
