// Subset simulation of whole flights against as many plain flights as it saves. Minutes to an hour: run by name, with
// --gtest_also_run_disabled_tests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <thread>
#include <vector>

#include "sim/campaign/statistics.h"
#include "sim/campaign/subset_simulation.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim {
namespace {

constexpr double kLimitM = 0.85;

double margin_of(const Scenario& alley, const Chance& chance) {
  Scenario scenario = alley;
  scenario.seed = chance.seed;
  for (const BlendTerm& term : chance.blend) scenario.chance.push_back({term.seed, term.weight});
  return Simulation(std::move(scenario)).run().result.closest_obstacle.distance_m - kLimitM;
}

std::vector<double> margins_of(const Scenario& alley, const std::vector<Chance>& chances) {
  std::vector<double> margins(chances.size());
  const size_t threads = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> pool;
  for (size_t first = 0; first < threads; ++first) {
    pool.emplace_back([&, first] {
      for (size_t i = first; i < chances.size(); i += threads) margins[i] = margin_of(alley, chances[i]);
    });
  }
  pool.clear();
  return margins;
}

Scenario alley() { return load_scenario(std::string(HEDGEHOP_SOURCE_DIR) + "/configs/estimate/alley.yaml"); }

/// Both 95 % intervals of the probability must have a part in common.
void compare(size_t plain_flights, size_t samples, size_t runs) {
  const Scenario scenario = alley();
  std::vector<Chance> plain;
  for (size_t i = 0; i < plain_flights; ++i) plain.push_back(Chance::of_seed(1'000'001 + i));
  const std::vector<double> margins = margins_of(scenario, plain);
  const Count count{std::ranges::count_if(margins, [](double m) { return m <= 0.0; }),
                    static_cast<int64_t>(plain_flights)};
  const Interval counted = wilson_interval(count, kTableConfidence);

  std::vector<SubsetRun> estimates;
  size_t flights = 0;
  for (size_t run = 0; run < runs; ++run) {
    estimates.push_back(*simulate_subsets({.samples = samples, .seed = 1101}, run, [&](const auto& wanted) {
      std::vector<Chance> chances;
      for (const SubsetSample& sample : wanted) chances.push_back(sample.chance);
      return std::optional(margins_of(scenario, chances));
    }));
    flights += estimates.back().samples.size();
  }
  const SubsetEstimate estimate = combine(estimates);
  std::printf("counted %ld of %ld: %.3g, 95 %% within %.3g to %.3g\n", count.successes, count.trials, count.rate(),
              counted.low, counted.high);
  std::printf("estimated from %zu flights: %.3g, 95 %% within %.3g to %.3g; c.o.v. of one run %.2f\n", flights,
              estimate.mean, estimate.low, estimate.high, estimate.cov);
  EXPECT_LE(estimate.low, counted.high);
  EXPECT_GE(estimate.high, counted.low);
}

TEST(EstimateAgainstCount, DISABLED_OfFiveThousandFlights) { compare(5'000, 100, 4); }
TEST(EstimateAgainstCount, DISABLED_OfAHundredThousandFlights) { compare(100'000, 400, 5); }

}  // namespace
}  // namespace hedgehop::sim
