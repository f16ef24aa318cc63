#include "sim/campaign/subset_simulation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "sim/campaign/statistics.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;

/// The normal numbers of a blend, from streams of their own.
class Numbers {
 public:
  explicit Numbers(size_t count) : count_(count) {}
  std::vector<double> of(const Chance& chance) {
    std::vector<double> blended(count_, 0.0);
    for (const BlendTerm& term : chance.blend) {
      const std::vector<double>& z = stream(term.seed);
      for (size_t i = 0; i < count_; ++i) blended[i] += term.weight * z[i];
    }
    return blended;
  }

 private:
  const std::vector<double>& stream(uint64_t seed) {
    std::vector<double>& z = streams_[seed];
    if (z.empty()) {
      std::mt19937_64 generator(seed);
      std::normal_distribution<double> normal;
      for (size_t i = 0; i < count_; ++i) z.push_back(normal(generator));
    }
    return z;
  }
  size_t count_;
  std::map<uint64_t, std::vector<double>> streams_;
};

using Margin = std::function<double(const std::vector<double>&)>;

/// A rare event with a probability that is known.
struct Problem {
  size_t numbers;
  Margin margin;
  double probability;
};

Problem sum_of_many() {  // Phi(-3.5)
  return {1000, [](const std::vector<double>& z) { return 3.5 - std::reduce(z.begin(), z.end()) / std::sqrt(1000.0); },
          2.326291e-4};
}
Problem twenty_regions() {  // 1 - (2 Phi(4.5) - 1)^10
  return {10,
          [](const std::vector<double>& z) {
            double greatest = 0.0;
            for (const double x : z) greatest = std::max(greatest, std::abs(x));
            return 4.5 - greatest;
          },
          6.795138e-5};
}
/// First passage of a stationary Gauss-Markov process; its probability by quadrature.
Problem first_passage(double limit, double probability) {
  return {301,
          [limit](const std::vector<double>& z) {
            const double a = std::exp(-0.1), b = std::sqrt(1.0 - a * a);
            double x = z[0], greatest = z[0];
            for (size_t i = 1; i < z.size(); ++i) greatest = std::max(greatest, x = a * x + b * z[i]);
            return limit - greatest;
          },
          probability};
}

SubsetRun simulate(const Problem& problem, size_t samples, uint64_t seed, size_t number = 0) {
  Numbers numbers(problem.numbers);
  const FlyMargins fly = [&](const std::vector<SubsetSample>& some) {
    std::vector<double> margins;
    for (const SubsetSample& sample : some) margins.push_back(problem.margin(numbers.of(sample.chance)));
    return std::optional(margins);
  };
  return *simulate_subsets({.samples = samples, .seed = seed}, number, fly);
}

/// Twenty runs of 500: their mean lies within 0.75 to 1.35 of the truth, some three standard errors on either side.
class SubsetSimulation : public ::testing::TestWithParam<Problem> {};
TEST_P(SubsetSimulation, FindsTheKnownProbability) {
  constexpr int kRuns = 20;
  const Problem& problem = GetParam();
  double mean = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    mean += *simulate(problem, 500, 1101, static_cast<size_t>(run)).probability / kRuns;
  }
  EXPECT_GT(mean / problem.probability, 0.75);
  EXPECT_LT(mean / problem.probability, 1.35);
}
INSTANTIATE_TEST_SUITE_P(Problems, SubsetSimulation,
                         ::testing::Values(sum_of_many(), twenty_regions(), first_passage(4.5, 6.714918e-4),
                                           first_passage(4.0, 5.587718e-3), first_passage(3.0, 0.159137)));

/// How many intervals of five runs hold the truth.
int held(const Problem& problem, size_t samples, uint64_t repeats) {
  int held = 0;
  for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
    std::vector<SubsetRun> runs;
    for (size_t run = 0; run < 5; ++run) runs.push_back(simulate(problem, samples, 1101 + repeat, run));
    const SubsetEstimate estimate = combine(runs);
    held += estimate.low <= problem.probability && problem.probability <= estimate.high ? 1 : 0;
  }
  return held;
}

/// By the reference, 45 of 50 held the truth.
TEST(SubsetEstimate, HoldsTheTruthAboutAsOftenAsItClaims) {
  EXPECT_GE(held(first_passage(4.5, 6.714918e-4), 200, 20), 16);  // P(fewer) = 1.6 % at 95 %, 13 % at 90 %
}

