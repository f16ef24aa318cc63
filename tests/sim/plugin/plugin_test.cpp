#include <gmock/gmock.h>
#include <sqlite3.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/batch/flight_table.h"
#include "sim/record/flight_columns.h"
#include "sim/scenario/validate.h"
#include "tests/sim/plugin/plugin_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(Plugin, FliesWithItsOwnParametersAndMetrics) {
  const CommandEnd end = run("speed: 0.5, list: [4, 5], word: abc, flag: true");
  EXPECT_EQ(end.status, 0) << end.err;
  const auto result = folder.json("out/result.json");
  EXPECT_EQ(result["metrics"]["module.parameters_sum"], 112.0);
  EXPECT_EQ(result["metrics"]["module.decisions_seen"], result["decisions"]);
  EXPECT_THAT(folder.read("out/scenario.yaml"), AllOf(HasSubstr("word: abc"), HasSubstr("list: [4, 5]")));
}

TEST_F(Plugin, ItsMetricsCannotPassForTheJudges) {
  const auto check = [](const std::string& name) {
    return "--set 'checks=[{check: metric, name: " + name + ", at_least: 0.9}]'";
  };
  EXPECT_EQ(run("speed: 0.5", check("corners_found")).status, 1);
  EXPECT_EQ(folder.json("out/result.json")["metrics"].count("corners_found"), 0U);
  EXPECT_EQ(run("speed: 0.5", check("module.corners_found")).status, 0);
}

TEST_F(Plugin, TheResolvedScenarioFliesTheSameAgain) {
  ASSERT_EQ(run("speed: 0.5, word: \"0x1\"").status, 0);
  const CommandEnd again = folder.hedgehop("run out/scenario.yaml --no-video --no-report --out again");
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(folder.json("out/result.json")["trajectory_hash"], folder.json("again/result.json")["trajectory_hash"]);
  EXPECT_EQ(folder.read("out/scenario.yaml"), folder.read("again/scenario.yaml"));
}

