#include <gmock/gmock.h>

#include "sim/record/table.h"
#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;

class Branch : public ::testing::Test {
 protected:
  Branch() {
    folder.write("short.yaml", "use: tiny.yaml\nname: short\nduration: 3\nfilm: {enabled: false}\n");
    folder.hedgehop("run short.yaml --out run --seed 1101");
  }
  std::string hash(const std::string& flight) const {
    return folder.json("out/flights/" + flight + "/result.json")["trajectory_hash"].get<std::string>();
  }
  CampaignFolder folder;
};

TEST_F(Branch, ChangesTheFlightOnlyAfterTheGivenTime) {
  const CommandEnd end = folder.hedgehop("branch run --at 1.5 --set avoidance.speed=0.3 --out out");
  ASSERT_LT(end.status, 2) << end.err;
  EXPECT_THAT(end.out, HasSubstr("equal up to 1.5 s, bit for bit"));
  EXPECT_NE(hash("at-1.5-avoidance.speed=0.3"), hash("unbroken"));
  const Table base(folder.path() / "out/flights/unbroken/trajectory.csv");
  const Table branch(folder.path() / "out/flights/at-1.5-avoidance.speed=0.3/trajectory.csv");
  const auto a = base.numbers("north_m"), b = branch.numbers("north_m");
  EXPECT_EQ(a.at(150), b.at(150));
  EXPECT_GT(a.back(), b.back());
  // A second branch is added to the first, and existing flights are reused.
  ASSERT_LT(folder.hedgehop("branch run --at 2 --set avoidance.speed=0.3 --out out").status, 2);
  EXPECT_EQ(Table(folder.path() / "out/batch.csv").rows(), 3u);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/report.html"));
}

TEST_F(Branch, WithoutAChangeTheBranchEqualsTheFlight) {
  ASSERT_LT(folder.hedgehop("branch run --at 1.5 --out out").status, 2);
  EXPECT_EQ(hash("at-1.5"), hash("unbroken"));
  EXPECT_EQ(hash("unbroken"), folder.json("run/result.json")["trajectory_hash"].get<std::string>());
}

TEST_F(Branch, RejectsChangesThatAffectEarlierTimes) {
  const auto fault = [&](const std::string& arguments) {
    const CommandEnd end = folder.hedgehop("branch run --out none " + arguments);
    EXPECT_EQ(end.status, 2) << arguments;
    EXPECT_EQ(std::ranges::count(end.err, '\n'), 1) << end.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "none"));
    return end.err;
  };
  EXPECT_THAT(fault("--at 1 --set wind.speed=3"),
              HasSubstr("in flight may change: avoidance, failures that begin later"));
  EXPECT_THAT(fault("--at 1 --set 'failures=[{at: 0.5, what: height_sensor, mode: off}]'"),
              HasSubstr("begins before 1 s"));
  EXPECT_THAT(fault("--at 7"), HasSubstr("--at 7: the flight has ended at 3 s"));
  EXPECT_THAT(fault("--at 1 --set avoidance.sped=3"), HasSubstr("did you mean 'speed'?"));
  ASSERT_LT(folder.hedgehop("branch run --at 1 --set 'failures=[{at: 2, what: height_sensor, mode: off}]' --out later")
                .status,
            2);
}

}  // namespace
}  // namespace hedgehop::sim
