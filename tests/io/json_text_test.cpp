#include "io/json_text.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace mimicry::io {
namespace {

std::string dumped(const OrderedJson& value) {
  return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

template <class Value>
void expect_as_dumped(const Value& value) {
  const std::string text = JsonText().value(value).text();
  EXPECT_EQ(text, dumped(OrderedJson(value)));
}

// The library that reads the files is the oracle of what is written without it.
TEST(JsonText, NumbersAreWrittenAsTheLibraryDumpsThem) {
  for (const double x : {0.0, -0.0, 1.0, -1.0, 0.1, 1e15, 1e16, 1e21, 1e-5, 123456789.0, 5e-324,
                         2.2250738585072014e-308, std::numeric_limits<double>::max(),
                         std::numeric_limits<double>::infinity(), std::nan("")})
    expect_as_dumped(x);
  std::mt19937_64 random(7);
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t bits = random();
    // Signalling NaN would trap.
    if ((bits >> 52 & 0x7ff) != 0x7ff) expect_as_dumped(std::bit_cast<double>(bits));
  }
  expect_as_dumped(std::numeric_limits<std::int32_t>::min());
  expect_as_dumped(std::numeric_limits<std::int64_t>::min());
  expect_as_dumped(std::numeric_limits<std::uint64_t>::max());
  expect_as_dumped(true);
  expect_as_dumped(false);
}

TEST(JsonText, TextsAreEscapedAndWhatIsNotUtf8IsReplaced) {
  for (const std::string& text :
       {std::string(), std::string("a\"b\\c/\b\f\n\r\t"), std::string("\0\x01\x1f\x7f", 4),
        std::string("\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80"), std::string("\xff\xc3(\xed\xa0\x80")})
    expect_as_dumped(text);
}

TEST(JsonText, SeparatesMembersAndElements) {
  JsonText out;
  out.begin('{').member("a", std::vector<double>{}).key("b").begin('[');
  out.begin('{').end('}').begin('[').end(']').value(1).end(']');
  out.member("c", Vec3(1, 2.5, -3)).member("d", "x").end('}');
  const OrderedJson expected = {{"a", OrderedJson::array()},
                                {"b", {OrderedJson::object(), OrderedJson::array(), 1}},
                                {"c", {1.0, 2.5, -3.0}},
                                {"d", "x"}};
  EXPECT_EQ(out.text(), dumped(expected));
}

}  // namespace
}  // namespace mimicry::io
