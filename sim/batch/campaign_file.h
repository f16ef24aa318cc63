#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/batch/record.h"
#include "sim/fields/field.h"

namespace hedgehop::sim {

/// A world of a leaderboard: all of a scenario but what flies.
struct LeaderboardWorld {
  std::string name, scenario;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LeaderboardWorld> auto& c) {
  v("name", c.name, {.required = true, .meaning = "in the matrix"});
  v("scenario", c.scenario, {.required = true, .meaning = "scenario file without what flies, relative to this file"});
}

/// A module with the aircraft and cameras that it needs.
struct LeaderboardModule {
  std::string name;
  bool control = false;
  std::vector<std::string> set;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LeaderboardModule> auto& c) {
  v("name", c.name, {.required = true, .meaning = "in the matrix"});
  v("control", c.control, {.meaning = "flies without looking: it does not count for the difficulty of worlds"});
  v("set", c.set,
    {.required = true, .meaning = "overrides of each world: vehicle, rig, avoidance; files relative to the world's"});
}

/// Why a module flies in some worlds not at all.
struct LeaderboardGap {
  std::string module, reason;
  std::vector<std::string> worlds;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LeaderboardGap> auto& c) {
  v("module", c.module, {.required = true, .meaning = "name of a module"});
  v("worlds", c.worlds, {.required = true, .meaning = "names of worlds"});
  v("reason", c.reason, {.required = true, .meaning = "why it cannot fly there"});
}

/// Every module in every world.
struct LeaderboardConfig {
  std::string seeds;
  std::vector<LeaderboardWorld> worlds;
  std::vector<LeaderboardModule> modules;
  std::vector<LeaderboardGap> not_flown;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LeaderboardConfig> auto& c) {
  v("seeds", c.seeds, {.required = true, .meaning = "the same for all, such as 1:10"});
  v("worlds", c.worlds, {.required = true, .meaning = "what is flown in"});
  v("modules", c.modules, {.required = true, .meaning = "what flies"});
  v("not_flown", c.not_flown, {.meaning = "what cannot be flown, and why"});
}

/// A module in a world: the group of flights that differ by the seed alone, or why there are none.
struct LeaderboardCell {
  std::string world, module, group, reason;
};

/// What the matrix is made of.
struct Leaderboard {
  std::vector<LeaderboardWorld> worlds;
  std::vector<LeaderboardModule> modules;
  std::vector<LeaderboardCell> cells;  ///< one for each world and module, world by world
};

/// Its cells, with groups that are not flown yet. Throws InputError for names that are listed twice or unknown, and for
/// a gap without a reason.
Leaderboard leaderboard_of(const LeaderboardConfig& config);

/// Asserts of the flights that differ by the seed alone that enough of them pass.
struct SuccessRateCheck {
  static constexpr std::string_view kName = "success_rate";
  static constexpr std::string_view kMeaning =
      "over the seeds of a scenario, the lower end of the success rate's Wilson interval is high enough";
  double at_least = 0.0;  ///< 0..1
  double confidence = 0.95;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SuccessRateCheck> auto& c) {
  v("at_least", c.at_least,
    {.at_least = 0.0, .at_most = 1.0, .required = true, .meaning = "least rate of flights whose checks all hold"});
  v("confidence", c.confidence, {.above = 0.0, .below = 1.0, .meaning = "of the two-sided interval"});
}

/// Asserts that the success rate is no worse than that of an earlier batch.
struct NoWorseCheck {
  static constexpr std::string_view kName = "no_worse";
  static constexpr std::string_view kMeaning =
      "over the seeds of a scenario, the success rate is no worse than in an earlier batch";
  std::string than;  ///< batch.json of the earlier batch; relative to the campaign's file
  double confidence = 0.95;
  std::optional<double> margin;  ///< loss to be ruled out; without one, a loss must be shown for the check to fail
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<NoWorseCheck> auto& c) {
  v("than", c.than, {.required = true, .meaning = "batch.json of the earlier batch, relative to this file"});
  v("confidence", c.confidence, {.above = 0.0, .below = 1.0, .meaning = "of the statement"});
  v("margin", c.margin,
    {.above = 0.0,
     .at_most = 1.0,
     .meaning =
         "a loss of rate that must be ruled out (Newcombe); else the check fails where a loss is shown (Fisher)"});
}

using CampaignCheck = std::variant<SuccessRateCheck, NoWorseCheck>;

/// One scenario of a campaign.
struct CampaignFlights {
  std::string scenario;
  std::string seeds;
  std::optional<std::string> tuned_on;  ///< else the campaign's
  std::vector<std::string> set;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CampaignFlights> auto& c) {
  v("scenario", c.scenario, {.required = true, .meaning = "scenario file, relative to this file"});
  v("seeds", c.seeds, {.required = true, .meaning = "seeds such as 1001:1010 or 1001:1003,1007, none of tuned_on"});
  v("tuned_on", c.tuned_on, {.meaning = "in place of the file's"});
  v("set", c.set, {.meaning = "overrides of the scenario, each key.path=value"});
}

/// A file that `hedgehop batch` takes beside scenarios: it has the key `flights` or `leaderboard`.
struct CampaignConfig {
  std::string description;
  std::optional<std::string> tuned_on;
  std::string moved_on;
  std::vector<CampaignFlights> flights;
  std::optional<LeaderboardConfig> leaderboard;
  std::vector<CampaignCheck> checks;
  std::optional<std::string> plan;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CampaignConfig> auto& c) {
  v("description", c.description, {.meaning = "what the campaign is for"});
  v("tuned_on", c.tuned_on, {.meaning = "seeds that parameters were chosen on, such as 1:100, or none; must be given"});
  v("moved_on", c.moved_on, {.meaning = "why the seeds to judge by are others than before"});
  v("flights", c.flights, {.meaning = "scenarios, each with its seeds"});
  v("leaderboard", c.leaderboard, {.meaning = "every module in every world"});
  v("checks", c.checks, {.selector = "check", .meaning = "what must hold over the seeds of each scenario"});
  v("plan", c.plan, {.meaning = "plan's file, registered before the flights, relative to this file"});
}

/// What a batch is to fly.
struct BatchOrders {
  std::vector<Order> orders;
  std::vector<CampaignCheck> checks;
  std::optional<Leaderboard> leaderboard;
  std::optional<std::filesystem::path> plan;  ///< file of the last plan that an input names
  std::string tuned_on;                       ///< what the files say of it; "" where none does
  std::vector<std::string> faults;            ///< one line each; the order of a bad file has the first of its own
};

/// Orders of scenario files, campaign files and folders (all `*.yaml` right in them, by name), in this order.
/// @param seeds      replace those of files and campaigns when not empty.
/// @param overrides  "a.b=value", applied to every scenario after a campaign's own.
BatchOrders read_batch(const std::vector<std::filesystem::path>& inputs, const std::vector<uint64_t>& seeds,
                       const std::vector<std::string>& overrides);

/// Orders of scenarios, each with its seeds and overrides. @param seeds, overrides  as of read_batch().
BatchOrders orders_of(const std::vector<CampaignFlights>& flights, const std::vector<uint64_t>& seeds,
                      const std::vector<std::string>& overrides);

/// The orders of an earlier batch, from its batch.json. Scenario files are read again. Throws InputError naming the
/// file when it is no such record.
BatchOrders reread_batch(const std::filesystem::path& batch_json);

}  // namespace hedgehop::sim
