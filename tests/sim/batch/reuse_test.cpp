// Reuse of results of an earlier batch.
#include <gmock/gmock.h>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

/// The second command is refused before it changes anything; a killed command leaves no lock.
TEST(Reuse, TwoCommandsCannotWriteIntoOneFolder) {
  const CampaignFolder folder;
  const std::string worker =
      folder.worker("[ -e second ] || { touch second; $PWD/again.sh; }; fly \"$@\"");  // during the first flight
  folder.write("again.sh", "#!/bin/sh\n" HEDGEHOP_PROGRAM
                           " batch tiny.yaml --seeds 1:2 --out out >again.txt 2>&1; echo $? >>again.txt\n");
  std::filesystem::permissions(folder.path() / "again.sh", std::filesystem::perms::owner_all);
  const CommandEnd first = folder.hedgehop("batch tiny.yaml --seeds 1:2 -j 1 --out out --program " + worker);
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(folder.read("again.txt"),
              testing::MatchesRegex("out: in use by another hedgehop command \\(process [0-9]+\\); "
                                    "wait for its end or choose another --out\n2\n"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/.hedgehop.lock"));

  const std::string killed = folder.worker("kill -KILL $PPID");
  EXPECT_NE(folder.hedgehop("batch tiny.yaml --out torn --program " + killed).status, 0);
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --out torn").status, 0);
}

/// The second batch reuses the flights of the first one. A failed check is a result, too.
TEST(Reuse, ResumeFliesOnlyFlightsWithoutAResult) {
  const CampaignFolder folder;
  const std::string worker = folder.worker("echo $seed >> flown.txt; fly \"$@\"");
  const std::string command =
      "batch tiny.yaml --set 'checks=[{check: reached_goal}]' --out out -j 1 --program " + worker;
  EXPECT_EQ(folder.hedgehop(command + " --seeds 1:2").status, 1);
  EXPECT_EQ(folder.hedgehop(command + " --seeds 1:4 --resume").status, 1);
  EXPECT_EQ(folder.read("flown.txt"), "1\n2\n3\n4\n");
  EXPECT_THAT(folder.json("out/batch.json").at("flights"), testing::SizeIs(4));
}

TEST(Reuse, AChangedScenarioIsFlownAgain) {
  const CampaignFolder folder;
  const std::string worker = folder.worker("echo $seed >> flown.txt; fly \"$@\"");
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --seeds 1:2 --out out --program " + worker).status, 0);
  folder.write("tiny.yaml", folder.read("tiny.yaml") + "control_rate: 50\n");
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --seeds 1:2 --failed-only -j 1 --out out --program " + worker).status, 0);
  EXPECT_THAT(folder.read("flown.txt"), EndsWith("1\n2\n"));
  EXPECT_EQ(folder.read("flown.txt").size(), 8u);
}

/// A change of one byte in an input file makes the result invalid, even with --reuse-other-builds.
TEST(Reuse, AChangedFileOfTheSceneIsFlownAgain) {
  const CampaignFolder folder;
  folder.write("t.obj", "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n");
  folder.write("t.mtl", "newmtl m\nmap_Kd t.ppm\n");
  folder.write("t.ppm", "P3 1 1 255\n9 8 7\n");
  folder.write("meshy.yaml", "use: tiny.yaml\nname: meshy\nscene: {imports: [{file: t.obj, collide: none}]}\n");
  const std::string again =
      "batch meshy.yaml --out out --resume --program " + folder.worker("echo x >> flown.txt; fly \"$@\"");
  ASSERT_EQ(folder.hedgehop(again).status, 0);
  ASSERT_EQ(folder.hedgehop(again).status, 0);
  EXPECT_EQ(folder.read("flown.txt"), "x\n");
  const Json inputs = folder.json("out/meshy/seed1/result.json").at("inputs");
  for (const std::string name : {"meshy.yaml", "tiny.yaml", "t.obj", "t.mtl", "t.ppm"}) {
    EXPECT_EQ(inputs.at(name).get<std::string>(), folder.shell("sha256sum " + name).out.substr(0, 64)) << name;
  }
  folder.write("t.ppm", "P3 1 1 255\n9 8 6\n");
  ASSERT_EQ(folder.hedgehop(again + " --reuse-other-builds").status, 0);
  EXPECT_EQ(folder.read("flown.txt"), "x\nx\n");
}

/// A result of another build is reused only with --reuse-other-builds; every table then names both builds.
TEST(Reuse, AResultOfAnotherBuildIsReusedOnlyWithTheOption) {
  const CampaignFolder folder;
  ASSERT_EQ(folder.hedgehop("batch tiny.yaml --seeds 1:2 --out out").status, 0);
  const std::string own = folder.json("out/tiny/seed1/result.json").at("build");
  EXPECT_EQ(own.size(), 16u);
  Json result = folder.json("out/tiny/seed1/result.json");
  result["build"] = "0123456789abcdef";
  const auto leave_another = [&] { folder.write("out/tiny/seed1/result.json", result.dump()); };

  leave_another();
  const CommandEnd asked = folder.hedgehop("batch tiny.yaml --seeds 1:2 --out out --resume --reuse-other-builds");
  EXPECT_EQ(folder.json("out/tiny/seed1/result.json").at("build"), "0123456789abcdef");
  EXPECT_THAT(asked.out, HasSubstr("Flights of 2 builds: "));
  EXPECT_THAT(folder.read("out/batch.csv"), AllOf(HasSubstr(",0123456789abcdef,"), HasSubstr("," + own + ",")));

  leave_another();
  const CommandEnd resumed = folder.hedgehop("batch tiny.yaml --seeds 1:2 --out out --resume");
  EXPECT_EQ(folder.json("out/tiny/seed1/result.json").at("build"), own);
  EXPECT_THAT(resumed.out, Not(HasSubstr("builds")));
}

}  // namespace
}  // namespace hedgehop::sim
