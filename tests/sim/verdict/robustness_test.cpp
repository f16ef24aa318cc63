#include "sim/verdict/formula_check.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace hedgehop::sim {
namespace {

using ::testing::ElementsAre;

constexpr double kInf = std::numeric_limits<double>::infinity();

/// Signals of the specification's tables under the names of formula signals: x is north, y is east.
SampledSignals sampled(double dt_s, std::vector<double> x, std::vector<double> y) {
  SampledSignals signals{.dt_s = dt_s, .samples = x.size(), .numbers = {}, .status = {}};
  signals.numbers["north"] = std::move(x);
  signals.numbers["east"] = std::move(y);
  return signals;
}

std::vector<double> robustness_values(const std::string& formula) {
  return robustness(parse_formula(formula), sampled(1.0, {1, 2, 3, -1, 2, 1}, {-3, -2, -1, 2, 1, 0})).value;
}

/// Values of two other evaluators, one of them rtamt.
TEST(Robustness, EqualsReferenceValuesOnSixSamples) {
  EXPECT_THAT(robustness_values("always[0,2] (north>=0)"), ElementsAre(1, -1, -1, -1, 1, 1));
  EXPECT_THAT(robustness_values("eventually[1,3] (east>=0)"), ElementsAre(2, 2, 2, 1, 0, -kInf));
  EXPECT_THAT(robustness_values("always[4,6] (north>=0)"), ElementsAre(1, 1, kInf, kInf, kInf, kInf));
  EXPECT_THAT(robustness_values("eventually[4,6] (east>=0)"), ElementsAre(1, 0, -kInf, -kInf, -kInf, -kInf));
  EXPECT_THAT(robustness_values("(north>=0) until[0,3] (east>=0)"), ElementsAre(1, 2, 2, 2, 1, 0));
  EXPECT_THAT(robustness_values("(north>=0) until[2,3] (east>=0)"), ElementsAre(1, 2, -1, -1, -kInf, -kInf));
  EXPECT_THAT(robustness_values("always[0,3] (eventually[0,2] (east>=0))"), ElementsAre(-1, 1, 0, 0, 0, 0));
  EXPECT_THAT(robustness_values("always ((north<=0) -> eventually[0,1] (east>=1.5))"),
              ElementsAre(.5, .5, .5, .5, 1, 1));
}

TEST(Robustness, EqualsReferenceValuesOnAThousandSamples) {
  std::vector<double> x, y;
  for (int i = 0; i < 1000; ++i) {
    const double t = i / 100.0, turn = 2.0 * std::numbers::pi;
    x.push_back(2.0 + std::sin(turn * 0.3 * t) + 0.5 * std::sin(turn * 1.1 * t + 1.0));
    y.push_back(std::cos(turn * 0.2 * t));
  }
  const SampledSignals signals = sampled(0.01, x, y);
  const auto at_start = [&](const char* formula) { return robustness(parse_formula(formula), signals).value[0]; };
  constexpr double kPrinted = 5e-9;
  EXPECT_NEAR(at_start("always[0,2] (north>=1.2)"), 0.59915818, kPrinted);
  EXPECT_NEAR(at_start("(north>=1) until[3,6] (east>=.9)"), -0.46755302, kPrinted);
  EXPECT_NEAR(at_start("always eventually[0,3] (east>=0)"), 0.30901699, kPrinted);
}

/// The published definition, sample by sample.
double by_definition(const Formula& f, const SampledSignals& s, size_t i) {
  const size_t last = s.samples - 1;
  const auto from = static_cast<size_t>(f.interval.from_s);
  const size_t to = f.interval.to_s ? static_cast<size_t>(*f.interval.to_s) : last;
  const auto part = [&](size_t k, size_t j) { return by_definition(f.of[k], s, j); };
  double r = 0.0;
  switch (f.kind) {
    case Formula::Kind::at_least_zero:
      return s.numbers.at(f.margin.of[0].signal)[i] - f.margin.of[1].number;
    case Formula::Kind::negation:
      return -part(0, i);
    case Formula::Kind::conjunction:
      return std::min(part(0, i), part(1, i));
    case Formula::Kind::disjunction:
      return std::max(part(0, i), part(1, i));
    case Formula::Kind::implication:
      return std::max(-part(0, i), part(1, i));
    case Formula::Kind::always:
      r = kInf;
      for (size_t j = i + from; j <= std::min(i + to, last); ++j) r = std::min(r, part(0, j));
      return r;
    case Formula::Kind::eventually:
      r = -kInf;
      for (size_t j = i + from; j <= std::min(i + to, last); ++j) r = std::max(r, part(0, j));
      return r;
    case Formula::Kind::until:
      r = -kInf;
      for (size_t j = i + from; j <= std::min(i + to, last); ++j) {
        double both = part(1, j);
        for (size_t k = i; k < j; ++k) both = std::min(both, part(0, k));
        r = std::max(r, both);
      }
      return r;
    case Formula::Kind::has_status:
      break;
  }
  return r;
}

/// Returns a random formula of at most `depth` levels over x and y, with integer seconds; equal values are common.
std::string random_formula(int depth, std::mt19937& random) {
  const auto draw = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  if (depth == 0) return std::string(draw(2) ? "(north" : "(east") + ">=" + std::to_string(draw(3)) + ")";
  const std::string a = random_formula(depth - 1, random), b = random_formula(depth - 1, random);
  const int from = draw(4);
  const std::string to = draw(3) == 0 ? "end" : std::to_string(from + draw(4));
  const std::string interval = "[" + std::to_string(from) + "," + to + "]";
  switch (draw(7)) {
    case 0:
      return "(not " + a + ")";
    case 1:
      return "(" + a + " and " + b + ")";
    case 2:
      return "(" + a + " or " + b + ")";
    case 3:
      return "(" + a + " -> " + b + ")";
    case 4:
      return "(always" + interval + " " + a + ")";
    case 5:
      return "(eventually" + interval + " " + a + ")";
    default:
      return "(" + a + " until" + interval + " " + b + ")";
  }
}

std::vector<double> random_signal(size_t samples, std::mt19937& random) {
  std::vector<double> signal(samples);
  for (double& value : signal) value = static_cast<double>(random() % 9) - 4.0;
  return signal;
}

TEST(Robustness, EqualsItsDefinitionOnTenThousandRandomSignals) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 10'000; ++trial) {
    const size_t samples = 1 + random() % 8;
    const SampledSignals signals = sampled(1.0, random_signal(samples, random), random_signal(samples, random));
    const std::string text = random_formula(1 + trial % 3, random);
    const Formula formula = parse_formula(text);
    const Robustness fast = robustness(formula, signals);
    for (size_t i = 0; i < samples; ++i) {
      ASSERT_EQ(fast.value[i], by_definition(formula, signals, i)) << text << " at " << i;
    }
  }
}

