#include "io/csv.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>

#include "io/number.h"

namespace mimicry {
namespace {

using Strings = std::vector<std::string>;

TEST(Csv, WritesAndReadsEveryKindOfCell) {
  const Strings columns = {"name", "count", "value", "none"};
  const std::vector<Cell> cells = {"a \"b\",\nc", std::int64_t{-3}, 0.1 + 0.2, {}};
  const std::string text = csv_heading(columns) + csv_line(cells);
  EXPECT_EQ(text, "name,count,value,none\n\"a \"\"b\"\",\nc\",-3,0.30000000000000004,\n");
  const CsvTable table = read_csv(text, "t.csv");
  EXPECT_EQ(table.columns, columns);
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0], (Strings{"a \"b\",\nc", "-3", "0.30000000000000004", ""}));
  EXPECT_EQ(parse_double(table.rows[0][2]), 0.1 + 0.2);
  EXPECT_EQ(table.find("value"), 2u);
  EXPECT_FALSE(table.find("values"));
  EXPECT_EQ(json_line(columns, cells),
            "{\"name\": \"a \\\"b\\\",\\nc\", \"count\": -3, \"value\": 0.30000000000000004, "
            "\"none\": null}\n");
}

TEST(Csv, WhatIsNotFiniteIsNothing) {
  const std::vector<Cell> cells = {std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity()};
  EXPECT_EQ(csv_line(cells), ",\n");
  EXPECT_EQ(json_line(Strings{"a", "b"}, cells), "{\"a\": null, \"b\": null}\n");
}

TEST(Csv, OtherProgramsFiles) {
  const CsvTable table = read_csv("\xEF\xBB\xBF\"a\",b\r\n1,\"2\"\r\n\r\n,", "t.csv");
  EXPECT_EQ(table.columns, (Strings{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (Strings{"1", "2"}));
  EXPECT_EQ(table.rows[1], (Strings{"", ""}));
}

TEST(Csv, ErrorsNameFileAndLine) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      read_csv(text, "t.csv");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("a,b\n1,2\n\n3\n").find("t.csv: line 4"), std::string::npos);
  EXPECT_NE(message("a,b\n\"1,2\n").find("t.csv: line 2"), std::string::npos);
  EXPECT_NE(message("a\n\"1\"x\n").find("line 2"), std::string::npos);
  EXPECT_NE(message("a,a\n").find("line 1: two columns"), std::string::npos);
  EXPECT_NE(message("").find("t.csv: is empty"), std::string::npos);
}

}  // namespace
}  // namespace mimicry
