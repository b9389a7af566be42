// The C interface as a state machine: the bytes choose calls, handles made so far (or NULL) and
// arguments, with numbers that are none and enumerations that have no such value among them. A call
// that fails says so in a sentence and gives nothing; none may say that the library is at fault.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include <mimicry/mimicry.h>

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), end_(data + size) {}
  bool is_empty() const { return data_ == end_; }
  std::uint8_t byte() { return is_empty() ? 0 : *data_++; }
  template <class T, std::size_t N>
  T one_of(const T (&choices)[N]) {
    return choices[byte() % N];
  }
  double number() {
    static constexpr double kOdd[] = {std::numeric_limits<double>::quiet_NaN(),
                                      std::numeric_limits<double>::infinity(),
                                      -std::numeric_limits<double>::infinity(),
                                      1e300,
                                      -1e300,
                                      1e-300,
                                      0.0,
                                      -0.0};
    const std::uint8_t x = byte();
    return x < 8 ? kOdd[x] : (x - 128) / 32.0;
  }

 private:
  const std::uint8_t *data_, *end_;
};

// Handles of one kind; a few, or NULL.
template <class T, void (*destroy)(T*)>
class Pool {
 public:
  ~Pool() {
    for (T* x : slots_) destroy(x);
  }
  T* pick(Input& in) { return slots_[in.byte() % slots_.size()]; }
  void drop(Input& in) {
    T*& slot = slots_[in.byte() % slots_.size()];
    destroy(slot);
    slot = nullptr;
  }
  // Calls make(&out) and keeps what it gives in the place of an older one.
  template <class Make>
  void add(Input& in, Make&& make) {
    T* out = reinterpret_cast<T*>(8);
    const mimicry_status status = make(in.byte() == 0 ? nullptr : &out);
    require(status >= MIMICRY_OK && status < MIMICRY_FAILED);
    if (status != MIMICRY_OK) {
      require(mimicry_last_error()[0] != 0);
      require(out == nullptr || out == reinterpret_cast<T*>(8));  // 8: its place was NULL
      return;
    }
    require(out != nullptr && out != reinterpret_cast<T*>(8));
    T*& slot = slots_[next_++ % slots_.size()];
    destroy(slot);
    slot = out;
  }

 private:
  std::array<T*, 4> slots_{};  // the last is NULL at first, for some time
  std::size_t next_ = 0;
};

void check(mimicry_status status) {
  require(status >= MIMICRY_OK && status < MIMICRY_FAILED);
  if (status != MIMICRY_OK) require(mimicry_last_error()[0] != 0);
}

constexpr const char* kNames[] = {nullptr,
                                  "",
                                  "cube",
                                  "sphere",
                                  "teapot",
                                  "a.obj",
                                  "b.off",
                                  "s.json",
                                  "occlude",
                                  "spraycan",
                                  "head-centric",
                                  "snap",
                                  "mimicry",
                                  "mimicry-live",
                                  "anchored-closest",
                                  "nozzle",
                                  "soft-anchor",
                                  "dipped-pen",
                                  "\xff\xfe"};
constexpr std::size_t kCounts[] = {0, 1, 2, 3, 7, 50};

constexpr char kObj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";

mimicry_frame frame(Input& in, double time) {
  mimicry_frame f{};
  f.time_s = in.byte() == 0 ? in.number() : time;
  for (double& x : f.head_position) x = in.number();
  for (double& x : f.controller_position) x = in.number();
  f.head_orientation[3] = f.controller_orientation[3] = 1.0;
  if (in.byte() % 8 == 0) f.controller_orientation[in.byte() % 4] = in.number();
  f.trigger = 1.0;
  f.pressure = in.byte() % 8 == 0 ? in.number() : -1.0;
  return f;
}

mimicry_similarity placement(Input& in) {
  mimicry_similarity s{{0, 0, 0, 1}, {0, 0, 0}, 1.0};
  switch (in.byte() % 8) {
    case 0:
      s.scale = in.number();
      break;
    case 1:
      s.translation[in.byte() % 3] = in.number();
      break;
    case 2:
      s.rotation[in.byte() % 4] = in.number();
      break;
    default:
      break;
  }
  return s;
}

