#include <array>
#include <limits>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/technique/technique.h>

namespace mimicry {
namespace {

using testing::HasSubstr;

TEST(Registry, NamesAreUniqueAndFound) {
  std::set<std::string_view> names;
  for (const TechniqueInfo& info : techniques()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_EQ(&find_technique(info.name), &info);
    EXPECT_FALSE(info.description.empty());
    EXPECT_NE(info.step, nullptr);
  }
}

TEST(Registry, UnknownNameIsAnsweredWithTheList) {
  try {
    find_technique("airbrush");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("'airbrush'"));
    EXPECT_THAT(error.what(), HasSubstr("anchored-closest"));
  }
}

// A legal value that is not the given one.
OptionValue another(const OptionInfo& option, const OptionValue& than) {
  switch (option.kind) {
    case OptionKind::direction:
      return OptionValue(std::array{than[1], than[2], than[0] == 0.5 ? 0.25 : 0.5});
    case OptionKind::number:
      return OptionValue(than[0] == option.highest ? option.lowest : option.highest);
    default:
      return OptionValue(than[0] == 0.0 ? 1.0 : 0.0);
  }
}

TEST(Registry, DefaultsOfOptionsAreLegalAndCanBeSet) {
  int count = 0;
  for (const TechniqueInfo& info : techniques())
    for (const OptionInfo& option : info.options) {
      SCOPED_TRACE(std::string(info.name) + " " + option.name);
      TechniqueOptions options;
      const OptionValue usual = option_value(info, option, options);
      const OptionValue other = another(option, usual);
      ASSERT_NE(other, usual);
      const auto set = [&](const OptionValue& value) {
        EXPECT_NO_THROW(set_option(info, options, option.name, {value.begin(), value.end()}));
        EXPECT_EQ(option_value(info, option, options), value);
      };
      set(other);
      // And no other option than that.
      for (const OptionInfo& rest : info.options) {
        if (rest.name == option.name) continue;
        EXPECT_EQ(option_value(info, rest, options), option_value(info, rest, {})) << rest.name;
      }
      set(usual);
      ++count;
    }
  EXPECT_GT(count, 10);
}

TEST(Registry, WrongOptionsAreRefusedAndChangeNothing) {
  const TechniqueInfo& spray = find_technique("spraycan");
  TechniqueOptions options;
  const std::array<double, 3> down = {0, -1, 0};
  const std::array<double, 3> zero = {0, 0, 0};
  const std::array<double, 3> bad = {0, std::numeric_limits<double>::quiet_NaN(), 1};
  EXPECT_THROW(set_option(spray, options, "nozzle", std::span(down).first(2)), Error);
  EXPECT_THROW(set_option(spray, options, "nozzle", zero), Error);
  EXPECT_THROW(set_option(spray, options, "nozzle", bad), Error);
  EXPECT_THROW(set_option(spray, options, "muzzle", down), Error);
  EXPECT_THROW(set_option(find_technique("snap"), options, "nozzle", down), Error);
  EXPECT_TRUE(options.is_default());
  set_option(spray, options, "nozzle", down);
  EXPECT_EQ(option_value(spray, spray.options[0], options), OptionValue(down));
}

}  // namespace
}  // namespace mimicry
