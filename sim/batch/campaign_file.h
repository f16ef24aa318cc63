#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "sim/batch/record.h"
#include "sim/fields/field.h"

namespace hedgehop::sim {

/// A world of a leaderboard: a scenario without vehicle, rig and module.
struct LeaderboardWorld {
  std::string name, scenario;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LeaderboardWorld> auto& c) {
  v("name", c.name, {.required = true, .meaning = "name in the matrix"});
  v("scenario", c.scenario,
    {.required = true, .meaning = "scenario file without vehicle, rig and module, relative to this file"});
}

/// A module with its vehicle and cameras.
struct LeaderboardModule {
  std::string name;
  bool control = false;
  std::vector<std::string> set;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LeaderboardModule> auto& c) {
  v("name", c.name, {.required = true, .meaning = "name in the matrix"});
  v("control", c.control,
    {.meaning = "whether it is a blind baseline, which does not count for the difficulty of worlds"});
  v("set", c.set,
    {.required = true,
     .meaning = "overrides of each world: vehicle, rig, avoidance; `use` relative to the world's file, modules in "
                "shared libraries and Python files relative to this file"});
}

/// Worlds in which a module is not flown, with the reason.
struct LeaderboardGap {
  std::string module, reason;
  std::vector<std::string> worlds;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LeaderboardGap> auto& c) {
  v("module", c.module, {.required = true, .meaning = "name of a module"});
  v("worlds", c.worlds, {.required = true, .meaning = "names of worlds"});
  v("reason", c.reason, {.required = true, .meaning = "reason why the module cannot fly there"});
}

/// A leaderboard: every module in every world.
struct LeaderboardConfig {
  std::string seeds;
  std::vector<LeaderboardWorld> worlds;
  std::vector<LeaderboardModule> modules;
  std::vector<LeaderboardGap> not_flown;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LeaderboardConfig> auto& c) {
  v("seeds", c.seeds, {.required = true, .meaning = "seeds of every cell, such as 1:10"});
  v("worlds", c.worlds, {.required = true, .meaning = "worlds of the matrix"});
  v("modules", c.modules, {.required = true, .meaning = "modules of the matrix"});
  v("not_flown", c.not_flown, {.meaning = "cells that cannot be flown, with reasons"});
}

/// A module in a world: the group of flights that differ only in the seed, or the reason for no flights.
struct LeaderboardCell {
  std::string world, module, group, reason;
};

/// The rows, columns and cells of the matrix.
struct Leaderboard {
  std::vector<LeaderboardWorld> worlds;
  std::vector<LeaderboardModule> modules;
  std::vector<LeaderboardCell> cells;  ///< one for each world and module, world by world
};

/// Returns the leaderboard before its flights. Throws InputError for duplicate or unknown names, and for a gap without
/// a reason.
Leaderboard leaderboard_of(const LeaderboardConfig& config);

/// Requires a minimum success rate of the flights that differ only in the seed.
struct SuccessRateCheck {
  static constexpr std::string_view kName = "success_rate";
  static constexpr std::string_view kMeaning =
      "minimum for the lower end of the Wilson interval of the success rate over the seeds of a scenario";
  double at_least = 0.0;  ///< 0..1
  double confidence = 0.95;
  bool operator==(const SuccessRateCheck&) const = default;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SuccessRateCheck> auto& c) {
  v("at_least", c.at_least,
    {.at_least = 0.0, .at_most = 1.0, .required = true, .meaning = "minimum rate of flights that pass all checks"});
  v("confidence", c.confidence, {.above = 0.0, .below = 1.0, .meaning = "confidence of the two-sided interval"});
}

/// Requires a success rate no worse than that of an earlier batch.
struct NoWorseCheck {
  static constexpr std::string_view kName = "no_worse";
  static constexpr std::string_view kMeaning =
      "success rate over the seeds of a scenario no worse than in an earlier batch";
  std::string than;  ///< batch.json of the earlier batch; relative to the campaign's file
  double confidence = 0.95;
  std::optional<double> margin;  ///< loss to be ruled out; without it, the check fails if a loss is shown
  bool operator==(const NoWorseCheck&) const = default;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<NoWorseCheck> auto& c) {
  v("than", c.than, {.required = true, .meaning = "batch.json of the earlier batch, relative to this file"});
  v("confidence", c.confidence, {.at_least = 0.5, .below = 1.0, .meaning = "confidence of the comparison"});
  v("margin", c.margin,
    {.above = 0.0,
     .at_most = 1.0,
     .meaning =
         "loss of rate that must be ruled out (Newcombe); without it, the check fails if a loss is shown (Fisher)"});
}

using CampaignCheck = std::variant<SuccessRateCheck, NoWorseCheck>;

/// One scenario of a campaign.
struct CampaignFlights {
  std::string scenario;
  std::string seeds;
  std::optional<std::string> tuned_on;  ///< default: the campaign's
  std::vector<std::string> set;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CampaignFlights> auto& c) {
  v("scenario", c.scenario, {.required = true, .meaning = "scenario file, relative to this file"});
  v("seeds", c.seeds,
    {.required = true, .meaning = "seeds such as 1001:1010 or 1001:1003,1007, disjoint from tuned_on"});
  v("tuned_on", c.tuned_on, {.meaning = "tuning seeds of this scenario, instead of the campaign's"});
  v("set", c.set,
    {.meaning = "overrides of the scenario, each key.path=value; modules in shared libraries and Python files "
                "relative to this file"});
}

/// A campaign file of `hedgehop batch`, which has the key `flights` or `leaderboard`.
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
  v("description", c.description, {.meaning = "purpose of the campaign"});
  v("tuned_on", c.tuned_on, {.meaning = "required: seeds on which parameters were chosen, such as 1:100, or none"});
  v("moved_on", c.moved_on, {.meaning = "reason for a change of the evaluation seeds"});
  v("flights", c.flights, {.meaning = "scenarios, each with its seeds"});
  v("leaderboard", c.leaderboard, {.meaning = "matrix of every module in every world"});
  v("checks", c.checks, {.selector = "check", .meaning = "requirements over the seeds of each scenario"});
  v("plan", c.plan, {.meaning = "file of the plan registered before the flights, relative to this file"});
}

