#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

namespace hedgehop::dynamics {

/// Expects a value within `tolerance` of the published or derived one, and records both as a property of the test.
/// scripts/check_table creates the tables of docs/verification.md from them.
/// @param name  of the quantity with its unit, "thrust, N".
inline void expect_recorded(const std::string& name, double actual, double expected, double tolerance) {
  EXPECT_NEAR(actual, expected, tolerance) << name;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::ostringstream line;
  line << std::setprecision(9) << name << '|' << expected << '|' << actual << '|' << tolerance;
  testing::Test::RecordProperty("check_" + std::to_string(test->result()->test_property_count()), line.str());
}

/// The same with a tolerance relative to the expected value.
inline void expect_recorded_relative(const std::string& name, double actual, double expected, double relative) {
  expect_recorded(name, actual, expected, relative * std::abs(expected));
}

/// The same for an upper bound.
inline void expect_recorded_below(const std::string& name, double actual, double bound) {
  EXPECT_LT(actual, bound) << name;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::ostringstream line;
  line << std::setprecision(4) << name << "|< " << bound << '|' << actual << '|';
  testing::Test::RecordProperty("check_" + std::to_string(test->result()->test_property_count()), line.str());
}

}  // namespace hedgehop::dynamics
