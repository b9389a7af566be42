#include "io/stroke_splitter.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/io/strokes.h>

namespace mimicry {
namespace {

std::vector<std::string> parts_of(const std::string& text, std::size_t most = 1 << 20) {
  std::size_t at = 0;
  StrokeSplitter splitter([&](char* buffer, std::size_t size) {
    const std::size_t count = std::min({size, most, text.size() - at});
    std::memcpy(buffer, text.data() + at, count);
    at += count;
    return count;
  });
  std::vector<std::string> parts;
  while (auto part = splitter.next()) parts.push_back(*part);
  return parts;
}

std::string file_of(int count) {
  std::vector<Stroke> strokes;
  for (int i = 0; i < count; ++i) {
    Stroke s;
    s.id = "a \\\" ] } , \"strokes\": [ " + std::to_string(i);
    s.target = "torus";
    s.frames.resize(3);
    strokes.push_back(s);
  }
  return write_strokes(strokes);
}

TEST(StrokeSplitter, PartsReadAsTheWhole) {
  const std::string text = file_of(4);
  const auto whole = read_strokes(text, "s.json").strokes;
  // Every size of block, so that each place falls on a border once.
  for (const std::size_t most : {1u, 7u, 1000000u}) {
    const auto parts = parts_of(text, most);
    ASSERT_EQ(parts.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto read = read_strokes(parts[i], "s.json").strokes;
      ASSERT_EQ(read.size(), 1u);
      EXPECT_EQ(read[0].id, whole[i].id);
      EXPECT_EQ(read[0].frames.size(), 3u);
    }
  }
  EXPECT_TRUE(parts_of(file_of(0)).empty());
}

TEST(StrokeSplitter, WhatIsBrokenIsSaidByTheReader) {
  const std::string text = file_of(3);
  const auto parts = parts_of(text.substr(0, text.size() * 2 / 3));
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NO_THROW(read_strokes(parts[0], "s.json"));
  try {
    read_strokes(
        parts[1], "s.json", [](Stroke&&) {}, 1);
    FAIL() << "it is cut off";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("s.json: stroke 1: "), std::string::npos)
        << error.what();
  }
  for (const char* other : {"", "[1, 2]", "{\"format\": \"mimicry-strokes\"}", "nonsense"}) {
    const auto one = parts_of(other);
    ASSERT_EQ(one.size(), 1u) << other;
    EXPECT_THROW(read_strokes(one[0], "s.json"), Error) << other;
  }
  // The key inside of another value is not the file's.
  EXPECT_EQ(parts_of("{\"a\": {\"strokes\": [1, 2]}, \"strokes\": [3]}").size(), 1u);
}

}  // namespace
}  // namespace mimicry