// All that has been made so far.
struct World {
  Pool<mimicry_mesh, mimicry_mesh_destroy> meshes;
  Pool<mimicry_target, mimicry_target_destroy> targets;
  Pool<mimicry_session, mimicry_session_destroy> sessions;
  Pool<mimicry_curve, mimicry_curve_destroy> curves;
  Pool<mimicry_curve_list, mimicry_curve_list_destroy> lists;
  Pool<mimicry_strokes, mimicry_strokes_destroy> strokes;
  Pool<mimicry_tube, mimicry_tube_destroy> tubes;
  Pool<mimicry_bytes, mimicry_bytes_destroy> bytes;
  double time = 0.0;
};

void make_mesh(World& w, Input& in) {
  switch (in.byte() % 4) {
    case 0: {
      const std::size_t vertices = in.byte() % 8, faces = in.byte() % 8;
      std::vector<double> positions(3 * vertices);
      for (double& x : positions) x = in.number();
      std::vector<std::int32_t> corners(3 * faces);
      for (std::int32_t& v : corners) v = in.byte() % 9 - 1;
      const char* name = in.one_of(kNames);
      w.meshes.add(in, [&](mimicry_mesh** out) {
        return mimicry_mesh_create(positions.data(), vertices, corners.data(), faces, name, out);
      });
      break;
    }
    case 1: {
      const char* name = in.one_of(kNames);
      const std::size_t size = in.byte() % sizeof kObj;
      w.meshes.add(in,
                   [&](mimicry_mesh** out) { return mimicry_mesh_read(kObj, size, name, out); });
      break;
    }
    case 2: {
      const mimicry_bytes* file = w.bytes.pick(in);
      const char* name = in.one_of(kNames);
      w.meshes.add(in, [&](mimicry_mesh** out) {
        return mimicry_mesh_read(mimicry_bytes_data(file), mimicry_bytes_size(file), name, out);
      });
      break;
    }
    default: {
      constexpr std::int32_t kResolutions[] = {3, 4, 5, -1, 1 << 30};
      const char* name = in.one_of(kNames);
      const std::int32_t resolution = in.one_of(kResolutions);
      w.meshes.add(in,
                   [&](mimicry_mesh** out) { return mimicry_mesh_shape(name, resolution, out); });
    }
  }
}

void look(World& w, Input& in) {
  const mimicry_mesh* mesh = w.meshes.pick(in);
  mimicry_mesh_report report;
  check(mimicry_mesh_validate(mesh, in.byte() == 0 ? nullptr : &report));
  (void)mimicry_mesh_vertex_count(mesh);
  (void)mimicry_mesh_metres_per_unit(mesh);
  (void)mimicry_shape(in.byte() - 3);
  (void)mimicry_technique(in.byte() - 3);
  const mimicry_target* target = w.targets.pick(in);
  const double p[3] = {in.number(), in.number(), in.number()};
  const double d[3] = {in.number(), in.number(), in.number()};
  mimicry_surface_point point;
  check(mimicry_target_closest_point(target, p, in.number(), in.byte() - 5,
                                     in.byte() == 0 ? nullptr : &point));
  check(mimicry_target_first_hit(target, p, in.byte() == 0 ? nullptr : d, &point));
  (void)mimicry_target_diagonal(target);
  if (target) require(mimicry_target_notes(target) != nullptr);
  require(mimicry_target_surface_vertex_count(target) == 0 ||
          mimicry_target_surface_sources(target) != nullptr);
  (void)mimicry_target_has_embedding(target);
  const mimicry_curve* curve = w.curves.pick(in);
  mimicry_curve_point curve_point;
  check(mimicry_curve_point_at(curve, in.byte(), &curve_point));
  require(mimicry_curve_ink_count(curve) == 0 || mimicry_curve_ink(curve) != nullptr);
  (void)mimicry_curve_length(curve);
  (void)mimicry_curve_is_closed(curve);
  const mimicry_strokes* strokes = w.strokes.pick(in);
  const std::size_t number = in.byte() % 4;
  (void)mimicry_strokes_id(strokes, number);
  std::vector<mimicry_frame> frames(mimicry_strokes_frame_count(strokes, number));
  check(mimicry_strokes_frames(strokes, number, frames.data()));
  mimicry_similarity placed;
  check(mimicry_strokes_placement(strokes, number, &placed));
}

