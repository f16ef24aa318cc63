#include "sim/record/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/config/whole_file.h"
#include "sim/record/table.h"
#include "tests/sim/record/error_of.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Table, AppendsRowsByTheNamesOfColumns) {
  Table table, more;
  table.add("id", std::vector<std::string>{"a"});
  table.add("metric.x", std::vector<double>{1.0});
  table.add("last", std::vector<double>{2.0});
  more.add("id", std::vector<std::string>{"b"});
  more.add("metric.x", std::vector<std::string>{"word"});
  more.add("metric.y", std::vector<double>{3.0});
  table.append(std::move(more));
  EXPECT_EQ(table.csv(), "id,metric.x,metric.y,last\na,1,,2\nb,word,3,\n");
}

TEST(Table, NamesFileLineAndColumnOfABadNumber) {
  const TemporaryFolder folder;
  write_file_whole(folder.path() / "t.csv", "t_s,a_m\n0,1\n1,two\n");
  const Table table(folder.path() / "t.csv");
  EXPECT_THAT(error_of([&] { table.numbers("a_m"); }),
              AllOf(HasSubstr("t.csv:3:"), HasSubstr("'two'"), HasSubstr("'a_m'")));
  EXPECT_THAT(error_of([&] { table.numbers("b_m"); }), HasSubstr("no column 'b_m'"));
}

TEST(Table, RejectsARowOfAnotherWidth) {
  const TemporaryFolder folder;
  write_file_whole(folder.path() / "t.csv", "t_s,a_m\n0,1\n1\n");
  EXPECT_THAT(error_of([&] { Table(folder.path() / "t.csv"); }), HasSubstr("t.csv:3: 1 fields; the header has 2"));
}

TEST(Table, ReadsBackTextWithLineBreaksQuotesAndCommas) {
  const std::vector<std::string> texts = {"two\nlines", "\"quoted\", and\r\na comma", "plain", "\n", ","};
  fmt::memory_buffer out;
  CsvLine(out).add("cause").add("t_s");
  for (const std::string& text : texts) CsvLine(out).add(text).add(1.5);
  const TemporaryFolder folder;
  write_file_whole(folder.path() / "t.csv", {out.data(), out.size()});
  const Table table(folder.path() / "t.csv");
  EXPECT_EQ(table.words("cause"), texts);
  EXPECT_EQ(table.numbers("t_s"), std::vector<double>(texts.size(), 1.5));
}

TEST(Table, ConvertsColumnsBetweenNumbersAndWords) {
  Table table;
  table.add("t_s", std::vector<double>{0.5, std::nan(""), 3.0});
  table.add("seed", std::vector<std::string>{"7", "", "12"});
  EXPECT_EQ(table.words("t_s"), (std::vector<std::string>{"0.5", "", "3"}));
  EXPECT_EQ(table.numbers("seed")[0], 7.0);
  EXPECT_TRUE(std::isnan(table.numbers("seed")[1]));
  EXPECT_EQ(table.csv(), "t_s,seed\n0.5,7\n,\n3,12\n");
  EXPECT_TRUE(table.has("seed"));
  EXPECT_FALSE(table.has("none"));
}

TEST(Table, CountsTheLinesInsideQuotes) {
  const TemporaryFolder folder;
  write_file_whole(folder.path() / "t.csv", "cause,a_m\n\"two\nlines\",1\nx,two\n");
  const Table table(folder.path() / "t.csv");
  EXPECT_THAT(error_of([&] { table.numbers("a_m"); }), HasSubstr("t.csv:4:"));
}

TEST(Table, ReadsTheByteOrderMarkWindowsLineEndsAndAMissingLastOne) {
  const TemporaryFolder folder;
  write_file_whole(folder.path() / "t.csv", "\xef\xbb\xbft_s,a_m\r\n0,\r\n1,2.5");
  const Table table(folder.path() / "t.csv");
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.numbers("t_s")[1], 1.0);
  EXPECT_TRUE(std::isnan(table.numbers("a_m")[0]));
  EXPECT_EQ(table.numbers("a_m")[1], 2.5);
}

}  // namespace
}  // namespace hedgehop::sim
