#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <set>

#include "tests/sim/batch/campaign_folder.h"

extern char** environ;

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// The flight of a seed in a batch.json.
Json flight(const Json& batch, int seed) {
  for (const Json& flight : batch.at("flights")) {
    if (flight.at("seed") == seed) return flight;
  }
  return {};
}

TEST(Batch, WorkerThatCrashesOrIsKilledFailsItsOwnFlightOnly) {
  const CampaignFolder folder;
  const std::string worker = folder.worker(
      "case $seed in\n"
      "1) kill -SEGV $$ ;;\n"
      "2) kill -TERM $$ ;;\n"
      "3) echo first >&2; echo 'the <last> words' >&2; exit 3 ;;\n"
      "4) kill -KILL $$ ;;\n"
      "5) exit 0 ;;\n"
      "*) fly \"$@\" ;;\nesac");
  const CommandEnd end =
      folder.hedgehop("batch tiny.yaml --seeds 1:7 -j 3 --out out --junit j.xml --program " + worker);
  EXPECT_EQ(end.status, 1) << end.err;
  const Json batch = folder.json("out/batch.json");
  EXPECT_EQ(flight(batch, 1).at("cause"), "killed by SIGSEGV (Segmentation fault)");
  EXPECT_EQ(flight(batch, 2).at("cause"), "killed by SIGTERM (Terminated)");
  EXPECT_EQ(flight(batch, 3).at("cause"), "exit status 3: the <last> words");
  EXPECT_EQ(flight(batch, 4).at("cause"), "killed by SIGKILL (Killed)");
  EXPECT_THAT(flight(batch, 5).at("cause").get<std::string>(), StartsWith("exit status 0; left no result"));
  for (int seed = 1; seed <= 5; ++seed) EXPECT_EQ(flight(batch, seed).at("status"), "failed");
  for (int seed = 6; seed <= 7; ++seed) EXPECT_TRUE(flight(batch, seed).at("passed"));
  EXPECT_EQ(batch.at("groups").at(0).at("failed"), 5);

  const std::string cases = junit_cases(folder, "j.xml");
  EXPECT_THAT(cases, HasSubstr("tiny/seed3/flight error exit status 3: the <last> words\n"));
  EXPECT_THAT(cases, ContainsRegex("tiny/seed6/no_collision\n  0.7[0-9]* m at [0-9.]+ s, must be > 0 m"));
  EXPECT_THAT(cases, HasSubstr("re-run: hedgehop run tiny.yaml --seed 6"));
  EXPECT_THAT(end.out, HasSubstr("FAIL  tiny/seed1: killed by SIGSEGV"));
}

TEST(Batch, WorkerThatHangsIsKilledAtItsLimitWithItsChildren) {
  const CampaignFolder folder;
  const std::string worker = folder.worker("sleep 60 & echo $! > pid.txt; wait");
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --limit 3 --out out --program " + worker).status, 1);
  EXPECT_EQ(folder.json("out/batch.json").at("flights").at(0).at("cause"),
            "killed: over its limit of 3 s of wall time");
  ASSERT_TRUE(std::filesystem::exists(folder.path() / "pid.txt"));
  // A zombie is waiting for init, so it is acceptable; the process must no longer run.
  const std::string state = folder.shell("cut -d' ' -f3 /proc/$(cat pid.txt)/stat").out;
  EXPECT_TRUE(state.empty() || state == "Z\n") << state;
}

TEST(Batch, FailedOnlyFliesFailedFlightsAndKeepsTheOthers) {
  const CampaignFolder folder;
  const std::string worker = folder.worker("echo $seed >> flown.txt; [ $seed = 2 ] && exit 3; fly \"$@\"");
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --seeds 1:3 -j 1 --out out --program " + worker).status, 1);
  folder.worker("echo $seed >> flown.txt; fly \"$@\"");
  EXPECT_EQ(folder.hedgehop("batch --failed-only -j 1 --out out --program " + worker).status, 0);
  EXPECT_EQ(folder.read("flown.txt"), "1\n2\n3\n2\n");
}

