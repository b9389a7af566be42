#include "io/number.h"

#include <clocale>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "base/float_traps.h"

namespace mimicry {
namespace {

double from_bits(std::uint64_t bits) {
  double value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

std::uint64_t bits_of(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

TEST(Number, EveryFiniteDoubleReadsBackTheSameBits) {
  std::mt19937_64 random(7);
  for (int n = 0; n < 200'000; ++n) {
    const std::uint64_t bits = random();
    if ((bits >> 52 & 0x7ff) == 0x7ff)
      continue;  // a signalling NaN would trap when it is looked at
    const double value = from_bits(bits);
    const auto back = parse_double(format_double(value));
    ASSERT_TRUE(back) << format_double(value);
    ASSERT_EQ(bits_of(*back), bits_of(value)) << format_double(value);
  }
}

TEST(Number, ShortTextStaysShort) {
  for (const char* text : {"0", "-0", "1", "-1", "0.1", "0.5", "123.456", "1000000", "0.0001",
                           "1e-05", "1.5e-07", "12345678901234568", "1.2345678901234568e+17",
                           "1e+22", "1e+300", "1.7976931348623157e+308", "nan", "inf", "-inf"})
    EXPECT_EQ(format_double(*parse_double(text)), text);
  EXPECT_EQ(format_double(1.0 / 3.0), "0.3333333333333333");
  EXPECT_EQ(format_double(0.1 + 0.2), "0.30000000000000004");
}

// strtod is the independent reader; in the "C" locale it reads the same language.
TEST(Number, ReadsWhatStrtodReads) {
  std::mt19937_64 random(11);
  const auto digits = [&](std::size_t most) {
    std::string out;
    for (std::size_t n = random() % (most + 1); n > 0; --n)
      out += static_cast<char>('0' + random() % 10);
    return out;
  };
  for (int n = 0; n < 100'000; ++n) {
    std::string text = random() % 2 ? "-" : "";
    text += '1';
    text += digits(n % 10 ? 25 : 1000);
    if (random() % 2) text.append(1, '.').append(digits(25));
    if (random() % 2) text.append(random() % 2 ? "e-" : "e").append(digits(2));
    if (text.back() == 'e' || text.back() == '-') text += '0';
    const auto value = parse_double(text);
    ASSERT_TRUE(value) << text;
    const FloatTrapMask mask;  // strtod overflows on purpose
    ASSERT_EQ(bits_of(*value), bits_of(std::strtod(text.c_str(), nullptr))) << text;
  }
}

TEST(Number, TiesBeyondEightHundredDigitsAreDecidedByTheRest) {
  // Half way between 1 and the next double: the even one, 1, unless anything follows.
  std::string half = "1.00000000000000011102230246251565404236316680908203125";
  EXPECT_EQ(*parse_double(half), 1.0);
  half.append(2000, '0');
  EXPECT_EQ(*parse_double(half), 1.0);
  EXPECT_EQ(*parse_double(half + "1"), std::nextafter(1.0, 2.0));
}

TEST(Number, RefusesWhatIsNoNumberFromEndToEnd) {
  for (const char* text :
       {"",   "-",       "+",     ".",   "-.",    "e5",     "1e",   "1e+",   "1x",
        "x1", "1,5",     "0x10",  "1 ",  " 1",    "--1",    "+-1",  "1.2.3", "nanx",
        "in", "infinit", "1e5.0", "1.#", "1.#00", "2.#INF", "1.#x", "nan(",  "1.0#INF"})
    EXPECT_FALSE(parse_double(text)) << text;
  for (const char* text : {"", "-", "+", "1.0", "1e3", "x", "9223372036854775808", "+-1", "1 "})
    EXPECT_FALSE(parse_integer(text)) << text;
}

TEST(Number, ReadsTheOddForms) {
  EXPECT_EQ(*parse_double("1."), 1.0);
  EXPECT_EQ(*parse_double(".5"), 0.5);
  EXPECT_EQ(*parse_double("+2E+1"), 20.0);
  EXPECT_EQ(*parse_double("000000000000000000000000000001"), 1.0);
  EXPECT_EQ(*parse_double("1e999"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(*parse_double("-1e99999999999999999999"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(*parse_double("1e-99999999999999999999"), 0.0);
  EXPECT_EQ(*parse_double("1.8e308"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(*parse_double("4.9e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_TRUE(std::isnan(*parse_double("-NaN")));
  EXPECT_EQ(*parse_double("-Infinity"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::signbit(*parse_double("-0.000")));
  for (const char* nan : {"-nan(ind)", "nan(0x8000)", "1.#QNAN", "-1.#IND00", "1.#SNAN"})
    EXPECT_TRUE(std::isnan(parse_double(nan).value_or(0.0))) << nan;
  EXPECT_EQ(*parse_double("1.#INF"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(*parse_double("-1.#INF00"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(*parse_integer("+12"), 12);
  EXPECT_EQ(*parse_integer("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
}

TEST(Number, LocalePlaysNoPart) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  bool comma = false;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "it_IT.UTF-8"})
    if (std::setlocale(LC_NUMERIC, name)) {
      comma = true;
      break;
    }
  if (!comma) GTEST_SKIP() << "no locale with a decimal comma is installed";
  const std::string text = format_double(0.12345678901234568);
  const auto value = parse_double("0.12345678901234567890123");
  std::setlocale(LC_NUMERIC, before.c_str());
  EXPECT_EQ(text, "0.12345678901234568");
  EXPECT_EQ(value, 0.12345678901234567890123);
}

}  // namespace
}  // namespace mimicry
