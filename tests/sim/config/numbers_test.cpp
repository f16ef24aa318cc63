#include "sim/config/numbers.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <random>

namespace hedgehop::sim {
namespace {

using Kind = ParsedNumber::Kind;

TEST(Numbers, ReadsTheDecimalsOfYaml) {
  EXPECT_EQ(parse_number("3", false).member, 3.0);
  EXPECT_EQ(parse_number("+3.5", false).member, 3.5);
  EXPECT_EQ(parse_number("-.5e2", false).member, -50.0);
  EXPECT_EQ(parse_number("6.02E+23", false).member, 6.02e23);
}

TEST(Numbers, RefusesTextsThatAreNotDecimals) {
  for (const char* text :
       {"", "+", "-", ".", "abc", "0x10", "1_000", "1,5", "3 m", "infinity", "+-3", "--3", "e5", "1e"}) {
    EXPECT_EQ(parse_number(text, false).kind, Kind::not_a_number) << text;
  }
}

TEST(Numbers, DetectsNumbersThatAreNotFinite) {
  for (const char* text : {".inf", "-.inf", "+.INF", ".nan", ".NaN", "nan", "inf", "1e999", "-1e999"}) {
    EXPECT_EQ(parse_number(text, false).kind, Kind::not_finite) << text;
  }
}

TEST(Numbers, RightAnglesAreExact) {
  EXPECT_EQ(parse_number("180", true).member, std::numbers::pi);
  EXPECT_EQ(parse_number("-90", true).member, -std::numbers::pi / 2);
  EXPECT_EQ(parse_number("45", true).member, std::numbers::pi / 4);
}

TEST(Numbers, DegreesAreWrittenAsAPersonWould) {
  for (const char* text : {"0", "90", "-180", "22.5", "360", "0.1", "45", "123.456", "1e-07", "60"}) {
    EXPECT_EQ(number_text(parse_number(text, true).member, true), text);
  }
}

/// The floats of YAML 1.1, https://yaml.org/type/float.html: with a point and a signed exponent.
TEST(Numbers, HaveAPointBeforeTheirExponentForReadersOfYaml11) {
  EXPECT_EQ(yaml_1_1_number(2e-5), "2.0e-05");
  EXPECT_EQ(yaml_1_1_number(-1.5e-7), "-1.5e-07");
  EXPECT_EQ(yaml_1_1_number(3e20), "3.0e+20");
  EXPECT_EQ(yaml_1_1_number(0.25), "0.25");
  EXPECT_EQ(yaml_1_1_number(400.0), "400");
  EXPECT_EQ(yaml_1_1_list(std::vector{2e-5, -0.0, 0.25}), "2.0e-05, 0, 0.25");
  EXPECT_EQ(yaml_1_1_list({}), "");
}

TEST(Numbers, EveryDoubleComesBackBitForBit) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 50'000; ++i) {
    // Half of them from all bit patterns, half of a size that occurs.
    double value = std::bit_cast<double>(random());
    if (i % 2 == 0) value = std::ldexp(static_cast<double>(static_cast<int64_t>(random())), -60);
    // Beyond this a double in radians has no finite double in degrees, below it no normal one.
    if (!std::isfinite(value) || std::abs(value) > 1e300 || std::abs(value) < 1e-300) continue;
    for (bool degrees : {false, true}) {
      const std::string text = number_text(value, degrees);
      const ParsedNumber back = parse_number(text, degrees);
      ASSERT_EQ(back.kind, Kind::number) << text;
      ASSERT_EQ(std::bit_cast<uint64_t>(back.member), std::bit_cast<uint64_t>(value)) << text;
    }
  }
}

TEST(Numbers, IntegersAreWholeAndFit) {
  EXPECT_EQ(parse_signed("-9223372036854775808"), INT64_MIN);
  EXPECT_EQ(parse_unsigned("18446744073709551615"), UINT64_MAX);
  EXPECT_FALSE(parse_signed("9223372036854775808"));
  EXPECT_FALSE(parse_unsigned("-1"));
  EXPECT_FALSE(parse_signed("5.0"));
  EXPECT_FALSE(parse_signed("1e3"));
}

}  // namespace
}  // namespace hedgehop::sim
