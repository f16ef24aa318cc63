#include "sim/batch/group_verdict.h"

#include <gmock/gmock.h>

#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;

TEST(FlightsToShow, IsTheSmallestNumberThatTheIntervalAccepts) {
  for (const double confidence : {0.5, 0.8, 0.95, 0.99, 0.999}) {
    for (const double rate : {0.0, 0.1, 0.5, 0.8, 0.9, 0.95, 0.99, 0.999, 0.9999, 0.99999, 0.999999, 0.9999999}) {
      const int64_t flights = flights_to_show(rate, confidence);
      EXPECT_GE(wilson_interval({flights, flights}, confidence).low, rate) << rate << " at " << confidence;
      if (flights == 1) continue;
      EXPECT_LT(wilson_interval({flights - 1, flights - 1}, confidence).low, rate) << rate << " at " << confidence;
    }
  }
}

std::string refusal(double rate, int64_t flights) {
  const GroupSummary group{.group = "city", .flights = flights};
  try {
    require_decidable({SuccessRateCheck{.at_least = rate}}, {group});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RequireDecidable, NamesTheNumberOfFlightsThatCouldShowTheRate) {
  const int64_t needed = flights_to_show(0.9, 0.95);
  EXPECT_EQ(refusal(0.9, needed), "");
  EXPECT_THAT(refusal(0.9, needed - 1), HasSubstr(std::to_string(needed)));
}

TEST(RequireDecidable, RefusesARateThatNoNumberOfFlightsShows) {
  EXPECT_THAT(refusal(1.0, 1'000'000), HasSubstr("no finite number of flights"));
  EXPECT_THAT(refusal(0.99999999999, 10), HasSubstr("it takes"));
}

TEST(Judge, PrintsAnIntervalThatMissesItsLimitWithMoreDecimals) {
  const GroupSummary group{.group = "city", .success = {.successes = 95, .trials = 100}};  // from 0.88825
  const GroupVerdict verdict = judge({SuccessRateCheck{.at_least = 0.8883}}, {group}).at(0);
  EXPECT_FALSE(verdict.passed);
  EXPECT_THAT(verdict.words, HasSubstr("interval 0.8882; required: >= 0.8883"));
}

/// Fisher's test of 11 of 15 after 15 of 15 has the probability 0.0498.
TEST(Judge, PassedComparisonWithAnEarlierBatchDoesNotRuleOutALoss) {
  const TemporaryFolder folder;
  std::string flights;
  for (int i = 0; i < 15; ++i)
    flights += std::string(i > 0 ? "," : "") + R"({"group": "city", "status": "flown", "passed": true})";
  write_file_whole(folder.path() / "batch.json", R"({"groups": [], "flights": [)" + flights + "]}");
  const NoWorseCheck check{.than = (folder.path() / "batch.json").string()};
  const auto verdict_of_successes = [&](int64_t successes) {
    return judge({check}, {{.group = "city", .success = {.successes = successes, .trials = 15}}}).at(0);
  };
  EXPECT_FALSE(verdict_of_successes(11).passed);
  EXPECT_THAT(verdict_of_successes(11).words, HasSubstr("probability 0.0498, so it has become worse"));
  EXPECT_TRUE(verdict_of_successes(15).passed);
  EXPECT_THAT(verdict_of_successes(15).words,
              HasSubstr("probability 1.000, so a loss is not shown; 'margin' can rule one out"));
}

TEST(Judge, RefusedFileOfAnEarlierBatchIsNoFlight) {
  const TemporaryFolder folder;
  write_file_whole(
      folder.path() / "batch.json",
      R"({"groups": [], "flights": [{"id": "city/bad", "group": "city", "status": "failed", "passed": false}]})");
  const NoWorseCheck check{.than = (folder.path() / "batch.json").string()};
  EXPECT_THAT(judge({check}, {{.group = "city", .success = {.successes = 3, .trials = 3}}}).at(0).words,
              HasSubstr("no flights to compare: 3 now, 0 in "));
}

TEST(Summarize, RefusedOrdersAreNoTrials) {
  std::vector<FlightRecord> records(3);
  for (FlightRecord& record : records) record.status = FlightRecord::Status::failed;
  records[0].order.id = "city/bad";  // as read from a table
  records[1].order.fault = "city.yaml:3:1: unknown key 'foo'";
  const GroupSummary group = summarize(records).at(0);
  EXPECT_EQ(group.flights, 3);
  EXPECT_EQ(group.failed, 3);
  EXPECT_EQ(group.success.trials, 1);
  EXPECT_EQ(without_refused(records).size(), 1u);
}

TEST(VerdictOf, IsOneDecisionForEveryRecord) {
  const auto record = [](Outcome outcome, std::vector<CheckResult> checks) {
    FlightRecord flown{.status = FlightRecord::Status::flown};
    flown.result.emplace();
    flown.result->flight.outcome = outcome;
    flown.result->flight.checks = std::move(checks);
    return flown;
  };
  const CheckResult good{.name = "a", .passed = true}, bad{.name = "b", .passed = false};
  EXPECT_EQ(verdict_of(record(Outcome::collided, {good})), Verdict::passed);
  EXPECT_EQ(verdict_of(record(Outcome::reached, {good, bad})), Verdict::failed);
  EXPECT_EQ(verdict_of(record(Outcome::reached, {})), Verdict::unchecked);
  EXPECT_EQ(verdict_of(record(Outcome::fault, {good})), Verdict::fault);
  EXPECT_EQ(verdict_of(FlightRecord{}), Verdict::not_flown);
  EXPECT_EQ(verdict_of(FlightRecord{.status = FlightRecord::Status::failed}), Verdict::not_flown);
}

}  // namespace
}  // namespace hedgehop::sim
