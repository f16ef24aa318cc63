#include "sim/falsify/competition_suite.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/config/whole_file.h"
#include "sim/falsify/box_constraints.h"
#include "sim/flight/build.h"
#include "sim/flight/flight.h"
#include "sim/sweep/plan.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

void score(CompetitionTest& test) {
  for (const FlightRecord& record : test.records) {
    if (record.result) test.runs.push_back(competition_run(record));
  }
  if (test.runs.empty()) return;
  for (const CompetitionRun& run : test.runs) test.mean_points += run_points(run.min_distance_m);
  test.mean_points /= static_cast<double>(test.runs.size());
  test.score = test_score(test.runs, test.boxes.size());
  test.confirmed = test.runs.size() == kRunsOfTest && std::ranges::all_of(test.runs, [](const CompetitionRun& run) {
                     return run.min_distance_m < kSafeDistanceM;
                   });
}

CompetitionScores scores_of(const std::vector<CompetitionTest>& tests, bool only_confirmed) {
  CompetitionScores scores;
  std::vector<std::vector<scenes::BoxConfig>> boxes;
  for (const CompetitionTest& test : tests) {
    if (only_confirmed && !test.confirmed) continue;
    scores.failure += test.score;
    boxes.push_back(test.boxes);
  }
  scores.diversity = diversity_score(boxes);
  return scores;
}

Json scores_json(const CompetitionScores& scores) {
  Json json{{"failure_score", scores.failure}, {"diversity_score", nullptr}};
  if (scores.diversity) json["diversity_score"] = *scores.diversity;
  return json;
}

std::string scores_words(const CompetitionScores& scores) {
  const std::string diversity = scores.diversity ? fmt::format("{:.2f}", *scores.diversity) : "- (needs two tests)";
  return fmt::format("failure score {:.2f}, diversity score {}", scores.failure, diversity);
}

std::vector<double> distances_m(const CompetitionTest& test) {
  std::vector<double> distances;
  for (const CompetitionRun& run : test.runs) distances.push_back(run.min_distance_m);
  return distances;
}

}  // namespace

size_t CompetitionSuite::confirmed() const {
  return static_cast<size_t>(std::ranges::count_if(tests, &CompetitionTest::confirmed));
}

size_t suite_candidates(const FalsifyResult& result) { return std::min(kTestsOfSuite, result.failures.size()); }

std::optional<CompetitionSuite> fly_suite(const FalsifySearch& search, const FalsifyResult& result,
                                          const FlyPoint& fly) {
  std::vector<size_t> trials = result.failures;
  std::ranges::stable_sort(trials, {}, [&](size_t trial) { return result.trials[trial].weakest.robustness; });
  trials.resize(suite_candidates(result));
  SweepConfig sweep = search.sweep;
  sweep.seeds = fmt::format("{}:{}", search.scenario.seed + 1, search.scenario.seed + kRunsOfTest);

  CompetitionSuite suite;
  std::vector<Order> orders;
  for (const size_t trial : trials) {
    const std::vector<std::string>& values = result.trials[trial].values;
    suite.tests.push_back(
        {.name = fmt::format("test{:02}", suite.tests.size() + 1), .trial = trial, .boxes = boxes_at(search, values)});
    for (Order& order : point_orders(sweep, values, suite.tests.back().name)) orders.push_back(std::move(order));
  }
  const std::optional<std::vector<FlightRecord>> records = orders.empty() ? std::vector<FlightRecord>{} : fly(orders);
  if (!records) return {};
  for (size_t i = 0; i < suite.tests.size(); ++i) {
    CompetitionTest& test = suite.tests[i];
    const auto first = records->begin() + static_cast<ptrdiff_t>(i * kRunsOfTest);
    test.records.assign(first, first + kRunsOfTest);
    score(test);
  }
  suite.of_confirmed = scores_of(suite.tests, true);
  suite.of_all = scores_of(suite.tests, false);
  return suite;
}

void write_tests(const std::string& search_file, const std::filesystem::path& out, CompetitionSuite& suite) {
  for (CompetitionTest& test : suite.tests) {
    if (!test.confirmed) continue;
    const FlightRecord& first = test.records.front();
    Scenario scenario = load_scenario(first.order.scenario, first.order.overrides);
    scenario.name = fmt::format("{}-{}", std::filesystem::path(search_file).stem().string(), test.name);
    scenario.seed = first.order.seed;
    scenario.origin = OriginConfig{.search = search_file,
                                   .failed = "distance",
                                   .trajectory_hash = first.result->flight.trajectory_hash,
                                   .version = std::string(version()),
                                   .robustness = test.runs.front().min_distance_m - kSafeDistanceM};
    test.file = std::filesystem::path("counterexamples") / (scenario.name + ".yaml");
    std::filesystem::create_directories(out / "counterexamples");
    write_file_whole(out / test.file, to_yaml(scenario));
  }
}

Json suite_json(const CompetitionSuite& suite) {
  Json json{{"runs_of_test", kRunsOfTest},         {"candidates", suite.tests.size()},
            {"confirmed", suite.confirmed()},      {"of_confirmed", scores_json(suite.of_confirmed)},
            {"of_all", scores_json(suite.of_all)}, {"tests", Json::array()}};
  for (const CompetitionTest& test : suite.tests) {
    Json one{{"name", test.name}, {"point", test.trial}, {"confirmed", test.confirmed}};
    for (const scenes::BoxConfig& box : test.boxes) {
      one["boxes"].push_back({{"north_m", box.north_m},
                              {"east_m", box.east_m},
                              {"length_m", box.length_m},
                              {"width_m", box.width_m},
                              {"heading_rad", box.heading_rad}});
    }
    one["runs"] = Json::array();
    for (const FlightRecord& record : test.records) {
      Json run{{"flight", record.order.id}, {"seed", record.order.seed}, {"outcome", outcome_words(record)}};
      if (record.result) {
        const CompetitionRun scored = competition_run(record);
        run["min_distance_m"] = scored.min_distance_m;
        run["time_s"] = scored.time_s;
        run["points"] = run_points(scored.min_distance_m);
      }
      one["runs"].push_back(std::move(run));
    }
    one["mean_points"] = test.mean_points;
    one["score"] = test.score;
    one["file"] = test.file.string();
    json["tests"].push_back(std::move(one));
  }
  return json;
}

std::string suite_words(const CompetitionSuite& suite) {
  std::string text;
  for (const CompetitionTest& test : suite.tests) {
    text += fmt::format("{}  {}: {:.2f} m, {:g} points, score {:.2f}\n", test.confirmed ? "FAIL" : "----", test.name,
                        fmt::join(distances_m(test), ", "), test.mean_points, test.score);
  }
  return text + fmt::format("confirmed: {} of {} tests, unsafe in each of {} runs: {}\nwith the other tests: {}\n",
                            suite.confirmed(), suite.tests.size(), kRunsOfTest, scores_words(suite.of_confirmed),
                            scores_words(suite.of_all));
}

}  // namespace hedgehop::sim
