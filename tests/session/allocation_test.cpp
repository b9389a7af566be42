#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>

#include "support/allocations.h"
#include "support/strokes.h"

namespace mimicry {
namespace {

TEST(StrokeSession, NoFrameAllocates) {
  const Target target(make_sphere(24));
  const Canvas canvas{target};
  const Stroke stroke = test::waving_stroke(600);
  for (const auto& info : techniques()) {
    if (info.needs_bake) continue;  // baked_test.cpp
    StrokeSession session(canvas, info);
    session.begin(stroke.model_to_world);
    const long before = test::allocation_count();
    for (const auto& frame : stroke.frames) session.add(frame);
    EXPECT_EQ(test::allocation_count(), before) << info.name;
    EXPECT_GT(session.curve().points.size(), 100u) << info.name;
  }
}

}  // namespace
}  // namespace mimicry