TEST(Batch, RecordWithAFormerKeyIsRefusedWithItsNewName) {
  const CampaignFolder folder;
  folder.write("batch.json", R"({"groups": [{"group": "tiny", "least_clearance_m": 1.0}], "flights": []})");
  for (const char* command : {"batch --failed-only --out .", "batch tiny.yaml --no-worse-than batch.json --out out"}) {
    const CommandEnd end = folder.hedgehop(command);
    EXPECT_EQ(end.status, 2) << command;
    EXPECT_THAT(end.err, HasSubstr("'groups.least_clearance_m' of an earlier version is now 'min_clearance_m'"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out")) << "no flight before the message";
  }
}

TEST(Batch, FlightWithoutChecksDoesNotPass) {
  const CampaignFolder folder;
  std::string scenario = folder.read("tiny.yaml");
  scenario.replace(scenario.find("checks:"), std::string::npos,
                   "may_collide: true\nchecks: []\ndrawing: {renderer: tiles}\n");
  folder.write("free.yaml", scenario);
  const CommandEnd end = folder.hedgehop("batch free.yaml --out out --junit j.xml");
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("| tiny | 1 | no checks | - |"));
  EXPECT_TRUE(flight(folder.json("out/batch.json"), 1).at("passed").is_null());
  EXPECT_THAT(junit_cases(folder, "j.xml"), HasSubstr("tiny/seed1/flight skipped no checks"));
  for (const std::string& text : {end.out + end.err, folder.read("j.xml")}) EXPECT_THAT(text, Not(HasSubstr("pass ")));
}

TEST(Batch, JUnitNamesTheObstacleOfACollision) {
  const CampaignFolder folder;
  folder.write("wall.yaml", "use: " HEDGEHOP_SOURCE_DIR
                            "/configs/worlds/wall.yaml\nname: wall\nduration: 15\n"
                            "may_collide: false\ndrawing: {renderer: tiles}\n");
  EXPECT_EQ(folder.hedgehop("batch wall.yaml --out out --junit j.xml").status, 1);
  const std::string cases = junit_cases(folder, "j.xml");
  EXPECT_THAT(cases, ContainsRegex("wall/seed1/flight\n  collided \\(hit wall at [0-9.]+ s\\)"));
  EXPECT_THAT(cases, ContainsRegex("no_collision failure .*must be > 0 m \\(hit wall at"));
}

TEST(Batch, EveryFileNamesTheBuild) {
  const CampaignFolder folder;
  ASSERT_EQ(folder.hedgehop("batch tiny.yaml --out out --junit j.xml").status, 0);
  ASSERT_EQ(folder.hedgehop("report out").status, 0);
  const std::string build = folder.json("out/tiny/seed1/result.json").at("build");
  EXPECT_THAT(folder.read("j.xml"), HasSubstr("<property name=\"build\" value=\"" + build + "\" />"));
  EXPECT_THAT(folder.read("out/report.html"), HasSubstr("\"build\":\"" + build + "\""));
  EXPECT_THAT(folder.read("out/batch.csv"), AllOf(HasSubstr(",truth_used,"), HasSubstr("," + build + ",")));
}

TEST(Batch, BadFileIsReportedWithItsPlaceAndTheOthersAreFlown) {
  const CampaignFolder folder;
  folder.write("typo.yaml", "use: tiny.yaml\nname: typo\nduratoin: 3\n");
  const CommandEnd end = folder.hedgehop("batch typo.yaml tiny.yaml --out out --junit j.xml");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr("typo.yaml:3:1: unknown key 'duratoin' in the scenario; did you mean 'duration'?"));
  const Json batch = folder.json("out/batch.json");
  EXPECT_EQ(batch.at("flights").at(0).at("status"), "failed");
  EXPECT_TRUE(batch.at("flights").at(1).at("passed"));
  EXPECT_THAT(junit_cases(folder, "j.xml"), HasSubstr("typo/bad/flight error typo.yaml:3:1: unknown key"));
}

TEST(Batch, WithoutAValidInputOnlyTheJUnitFileIsWritten) {
  const CampaignFolder folder;
  EXPECT_EQ(folder.hedgehop("batch missing.yaml --out out --junit j.xml").status, 2);
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --set avoidance.modle=x --out out").status, 2);
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --seeds 3:1 --out out").status, 2);
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --no-worse-than missing --out out").status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  EXPECT_THAT(junit_cases(folder, "j.xml"), HasSubstr("error missing.yaml: there is no such file"));
}

/// With a limit on file sizes, a write fails in the middle of the file, like on a full disk.
TEST(Batch, FullDiskFailsTheFlightWithTheFilesName) {
  const CampaignFolder folder;
  const std::string worker = folder.worker("trap '' XFSZ; ulimit -f 2; fly \"$@\"");
  const CommandEnd end = folder.hedgehop("batch tiny.yaml --out out --program " + worker);
  EXPECT_EQ(end.status, 1);
  const Json one = folder.json("out/batch.json").at("flights").at(0);
  EXPECT_THAT(one.at("cause").get<std::string>(), StartsWith("exit status 3: hedgehop: cannot write out/tiny/seed1/"));
  EXPECT_THAT(one.at("cause").get<std::string>(), EndsWith("File too large"));
}

