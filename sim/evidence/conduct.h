#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/batch/campaign_file.h"
#include "sim/evidence/claims.h"
#include "sim/fields/field.h"

namespace hedgehop::sim {

/// A scenario and its seeds, fixed before the first flight.
struct RegisteredFlights {
  std::string scenario;  ///< relative to the plan's file; once read, to the working folder
  std::string seeds;
  std::string sha256;  ///< scenario_sha256() as registered; empty if the plan does not state it
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RegisteredFlights> auto& c) {
  v("scenario", c.scenario, {.required = true, .meaning = "scenario file, relative to this file"});
  v("seeds", c.seeds, {.required = true, .meaning = "seeds such as 1001:1400, disjoint from tuned_on"});
  v("sha256", c.sha256,
    {.meaning = "SHA-256 of the resolved scenario with its renderer and files, as `hedgehop validate` prints it"});
}

/// The registered stopping rule.
struct RegisteredRule {
  std::string until;
  double confidence = 0.95;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RegisteredRule> auto& c) {
  v("until", c.until,
    {.required = true, .meaning = "claim, as for `hedgehop batch --until`, such as collision < 0.01"});
  v("confidence", c.confidence, {.at_least = 0.5, .below = 1.0, .meaning = "confidence of the claim"});
}

/// The tuning that preceded the flights.
struct RegisteredTuning {
  std::string seeds;
  std::optional<int64_t> settings_tried;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RegisteredTuning> auto& c) {
  v("seeds", c.seeds, {.required = true, .meaning = "seeds that parameters were chosen on, such as 1:100, or none"});
  v("settings_tried", c.settings_tried, {.at_least = 0, .meaning = "number of settings tried on these seeds"});
}

/// A plan that is written, and preferably committed, before the flights: `plan:` of a campaign, or `batch --plan`.
struct PlanConfig {
  std::string question;
  std::vector<RegisteredFlights> flights;
  std::optional<RegisteredRule> rule;
  RegisteredTuning tuned_on;
  std::string build;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PlanConfig> auto& c) {
  v("question", c.question, {.required = true, .meaning = "question that the flights answer, in words"});
  v("flights", c.flights, {.required = true, .meaning = "scenarios, each with its seeds"});
  v("rule", c.rule, {.meaning = "stopping rule; without it, all flights are flown"});
  v("tuned_on", c.tuned_on, {.required = true, .meaning = "seeds on which the parameters were chosen"});
  v("build", c.build, {.meaning = "identity of the registered build, as printed by `hedgehop --version`"});
}

/// The file of a plan as read.
struct Registration {
  std::filesystem::path file;
  std::string sha256;
  PlanConfig config;
};

/// Reads a plan. Throws InputError with every fault and its place. Seeds in both `tuned_on` and `flights` are a fault.
Registration read_registration(const std::filesystem::path& file);

/// Returns the plan that a batch names; nullopt if it names no plan. Throws like read_registration().
std::optional<Registration> plan_of(const BatchOrders& batch);

/// Returns the orders of a plan. @param seeds, overrides, check  as for read_batch().
BatchOrders orders_of(const Registration& plan, const std::vector<uint64_t>& seeds,
                      const std::vector<std::string>& overrides, const OrderCheck& check = {});

/// Returns the deviations of a batch from its plan, one line each; empty if it is as registered.
/// @param limit_s  maximum wall time of a flight; 0 for no limit.
std::vector<std::string> deviations(const Registration& plan, const std::vector<Order>& orders,
                                    const std::optional<StoppingRule>& rule, double limit_s);

/// How a batch was planned and flown, which a reader needs to interpret a rate.
struct Conduct {
  std::string description;      ///< of the campaigns; "" if not stated
  int64_t planned = 0;          ///< flights
  std::string seeds, tuned_on;  ///< flown seeds, and seeds of the tuning; "" if not stated
  std::optional<int64_t> settings_tried;
  std::optional<StoppingRule> rule;
  double limit_s = 0.0;  ///< maximum wall time of a flight; 0 for no limit
  std::optional<Registration> plan;
  std::vector<std::string> deviations;  ///< from the plan
  std::vector<CampaignCheck> checks;    ///< over the seeds
};

/// Refuses a stopping rule together with checks over the seeds or a leaderboard. Throws InputError.
/// @param rule  place of the rule, such as "--until".
void require_planned_number(const BatchOrders& batch, const std::string& rule);
/// The same for the rule of a plan, if it has one.
void require_planned_number(const BatchOrders& batch, const Registration& plan);

/// Returns the conduct of a batch without its refused orders. @param limit_s  maximum wall time of a flight; 0: no
/// limit.
Conduct conduct_of(const BatchOrders& batch, const std::optional<Registration>& plan,
                   const std::optional<StoppingRule>& rule, double limit_s);

/// Returns the key `conduct` of batch.json.
nlohmann::ordered_json to_json(const Conduct& conduct);

/// Returns the key `conduct` of a folder's batch.json for its page, plus `sequential` and `verdicts`; null if there is
/// no such key. The key `now` of its plan is "same", "changed" since the batch was flown, or "gone".
nlohmann::ordered_json conduct_data(const std::filesystem::path& folder);

}  // namespace hedgehop::sim
