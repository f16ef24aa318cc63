#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/falsify/competition_score.h"
#include "sim/falsify/falsify.h"

namespace hedgehop::sim {

/// Runs of each test in the competition. (The reports of 2025 state three, its later rules five.)
inline constexpr size_t kRunsOfTest = 5;
/// Tests of a suite that the competition evaluates.
inline constexpr size_t kTestsOfSuite = 20;

/// A failing point of a search, flown again with seeds that the search did not use.
struct CompetitionTest {
  std::string name;
  size_t trial = 0;  ///< of the search
  std::vector<scenes::BoxConfig> boxes;
  std::vector<FlightRecord> records;  ///< one per run
  std::vector<CompetitionRun> runs;   ///< of the records with a result
  double mean_points = 0.0, score = 0.0;
  bool confirmed = false;      ///< every run was flown and is unsafe
  std::filesystem::path file;  ///< its scenario, if it is confirmed
};

/// Scores of several tests.
struct CompetitionScores {
  double failure = 0.0;             ///< sum of the tests' scores. Source: [KhatiriEtAl2025] eq. (3)
  std::optional<double> diversity;  ///< nullopt with fewer than two tests
};

/// The tests of a search and their scores.
struct CompetitionSuite {
  std::vector<CompetitionTest> tests;
  CompetitionScores of_confirmed, of_all;

  size_t confirmed() const;
};

/// Returns the number of tests that fly_suite() flies.
size_t suite_candidates(const FalsifyResult& result);

/// Flies the distinct failures of a search, the best 20, five times each, with the five seeds after the scenario's.
/// Returns nullopt if interrupted.
std::optional<CompetitionSuite> fly_suite(const FalsifySearch& search, const FalsifyResult& result,
                                          const FlyPoint& fly);

/// Writes counterexamples/<search>-<number>.yaml for each confirmed test: its first run, with `origin`.
/// @param search_file  path as the user gave it. @param out  the search's folder.
void write_tests(const std::string& search_file, const std::filesystem::path& out, CompetitionSuite& suite);

/// Returns the suite for falsify.json.
nlohmann::ordered_json suite_json(const CompetitionSuite& suite);

/// Returns the tests and scores as lines of text.
std::string suite_words(const CompetitionSuite& suite);

}  // namespace hedgehop::sim