/// The signals have the value at the decisive sample, for a formula of one comparison.
TEST(Robustness, DecisiveSampleHasTheValue) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const SampledSignals signals = sampled(1.0, random_signal(12, random), random_signal(12, random));
    for (const char* text : {"always[1,7] (north>=0)", "not eventually (north>=0)",
                             "always[0,4] eventually[1,3] (north>=0)", "(north>=0) until[1,5] (east>=0)"}) {
      const Robustness r = robustness(parse_formula(text), signals);
      const double north = signals.numbers.at("north")[r.decisive[0]], east = signals.numbers.at("east")[r.decisive[0]];
      ASSERT_TRUE(std::abs(r.value[0]) == std::abs(north) || r.value[0] == east) << text;
    }
  }
  const SampledSignals twice = sampled(1.0, {3, 1, 2, 1, 1}, {0, 0, 0, 0, 0});
  EXPECT_EQ(robustness(parse_formula("always (north>=0)"), twice).decisive[0], 1u);
}

/// A window of half the flight costs as much as one of two samples.
TEST(Robustness, CostIsIndependentOfTheWindow) {
  std::mt19937 random(3);
  const auto comparisons = [&](size_t samples, const std::string& formula) {
    const SampledSignals signals = sampled(1.0, random_signal(samples, random), random_signal(samples, random));
    return robustness(parse_formula(formula), signals).comparisons;
  };
  for (const char* window : {"[0,1]", "[500,9000]", "[0,end]"}) {
    EXPECT_LE(comparisons(20'000, std::string("always") + window + " (north>=0)"), 2u * 20'000) << window;
    EXPECT_LE(comparisons(20'000, std::string("(north>=0) until") + window + " (east>=0)"), 8u * 20'000) << window;
  }
}

TEST(Robustness, StatusIsInfiniteAndNanFails) {
  SampledSignals signals = sampled(1.0, {1, 1}, {0, 0});
  signals.status = {"cruise", "avoid"};
  const auto at_start = [&](const char* formula) { return robustness(parse_formula(formula), signals).value[0]; };
  EXPECT_EQ(at_start("status == cruise"), kInf);
  EXPECT_EQ(at_start("always (status == avoid -> north >= 0.25)"), 0.75);
  EXPECT_EQ(at_start("eventually (status != cruise)"), kInf);
  EXPECT_EQ(at_start("east / east >= 0"), -kInf);
}

}  // namespace
}  // namespace hedgehop::sim
