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

/// A scenario and the seeds that were decided on before anything was flown.
struct RegisteredFlights {
  std::string scenario;  ///< relative to the plan's file; once read, to the working folder
  std::string seeds;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RegisteredFlights> auto& c) {
  v("scenario", c.scenario, {.required = true, .meaning = "scenario file, relative to this file"});
  v("seeds", c.seeds, {.required = true, .meaning = "seeds such as 1001:1400, none of tuned_on"});
}

/// When to stop, and how surely.
struct RegisteredRule {
  std::string until;
  double confidence = 0.95;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RegisteredRule> auto& c) {
  v("until", c.until, {.required = true, .meaning = "claim as of `hedgehop batch --until`, such as collision < 0.01"});
  v("confidence", c.confidence, {.at_least = 0.5, .below = 1.0, .meaning = "of the claim"});
}

/// What parameters were chosen on before.
struct RegisteredTuning {
  std::string seeds;
  int64_t settings_tried = 0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RegisteredTuning> auto& c) {
  v("seeds", c.seeds, {.required = true, .meaning = "seeds that parameters were chosen on, such as 1:100, or none"});
  v("settings_tried", c.settings_tried, {.at_least = 0, .meaning = "how many settings were tried on them"});
}

/// A plan that is written, and best committed, before the flights: `plan:` of a campaign, or `hedgehop batch --plan`.
struct PlanConfig {
  std::string question;
  std::vector<RegisteredFlights> flights;
  std::optional<RegisteredRule> rule;
  RegisteredTuning tuned_on;
  std::string build;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PlanConfig> auto& c) {
  v("question", c.question, {.required = true, .meaning = "what the flights are to answer, in words"});
  v("flights", c.flights, {.required = true, .meaning = "scenarios, each with its seeds"});
  v("rule", c.rule, {.meaning = "when to stop; without it, all flights are flown"});
  v("tuned_on", c.tuned_on, {.required = true, .meaning = "what parameters were chosen on"});
  v("build", c.build, {.meaning = "identity of the build that is to fly, as `hedgehop --version` prints it"});
}

/// A plan's file as it was when it was read.
struct Registration {
  std::filesystem::path file;
  std::string sha256;
  PlanConfig config;
};

/// Throws InputError with every fault, each with its place; seeds both in `tuned_on` and `flights` are one.
Registration read_registration(const std::filesystem::path& file);

/// The plan that a batch names; none without one. Throws as read_registration().
std::optional<Registration> plan_of(const BatchOrders& batch);

/// The orders of a plan. @param seeds, overrides  as of read_batch().
BatchOrders orders_of(const Registration& plan, const std::vector<uint64_t>& seeds,
                      const std::vector<std::string>& overrides);

/// What a batch does that its plan does not say, one line each; empty when it is as registered.
/// @param limit_s  longest wall time of a flight, 0 for none.
std::vector<std::string> deviations(const Registration& plan, const std::vector<Order>& orders,
                                    const std::optional<StoppingRule>& rule, double limit_s);

/// How a batch was to be flown: what a reader must know beside a rate.
struct Conduct {
  int64_t planned = 0;          ///< flights
  std::string seeds, tuned_on;  ///< flown, and those that parameters were chosen on; "" where nobody said
  std::optional<int64_t> settings_tried;
  std::optional<StoppingRule> rule;
  double limit_s = 0.0;  ///< longest wall time of a flight, 0 for none
  std::optional<Registration> plan;
  std::vector<std::string> deviations;  ///< from the plan
};

/// @param limit_s  longest wall time of a flight, 0 for none.
Conduct conduct_of(const BatchOrders& batch, const std::optional<Registration>& plan,
                   const std::optional<StoppingRule>& rule, double limit_s);

/// The key `conduct` of batch.json.
nlohmann::ordered_json to_json(const Conduct& conduct);

/// The key `conduct` of a folder's batch.json for its page, with `now` of its plan: "same", "changed" since the
/// batch was flown, or "gone"; and `sequential` beside it. Null where there is none.
nlohmann::ordered_json conduct_data(const std::filesystem::path& folder);

}  // namespace hedgehop::sim