mimicry_surface_point surface_point(Input& in) {
  mimicry_surface_point p{};
  p.face = in.byte() - 4;
  p.barycentric[0] = in.byte() % 4 == 0 ? in.number() : 0.25;
  p.barycentric[1] = 0.5;
  p.barycentric[2] = 1.0 - p.barycentric[0] - p.barycentric[1];
  return p;
}

// Queries for many points, paths, and vertices that move.
void geometry(World& w, Input& in) {
  mimicry_target* target = w.targets.pick(in);
  mimicry_surface_point points[2] = {surface_point(in), surface_point(in)};
  switch (in.byte() % 6) {
    case 0: {
      double y[6], d[6];
      for (double& x : y) x = in.number();
      for (double& x : d) x = in.number();
      mimicry_answer answers[2];
      check(mimicry_target_closest_points(target, y, 2, in.number(), points));
      check(mimicry_target_first_hits(target, y, d, 2, points));
      check(mimicry_target_smooth_closest_points(target, y, 2, in.byte() % 2, points, answers));
      break;
    }
    case 1: {
      mimicry_geodesics* geodesics = nullptr;
      check(mimicry_geodesics_create(target, points, in.byte() % 3, in.number(), nullptr, nullptr,
                                     &geodesics));
      double distances[2];
      check(mimicry_geodesics_distances(geodesics, points, 2, distances));
      check(mimicry_geodesics_find_path(geodesics, &points[1], distances, nullptr));
      require(mimicry_geodesics_path_count(geodesics) == 0 ||
              mimicry_geodesics_path(geodesics) != nullptr);
      mimicry_geodesics_destroy(geodesics);
      break;
    }
    case 2: {
      mimicry_path_finder* finder = nullptr;
      check(mimicry_path_finder_create(target, &finder));
      double length;
      const double direction[3] = {in.number(), in.number(), in.number()};
      check(mimicry_path_finder_find(finder, &points[0], &points[1], &length, nullptr));
      check(
          mimicry_path_finder_trace(finder, &points[0], direction, in.number(), nullptr, &length));
      mimicry_path_finder_destroy(finder);
      break;
    }
    case 3: {
      mimicry_exponential_map* map = nullptr;
      check(mimicry_exponential_map_create(target, &map));
      check(mimicry_exponential_map_compute(map, &points[0], in.number(), nullptr, nullptr));
      mimicry_exponential_map_destroy(map);
      break;
    }
    case 4: {
      std::vector<double> positions(3 * (in.byte() % 9));
      for (double& x : positions) x = in.number();
      check(mimicry_target_update_positions(target, positions.data(), positions.size() / 3));
      const mimicry_curve* curve = w.curves.pick(in);
      w.curves.add(in, [&](mimicry_curve** out) { return mimicry_curve_follow(curve, out); });
      break;
    }
    default: {
      const mimicry_curve* curve = w.curves.pick(in);
      const mimicry_similarity placed = placement(in);
      mimicry_frame frames[2] = {frame(in, 0.0), frame(in, 0.1)};
      mimicry_measures measures;
      check(mimicry_measure(curve, &placed, frames, 2, points, 2, nullptr, 0, in.byte() % 2,
                            &measures));
      int32_t numbers[2];
      std::size_t found;
      check(mimicry_keypoints(target, points, 2, in.number(), numbers, &found));
      check(mimicry_frames_in(in.byte() % 2 ? "unity" : "unreal", frames, 2, frames));
    }
  }
}

