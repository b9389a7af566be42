#include <algorithm>
#include <cmath>

#include "geodesic/exact_state.h"

namespace mimicry {

// Ways whose lengths differ relatively by less are one, and the one over a vertex is taken: it
// cannot lead around the vertex without coming nearer.
static constexpr double kSameStep = 1e-13;

Vec2 ExactGeodesics::State::in_frame(Index h, const SurfacePoint& p) const {
  const EdgeFrame& f = frame(h);
  const int k = HalfEdges::corner(h);
  const double head = p.bary[(k + 1) % 3];
  const double apex = p.bary[(k + 2) % 3];
  return {head * f.length + apex * f.apex_x, apex * f.apex_y};
}

// p is in the frame of h.
void ExactGeodesics::State::best_window(Index h, const Vec2& p, Step& best) const {
  if (!half_edges.has_twin(h)) return;
  const EdgeFrame& f = frame(h);
  const double px = f.forward ? p.x() : f.length - p.x();
  for (const Window& w : lists[f.edge]) {
    if (w.forward != f.forward) continue;
    const double straight = w.x + (px - w.x) * (w.y / (w.y + p.y()));
    const double x = std::clamp(straight, w.begin, w.end);
    const double d = lists.distance(w, x) + std::sqrt((px - x) * (px - x) + p.y() * p.y());
    if (d < best.distance) best = {Step::Kind::edge, d, h, f.forward ? x : f.length - x};
  }
}

Step ExactGeodesics::State::best_step(const SurfacePoint& p, Index entered, double below) const {
  Step best;
  const Vec3 position = mesh.position(p);
  for (int k = 0; k < 3; ++k) {
    const Index h = 3 * p.face + k;
    if (h != entered) best_window(h, in_frame(h, p), best);
  }
  for (int k = 0; k < 3; ++k) {
    const Index v = mesh.face(p.face)[static_cast<std::size_t>(k)];
    if (!(at(v) < below)) continue;
    const double d = at(v) + (position - mesh.corner(p.face, k)).norm();
    if (d <= best.distance + kSameStep * d) best = {Step::Kind::vertex, d, v, 0.0};
  }
  auto source = std::lower_bound(face_sources.begin(), face_sources.end(),
                                 std::pair<Index, Index>(p.face, 0));
  for (; source != face_sources.end() && source->first == p.face; ++source) {
    const Source& s = sources[static_cast<std::size_t>(source->second)];
    const double d = s.distance + (position - mesh.position(s.point)).norm();
    if (d <= best.distance + kSameStep * d) best = {Step::Kind::source, d, source->second, 0.0};
  }
  return best;
}

double ExactGeodesics::State::distance_at(const SurfacePoint& p) const {
  const Site site = site_of(mesh, p);
  double d = kInfinity;
  if (site.kind == Site::Kind::vertex) {
    d = at(site.index);
  } else {
    d = best_step(p, kNone, kInfinity).distance;
    if (site.kind == Site::Kind::edge && half_edges.has_twin(site.index)) {
      const Index twin = half_edges.twin(site.index);
      d = std::min(
          d, best_step(surface_point(Crossing{twin, 1.0 - site.t}), twin, kInfinity).distance);
    }
  }
  return d <= known ? d : kInfinity;
}

ExactPath ExactGeodesics::State::path_to(const SurfacePoint& target) const {
  ExactPath path;
  if (!(distance_at(target) < kInfinity)) return path;
  const SurfacePoint start = normalised(target);
  const Vec3 start_position = mesh.position(start);
  Vec3 last = start_position;
  const auto add = [&](const Crossing& c) {
    const Vec3 next = mimicry::position(mesh, c);
    path.length += (next - last).norm();
    last = next;
    path.crossings.push_back(c);
  };

  // One step from a vertex: the recorded edge, or the best window of the faces around.
  const auto from_vertex = [&](Index v) {
    Step best;
    const auto i = static_cast<std::size_t>(v);
    const Index from = arrived_from[i];
    if (from == kIsSource) return Step{Step::Kind::source, at(v), vertex_sources[i], 0.0};
    if (from >= 0) return Step{Step::Kind::vertex, at(v), from, 0.0};
    for (Index k = surface.fan_begin[i]; k < surface.fan_begin[i + 1]; ++k) {
      const Index h = surface.fan[static_cast<std::size_t>(k)];
      const Index opposite = HalfEdges::next(h);
      best_window(opposite, Vec2(frame(opposite).apex_x, frame(opposite).apex_y), best);
      const Index face = HalfEdges::face(h);
      for (const auto& [source_face, number] : face_sources) {
        if (source_face != face) continue;
        const Source& s = sources[static_cast<std::size_t>(number)];
        const double d = s.distance + (mesh.position(v) - mesh.position(s.point)).norm();
        if (d <= best.distance + kSameStep * d) best = {Step::Kind::source, d, number, 0.0};
      }
    }
    return best;
  };

  // Vertices are passed nearer and nearer: those that all but coincide could lead back and forth.
  double below = kInfinity;
  const Site site = site_of(mesh, start);
  Step step;
  if (site.kind == Site::Kind::vertex) {
    below = at(site.index);
    step = from_vertex(site.index);
  } else if (site.kind == Site::Kind::face) {
    step = best_step(start, kNone, kInfinity);
  } else {
    step = best_step(surface_point(Crossing{site.index, site.t}), site.index, kInfinity);
    const Index twin = half_edges.twin(site.index);
    if (twin >= 0) {
      const Step other = best_step(surface_point(Crossing{twin, 1.0 - site.t}), twin, kInfinity);
      if (other.distance < step.distance) step = other;
    }
  }

  // Each step comes nearer; the count ends a walk that rounding lets circle.
  const std::size_t most_steps = static_cast<std::size_t>(half_edges.count()) * 4 + 16;
  for (std::size_t steps = 0; steps < most_steps && step.kind != Step::Kind::none; ++steps) {
    if (step.kind == Step::Kind::source) {
      path.found = true;
      path.source = static_cast<std::size_t>(step.index);
      path.length += (mesh.position(sources[path.source].point) - last).norm();
      break;
    }
    if (step.kind == Step::Kind::edge) {
      const double length = frame(step.index).length;
      const double t = std::clamp(step.x / length, 0.0, 1.0);
      constexpr double kAtEnd = 1e-12;
      const Index end = t <= kAtEnd         ? half_edges.tail(step.index)
                        : t >= 1.0 - kAtEnd ? half_edges.head(step.index)
                                            : kNone;
      if (end == kNone || !(at(end) < below)) {
        const Index twin = half_edges.twin(step.index);
        add({step.index, t});
        step = best_step(surface_point(Crossing{twin, 1.0 - t}), twin, below);
        continue;
      }
      step.index = end;
    }
    const Index v = step.index;
    // Only faces that name a vertex twice use v: no crossing stands for it.
    if (half_edges.outgoing(v) < 0) return {};
    below = at(v);
    step = from_vertex(v);
    if (step.kind != Step::Kind::source)
      add({half_edges.outgoing(v), 0.0});
    else if (site_of(mesh, sources[static_cast<std::size_t>(step.index)].point).kind !=
             Site::Kind::vertex)
      add({half_edges.outgoing(v), 0.0});
  }
  std::reverse(path.crossings.begin(), path.crossings.end());
  return path;
}

ExactGeodesics::ExactGeodesics(const Surface& surface) : state_(std::make_unique<State>(surface)) {}
ExactGeodesics::~ExactGeodesics() = default;
ExactGeodesics::ExactGeodesics(ExactGeodesics&&) noexcept = default;
ExactGeodesics& ExactGeodesics::operator=(ExactGeodesics&&) noexcept = default;

void ExactGeodesics::compute(std::span<const Source> sources, const ExactOptions& options) {
  state_->compute(sources, options);
}
void ExactGeodesics::compute(const SurfacePoint& source, const ExactOptions& options) {
  const Source one{source, 0.0};
  state_->compute({&one, 1}, options);
}
double ExactGeodesics::distance(Index vertex) const {
  const double d = state_->at(vertex);
  return d <= state_->known ? d : kInfinity;
}
double ExactGeodesics::distance(const SurfacePoint& p) const {
  check_surface_point(state_->mesh, p, "target");
  return state_->distance_at(normalised(p));
}
ExactPath ExactGeodesics::path_to(const SurfacePoint& p) const {
  check_surface_point(state_->mesh, p, "target");
  return state_->path_to(normalised(p));
}
bool ExactGeodesics::exact() const {
  return state_->complete;
}
std::size_t ExactGeodesics::windows_made() const {
  return state_->made;
}
std::size_t ExactGeodesics::memory_bytes() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  const State& s = *state_;
  return s.lists.memory_bytes() + bytes(s.heap) + bytes(s.edge_keys) + bytes(s.distances) +
         bytes(s.arrival_angles) + bytes(s.arrived_from) + bytes(s.vertex_sources) +
         bytes(s.is_watched) + bytes(s.surface.frames) + bytes(s.surface.edge_half_edges) +
         bytes(s.surface.start_angles) + bytes(s.surface.corner_angles) +
         bytes(s.surface.total_angles) + bytes(s.surface.fan_begin) + bytes(s.surface.fan) +
         bytes(s.surface.bends);
}

}  // namespace mimicry
