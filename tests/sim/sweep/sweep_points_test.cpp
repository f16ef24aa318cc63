#include <gmock/gmock.h>

#include "sim/record/table.h"
#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class PointsOfASweep : public ::testing::Test {
 protected:
  /// Writes a sweep of the tiny scenario over one list of speeds.
  void write(const std::string& speeds, const std::string& seeds = "1:2") const {
    folder.write("s.yaml", "scenario: tiny.yaml\nseeds: " + seeds +
                               "\ndesign: {type: grid}\nparameters:\n  - {path: avoidance.speed, values: [" + speeds +
                               "]}\n");
  }
  std::string missing(const std::string& speeds, const std::string& seeds = "1:2") const {
    write(speeds, seeds);
    return folder.hedgehop("sweep s.yaml --out out --missing").out;
  }
  CommandEnd sweep(const std::string& parameters, const std::string& options = "--missing") const {
    folder.write("s.yaml", "scenario: tiny.yaml\nseeds: 1\ndesign: {type: grid}\nparameters:\n" + parameters);
    return folder.hedgehop("sweep s.yaml --out out " + options);
  }
  CampaignFolder folder;
};

TEST_F(PointsOfASweep, KeepTheirFlightsWhereverTheyStandInTheFile) {
  write("0.5, 1");
  ASSERT_EQ(folder.hedgehop("sweep s.yaml --out out").status, 0);
  EXPECT_EQ(missing("0.5, 1, 2"), "2\n");
  EXPECT_EQ(missing("0.25, 0.5, 1"), "2\n");
  EXPECT_EQ(missing("1"), "0\n");
  EXPECT_EQ(missing("0.50, 1.0"), "0\n");
  EXPECT_EQ(missing("0.5, 1", "1:3"), "2\n");
  write("0.25, 0.5, 1");
  ASSERT_EQ(folder.hedgehop("sweep s.yaml --out out").status, 0);
  const Table table(folder.path() / "out/sweep.csv");
  EXPECT_THAT(table.numbers("avoidance.speed"), ElementsAre(.25, .25, .5, .5, 1, 1));
  const auto points = table.words("point");
  EXPECT_EQ(points[2], points[3]);
  EXPECT_NE(points[2], points[4]);
}

TEST_F(PointsOfASweep, OfEqualContentAreFlownOnceAndReported) {
  CommandEnd end = sweep("  - {path: avoidance.speed, values: [1, 1.0, 1e0, 2]}\n");
  EXPECT_EQ(end.out, "2\n");
  EXPECT_THAT(end.err, HasSubstr("s.yaml: 2 of 4 points repeat an earlier point and are flown once: "
                                 "avoidance.speed=1.0, avoidance.speed=1e0"));
  end = sweep("  - {path: rig.cameras.0.width, from: 62, to: 66, count: 9, whole: true}\n");
  EXPECT_EQ(end.out, "5\n");
  EXPECT_THAT(end.err, HasSubstr("s.yaml:5:12: 'rig.cameras.0.width': 4 of 9 values are rounded to another value: "
                                 "62.5 to 63, 63.5 to 64, 64.5 to 65, ..."));
}

