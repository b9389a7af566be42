#include <array>
#include <limits>
#include <set>

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

TEST(Registry, DefaultsOfOptionsAreLegalAndCanBeSet) {
  for (const TechniqueInfo& info : techniques())
    for (const OptionInfo& option : info.options) {
      TechniqueOptions options;
      const OptionValue usual = option_value(info, option, options);
      EXPECT_NO_THROW(set_option(info, options, option.name, {usual.begin(), usual.end()}))
          << info.name << option.name;
      EXPECT_EQ(option_value(info, option, options), usual) << info.name << option.name;
    }
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
