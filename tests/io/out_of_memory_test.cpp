// Readers leave with bad_alloc wherever memory ends, and do not end the program.
#include <functional>
#include <new>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/io/mesh_reader.h>
#include <mimicry/io/strokes.h>
#include <mimicry/io/study_recording.h>
#include <mimicry/io/targets_reader.h>

#include "support/allocations.h"

namespace mimicry::io {
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
}  // namespace mimicry::io
