#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>

#include "support/strokes.h"

// Every allocation of this program is counted.
namespace {
std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

namespace mimicry::session {
namespace {

TEST(StrokeSession, NoFrameAllocates) {
  const spatial::Target target(make_sphere(24));
  const technique::Canvas canvas{&target};
  const stroke::Stroke stroke = test::waving_stroke(600);
  for (const auto& info : technique::techniques()) {
    StrokeSession session(canvas, info);
    session.begin(stroke.model_to_world);
    const long before = allocations;
    for (const auto& frame : stroke.frames) session.add(frame);
    EXPECT_EQ(allocations, before) << info.name;
    EXPECT_GT(session.curve().points.size(), 100u) << info.name;
  }
}

}  // namespace
}  // namespace mimicry::session