/// The flights and checks of a batch.
struct BatchOrders {
  std::vector<Order> orders;
  std::vector<CampaignCheck> checks;
  std::optional<Leaderboard> leaderboard;
  std::optional<std::filesystem::path> plan;  ///< file of the last plan that an input names
  std::string description;                    ///< of the campaigns
  std::string tuned_on;                       ///< seeds of the tuning as stated by the files; "" if not stated
  std::vector<std::string> faults;            ///< one line each; the order of a bad file carries its faults
  std::vector<std::string> left_out;          ///< one line for each folder of which files are left out
};

/// Throws InputError if a flight is not possible, although its scenario is valid.
using OrderCheck = std::function<void(const Scenario& scenario, const Order& order)>;

/// Returns the orders of scenario files, campaign files and folders (their YAML files, sorted by name), in the order of
/// the inputs.
/// @param seeds      replace those of files and campaigns unless empty.
/// @param overrides  "a.b=value", applied to every scenario after a campaign's own.
/// @param recursive  whether the subfolders of folders are read, too.
/// @param check      called once for each scenario, with its first seed; empty: no check.
BatchOrders read_batch(const std::vector<std::filesystem::path>& inputs, const std::vector<uint64_t>& seeds,
                       const std::vector<std::string>& overrides, bool recursive = false, const OrderCheck& check = {});

/// Returns the orders of scenarios, each with its seeds and overrides. @param seeds, overrides, check  as for
/// read_batch().
BatchOrders orders_of(const std::vector<CampaignFlights>& flights, const std::vector<uint64_t>& seeds,
                      const std::vector<std::string>& overrides, const OrderCheck& check = {});

/// Loads the scenario of an order with its overrides, and stores the hash and the input files in the order. Throws
/// InputError. @param file  of the scenario, named as in messages.
Scenario load_order(const std::filesystem::path& file, Order& order);

/// Refuses an order because of the faults of its file. @param faults  one line each; not empty.
void refuse(Order& order, const std::vector<std::string>& faults);

/// Adds an order and its faults to a batch. A flight listed twice is flown once, and an equal fault is listed once.
/// @param ids  of the batch's orders.
void add_order(Order order, std::set<std::string>& ids, BatchOrders& batch);

/// Returns whether an order cannot be flown, because its file is invalid. A table of flights has only its id.
bool is_refused(const Order& order);

/// Returns the records that count for rates and planned numbers: those of orders that are not refused.
std::vector<FlightRecord> without_refused(std::vector<FlightRecord> records);

}  // namespace hedgehop::sim
