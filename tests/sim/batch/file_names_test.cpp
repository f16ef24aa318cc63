// Names of files are data: any bytes, a dash at the beginning, more letters than a folder's name may have.
#include <gmock/gmock.h>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(FileName, ThatIsNotUtf8IsFlownReusedAndRepeated) {
  const CampaignFolder folder;
  const std::string name = "caf\xe9.yaml", text = "caf\\xE9.yaml";
  std::filesystem::rename(folder.path() / "tiny.yaml", folder.path() / name);
  const CommandEnd flown = folder.hedgehop("batch . --out out --junit out/junit.xml");
  ASSERT_EQ(flown.status, 0) << flown.err << flown.out;
  const auto flight = [&] { return folder.json("out/batch.json").at("flights").at(0); };
  EXPECT_EQ(flight().at("scenario"), text);
  EXPECT_TRUE(flight().at("result").at("inputs").contains(text));
  EXPECT_THAT(folder.read("out/batch.csv"), HasSubstr(text));
  EXPECT_THAT(folder.read("out/report.html"), HasSubstr("caf\\\\xE9.yaml")) << "as a string of JSON";
  EXPECT_THAT(junit_cases(folder, "out/junit.xml"), HasSubstr("no_collision"));
  EXPECT_THAT(folder.read("out/junit.xml"), HasSubstr(text));
  EXPECT_THAT(folder.hedgehop("batch . --resume --out out").err, HasSubstr("tiny/seed1 passed, timeout (earlier)"));
  EXPECT_EQ(folder.hedgehop("batch --failed-only --out out").status, 0);
  // The printed command, by a shell.
  const std::string command = flight().at("command").get<std::string>();
  ASSERT_THAT(command, HasSubstr("$(printf 'caf\\351.yaml')"));
  EXPECT_EQ(folder.hedgehop(command.substr(std::string("hedgehop ").size()) + " --out again").status, 0);
  EXPECT_EQ(folder.json("again/result.json").at("trajectory_hash"), flight().at("result").at("trajectory_hash"));
}

TEST(FileName, OfAFolderThatIsNotUtf8LeavesAScenarioThatFliesAgain) {
  const CampaignFolder folder;
  folder.shell("mkdir \"$(printf 'caf\\351')\" && mv tiny.yaml \"$(printf 'caf\\351')\"");
  folder.write("caf\xe9/post.obj", "v 40 0 0\nv 41 0 0\nv 40 1 0\nf 1 2 3\n");
  std::string scenario = folder.read("caf\xe9/tiny.yaml");
  scenario.replace(scenario.find("{texture_size: 64}"), 18,
                   "{texture_size: 64, imports: [{file: post.obj, name: post}]}");
  folder.write("caf\xe9/tiny.yaml", scenario);
  const CommandEnd first = folder.hedgehop("run \"$(printf 'caf\\351')/tiny.yaml\" --out \"$(printf 'caf\\351')/out\"");
  ASSERT_EQ(first.status, 0) << first.err << first.out;
  const CommandEnd second = folder.hedgehop("run \"$(printf 'caf\\351')/out/scenario.yaml\" --out again");
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(folder.json("again/result.json").at("trajectory_hash"),
            folder.json("caf\xe9/out/result.json").at("trajectory_hash"));
  EXPECT_EQ(folder.hedgehop("batch \"$(printf 'caf\\351')\" --out all").status, 0);
}

TEST(FileName, WithADashAtTheBeginningIsNoOption) {
  const CampaignFolder folder;
  std::filesystem::rename(folder.path() / "tiny.yaml", folder.path() / "-dash.yaml");
  for (const std::string arguments :
       {"batch ./-dash.yaml --out out", "batch --out out -- -dash.yaml", "run --out out -- -dash.yaml",
        "run ./-dash.yaml --out out", "validate -- -dash.yaml", "batch . --out ./-out"}) {
    const CommandEnd end = folder.hedgehop(arguments);
    EXPECT_EQ(end.status, 0) << arguments << ": " << end.err << end.out;
    if (arguments.starts_with("batch ./-dash.yaml")) {
      EXPECT_THAT(folder.json("out/batch.json").at("flights").at(0).at("command").get<std::string>(),
                  HasSubstr("hedgehop run ./-dash.yaml --seed"));
    }
    folder.shell("rm -rf out");
  }
}

}  // namespace
}  // namespace hedgehop::sim