TEST(Batch, FullDiskForItsOwnFilesIsAnErrorThatNamesThem) {
  const CampaignFolder folder;
  const std::string worker = folder.worker("exit 3");
  const CommandEnd end = folder.shell(
      "trap '' XFSZ; ulimit -f 3; " HEDGEHOP_PROGRAM " batch tiny.yaml --seeds 1:9 --out out --program " + worker);
  EXPECT_EQ(end.status, 3);
  EXPECT_THAT(end.err, HasSubstr("cannot write out/batch.json: File too large"));
  EXPECT_THAT(end.out, HasSubstr("| tiny | 9 | 0 |"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/batch.json"));
}

TEST(Batch, InterruptEndsTheWorkersAndKeepsTheResults) {
  const CampaignFolder folder;
  const std::string worker = folder.worker(
      "[ $seed = 1 ] || { echo $$ >> pids.txt; exec sleep 60; }\n"
      "until [ -s pids.txt ]; do sleep 0.01; done; fly \"$@\"");
  const std::string out = (folder.path() / "out").string(), junit = (folder.path() / "j.xml").string();
  std::vector<const char*> arguments{
      HEDGEHOP_PROGRAM, "batch",     "tiny.yaml", "--seeds",     "1:4",       "-j",           "2",    "--limit", "60",
      "--out",          out.c_str(), "--junit",   junit.c_str(), "--program", worker.c_str(), nullptr};
  std::array<int, 2> errors{};
  ASSERT_EQ(pipe2(errors.data(), O_CLOEXEC), 0);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addchdir_np(&files, folder.path().c_str());
  posix_spawn_file_actions_adddup2(&files, errors[1], STDERR_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t batch = 0;
  ASSERT_EQ(posix_spawn(&batch, HEDGEHOP_PROGRAM, &files, nullptr, const_cast<char**>(arguments.data()), environ), 0);
  posix_spawn_file_actions_destroy(&files);
  close(errors[1]);
  // The first line of progress says that seed 1 has ended, while the worker of seed 2 sleeps.
  char c = 0;
  while (read(errors[0], &c, 1) == 1 && c != '\n') {
  }
  ASSERT_EQ(kill(batch, SIGINT), 0);
  int status = 0;
  ASSERT_EQ(waitpid(batch, &status, 0), batch);
  close(errors[0]);

  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
  const Json json = folder.json("out/batch.json");
  EXPECT_TRUE(flight(json, 1).at("passed"));
  for (int seed = 2; seed <= 4; ++seed) EXPECT_EQ(flight(json, seed).at("status"), "missing");
  EXPECT_THAT(junit_cases(folder, "j.xml"), HasSubstr("tiny/seed3/flight skipped not flown"));
  std::istringstream pids(folder.read("pids.txt"));
  int found = 0;
  for (pid_t pid = 0; pids >> pid; ++found) EXPECT_NE(kill(pid, 0), 0) << pid << " still lives";
  EXPECT_GE(found, 1);
}

TEST(Batch, SameFlightsWithAnyNumberOfWorkers) {
  const CampaignFolder folder;
  std::set<std::string> hashes;
  for (const std::string jobs : {"1", "2", "3"}) {
    EXPECT_EQ(folder.hedgehop("batch tiny.yaml --seeds 5:8 -j " + jobs + " --out out" + jobs).status, 0);
    std::string all;
    const Json batch = folder.json("out" + jobs + "/batch.json");
    for (const Json& flight : batch.at("flights")) {
      all += flight.at("result").at("trajectory_hash").get<std::string>() + " ";
    }
    hashes.insert(all);
  }
  EXPECT_EQ(hashes.size(), 1u);
}

TEST(Batch, StatisticalChecksDecideInsteadOfSingleFlights) {
  const CampaignFolder folder;
  const std::string worker = folder.worker("[ $seed = 2 ] && exit 3; fly \"$@\"");
  const std::string common = "batch tiny.yaml --seeds 1:6 --junit j.xml --program " + worker;
  EXPECT_EQ(folder.hedgehop(common + " --out a --min-success 0.4").status, 0);  // 5 of 6: 0.436 to 0.970
  EXPECT_EQ(folder.hedgehop(common + " --out b --min-success 0.5").status, 1);
  EXPECT_THAT(junit_cases(folder, "j.xml"), HasSubstr("over the seeds/success_rate tiny failure 5 of 6 passed"));
  EXPECT_EQ(folder.hedgehop(common + " --out c --no-worse-than a").status, 0);
  folder.worker("exit 3");
  EXPECT_EQ(folder.hedgehop(common + " --out d --no-worse-than a").status, 1);  // 0 of 6 after 5 of 6: p = 0.008
}

TEST(Batch, RejectsARateThatItsFlightsCannotShow) {
  const CampaignFolder folder;
  // All of n passing: the Wilson interval begins at n / (n + z^2), z = 1.96, which is 0.7 from n = 8.96 on.
  const CommandEnd end = folder.hedgehop("batch tiny.yaml --seeds 1:8 --out out --min-success 0.7");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err,
              HasSubstr("8 of 8 flights that pass cannot show a rate of 0.7 with 95 % confidence; it takes 9"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/batch.json"));
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --seeds 1:9 --out out --min-success 0.7").status, 0);
}

TEST(Batch, CampaignFileNamesScenariosSeedsAndValues) {
  const CampaignFolder folder;
  folder.write("campaign.yaml",
               "description: two speeds\ntuned_on: 5:9\nflights:\n"
               "  - {scenario: tiny.yaml, seeds: 1:2}\n"
               "  - {scenario: tiny.yaml, seeds: 4, set: [avoidance.speed=0.5]}\n"
               "checks: [{check: success_rate, at_least: 0.1}]\n");
  ASSERT_EQ(folder.hedgehop("batch campaign.yaml --out out").status, 0);
  const Json batch = folder.json("out/batch.json");
  ASSERT_EQ(batch.at("flights").size(), 3u);
  EXPECT_EQ(batch.at("flights").at(2).at("command"), "hedgehop run tiny.yaml --seed 4 --set avoidance.speed=0.5");
  EXPECT_EQ(batch.at("verdicts").size(), 2u);
  folder.write("campaign.yaml", "flights:\n  - {scenario: tiny.yaml, seds: 1:2}\n");
  EXPECT_THAT(folder.hedgehop("batch campaign.yaml --out out2").err,
              HasSubstr("campaign.yaml:2:27: unknown key 'seds' in 'flights.0'; did you mean 'seeds'?"));
  folder.write("campaign.yaml",
               "tuned_on: none\nflights:\n  - {scenario: tiny.yaml, seeds: 1, set: [vehicle.use=none.yaml]}\n");
  EXPECT_THAT(
      folder.hedgehop("batch campaign.yaml --out out2").err,
      HasSubstr("campaign.yaml:3:43: there is no such file: 'none.yaml' (relative to the scenario's folder)\n"));
}

TEST(Batch, CampaignRejectsTuningSeedsForEvaluation) {
  const CampaignFolder folder;
  folder.write("campaign.yaml", "flights:\n  - {scenario: tiny.yaml, seeds: 1:2}\n");
  const CommandEnd unsaid = folder.hedgehop("batch campaign.yaml --out out");
  EXPECT_EQ(unsaid.status, 2);
  EXPECT_THAT(unsaid.err, HasSubstr("campaign.yaml:2:34: missing key 'tuned_on'"));
  folder.write("campaign.yaml", "tuned_on: 2:9\nflights:\n  - {scenario: tiny.yaml, seeds: 1:2}\n");
  EXPECT_THAT(folder.hedgehop("batch campaign.yaml --out out").err,
              HasSubstr("campaign.yaml:3:34: seeds '1:2' judge by seed 2, which parameters were chosen on"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(Batch, EntriesThatDifferAfterTheMaximumNameLengthHaveDifferentFolders) {
  const CampaignFolder folder;
  const std::string zeros(150, '0');
  const std::string entry = "  - {scenario: tiny.yaml, seeds: 1, set: [avoidance.speed=0.5" + zeros;
  folder.write("campaign.yaml", "tuned_on: none\nflights:\n" + entry + "1]}\n" + entry + "2]}\n");
  ASSERT_EQ(folder.hedgehop("batch campaign.yaml --out out").status, 0);
  const Json batch = folder.json("out/batch.json");
  ASSERT_EQ(batch.at("flights").size(), 2u);
  EXPECT_NE(batch.at("flights").at(0).at("id"), batch.at("flights").at(1).at("id"));
}

}  // namespace
}  // namespace hedgehop::sim