void bake(World& w, Input& in) {
  mimicry_bake_options options = mimicry_default_bake_options();
  options.samples = 10;
  options.offset = 0.4;
  if (in.byte() % 4 == 0) options.dimension = in.byte() - 3;
  if (in.byte() % 4 == 0) options.threads = in.byte() % 8 - 2;
  if (in.byte() % 4 == 0) options.offset = in.number();
  if (!(options.offset >= 0.2)) options.offset = options.offset >= 1e-3 ? 0.2 : options.offset;
  const mimicry_mesh* mesh = w.meshes.pick(in);
  if (mimicry_mesh_face_count(mesh) > 400) return;
  const mimicry_progress stop = [](void*, const char*, double) -> std::int32_t { return 0; };
  const bool stopped = in.byte() % 8 == 0;
  w.bytes.add(in, [&](mimicry_bytes** out) {
    return mimicry_bake(mesh, &options, stopped ? stop : nullptr, nullptr, out);
  });
}

void draw(World& w, Input& in) {
  mimicry_session* session = w.sessions.pick(in);
  switch (in.byte() % 8) {
    case 0: {
      const mimicry_similarity placed = placement(in);
      check(mimicry_session_begin(session, in.byte() == 0 ? nullptr : &placed));
      break;
    }
    case 1:
      check(mimicry_session_end(session));
      break;
    case 2: {
      const double values[3] = {in.number(), in.number(), in.number()};
      check(mimicry_session_set_option(session, in.one_of(kNames), values, in.byte() % 4));
      break;
    }
    case 3:
      check(mimicry_session_set_minimum_motion(session, in.number()));
      check(mimicry_session_set_split_at_misses(session, in.byte() % 3));
      break;
    case 4: {
      const mimicry_similarity placed = placement(in);
      std::vector<mimicry_frame> frames(in.byte() % 8);
      for (mimicry_frame& f : frames) f = frame(in, w.time += 0.01);
      w.curves.add(in, [&](mimicry_curve** out) {
        return mimicry_session_project(session, &placed, frames.data(), frames.size(), out);
      });
      break;
    }
    case 5:
      w.curves.add(in, [&](mimicry_curve** out) { return mimicry_session_curve(session, out); });
      break;
    default: {
      const mimicry_frame f = frame(in, w.time += 0.01);
      mimicry_frame_status status{};
      check(mimicry_session_add(session, in.byte() == 0 ? nullptr : &f, &status));
      const mimicry_ink* ink = mimicry_session_ink(session);
      for (std::size_t i = 0; i < mimicry_session_ink_count(session); ++i)
        for (const float x : ink[i].position) require(std::isfinite(x));
    }
  }
}

void edit(World& w, Input& in) {
  const mimicry_curve* curve = w.curves.pick(in);
  const std::uint8_t what = in.byte() % 7;
  const std::size_t first = in.one_of(kCounts), second = in.one_of(kCounts);
  const double number = in.number();
  const char* name = in.one_of(kNames);
  w.curves.add(in, [&](mimicry_curve** out) {
    switch (what) {
      case 0:
        return mimicry_curve_slice(curve, first, second, out);
      case 1:
        return mimicry_curve_resample(curve, first, out);
      case 2:
        return mimicry_curve_smooth(curve, number, static_cast<std::int32_t>(second) - 2, out);
      case 3:
        return mimicry_curve_simplify(curve, number, out);
      case 4:
        return mimicry_curve_close(curve, out);
      case 5:
        return mimicry_curve_with_stroke(curve, name, out);
      default:
        return mimicry_curve_list_get(w.lists.pick(in), first, out);
    }
  });
  if (what != 0) return;
  constexpr std::int32_t kSides[] = {3, 8, 0, -1, 1024, 5000};
  const std::int32_t sides = in.one_of(kSides);
  const double lift = in.number();
  w.tubes.add(
      in, [&](mimicry_tube** out) { return mimicry_curve_tube(curve, number, sides, lift, out); });
}

