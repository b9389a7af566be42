// Readers and writers leave with bad_alloc wherever memory ends, and do not end the program.
#include <array>
#include <functional>
#include <new>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/io/curves.h>
#include <mimicry/io/meshes.h>
#include <mimicry/io/strokes.h>
#include <mimicry/io/study.h>
#include <mimicry/mesh/shapes.h>

#include "support/allocations.h"

namespace mimicry {
namespace {

// Runs `read` with ever more allocations until it has enough of them.
long allocations_needed(const std::function<void()>& read) {
  for (long count = 0; count < 100000; ++count) {
    bool ended = true;
    {
      const test::AllocationLimit limit(count);
      try {
        read();
      } catch (const std::bad_alloc&) {
        ended = false;
      }
    }
    if (ended) return count;
  }
  return -1;
}

const std::string kNested =
    R"([[1, [2, {"a": [3, "a text that is kept on the heap"]}]], [[], {}]])";

TEST(OutOfMemory, EveryAllocationOfAReaderMayFail) {
  const std::string strokes = R"({"format": "mimicry-strokes", "version": 1, "convention": "openxr",
      "other": )" + kNested + R"(, "strokes": [{"id": "a", "frames": [], "more": )" +
                              kNested + "}]}";
  EXPECT_GT(allocations_needed([&] {
              try {
                read_strokes(strokes, "s.json");
              } catch (const Error&) {
              }
            }),
            10);
  EXPECT_GT(allocations_needed([&] { read_recording("[" + kNested + "]", "r.json"); }), 10);
  const std::string gltf = R"({"asset": {"version": "2.0"}, "extras": )" + kNested + "}";
  EXPECT_GT(allocations_needed([&] {
              try {
                read_mesh(gltf, MeshFormat::gltf, "m.gltf");
              } catch (const Error&) {
              }
            }),
            10);
  EXPECT_GT(allocations_needed([&] {
              try {
                read_targets(R"({"shapes": [)" + kNested + "]}", "t.json");
              } catch (const Error&) {
              }
            }),
            10);
}

TEST(OutOfMemory, EveryAllocationOfAWriterMayFail) {
  const TriangleMesh mesh = make_box(1, 1, 1, Vec3::Ones());
  Stroke stroke;
  stroke.id = "an identifier that is kept on the heap";
  stroke.intended = Intention{"a", false, {{0, Vec3(1, 0, 0)}, {1, Vec3(0, 1, 0)}}};
  stroke.simulated = Simulation{"mimicry", 1, "snap"};
  CurveRecord record;
  record.stroke = stroke.id;
  record.options["a"] = {1.0, 2.0};
  RecordedStroke recorded;
  recorded.pieces.resize(2);
  TargetCurve target;
  for (int i = 0; i < 20; ++i) {
    stroke.frames.emplace_back().time_s = 0.1 * i;
    record.curve.points.push_back({{0, Vec3(1, 0, 0)}, Vec3::Zero(), Vec3::UnitX(), i, 0.1 * i, 0});
    if (i > 0) record.curve.pieces.emplace_back();
    recorded.pieces[0].frames.emplace_back();
    target.points.push_back({0, Vec3(1, 0, 0)});
  }
  const CurveSet curves{"box", {record, record}};
  const TargetSet targets{{{"box", 1.0, {target, target}}}};
  EXPECT_GT(allocations_needed([&] { write_strokes(std::array{stroke, stroke}); }), 10);
  EXPECT_GT(allocations_needed([&] { write_curves_json(curves, mesh); }), 10);
  EXPECT_GT(allocations_needed([&] { write_recording(std::array{recorded, recorded}); }), 10);
  EXPECT_GT(allocations_needed([&] { write_targets(targets, "a note"); }), 10);
}

TEST(OutOfMemory, TextsThatNestWithoutEndAreRefusedByName) {
  const std::string deep = R"({"asset": {"version": "2.0"}, "extras": )" +
                           std::string(100000, '[') + std::string(100000, ']') + "}";
  try {
    read_mesh(deep, MeshFormat::gltf, "m.gltf");
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("m.gltf: holds more than 1000 arrays"));
  }
}

}  // namespace
}  // namespace mimicry
