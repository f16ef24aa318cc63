#include <gmock/gmock.h>

#include "tests/sim/campaign/campaign_folder.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;

/// A folder with a scenario that chance moves: the start is drawn, the wind is turbulent.
class RareFolder : public CampaignFolder {
 public:
  RareFolder() { write("windy.yaml", "use: " HEDGEHOP_SOURCE_DIR "/configs/estimate/alley.yaml\nname: windy\n"); }
  std::string hash(const std::string& out, const std::string& options) const {
    EXPECT_EQ(hedgehop("run windy.yaml --no-video --no-report --out " + out + " " + options).status, 0);
    return json(out + "/result.json").at("trajectory_hash");
  }
};

TEST(ChanceOfAFlight, OfOneSeedIsThatSeedsAndOfABlendAnother) {
  const RareFolder folder;
  const std::string plain = folder.hash("a", "--seed 17");
  EXPECT_EQ(folder.hash("b", "--seed 17 --set 'chance=[{seed: 17, weight: 1}]'"), plain);
  // Nothing else in this scenario depends on the seed.
  EXPECT_EQ(folder.hash("c", "--seed 3 --set 'chance=[{seed: 17, weight: 1}]'"), plain);
  EXPECT_NE(folder.hash("d", "--seed 17 --set 'chance=[{seed: 17, weight: 0.8}, {seed: 4, weight: 0.6}]'"), plain);
  EXPECT_THAT(folder.hedgehop("run windy.yaml --set 'chance=[{seed: 17, weight: 0.8}]'").err,
              HasSubstr("the squares of the weights sum to 0.64"));
}

TEST(Estimate, SameForAnyNumberOfWorkersAndResumed) {
  const RareFolder folder;
  const std::string common =
      "estimate windy.yaml --event 'rate(min_clearance_m < 1.3)' --samples 50 --runs 1 --seed 1101 --out ";
  const CommandEnd one = folder.hedgehop(common + "one -j 1");
  ASSERT_EQ(one.status, 0) << one.err;
  ASSERT_EQ(folder.hedgehop(common + "four -j 4").status, 0);
  EXPECT_EQ(folder.json("one/estimate.json"), folder.json("four/estimate.json"));
  EXPECT_EQ(lasting_columns(folder.read("one/estimate.csv")), lasting_columns(folder.read("four/estimate.csv")));
  // All flights are there: none is flown again.
  ASSERT_EQ(folder.hedgehop(common + "four -j 4 --program " + folder.worker("exit 3")).status, 0);
  EXPECT_EQ(folder.json("one/estimate.json"), folder.json("four/estimate.json"));
  // The command of the worst flight flies it again.
  const Json worst = folder.json("one/estimate.json").at("worst").at(0);
  const std::string command = worst.at("command").get<std::string>().substr(std::string("hedgehop ").size());
  ASSERT_LE(folder.hedgehop(command + " --no-video --no-report --out again").status, 1);
  const double clearance = folder.json("again/result.json").at("min_clearance_m");
  EXPECT_DOUBLE_EQ(clearance - 1.3, worst.at("margin").get<double>());
}

TEST(Estimate, BadInputIsToldInOneLineBeforeFlying) {
  const RareFolder folder;
  struct Row {
    std::string options, message;
  };
  for (const Row& row : {Row{"--event colision", "did you mean 'collision'?"},
                         Row{"--event timeout", "how near a flight comes to it is not known"},
                         Row{"--event collision --samples 0", "--samples 0: must be a multiple of 50"},
                         Row{"--event collision --samples 75", "--samples 75: must be a multiple of 50"}}) {
    const CommandEnd end = folder.hedgehop("estimate windy.yaml --out out " + row.options);
    EXPECT_EQ(end.status, 2) << row.options;
    EXPECT_THAT(end.err, HasSubstr(row.message));
    EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  }
}

}  // namespace
}  // namespace hedgehop::sim
