#include <gmock/gmock.h>
#include <sqlite3.h>

#include <csignal>

#include "sim/record/table.h"
#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Sweep : public ::testing::Test {
 protected:
  Sweep() {
    folder.write("sweep.yaml",
                 "scenario: tiny.yaml\nseeds: 1:2\ndesign: {type: grid}\nparameters:\n"
                 "  - {path: avoidance.speed, from: 0.5, to: 2, count: 3}\n"
                 "  - {path: control_rate, values: [50, 100]}\n");
  }
  CampaignFolder folder;
};

TEST_F(Sweep, GridFliesEveryCombinationAndSeed) {
  const CommandEnd end = folder.hedgehop("sweep sweep.yaml --out out");
  ASSERT_EQ(end.status, 0) << end.err;
  const Table table(folder.path() / "out/sweep.csv");
  ASSERT_EQ(table.rows(), 12u);
  EXPECT_THAT(table.numbers("avoidance.speed"), ElementsAre(.5, .5, .5, .5, 1.25, 1.25, 1.25, 1.25, 2, 2, 2, 2));
  EXPECT_THAT(table.numbers("control_rate"), ElementsAre(50, 50, 100, 100, 50, 50, 100, 100, 50, 50, 100, 100));
  EXPECT_THAT(table.numbers("seed"), ElementsAre(1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2));
  EXPECT_EQ(table.words("command")[4],
            "hedgehop run tiny.yaml --seed 1 --set avoidance.speed=1.25 --set control_rate=50");
}

TEST_F(Sweep, SqliteHoldsTheSameTableAsTheCsv) {
  ASSERT_EQ(folder.hedgehop("sweep sweep.yaml --out out").status, 0);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder.path() / "out/sweep.sqlite").c_str(), &database), SQLITE_OK);
  sqlite3_stmt* statement = nullptr;
  ASSERT_EQ(sqlite3_prepare_v2(database, "SELECT path_length_m, trajectory_hash FROM flights", -1, &statement, nullptr),
            SQLITE_OK);
  const Table table(folder.path() / "out/sweep.csv");
  size_t row = 0;
  for (; sqlite3_step(statement) == SQLITE_ROW; ++row) {
    ASSERT_LT(row, table.rows());
    EXPECT_EQ(sqlite3_column_double(statement, 0), table.numbers("path_length_m")[row]);
    EXPECT_EQ(reinterpret_cast<const char*>(sqlite3_column_text(statement, 1)), table.words("trajectory_hash")[row]);
  }
  EXPECT_EQ(row, table.rows());
  sqlite3_finalize(statement);
  sqlite3_close(database);
}

/// A worker kills the sweep with SIGKILL, so the sweep cannot write anything before it ends.
TEST_F(Sweep, ResumedAfterAKillItWritesTheSameTable) {
  ASSERT_EQ(folder.hedgehop("sweep sweep.yaml --out whole").status, 0);
  const std::string worker = folder.worker(
      "n=1; while ! mkdir flown$n 2>/dev/null; do n=$((n + 1)); done\n"  // no two flights have the same number
      "[ $n = 2 -o $n = 5 -o $n = 9 ] && kill -KILL $PPID; fly \"$@\"");
  const std::string command = "sweep sweep.yaml --out torn -j 2 --program " + worker;
  for (int i = 0; i < 3; ++i) EXPECT_NE(folder.hedgehop(command).status, 0);
  EXPECT_EQ(folder.hedgehop(command).status, 0);
  EXPECT_EQ(lasting_columns(folder.read("torn/sweep.csv")), lasting_columns(folder.read("whole/sweep.csv")));
  // Each kill loses at most the two flights in the air.
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "flown19"));  // 12 and 3 times 2
}

/// As in a batch, each flight and each of its checks is a test case. The crash of a worker is an error of its flight.
TEST_F(Sweep, JunitHasACaseForEachFlightAndCheck) {
  const std::string worker = folder.worker(
      "case \"$*\" in *'seed 2 --set avoidance.speed=0.5 --set control_rate=100 '*) echo broken >&2; exit 3 ;; "
      "esac; fly \"$@\"");
  EXPECT_EQ(folder.hedgehop("sweep sweep.yaml --out out --junit ci/j.xml --program " + worker).status, 1);
  const std::string cases = junit_cases(folder, "ci/j.xml");
  EXPECT_EQ(std::ranges::count(cases, '\n'), 2 * (12 + 11)) << cases;  // one more line per flight for its figures
  EXPECT_THAT(cases, ContainsRegex("flights/[a-p][0-9a-f]{11}-seed2/flight error exit status 3: broken\n"));
  EXPECT_THAT(cases, ContainsRegex("-seed1/no_collision\n  0.7[0-9]* m at [0-9.]+ s, must be > 0 m"));
  EXPECT_THAT(cases,
              HasSubstr("re-run: hedgehop run tiny.yaml --seed 1 --set avoidance.speed=2 --set control_rate=100"));
  const std::string script = folder.hedgehop("sweep sweep.yaml --out out --junit ci/j.xml --on slurm --dry-run").out;
  EXPECT_THAT(script, HasSubstr("--merge --junit " + (folder.path() / "ci/j.xml").string() + "\n"));
}

