#include <gmock/gmock.h>
#include <signal.h>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(BatchUntil, ShowsARateAndStops) {
  const CampaignFolder folder;
  const CommandEnd end =
      folder.hedgehop("batch tiny.yaml --seeds 101:160 -j 2 --until 'collision < 0.3' --out out --junit j.xml");
  EXPECT_EQ(end.status, 0) << end.err;
  const Json batch = folder.json("out/batch.json");
  const Json found = batch.at("sequential").at(0);
  // 10 flights without an event show 0.3 at 95 %.
  EXPECT_EQ(found.at("n"), 10);
  EXPECT_EQ(found.at("k"), 0);
  EXPECT_EQ(found.at("verdict"), "shown");
  EXPECT_EQ(found.at("stopped_at"), 110);
  EXPECT_EQ(found.at("planned"), 60);
  EXPECT_EQ(found.at("discarded"), 50);
  EXPECT_LE(found.at("limit").get<double>(), 0.3);
  EXPECT_EQ(batch.at("flights").size(), 10u);
  EXPECT_EQ(batch.at("groups").at(0).at("success_rate_method"), "anytime");
  EXPECT_THAT(end.out, HasSubstr("pass  collision < 0.3 tiny: shown: collision in 0 of 10 flights"));
  EXPECT_THAT(junit_cases(folder, "j.xml"), HasSubstr("over the seeds/until collision < 0.3 tiny\n"));
  EXPECT_THAT(folder.read("out/batch.csv"), StartsWith("id,group,scenario,seed,counted,status,"));
}

TEST(BatchUntil, RefutesAndFailsOrStaysUndecided) {
  const CampaignFolder folder;
  const std::string worker = folder.worker("exit 3");
  const std::string common = " --out out --junit j.xml --program " + worker;
  const CommandEnd refuted = folder.hedgehop("batch tiny.yaml --seeds 1:20 --until 'collision < 0.1'" + common);
  EXPECT_EQ(refuted.status, 1);
  EXPECT_THAT(refuted.out, HasSubstr("FAIL  collision < 0.1 tiny: refuted: collision in 2 of 2 flights"));
  EXPECT_THAT(junit_cases(folder, "j.xml"), HasSubstr("failure refuted: collision in 2 of 2"));
  const CommandEnd open =
      folder.hedgehop("batch tiny.yaml --seeds 1:2 --until 'success > 0.9' --confidence 0.999" + common);
  EXPECT_EQ(open.status, 4);
  EXPECT_THAT(open.out, HasSubstr("open  success > 0.9 tiny: undecided: success in 0 of 2 flights"));
  EXPECT_THAT(junit_cases(folder, "j.xml"), HasSubstr("failure undecided"));
}

TEST(BatchUntil, CountsAFigureAndBoundsAWidth) {
  const CampaignFolder folder;
  // The minimum clearance is about 0.7 m.
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --seeds 1:9 --until 'rate(min_clearance_m < 0.5) < 0.5' --out a").status,
            0);
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --seeds 1:9 --until 'rate(min_clearance_m > 0.5) < 0.5' --out b").status,
            1);
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --seeds 1:9 --until-width 0.5 --of success --out c").status, 0);
  const Json found = folder.json("c/batch.json").at("sequential").at(0);
  const double low = found.at("interval").at(0), high = found.at("interval").at(1);
  EXPECT_LE(high - low, 0.5);
  EXPECT_EQ(found.at("width").get<double>(), high - low);
}

/// Failing flights end first. If flights counted in the order of their ends, the first ones would refute the claim.
TEST(BatchUntil, SameAnswerForAnyNumberOfWorkersAfterAKillAndResumed) {
  const CampaignFolder folder;
  const std::string worker = folder.worker(
      "[ $((seed % 5)) = 0 ] && exit 3; [ $seed = 108 ] && rm kill.txt 2>/dev/null && kill -KILL $PPID; fly \"$@\"");
  const std::string common = "batch tiny.yaml --seeds 101:160 --until 'success > 0.5' --program " + worker + " --out ";
  std::vector<std::string> answers, tables;
  const auto keep = [&](const std::string& out) {
    answers.push_back(lasting_fields(folder.json(out + "/batch.json")).dump(1));
    tables.push_back(lasting_columns(folder.read(out + "/batch.csv")));
  };
  ASSERT_EQ(folder.hedgehop(common + "one -j 1").status, 0);
  keep("one");
  ASSERT_EQ(folder.hedgehop(common + "eight -j 8").status, 0);
  keep("eight");
  // Killed without a chance to write anything, by the worker of a later flight.
  folder.write("kill.txt", "");
  EXPECT_EQ(folder.hedgehop(common + "killed -j 3").status, 128 + SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "killed/batch.json"));
  ASSERT_EQ(folder.hedgehop(common + "killed -j 2 --resume").status, 0);
  keep("killed");
  EXPECT_GE(folder.json("one/batch.json").at("sequential").at(0).at("k"), 10);
  for (size_t i = 1; i < answers.size(); ++i) {
    EXPECT_EQ(answers[i], answers[0]) << i;
    EXPECT_EQ(tables[i], tables[0]) << i;
  }
}