void files(World& w, Input& in) {
  const mimicry_target* target = w.targets.pick(in);
  const char* name = in.one_of(kNames);
  const mimicry_bytes* file = w.bytes.pick(in);
  switch (in.byte() % 6) {
    case 0: {
      const mimicry_curve* curves[] = {w.curves.pick(in), w.curves.pick(in)};
      constexpr int kFormats[] = {0, 1, 2, 3, 4, 5, -1, 8, 1 << 30};
      const auto format = static_cast<mimicry_curve_format>(in.one_of(kFormats));
      const double radius = in.number();
      const std::size_t count = in.byte() % 3;
      w.bytes.add(in, [&](mimicry_bytes** out) {
        return mimicry_curves_write(target, name, curves, count, format, nullptr, radius, out);
      });
      break;
    }
    case 1:
      w.lists.add(in, [&](mimicry_curve_list** out) {
        return mimicry_curves_read(target, mimicry_bytes_data(file), mimicry_bytes_size(file), name,
                                   out);
      });
      break;
    case 2:
      w.strokes.add(in, [&](mimicry_strokes** out) { return mimicry_strokes_create(out); });
      break;
    case 3: {
      const mimicry_similarity placed = placement(in);
      std::vector<mimicry_frame> frames(in.byte() % 6);
      for (mimicry_frame& f : frames) f = frame(in, w.time += 0.01);
      mimicry_strokes* strokes = w.strokes.pick(in);
      check(mimicry_strokes_append(strokes, name, in.one_of(kNames), &placed, frames.data(),
                                   frames.size()));
      break;
    }
    case 4: {
      const mimicry_strokes* strokes = w.strokes.pick(in);
      w.bytes.add(in, [&](mimicry_bytes** out) { return mimicry_strokes_write(strokes, out); });
      break;
    }
    default:
      w.strokes.add(in, [&](mimicry_strokes** out) {
        return mimicry_strokes_read(mimicry_bytes_data(file), mimicry_bytes_size(file), name, out);
      });
  }
}

void drop(World& w, Input& in) {
  switch (in.byte() % 8) {
    case 0:
      return w.meshes.drop(in);
    case 1:
      return w.targets.drop(in);
    case 2:
      return w.sessions.drop(in);
    case 3:
      return w.curves.drop(in);
    case 4:
      return w.lists.drop(in);
    case 5:
      return w.strokes.drop(in);
    case 6:
      return w.tubes.drop(in);
    default:
      return w.bytes.drop(in);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input in(data, size);
  World w;
  for (int call = 0; call < 200 && !in.is_empty(); ++call) {
    switch (in.byte() % 16) {
      case 0:
      case 1:
        make_mesh(w, in);
        break;
      case 2:
      case 3: {
        const mimicry_mesh* mesh = w.meshes.pick(in);
        const std::int32_t allow = in.byte() % 3;
        const mimicry_target_options options = {in.byte() % 3, in.byte() % 3};
        w.targets.add(in, [&](mimicry_target** out) {
          return allow == 0 ? mimicry_target_create(mesh, allow, out)
                            : mimicry_target_make(mesh, allow == 1 ? nullptr : &options, out);
        });
        break;
      }
      case 4: {
        const mimicry_target* target = w.targets.pick(in);
        const mimicry_bytes* file = w.bytes.pick(in);
        const char* name = in.one_of(kNames);
        w.targets.add(in, [&](mimicry_target** out) {
          return mimicry_target_with_embedding(target, mimicry_bytes_data(file),
                                               mimicry_bytes_size(file), name, out);
        });
        break;
      }
      case 5: {
        const mimicry_target* target = w.targets.pick(in);
        const char* name = in.one_of(kNames);
        w.sessions.add(
            in, [&](mimicry_session** out) { return mimicry_session_create(target, name, out); });
        break;
      }
      case 6:
        bake(w, in);
        break;
      case 7:
        look(w, in);
        break;
      case 8:
      case 9:
        files(w, in);
        break;
      case 10:
      case 11:
        edit(w, in);
        break;
      case 12:
        drop(w, in);
        break;
      case 13:
        geometry(w, in);
        break;
      default:
        draw(w, in);
    }
  }
  return 0;
}
