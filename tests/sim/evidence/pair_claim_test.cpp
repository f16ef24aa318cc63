#include "sim/evidence/claims.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "sim/config/input_error.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;

constexpr double kPairPrinted6 = 0.6e-6;  // references with six decimals
constexpr double kConfidence = 0.95;

PairTally counted(const PairClaim& claim, const std::vector<std::array<double, 2>>& pairs) {
  PairTally tally(claim, kConfidence);
  for (const auto& pair : pairs) tally.count(pair);
  return tally;
}

/// A tally of pairs in which only the base fails, only the candidate fails, or neither fails.
PairTally of_counts(const std::string& claim, int base_fails, int candidate_fails, int neither) {
  std::vector<std::array<double, 2>> pairs(static_cast<size_t>(neither), {0.0, 0.0});
  pairs.insert(pairs.end(), static_cast<size_t>(base_fails), {1.0, 0.0});
  pairs.insert(pairs.end(), static_cast<size_t>(candidate_fails), {0.0, 1.0});
  return counted(parse_pair_claim(claim, {}), pairs);
}

/// The reference values were computed with numpy.
TEST(MeanBets, MatchReferenceValues) {
  MeanBets at_04(0.4), at_08(0.8);
  for (const double x : {0.2, 0.9, 0.5, 0.7}) {
    at_04.add(x);
    at_08.add(x);
  }
  EXPECT_NEAR(at_04.ln_above(), 0.233930, kPairPrinted6);
  EXPECT_NEAR(at_08.ln_below(), 0.631311, kPairPrinted6);
}

TEST(AnytimeMeanInterval, MatchesReferenceValues) {
  struct Row {
    int n;
    double low, high;
  };
  for (const Row& row : {Row{10, 0.195543, 0.806827}, Row{30, 0.337144, 0.684699}, Row{100, 0.405010, 0.596158}}) {
    std::vector<double> x;
    for (int i = 1; i <= row.n; ++i) x.push_back(std::fmod(0.6180339887498949 * i, 1.0));
    const Interval interval = anytime_mean_interval(x, kConfidence);
    EXPECT_NEAR(interval.low, row.low, kPairPrinted6);
    EXPECT_NEAR(interval.high, row.high, kPairPrinted6);
  }
  EXPECT_EQ(anytime_mean_interval({}, kConfidence).high, 1.0);
}

TEST(PairTally, MatchesReferenceEvidenceOfDiscordantPairs) {
  struct Row {
    int base_fails, candidate_fails;
    double ln_e;
  };
  for (const Row& row : {Row{5, 0, 3.037320}, Row{8, 1, 2.381044}, Row{10, 1, 3.541112}, Row{20, 8, 0.955496},
                         Row{3, 3, -1.763880}, Row{0, 0, 0.0}}) {
    const PairTally tally = of_counts("collision: better", row.base_fails, row.candidate_fails, 100);
    EXPECT_NEAR(tally.figures().at("ln_e_for").get<double>(), row.ln_e, kPairPrinted6);
  }
  EXPECT_EQ(of_counts("collision: better", 5, 0, 0).standing(), Standing::shown);
  EXPECT_EQ(of_counts("collision: better", 4, 0, 0).standing(), Standing::undecided);
  EXPECT_EQ(of_counts("collision: better", 0, 5, 900).standing(), Standing::refuted);
}

TEST(PairTally, MatchesReferenceEvidenceOfNoLoss) {
  EXPECT_NEAR(of_counts("collision: no worse by 0.02", 7, 3, 390).figures().at("ln_e_for").get<double>(), 3.489116,
              kPairPrinted6);
  const PairTally none = of_counts("collision: no worse by 0.05", 0, 0, 200);
  EXPECT_NEAR(none.figures().at("ln_e_for").get<double>(), 4.695099, kPairPrinted6);
  EXPECT_EQ(none.standing(), Standing::shown);
}

/// For equal systems, any decision during 400 looks is a false alarm; up to 5 % are allowed.
TEST(PairTally, RarelyPrefersOneOfTwoEqualSystems) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> clearance(1.5, 1.0);
  constexpr int kRuns = 300, kPairs = 400;
  int better = 0, worse = 0;
  for (int run = 0; run < kRuns; ++run) {
    PairTally tally(parse_pair_claim("min_clearance_m: better", 3.0), kConfidence);
    for (int i = 0; i < kPairs && tally.standing() == Standing::undecided; ++i) {
      const double base = clearance(random), candidate = clearance(random);
      tally.count(std::array{base, candidate});
    }
    better += tally.standing() == Standing::shown ? 1 : 0;
    worse += tally.standing() == Standing::refuted ? 1 : 0;
  }
  constexpr int kMaxPreferred = 25;  // 15 and 2.7 standard deviations
  EXPECT_LE(better, kMaxPreferred);
  EXPECT_LE(worse, kMaxPreferred);
  EXPECT_GT(better + worse, 0);
}

/// An unknown result of either system counts against the candidate.
TEST(PairTally, CountsFlightsWithoutResultAgainstTheCandidate) {
  for (const auto& pair : {std::array{std::nan(""), 1.0}, std::array{1.0, std::nan("")}}) {
    PairTally graded(parse_pair_claim("min_clearance_m: better", 3.0), kConfidence);
    graded.count(pair);
    EXPECT_LT(graded.value(), 0.0);
  }
  PairTally events(parse_pair_claim("success: better", {}), kConfidence);
  events.count(std::array{std::nan(""), 1.0});
  events.count(std::array{0.0, std::nan("")});
  EXPECT_EQ(events.figures().at("candidate_worse"), 2);
}

TEST(PairTally, ClipsClearancesAtTheRange) {
  const PairTally tally = counted(parse_pair_claim("min_clearance_m: better", 3.0), {{1.0, 50.0}, {-0.5, 0.5}});
  EXPECT_NEAR(tally.value(), (2.0 + 0.5) / 2.0, 1e-12);
}

TEST(PairClaim, RejectsClaimsThatCannotBeDecided) {
  const auto message = [](const std::string& text, std::optional<double> range_m) -> std::string {
    try {
      parse_pair_claim(text, range_m);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(message("colision: better", {}), HasSubstr("did you mean 'collision'?"));
  EXPECT_THAT(message("collision: best", {}), HasSubstr("expected such as"));
  EXPECT_THAT(message("collision: no worse by 0", {}), HasSubstr("the margin must be > 0 and < 1"));
  EXPECT_THAT(message("min_clearance_m: better", {}), HasSubstr("requires --range"));
  EXPECT_THAT(message("min_clearance_m: no worse by 3", 3.0), HasSubstr("the margin must be > 0 and < 3"));
  EXPECT_THAT(message("collision: better", 3.0), HasSubstr("--range applies to clearances only"));
}

}  // namespace
}  // namespace hedgehop::sim