TEST_F(Plugin, ParametersAreReadAsStrictlyAsOurs) {
  const CommandEnd unknown = run("sped: 1");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("plug.yaml:4"), HasSubstr("did you mean 'speed'")));
  EXPECT_EQ(run("speed: -1").status, 2);
  EXPECT_EQ(run("how: somehow").status, 2);
  EXPECT_EQ(run("speed: 1", "--set avoidance.parameters.speed=fast").status, 2);
  EXPECT_THAT(run("speed: 1", "--set avoidance.parameters.sped=1").err,
              testing::StartsWith("--set avoidance.parameters.sped: "))
      << "and not a place in the file";
  const CommandEnd refused = run("how: refuse");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("how: not today"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST_F(Plugin, OneThatABatchCannotFlyIsRefusedAndTheOthersAreFlown) {
  const std::pair<std::string, std::string> ways[] = {{"missing.so", "plug.yaml:4:21: 'avoidance.plugin': "},
                                                      {HEDGEHOP_MISBEHAVING, "plug.yaml:4:"}};
  for (const auto& [library, words] : ways) {
    fly_by(library, "in_process: true, parameters: {sped: 1}");
    const CommandEnd end = folder.hedgehop("batch tiny.yaml plug.yaml --out out");
    EXPECT_EQ(end.status, 2) << end.out;
    EXPECT_THAT(end.err, HasSubstr(words));
    const auto flights = folder.json("out/batch.json")["flights"];
    EXPECT_EQ(flights[0]["passed"], true);
    EXPECT_EQ(flights[1]["id"], "plug/bad");
  }
}

TEST_F(Plugin, ErrorsOfItsParametersHaveTheLineOfTheCampaign) {
  folder.write("board.yaml",
               "tuned_on: none\nflights:\n  - scenario: tiny.yaml\n    seeds: 1\n    set:\n      - "
               "\"avoidance={plugin: " HEDGEHOP_MISBEHAVING ", module: misbehaving, parameters: {sped: 1}}\"\n");
  for (const char* command : {"validate board.yaml", "batch board.yaml --out out"}) {
    const CommandEnd end = folder.hedgehop(command);
    EXPECT_EQ(end.status, 2) << command;
    EXPECT_THAT(end.err, HasSubstr("board.yaml:6:9: unknown key 'sped' in 'avoidance.parameters'"));
  }
}

TEST_F(Plugin, OneThatFailsFailsItsFlightWithTheCauseAndKeepsTheFlownPart) {
  const std::pair<std::string, std::string> ways[] = {{"raise_exception", "no idea"},
                                                      {"segfault", "'misbehaving' crashed (Segmentation fault)"},
                                                      {"abort", "'misbehaving' crashed (Aborted)"},
                                                      {"recurse", "'misbehaving' crashed (Segmentation fault)"},
                                                      {"hang", "'misbehaving' did not return within 1 s"},
                                                      {"not_finite", "finite"}};
  for (const auto& [how, cause] : ways) {
    const CommandEnd end = run("how: " + how);
    EXPECT_EQ(end.status, 1) << how << end.err;
    const auto result = folder.json("out/result.json");
    EXPECT_EQ(result["outcome"], "fault") << how;
    EXPECT_THAT(result["cause"].get<std::string>(), HasSubstr(cause));
    EXPECT_EQ(result["decisions"], 2) << how;
  }
}

TEST_F(Plugin, FliesTheSameInTheSimulatorsProcess) {
  ASSERT_EQ(run("speed: 0.5").status, 0);
  const auto hash = folder.json("out/result.json")["trajectory_hash"];
  ASSERT_EQ(run("speed: 0.5", "--set avoidance.in_process=true").status, 0);
  EXPECT_EQ(folder.json("out/result.json")["trajectory_hash"], hash);
}

TEST_F(Plugin, ASignalCannotTakeAColumnOfTheRecord) {
  // The names are checked before the flight; decision_columns() has the reserved ones.
  const Table columns = decision_columns(Flight{});
  for (const std::string& column : columns.names()) {
    const avoidance::Signal signal{column, ""};
    EXPECT_THAT(signal_fault({&signal, 1}), HasSubstr("has the name of a column of decisions.csv")) << column;
  }
  for (const std::string name : {"", "a/b", "..", "two\nlines"}) {
    const avoidance::Signal signal{name, ""};
    EXPECT_NE(signal_fault({&signal, 1}), "") << name;
  }
  const avoidance::Signal twice[] = {{"gap_m", "m"}, {"gap_m", "m"}};
  EXPECT_THAT(signal_fault(twice), HasSubstr("occurs twice"));
}

TEST_F(Plugin, InABatchTheOthersFlyOn) {
  fly_by(HEDGEHOP_MISBEHAVING, "limit: 1, parameters: {how: segfault}");
  const CommandEnd end = folder.hedgehop("batch tiny.yaml plug.yaml --seeds 1:2 --out out");
  EXPECT_EQ(end.status, 1) << end.err;
  const auto batch = folder.json("out/batch.json");
  ASSERT_EQ(batch["flights"].size(), 4u);
  for (const auto& flight : batch["flights"]) {
    const bool ours = flight["group"] == "tiny";
    EXPECT_EQ(flight["result"]["outcome"] == "fault", !ours) << flight["id"];
    EXPECT_EQ(flight["passed"], ours);
  }
}

TEST_F(Plugin, NamesThatDifferOnlyInCaseAreBothInASweepsTables) {
  fly_by(HEDGEHOP_MISBEHAVING, "limit: 1, parameters: {}");
  folder.write("sweep.yaml",
               "scenario: plug.yaml\nseeds: 1:2\ndesign: {type: grid}\n"
               "parameters: [{path: avoidance.parameters.speed, values: [0.5, 1]}]\n");
  const CommandEnd end = folder.hedgehop("sweep sweep.yaml --out out");
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(folder.read("out/sweep.csv"), AllOf(HasSubstr("metric.module.AA"), HasSubstr("metric.module.aa")));
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder.path() / "out/sweep.sqlite").c_str(), &database), SQLITE_OK);
  sqlite3_stmt* statement = nullptr;
  const char* const columns = R"(SELECT "metric.module.AA", "metric.module.aa_2" FROM flights)";
  ASSERT_EQ(sqlite3_prepare_v2(database, columns, -1, &statement, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
  int flights = 0;
  for (; sqlite3_step(statement) == SQLITE_ROW; ++flights) {
    EXPECT_EQ(sqlite3_column_double(statement, 0), 1.0);
    EXPECT_EQ(sqlite3_column_double(statement, 1), 2.0);
  }
  EXPECT_EQ(flights, 4);
  sqlite3_finalize(statement);
  sqlite3_close(database);
}

TEST_F(Plugin, AnotherInterfaceNoPluginAndNoFileAreTold) {
  const auto told = [&](const std::string& library, const std::string& words) {
    fly_by(library, "parameters: {}");
    const CommandEnd end = folder.hedgehop("run plug.yaml --no-video --out out");
    EXPECT_EQ(end.status, 2);
    EXPECT_THAT(end.err, AllOf(HasSubstr(library), HasSubstr(words)));
    EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
  };
  told(HEDGEHOP_OLD, "built against another interface (modules 0)");
  told("missing.so", "no such file");
  told(folder.write("text.so", "no library").string(), "cannot be loaded");
  fly_by(HEDGEHOP_MISBEHAVING, "parameters: {}");
  const CommandEnd misspelt = folder.hedgehop("run plug.yaml --set avoidance.module=misbehavin --no-video --out out");
  EXPECT_EQ(misspelt.status, 2) << misspelt.out;
}

/// As a user would: install, build the documentation's example in a folder of its own, fly it with the installed
/// package.
TEST_F(Plugin, TheExampleBuildsAgainstTheInstalledPackageAndFlies) {
  const CommandEnd installed =
      folder.shell("cmake --install '" HEDGEHOP_BUILD_DIR "' --prefix '" + (folder.path() / "prefix").string() + "'");
  ASSERT_EQ(installed.status, 0) << installed.err;
  const CommandEnd built =
      folder.shell("cmake -G Ninja -S '" HEDGEHOP_SOURCE_DIR
                   "/docs/keep_left' -B build -DCMAKE_PREFIX_PATH=\"$PWD/prefix\" && cmake --build build");
  ASSERT_EQ(built.status, 0) << built.out << built.err;
  folder.write("left.yaml",
               "use: tiny.yaml\nname: left\navoidance: {plugin: build/libkeep_left.so, module: keep_left, "
               "parameters: {speed: 0.5}}\n");
  const CommandEnd end = folder.shell("prefix/bin/hedgehop run left.yaml --no-video --out out");
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(folder.json("out/result.json")["metrics"]["module.images"], folder.json("out/result.json")["decisions"]);
}

}  // namespace
}  // namespace hedgehop::sim
