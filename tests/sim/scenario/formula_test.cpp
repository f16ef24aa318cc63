#include "sim/scenario/formula.h"

#include <gmock/gmock.h>

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;

/// Returns the error of a formula; "" if it is valid.
std::string fault(const std::string& text) {
  try {
    parse_formula(text);
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(Formula, BindsNotBeforeUntilBeforeAndBeforeOrBeforeImplies) {
  const Formula f = parse_formula("not north > 1 until east > 2 and tilt < 3 or roll < 4 -> pitch < 5 -> climb < 6");
  ASSERT_EQ(f.kind, Formula::Kind::implication);
  EXPECT_EQ(f.of[1].kind, Formula::Kind::implication);  // to the right
  const Formula& either = f.of[0];
  ASSERT_EQ(either.kind, Formula::Kind::disjunction);
  ASSERT_EQ(either.of[0].kind, Formula::Kind::conjunction);
  const Formula& until = either.of[0].of[0];
  ASSERT_EQ(until.kind, Formula::Kind::until);
  EXPECT_EQ(until.of[0].kind, Formula::Kind::negation);
}

TEST(Formula, ParenthesesHoldNumbersAndFormulas) {
  EXPECT_EQ(fault("((clearance) + 1) * 2 >= 3 and ((speed < 2))"), "");
  EXPECT_EQ(fault("(speed < 2) + 1 >= 0"), "column 1: a comparison cannot be used as a number");
  EXPECT_EQ(fault("1 + abs((speed < 2)) > 2"), "column 9: a comparison cannot be used as a number");
  EXPECT_EQ(fault("(speed > 1) > 2"), "column 1: a comparison cannot be used as a number");
  EXPECT_THAT(fault("always (speed)"), HasSubstr("expected a comparison"));
}

TEST(Formula, FaultsNameTheColumnAndTheNearestSignal) {
  EXPECT_THAT(fault("always (clearence >= 1)"),
              HasSubstr("column 9: no signal 'clearence'; did you mean 'clearance'?"));
  EXPECT_EQ(fault("always[5,2] (speed < 2)"), "column 10: the interval ends at 2 s, before its start at 5 s");
  EXPECT_THAT(fault("always[-1,2] (speed < 2)"), HasSubstr("column 8: expected a time of at least 0 s, got '-'"));
  EXPECT_THAT(fault("speed <"), HasSubstr("column 8: expected a number or a signal, got the end of the formula"));
  EXPECT_THAT(fault("speed < 1e999"), HasSubstr("expected a finite number"));
  EXPECT_THAT(fault("speed < 2 speed"), HasSubstr("column 11: expected the formula's end, got 'speed'"));
  EXPECT_THAT(fault("status > 2"), HasSubstr("'status' takes == or !="));
  EXPECT_EQ(fault("always (speed >= status)"),
            "column 18: 'status' is no number; valid: status == WORD, status != WORD");
  EXPECT_THAT(fault("max(status, 1) > -status"), HasSubstr("column 5: 'status' is no number"));
  EXPECT_THAT(fault(""), HasSubstr("column 1: expected a number or a signal"));
  EXPECT_THAT(fault(std::string(10'000, '(')), HasSubstr("nested too deep"));
  EXPECT_THAT(fault(std::string(10'000, '-')), HasSubstr("nested too deep"));
  for (const std::string link : {" and ", " or ", " -> ", " until "}) {
    std::string chain = "speed < 1";
    for (int i = 0; i < 30'000; ++i) chain += link + "speed < 1";
    EXPECT_NE(fault(chain), "") << link;
  }
  std::string sum = "speed";
  for (int i = 0; i < 30'000; ++i) sum += " + speed";
  EXPECT_THAT(fault(sum + " < 1"), HasSubstr("more than 1000 operators; write several checks"));
}

TEST(Formula, UsesTheSignalsThatItNames) {
  const Formula f = parse_formula("always (speed < 1 -> abs(north - goal_distance) > 2 or status == stop)");
  EXPECT_TRUE(uses_signal(f, "goal_distance"));
  EXPECT_TRUE(uses_signal(f, "speed"));
  EXPECT_FALSE(uses_signal(f, "east"));
}

TEST(Formula, HorizonSumsAlongNestedIntervals) {
  EXPECT_EQ(horizon_s(parse_formula("always[1,4] eventually[0,2.5] (speed < 1)")), 6.5);
  EXPECT_EQ(horizon_s(parse_formula("always[3,end] (speed < 1) and eventually[0,2] (speed < 1)")), 3.0);
  EXPECT_EQ(horizon_s(parse_formula("always (speed < 1)")), 0.0);
}

}  // namespace
}  // namespace hedgehop::sim