/// A minute: by name, with --gtest_also_run_disabled_tests.
TEST(SubsetEstimate, DISABLED_HoldsTheTruthIn95Of100) {
  int all = 0;
  for (const Problem& problem : {sum_of_many(), twenty_regions(), first_passage(4.5, 6.714918e-4)}) {
    const int here = held(problem, 500, 100);
    std::printf("%d of 100\n", here);
    all += here;
  }
  EXPECT_GE(all, 278);  // of 300; P(fewer) = 3 % at 95 %
}

/// The spread of runs lies between the two coefficients that one run predicts.
TEST(SubsetSimulation, PredictsItsSpread) {
  const Problem problem = first_passage(4.5, 6.714918e-4);
  std::vector<SubsetRun> runs;
  double low = 0.0, high = 0.0;
  constexpr size_t kRuns = 40;
  for (size_t run = 0; run < kRuns; ++run) {
    runs.push_back(simulate(problem, 500, 1102, run));
    low += runs.back().cov_low / kRuns;
    high += runs.back().cov_high / kRuns;
  }
  const double cov = combine(runs).cov;
  EXPECT_GT(cov, 0.6 * low);
  EXPECT_LT(cov, 1.3 * high);
  // A third of what counting so many flights would have.
  const double flights = static_cast<double>(runs[0].samples.size());
  EXPECT_LT(cov, 0.7 * std::sqrt((1.0 - problem.probability) / (problem.probability * flights)));
}

TEST(SubsetSimulation, SameRunForTheSameSeedAndAnotherForAnother) {
  const Problem problem = first_passage(4.0, 5.587718e-3);
  EXPECT_EQ(simulate(problem, 200, 5).probability, simulate(problem, 200, 5).probability);
  EXPECT_NE(simulate(problem, 200, 5).probability, simulate(problem, 200, 6).probability);
}

/// 10,000 numbers of a blend of steps are standard normal, and correlate with a term's by its weight.
TEST(Chance, BlendsAreStandardNormal) {
  Chance chance = Chance::of_seed(1);
  for (uint64_t seed = 2; seed <= 17; ++seed) chance = chance.step(0.3, seed);
  ASSERT_EQ(chance.blend.size(), 17u);
  double squares = 0.0;
  for (const BlendTerm& term : chance.blend) squares += term.weight * term.weight;
  EXPECT_NEAR(squares, 1.0, 1e-12);
  Numbers numbers(10'000);
  const std::vector<double> z = numbers.of(chance);
  const double mean = std::reduce(z.begin(), z.end()) / 1e4;
  EXPECT_NEAR(mean, 0.0, 0.04);
  EXPECT_NEAR(std::inner_product(z.begin(), z.end(), z.begin(), 0.0) / 1e4, 1.0, 0.06);
  for (const BlendTerm& term : chance.blend) {
    const std::vector<double> alone = numbers.of(Chance::of_seed(term.seed));
    EXPECT_NEAR(std::inner_product(z.begin(), z.end(), alone.begin(), 0.0) / 1e4, term.weight, 0.04);
  }
}

TEST(SubsetSimulation, RefusesTiesAndWhatNeverHappens) {
  const Problem tied{1, [](const std::vector<double>& z) { return z[0] > 2.0 ? -1.0 : 1.0; }, 0.0};
  EXPECT_THAT(simulate(tied, 100, 1).fault, HasSubstr("have the same margin, 1"));
  const Problem never{1, [](const std::vector<double>& z) { return 100.0 - z[0]; }, 0.0};
  const SubsetRun run = simulate(never, 100, 1);
  EXPECT_FALSE(run.probability);
  EXPECT_THAT(run.fault, HasSubstr("no event in 8 levels"));
}

TEST(SubsetSimulation, StopsWhenInterrupted) {
  int batches = 0;
  const FlyMargins fly = [&](const std::vector<SubsetSample>& some) -> std::optional<std::vector<double>> {
    if (++batches == 3) return {};
    std::vector<double> margins;
    for (size_t i = 0; i < some.size(); ++i) margins.push_back(1.0 + static_cast<double>(i));
    return margins;
  };
  EXPECT_FALSE(simulate_subsets({.samples = 100, .seed = 1}, 0, fly));
  EXPECT_EQ(batches, 3);
}

}  // namespace
}  // namespace hedgehop::sim
