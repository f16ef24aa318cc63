#include <gmock/gmock.h>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;

/// Two nodes, three shards; the flight of point 1 and seed 2 crashes on its first attempt.
TEST(SweepOnSlurm, EqualsTheLocalSweepByteForByteIfAFlightCrashesOnce) {
  const CampaignFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));  // munge requires an accessible socket
  folder.write("sweep.yaml",
               "scenario: tiny.yaml\nseeds: 1:2\n"
               "parameters: [{path: avoidance.speed, from: 0.5, to: 2, count: 3}]\n");
  const std::string worker = folder.worker(
      "case \"$*\" in *'seed 2 --set avoidance.speed=1.25 '*) [ -e died ] || { touch died; exit 3; } ;; esac\n"
      "fly \"$@\"");
  folder.write("job.sh",
               std::string("set -e\n") + HEDGEHOP_PROGRAM +
                   " sweep sweep.yaml --out remote --on slurm --tasks 3 -j 1 --program " + worker +
                   "\nfor ((i = 0; i < 6000; i++)); do q=$(squeue -h) && [ -z \"$q\" ] && break; sleep 0.1; done\n"
                   "squeue -h -t all -o '%i %T %R'\n");
  const CommandEnd end =
      folder.shell("bash " HEDGEHOP_SOURCE_DIR "/tests/sim/sweep/slurm_cluster.sh cluster bash job.sh");
  if (end.status == 77) GTEST_SKIP() << "no Slurm: " << end.out;
  ASSERT_EQ(end.status, 0) << end.out << end.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "died"));
  ASSERT_EQ(folder.hedgehop("sweep sweep.yaml --out local").status, 0);
  EXPECT_EQ(lasting_columns(folder.read("remote/sweep.csv")), lasting_columns(folder.read("local/sweep.csv")))
      << folder.read("remote/slurm/merge.log");
  EXPECT_THAT(folder.read("remote/slurm/merge.log"), HasSubstr("6 flights: 6 passed"));
}

}  // namespace
}  // namespace hedgehop::sim
