#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/mimicry.h>

namespace mimicry::test {

template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* object) const {
    destroy(object);
  }
};
using Mesh = std::unique_ptr<mimicry_mesh, Destroy<mimicry_mesh_destroy>>;
using Target = std::unique_ptr<mimicry_target, Destroy<mimicry_target_destroy>>;
using Session = std::unique_ptr<mimicry_session, Destroy<mimicry_session_destroy>>;
using Curve = std::unique_ptr<mimicry_curve, Destroy<mimicry_curve_destroy>>;
using Bytes = std::unique_ptr<mimicry_bytes, Destroy<mimicry_bytes_destroy>>;
using Strokes = std::unique_ptr<mimicry_strokes, Destroy<mimicry_strokes_destroy>>;
using List = std::unique_ptr<mimicry_curve_list, Destroy<mimicry_curve_list_destroy>>;
using Tube = std::unique_ptr<mimicry_tube, Destroy<mimicry_tube_destroy>>;

// The object that a call makes; the call must succeed.
template <class Handle, class Function, class... Arguments>
Handle make(Function function, Arguments... arguments) {
  typename Handle::pointer out = nullptr;
  EXPECT_EQ(function(arguments..., &out), MIMICRY_OK) << mimicry_last_error();
  return Handle(out);
}

inline Target target_of(const char* shape, int resolution = 0) {
  const auto mesh = make<Mesh>(mimicry_mesh_shape, shape, resolution);
  return make<Target>(mimicry_target_create, mesh.get(), 0);
}

inline const mimicry_similarity kPlaced{{0, 0, 0, 1}, {0.1, 0.2, -0.3}, 0.5};

inline std::vector<mimicry_frame> wave(int count) {
  std::vector<mimicry_frame> frames(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    mimicry_frame& f = frames[static_cast<std::size_t>(i)];
    f = {};
    f.time_s = i / 90.0;
    f.head_position[2] = 1.0;
    f.head_orientation[3] = f.controller_orientation[3] = 1.0;
    f.controller_position[0] = 0.1 + 0.002 * i - 0.1;
    f.controller_position[1] = 0.2 + 0.05 * std::sin(0.1 * i);
    f.controller_position[2] = 0.3;
    f.trigger = 1.0;
    f.pressure = i % 2 == 0 ? -1.0 : 0.5;
  }
  return frames;
}

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A call that must be refused with a sentence that says why.
inline void expect_invalid(mimicry_status status, const char* why) {
  EXPECT_EQ(status, MIMICRY_INVALID_INPUT) << why;
  EXPECT_THAT(mimicry_last_error(), testing::HasSubstr(why));
}

}  // namespace mimicry::test