TEST(BatchUntil, AfterAnInterruptionCountsFlightsUpToTheFirstGap) {
  const CampaignFolder folder;
  const std::string worker =
      folder.worker("[ $seed = 2 ] && exec sleep 60; [ $seed = 5 ] && kill -INT $PPID && exec sleep 60; fly \"$@\"");
  const CommandEnd end =
      folder.hedgehop("batch tiny.yaml --seeds 1:5 -j 2 --until 'collision < 0.1' --out out --program " + worker);
  EXPECT_EQ(end.status, 128 + SIGINT);
  const Json batch = folder.json("out/batch.json");
  EXPECT_EQ(batch.at("sequential").at(0).at("n"), 1);
  EXPECT_EQ(batch.at("flights").at(0).at("passed"), true);
  EXPECT_TRUE(batch.at("flights").at(1).at("passed").is_null());
  const std::string table = folder.read("out/batch.csv");
  EXPECT_THAT(table, HasSubstr("tiny.yaml,1,1,flown,"));
  EXPECT_THAT(table, HasSubstr("tiny.yaml,2,0,missing,"));
  EXPECT_THAT(table, HasSubstr("tiny.yaml,3,0,flown,"));
}

TEST(BatchUntil, EachGroupStopsAtItsOwnSeed) {
  const CampaignFolder folder;
  const std::string worker = folder.worker("case \"$*\" in *speed=0.4*) exit 3 ;; esac; fly \"$@\"");
  folder.write("two.yaml",
               "tuned_on: none\nflights:\n  - {scenario: tiny.yaml, seeds: 1:20}\n"
               "  - {scenario: tiny.yaml, seeds: 1:20, set: [avoidance.speed=0.4]}\n");
  const CommandEnd end = folder.hedgehop("batch two.yaml --until 'success > 0.5' --out out --program " + worker);
  EXPECT_EQ(end.status, 1);
  const Json found = folder.json("out/batch.json").at("sequential");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found.at(0).at("verdict"), "shown");
  EXPECT_EQ(found.at(1).at("verdict"), "refuted");
  EXPECT_EQ(found.at(0).at("n"),
            found.at(1).at("n"));  // at a limit of one half, all events and no events are equal evidence
}

TEST(BatchUntil, RejectsBadRulesInOneLineBeforeAnyFlight) {
  const CampaignFolder folder;
  struct Row {
    std::string options, message;
  };
  for (const Row& row :
       {Row{"--until 'colision < 0.1'", "'colision < 0.1': no event 'colision'; did you mean 'collision'? "},
        Row{"--until 'collision < 0'", "'collision < 0': the limit of a rate must be > 0 and < 1"},
        Row{"--until 'collision < 1'", "the limit of a rate must be > 0 and < 1"},
        Row{"--until 'collision < x'", "'collision < x': 'x' is not a finite number"},
        Row{"--until 'collision'", "'collision': expected such as 'collision < 0.01'"},
        Row{"--until '" + std::string(60'000, 'a') + "'", "has 60000 bytes; a claim has at most 200"},
        Row{"--until 'rate(min_clearence_m < 1) < 0.1'", "did you mean 'min_clearance_m'?"},
        Row{"--until-width 0 --of success", "--until-width 0: the width must be > 0 and < 1"},
        Row{"--until-width 0.1 --of sucess", "did you mean 'success'?"},
        Row{"--until 'collision < 0.1' --min-success 0.1", "--until: success_rate, no_worse and leaderboards are for"},
        Row{"--until-width 0.1 --of success --min-success 0.1", "--until-width: success_rate, no_worse and"}}) {
    const CommandEnd end = folder.hedgehop("batch tiny.yaml --out out " + row.options);
    EXPECT_EQ(end.status, 2) << row.options;
    EXPECT_THAT(end.err, HasSubstr(row.message)) << row.options;
    EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  }
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --out out --until-width 0.1").status, 2);
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --out out --of success").status, 2);
}

}  // namespace
}  // namespace hedgehop::sim