TEST_F(Sweep, MergedShardsEqualTheWhole) {
  ASSERT_EQ(folder.hedgehop("sweep sweep.yaml --out whole").status, 0);
  for (const std::string shard : {"1/3", "2/3", "3/3"}) {
    ASSERT_EQ(folder.hedgehop("sweep sweep.yaml --shard " + shard + " --out part" + shard.substr(0, 1)).status, 0);
  }
  EXPECT_EQ(folder.hedgehop("sweep sweep.yaml --missing --out part1").out, "8\n");
  EXPECT_EQ(folder.hedgehop("sweep sweep.yaml --missing --out part1 --from part2").out, "4\n");
  EXPECT_EQ(folder.hedgehop("sweep sweep.yaml --merge --out merged --from part1 --from part3").status, 1);
  ASSERT_EQ(folder.hedgehop("sweep sweep.yaml --merge --out merged --from part1 --from part2 --from part3").status, 0);
  EXPECT_EQ(lasting_columns(folder.read("merged/sweep.csv")), lasting_columns(folder.read("whole/sweep.csv")));
}

TEST_F(Sweep, RejectsUnknownPathsBeforeAnyFlightWithTheNearestKey) {
  folder.write("bad.yaml",
               "scenario: tiny.yaml\nparameters:\n  - {path: avoidance.sped, values: [1]}\n"
               "  - {path: control_rate, values: [50, 0.5]}\n");
  const CommandEnd end = folder.hedgehop("sweep bad.yaml --out out");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr("bad.yaml:3:12: unknown key 'sped' in 'avoidance'; did you mean 'speed'?"));
  EXPECT_THAT(end.err, HasSubstr("bad.yaml:4:12: 'control_rate' expects a whole number"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  folder.write("bad.yaml", "scenario: tiny.yaml\nparameters:\n  - {path: seed, values: [1]}\n");
  EXPECT_THAT(folder.hedgehop("sweep bad.yaml --out out").err, HasSubstr("bad.yaml:3:5: 'seed': varied by 'seeds'"));
  folder.write("bad.yaml",
               "scenario: tiny.yaml\nseeds: 1:3\ntuned_on: 1:2\nparameters:\n  - {path: control_rate, values: [50]}\n");
  EXPECT_THAT(folder.hedgehop("sweep bad.yaml --out out").err, HasSubstr("bad.yaml:2:8: seeds '1:3' are not all of"));
}

TEST_F(Sweep, ListsTheFaultsOfItsFileItsOverridesAndItsParametersTogether) {
  const auto lines = [&](const std::string& rest) {
    folder.write("bad.yaml", "scenario: tiny.yaml\nset: [drawing.contxt=tiles]\n" + rest);
    const CommandEnd end = folder.hedgehop("sweep bad.yaml --out out");
    EXPECT_EQ(end.status, 2);
    EXPECT_THAT(end.err, HasSubstr("bad.yaml:2:7: unknown key 'contxt'"));
    EXPECT_EQ(std::ranges::count(end.err, '\n'), 2) << end.err;
    return end.err;
  };
  EXPECT_THAT(lines("parameters:\n  - {path: avoidance.sped, values: [1, 2]}\n"),
              HasSubstr("bad.yaml:4:12: unknown key"));
  EXPECT_THAT(lines("design: grid\nparameters:\n  - {path: avoidance.speed, values: [1, 2]}\n"),
              HasSubstr("bad.yaml:3:9: 'design' expects a map of keys, such as {type: grid}"));
  EXPECT_THAT(lines("parameters:\n  - {path: avoidance.speed, from: 1, to: 2}\n"),
              HasSubstr("bad.yaml:4:5: 'avoidance.speed': a grid needs 'count' >= 2"));
}

/// The maximum allowed speed brings the vehicle closest to the goal within one second.
TEST_F(Sweep, OptimizerFindsTheEndOfAMonotoneCost) {
  folder.write("best.yaml",
               "scenario: tiny.yaml\nseeds: 1:2\nset: [duration=1]\n"
               "design: {type: optimize, minimize: goal_distance_m, evaluations: 12}\n"
               "parameters: [{path: avoidance.speed, from: 0.2, to: 1}]\n");
  const CommandEnd end = folder.hedgehop("sweep best.yaml --out out");
  ASSERT_EQ(end.status, 0) << end.err;
  const auto optimum = folder.json("out/optimum.json");
  EXPECT_GT(std::stod(optimum.at("values").at("avoidance.speed").get<std::string>()), 0.95);
  const Table table(folder.path() / "out/sweep.csv");
  double best = 1e9;
  const auto distances = table.numbers("goal_distance_m");
  for (size_t i = 0; i < distances.size(); i += 2) best = std::min(best, 0.5 * (distances[i] + distances[i + 1]));
  EXPECT_NEAR(optimum.at("cost").get<double>(), best, 1e-12);
}

TEST_F(Sweep, DesignThatIsAWordIsRefusedWithTheMapToWrite) {
  folder.write("word.yaml",
               "scenario: tiny.yaml\ndesign: grid\nparameters: [{path: avoidance.speed, values: [0.2, 1]}]\n");
  EXPECT_THAT(folder.hedgehop("sweep word.yaml --out out").err,
              HasSubstr("word.yaml:2:9: 'design' expects a map of keys, such as {type: grid}, got 'grid'\n"));
  EXPECT_THAT(folder.hedgehop("sweep word.yaml --renderer tiles").err,
              HasSubstr("unknown option '--renderer'; use --set drawing.renderer=tiles (see --help)\n"));
}

TEST_F(Sweep, OptimizerRejectsAnUnknownColumnBeforeItsFirstPoint) {
  folder.write("best.yaml",
               "scenario: tiny.yaml\nset: [duration=1]\n"
               "design: {type: optimize, minimize: goal_distance, evaluations: 12}\n"
               "parameters: [{path: avoidance.speed, from: 0.2, to: 1}]\n");
  const CommandEnd end = folder.hedgehop("sweep best.yaml --out out");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr("best.yaml:3:36: no column 'goal_distance'; did you mean 'goal_distance_m'?"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  folder.shell("sed -i s/goal_distance,/jerk_rms,/ best.yaml");
  EXPECT_THAT(folder.hedgehop("sweep best.yaml --out out").err,
              HasSubstr("best.yaml:3:36: no column 'jerk_rms'; did you mean 'metric.jerk_rms'?"));
}

/// No flight of 0.1 s reaches the goal, and only flights that do have a path excess.
TEST_F(Sweep, OptimizerCountsAnAbsentMetricAsFailureCost) {
  const auto best = [&](const std::string& column) {
    folder.write("best.yaml", "scenario: tiny.yaml\ndesign: {type: optimize, minimize: " + column +
                                  ", evaluations: 3, failure_cost: 70}\n"
                                  "parameters: [{path: avoidance.speed, from: 0.2, to: 1}]\n");
    return folder.hedgehop("sweep best.yaml --out " + column);
  };
  const CommandEnd end = best("metric.path_excess");
  EXPECT_EQ(end.status, 1) << end.err;
  EXPECT_THAT(end.out, HasSubstr("no point has a mean below failure_cost: flights fail or lack metric.path_excess\n"));
  EXPECT_EQ(folder.json("metric.path_excess/optimum.json").at("cost"), 70);
  EXPECT_EQ(Table(folder.path() / "metric.path_excess/sweep.csv").rows(), 3u);
  const CommandEnd unknown = best("metric.module.nope");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("'design.minimize': no column 'metric.module.nope'"));
  EXPECT_EQ(Table(folder.path() / "metric.module.nope/sweep.csv").rows(), 1u);
}

TEST_F(Sweep, OptimizerStatesWhyItEndedEarly) {
  folder.write("best.yaml",
               "scenario: tiny.yaml\nset: [duration=1]\n"
               "design: {type: optimize, minimize: goal_distance_m, evaluations: 1000, method: nelder_mead}\n"
               "parameters: [{path: avoidance.speed, from: 0.2, to: 0.3}]\n");
  const CommandEnd end = folder.hedgehop("sweep best.yaml --out out");
  EXPECT_THAT(end.out, ContainsRegex("[0-9]+ points flown of up to 1000 \\(converged to 0.0001 of each range\\)"));
}

TEST_F(Sweep, InterruptedOptimizerKeepsTheTableOfItsPoints) {
  folder.write("best.yaml",
               "scenario: tiny.yaml\nset: [duration=1]\n"
               "design: {type: optimize, minimize: goal_distance_m, evaluations: 12}\n"
               "parameters: [{path: avoidance.speed, from: 0.2, to: 1}]\n");
  const std::string worker = folder.worker(
      "echo x >> flown.txt; if [ $(wc -l < flown.txt) = 3 ]; then kill -INT $PPID; exec sleep 1000; fi; fly \"$@\"");
  const CommandEnd end = folder.hedgehop("sweep best.yaml --out out -j 1 --program " + worker);
  EXPECT_EQ(end.status, 128 + SIGINT) << end.err;
  EXPECT_EQ(Table(folder.path() / "out/sweep.csv").rows(), 2u);
}

TEST_F(Sweep, SlurmScriptFliesOneShardPerTask) {
  const CommandEnd end = folder.hedgehop("sweep sweep.yaml --out out --on slurm --dry-run --tasks 5 -j 2");
  EXPECT_EQ(end.status, 0);
  EXPECT_THAT(end.out, HasSubstr("#SBATCH --array=1-5\n"));
  EXPECT_THAT(end.out, HasSubstr("--shard $SLURM_ARRAY_TASK_ID/5 -j 2\n"));
  EXPECT_EQ(folder
                .shell("hedgehop() { " HEDGEHOP_PROGRAM " \"$@\"; }; hedgehop sweep sweep.yaml --out out --on slurm "
                       "--dry-run | bash -n")
                .status,
            0);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace hedgehop::sim
