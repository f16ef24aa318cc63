#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/sim/cli/ask.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim::cli {
namespace {

using testing::HasSubstr;

const std::string kScenario = HEDGEHOP_SOURCE_DIR "/configs/andert2007_tree_160.yaml";

TEST(NumberOptions, RejectIntegerOverflowAndNonFiniteNumbers) {
  const TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string() + "/out";
  for (const std::string option : {"--seed -1", "--seed 18446744073709551616", "--seed 1.5", "--seed 0x10"}) {
    const Answer answer = ask("run " + kScenario + out + " " + option);
    EXPECT_EQ(answer.status, kBadInput) << option;
    EXPECT_THAT(answer.text, HasSubstr("--seed")) << option;
  }
  for (const std::string option :
       {"--limit nan", "--limit inf", "--min-success nan", "--margin nan", "--jobs 1e2", "--confidence nan"}) {
    const Answer answer = ask("batch " + kScenario + out + " " + option);
    EXPECT_EQ(answer.status, kBadInput) << option;
    EXPECT_THAT(answer.text, HasSubstr(option.substr(0, option.find(' ')))) << option;
  }
  EXPECT_EQ(ask("render " + kScenario + " --camera left -o /dev/null --time nan").status, kBadInput);
  EXPECT_EQ(ask("render " + kScenario + " --camera left -o x.png --time -1").text,
            "--time: must be 0 or more, got -1 (see --help)\n");
  EXPECT_EQ(ask("batch " + kScenario + " --limit 0").text, "--limit: must be more than 0, got 0 (see --help)\n");
}

TEST(Commands, AMisspelledNameListsTheNearest) {
  const Answer slip = ask("bacth " + kScenario);
  EXPECT_EQ(slip.status, kBadInput);
  EXPECT_THAT(slip.text, testing::StartsWith("unknown command 'bacth'; did you mean 'batch'? allowed: run, render, "));
  EXPECT_EQ(std::ranges::count(slip.text, '\n'), 1);
  EXPECT_THAT(ask(kScenario).text, testing::EndsWith("manual (see --help)\n"));
}

TEST(Commands, TheRemovedCommandEstimateNamesItsReplacement) {
  const Answer answer = ask("estimate " + kScenario + " --event collision");
  EXPECT_EQ(answer.status, kBadInput);
  EXPECT_EQ(answer.text, "the command 'estimate' was removed; to bound a rate, use `hedgehop batch --until`\n");
}

TEST(Options, AMisspelledNameListsTheNearest) {
  const Answer slip = ask("run " + kScenario + " --ot x");
  EXPECT_EQ(slip.status, kBadInput);
  EXPECT_THAT(slip.text, testing::StartsWith("unknown option '--ot'; did you mean '--out'? allowed: --help, "));
  EXPECT_THAT(slip.text, testing::Not(testing::HasSubstr("--worker-of"))) << "which is hidden";
  EXPECT_EQ(std::ranges::count(slip.text, '\n'), 1);
}

TEST(Options, AScenarioMayFollowSet) {
  EXPECT_THAT(ask("run --set duration=-1 " + kScenario).text, testing::HasSubstr("'duration': must be > 0"));
  EXPECT_THAT(ask("batch --set duration=-1 " + kScenario + " --seeds 1").text,
              testing::HasSubstr("'duration': must be > 0"));
}

TEST(NumberOptions, ReadDecimally) {
  const TemporaryFolder folder;
  const Answer answer =
      ask("run " + kScenario +
          " --seed 010 --set duration=0.02 --set 'checks=[]' --renderer tiles --no-video --json --out " +
          folder.path().string() + "/out");
  EXPECT_THAT(answer.text, HasSubstr("\"seed\": 10,"));
}

TEST(Options, ThatWouldHaveNoEffectAreRefused) {
  const TemporaryFolder folder;
  const std::string vehicle = HEDGEHOP_SOURCE_DIR "/configs/vehicles/hummingbird.yaml";
  const std::string sweep = "sweep " HEDGEHOP_SOURCE_DIR "/configs/sweeps/garratt2009_room_gains.yaml ";
  const std::string fit = "identify " + vehicle + " --log x.csv --fit rotor.drag=0:1 ";
  const std::vector<std::pair<std::string, std::string>> refused = {
      {"batch " + kScenario + " --margin 0.1", "--no-worse-than"},
      {sweep + "--tasks 4", "--on"},
      {sweep + "--on local --tasks 4", "--tasks is for --on slurm"},
      {sweep + "--on local --slurm-option=--x", "--slurm-option is for --on slurm"},
      {sweep + "--missing --junit j.xml", "no --junit"},
      {sweep + "--missing --dry-run", "no --merge or --missing"},
      {sweep + "--merge --dry-run", "no --merge or --missing"},
      {sweep + "--missing --merge", "--merge"},
      {sweep + "--from .", "--from is for --merge or --missing"},
      {"run " + kScenario + " --bind 127.0.0.1", "--bind: the scenario has no link"},
      {fit + "--plot x.html", "--plot"},
      {fit + "--csv", "--csv"},
      {fit + "--size 1deg", "--size"},
      {fit + "--speed 3", "--speed"},
      {"dataset " + kScenario + " --out " + folder.path().string() + "/out --images 1 --tilt nan",
       "'nan' is no finite"}};
  for (const auto& [command, words] : refused) {
    const Answer answer = ask(command);
    EXPECT_EQ(answer.status, kBadInput) << command;
    EXPECT_THAT(answer.text, HasSubstr(words)) << command;
  }
}

}  // namespace
}  // namespace hedgehop::sim::cli
