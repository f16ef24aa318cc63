#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

namespace hedgehop::dynamics {

/// Expects a value within `tolerance` of the published or derived one, and writes both down as a property of the test:
/// scripts/check_table makes the tables of docs/verification.md of them.
/// @param what  the quantity with its unit, "thrust, N".
inline void expect_recorded(const std::string& what, double here, double asked, double tolerance) {
  EXPECT_NEAR(here, asked, tolerance) << what;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::ostringstream line;
  line << std::setprecision(9) << what << '|' << asked << '|' << here << '|' << tolerance;
  testing::Test::RecordProperty("check_" + std::to_string(test->result()->test_property_count()), line.str());
}

/// The same with a tolerance relative to the asked value.
inline void expect_recorded_relative(const std::string& what, double here, double asked, double relative) {
  expect_recorded(what, here, asked, relative * std::abs(asked));
}

/// The same for a bound that the value must stay below.
inline void expect_recorded_below(const std::string& what, double here, double bound) {
  EXPECT_LT(here, bound) << what;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::ostringstream line;
  line << std::setprecision(4) << what << "|< " << bound << '|' << here << '|';
  testing::Test::RecordProperty("check_" + std::to_string(test->result()->test_property_count()), line.str());
}

}  // namespace hedgehop::dynamics
