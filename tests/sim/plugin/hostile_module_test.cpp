// Whatever a module does in any of its calls, the flight ends in a verdict.
#include <gmock/gmock.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/sim/plugin/plugin_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;

/// An action of the module `misbehaving` in one of its calls.
struct Attack {
  std::string how, where;
};

using Words = std::vector<std::string>;
const Words kBeforeFlight = {"make", "needs", "signals", "reset"};
const Words kInFlight = {"update", "map", "metrics"};
const Words kWithoutEffect = {"annotate", "end"};  // on the flight
const Words kFatal = {"exit",     "end_at_once", "end_quickly", "end_thread", "throw_int",
                      "segfault", "abort",       "recurse",     "close_files"};
const Words kEndless = {"hang", "allocate", "stop"};
const Words kHarmless = {"change_folder", "fork", "print"};

/// Returns every action in every place if requested (scripts/soak), otherwise a part: some actions in each place and,
/// with four or more places, each action.
std::vector<Attack> attacks(const Words& hows, const std::vector<Words>& places) {
  const bool all = std::getenv("HEDGEHOP_ATTACKS") != nullptr;
  std::vector<Attack> list;
  size_t number = 0;
  for (const Words& group : places) {
    for (const std::string& where : group) {
      for (size_t i = 0; i < hows.size(); ++i) {
        if (all || (i + number) % std::min<size_t>(hows.size(), 4) == 0) list.push_back({hows[i], where});
      }
      ++number;
    }
  }
  return list;
}

class HostileModule : public Plugin {
 protected:
  HostileModule() {
    EXPECT_EQ(run("how: behave").status, 0);
    whole_ = folder.json("out/result.json");
  }
  /// Flies with an attack, with a film if the attack is in annotate(); the report must be one complete flight.
  nlohmann::ordered_json fly(const Attack& attack, int expected_status) {
    std::filesystem::remove_all(folder.path() / "out");
    fly_by(HEDGEHOP_MISBEHAVING, "limit: 0.5, parameters: {how: " + attack.how + ", place: " + attack.where + "}");
    const std::string film = attack.where == "annotate" ? "" : "--no-video ";
    const CommandEnd end = folder.hedgehop("run plug.yaml --no-report --json --out out " + film);
    EXPECT_EQ(end.status, expected_status) << end.err;
    for (const char* file : {"scenario.yaml", "trajectory.csv", "decisions.csv"}) {
      EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / file)) << file;
    }
    const auto printed = nlohmann::ordered_json::parse(end.out, nullptr, false);
    EXPECT_EQ(printed["trajectory_hash"], folder.json("out/result.json")["trajectory_hash"]);
    return folder.json("out/result.json");
  }
  /// Expects the outcome `fault`, and all decisions before it.
  void expect_fault(const Attack& attack) {
    SCOPED_TRACE(attack.how + " in " + attack.where);
    const std::map<std::string, int> decisions = {{"update", 2}, {"map", 1}, {"metrics", whole_["decisions"]}};
    const auto result = fly(attack, 1);
    EXPECT_EQ(result["outcome"], "fault");
    const auto expected = decisions.find(attack.where);
    EXPECT_EQ(result["decisions"], expected == decisions.end() ? 0 : expected->second);
    EXPECT_THAT(result["cause"].get<std::string>(), HasSubstr("the module failed"));
  }
  void expect_no_effect(const Attack& attack) {
    SCOPED_TRACE(attack.how + " in " + attack.where);
    const auto result = fly(attack, 0);
    EXPECT_EQ(result["trajectory_hash"], whole_["trajectory_hash"]);
    EXPECT_EQ(result["decisions"], whole_["decisions"]);
    EXPECT_EQ(result["outcome"], "timeout");
  }
  nlohmann::ordered_json whole_;  ///< result without an attack
};

TEST_F(HostileModule, ThatCrashesOrEndsIsAFault) {
  for (const Attack& attack : attacks(kFatal, {kBeforeFlight, kInFlight})) expect_fault(attack);
}

/// Only a std::logic_error refuses the parameters.
TEST_F(HostileModule, ThatThrowsARuntimeErrorIsAFault) {
  for (const Attack& attack : attacks({"raise_exception"}, {kBeforeFlight, kInFlight})) expect_fault(attack);
}

/// Before the flight, the limit is 60 s.
TEST_F(HostileModule, ThatDoesNotReturnIsAFault) {
  const bool all = std::getenv("HEDGEHOP_ATTACKS") != nullptr;
  for (const Attack& attack : attacks(kEndless, {kInFlight, all ? kBeforeFlight : Words{}})) expect_fault(attack);
}

TEST_F(HostileModule, CannotChangeTheFlightInItsImageOrItsEnd) {
  for (const Words& hows : {kFatal, kEndless, Words{"raise_exception", "change_state"}}) {
    for (const Attack& attack : attacks(hows, {kWithoutEffect})) expect_no_effect(attack);
  }
  expect_no_effect({"change_state", "annotate"});  // the part has it in `end` only
}

TEST_F(HostileModule, CannotChangeTheFolderTheOutputOrTheProcessesOfTheSimulator) {
  for (const Attack& attack : attacks(kHarmless, {kBeforeFlight, kInFlight, kWithoutEffect})) expect_no_effect(attack);
  for (int flight = 0; flight < 2; ++flight) {
    EXPECT_EQ(run("how: print").status, 0);
    EXPECT_EQ(folder.read("out/module/module.log"), "text of the module\n") << "of this flight alone";
  }
}

TEST_F(HostileModule, WithTheNameOfAColumnIsRefused) {
  for (const char* name : {"t_s", "status", "cmd_altitude_m", "aa"}) {
    std::filesystem::remove_all(folder.path() / "out");
    const CommandEnd end = run(std::string("signal: ") + name);
    EXPECT_EQ(end.status, 2) << name;
    EXPECT_THAT(end.err, HasSubstr(name));
    EXPECT_EQ(std::ranges::count(end.err, '\n'), 1) << end.err;
  }
}

/// A hostile module that takes over, or that is taken over from, is a fault and not a bad scenario.
TEST_F(HostileModule, OfATakeoverIsAFault) {
  fly_by(HEDGEHOP_MISBEHAVING, "parameters: {how: exit, place: make}");
  for (const std::string takeover :
       {"takeover={at: 0.2, avoidance: {module: go_to_goal}}",
        "takeover={at: 0.2, avoidance: {plugin: " HEDGEHOP_MISBEHAVING ", module: misbehaving}}"}) {
    const CommandEnd end = folder.hedgehop("run plug.yaml --no-video --no-report --out out --set '" + takeover + "'");
    EXPECT_EQ(end.status, 1) << end.err;
    EXPECT_EQ(folder.json("out/result.json")["outcome"], "fault");
  }
}

}  // namespace
}  // namespace hedgehop::sim