TEST_F(PointsOfASweep, WithAParameterWithoutEffectAreRefused) {
  const CommandEnd end = sweep(
      "  - {path: start.north, values: [0, 1]}\n"
      "  - {path: start, values: [{north: 0.5, east: 0, altitude: 1}, {north: 0.2, east: 0, altitude: 1}]}\n");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr("s.yaml:5:12: 'start.north' has no effect: 'start' overrides it"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST_F(PointsOfASweep, WithAKeyWithoutEffectAreRefused) {
  EXPECT_THAT(sweep("  - {path: avoidance.speed, values: [1, 2], scale: log, whole: true}\n").err,
              HasSubstr("s.yaml:5:5: 'avoidance.speed': 'scale' and 'whole' are for a range"));
  folder.write("s.yaml",
               "scenario: tiny.yaml\ndesign: {type: random, points: 3}\n"
               "parameters:\n  - {path: avoidance.speed, from: 1, to: 2, count: 7}\n");
  EXPECT_THAT(folder.hedgehop("sweep s.yaml --out out").err,
              HasSubstr("s.yaml:4:5: 'avoidance.speed': 'count' is for a grid"));
}

TEST_F(PointsOfASweep, WithMapsAndNullAreFlown) {
  const CommandEnd end = sweep(
      "  - {path: start, values: [{north: 0, east: 0, altitude: 1}, {north: 0.1, east: 0, altitude: 1.1}]}\n"
      "  - {path: rig.cameras.0.imperfections, values: [null, {drop: 0.2}]}\n",
      "");
  EXPECT_EQ(end.status, 0) << end.err;
  const Table table(folder.path() / "out/sweep.csv");
  ASSERT_EQ(table.rows(), 4u);
  EXPECT_EQ(table.words("start")[2], "{north: 0.1, east: 0, altitude: 1.1}");
  EXPECT_THAT(table.words("rig.cameras.0.imperfections"), ElementsAre("null", "{drop: 0.2}", "null", "{drop: 0.2}"));
  EXPECT_EQ(
      folder.shell(std::string(HEDGEHOP_PROGRAM) + table.words("command")[3].substr(8) + " --no-video --out again")
          .status,
      0);
}

/// Neither its points nor its orders are made.
TEST_F(PointsOfASweep, OfAHugeGridAreRefusedAtOnce) {
  folder.write("s.yaml",
               "scenario: tiny.yaml\nparameters:\n"
               "  - {path: avoidance.speed, from: 0, to: 1, count: 100000}\n"
               "  - {path: wind.speed, from: 0, to: 1, count: 100000}\n");
  const CommandEnd end = folder.shell("ulimit -t 5; " HEDGEHOP_PROGRAM " sweep s.yaml --out out");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr("s.yaml:3:3: the grid has 1e+10 points; a sweep has at most 1000000"));
}

TEST_F(PointsOfASweep, HaveFaultsWithTheLineOfTheFile) {
  EXPECT_THAT(sweep("  - {path: avoidance.speed, values: [1, 80 cm]}\n").err, HasSubstr("s.yaml:5:"));
  folder.write("s.yaml", "scenario: none.yaml\nparameters: [{path: avoidance.speed, values: [1]}]\n");
  EXPECT_THAT(folder.hedgehop("sweep s.yaml --out out").err,
              HasSubstr("s.yaml:1:11: there is no such file: 'none.yaml' (relative to the sweep's folder)"));
  folder.write("s.yaml", "scenario: tiny.yaml\nseeds: 5:1\nparameters: [{path: avoidance.speed, values: [1]}]\n");
  EXPECT_THAT(folder.hedgehop("sweep s.yaml --out out").err, HasSubstr("s.yaml:2:8: seeds '5:1'"));
  folder.write("s.yaml",
               "scenario: tiny.yaml\nset: [avoidance.sped=1]\nparameters: [{path: avoidance.speed, values: [1]}]\n");
  EXPECT_THAT(folder.hedgehop("sweep s.yaml --out out").err, HasSubstr("s.yaml:2:7: unknown key 'sped'"));
  EXPECT_THAT(folder.hedgehop("sweep s.yaml --out out").err, Not(HasSubstr("--set")));
}

/// Each block has a row of A, a row of B, and one exchange per parameter.
TEST_F(PointsOfASweep, OfASobolDesignWithIndicesFormBlocks) {
  folder.write(
      "s.yaml",
      "description: purpose of the sweep\nscenario: tiny.yaml\nseeds: 1\nset: [duration=0.1]\n"
      "design: {type: sobol, points: 4, indices: true}\n"
      "parameters:\n  - {path: avoidance.speed, from: 0.5, to: 2}\n  - {path: wind.speed, from: 0.1, to: 1}\n");
  ASSERT_EQ(folder.hedgehop("sweep s.yaml --out out").status, 0);
  EXPECT_EQ(Table(folder.path() / "out/sweep.csv").rows(), 16u);
  const auto design = folder.json("out/sweep.json");
  EXPECT_EQ(design.at("block"), 4);
  EXPECT_THAT(folder.read("out/report.html"), HasSubstr("\"description\":\"purpose of the sweep\""));
  EXPECT_EQ(design.at("points").size(), 16u);
}

TEST_F(PointsOfASweep, HaveEveryKeyInListSchemaAndDocumentation) {
  const std::string page = read_file_whole(HEDGEHOP_SOURCE_DIR "/docs/sweeps.md");
  for (const std::string kind : {"sweep", "campaign"}) {
    const std::string list = folder.hedgehop("list " + kind).out;
    const auto schema = nlohmann::json::parse(folder.hedgehop("schema " + kind).out);
    for (const auto& [key, rule] :
         schema.contains("properties") ? schema.at("properties").items() : schema.at("else").at("properties").items()) {
      if (key == "use") continue;
      EXPECT_THAT(list, HasSubstr(key + " ")) << kind;
      EXPECT_THAT(page, HasSubstr("`" + key + "`")) << kind;
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim
