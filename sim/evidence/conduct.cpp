#include "sim/evidence/conduct.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/batch/earlier_batch.h"
#include "sim/batch/seeds.h"
#include "sim/config/include.h"
#include "sim/config/reader.h"
#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/flight/build.h"
#include "sim/scenario/inputs.h"

namespace hedgehop::sim {
namespace {

using SeedsOf = std::map<std::string, std::vector<uint64_t>>;  ///< by scenario, as a path without detours
using Json = nlohmann::ordered_json;

std::string key_of(const std::filesystem::path& scenario) {
  return std::filesystem::absolute(scenario).lexically_normal().string();
}

void compare_seeds(const SeedsOf& registered, const SeedsOf& flown, std::vector<std::string>& found) {
  for (const auto& [scenario, seeds] : flown) {
    const std::string name = std::filesystem::path(scenario).filename().string();
    const auto plan = registered.find(scenario);
    if (plan == registered.end()) {
      found.push_back(fmt::format("{} is not registered", name));
    } else if (plan->second != seeds) {
      found.push_back(fmt::format("{}: seeds {}, registered {}", name, seed_words(seeds), seed_words(plan->second)));
    }
  }
  for (const auto& [scenario, seeds] : registered) {
    if (flown.contains(scenario)) continue;
    found.push_back(
        fmt::format("{} is registered, but not flown", std::filesystem::path(scenario).filename().string()));
  }
}

/// Compares the resolved scenarios. An order that cannot be flown has no hash.
void compare_scenarios(const PlanConfig& plan, const std::vector<Order>& orders, std::vector<std::string>& found) {
  std::map<std::string, std::set<std::string>> flown;
  for (const Order& order : orders) {
    if (!order.scenario_sha256.empty()) flown[key_of(order.scenario)].insert(order.scenario_sha256);
  }
  std::set<std::string> lines;
  for (const RegisteredFlights& flights : plan.flights) {
    for (const std::string& sha256 : flown[key_of(flights.scenario)]) {
      if (sha256 == flights.sha256) continue;
      lines.insert(fmt::format("{}: resolved scenario has SHA-256 {}, registered {}",
                               std::filesystem::path(flights.scenario).filename().string(), sha256,
                               flights.sha256.empty() ? "none" : flights.sha256));
    }
  }
  found.insert(found.end(), lines.begin(), lines.end());
}

std::string rule_words(const std::optional<StoppingRule>& rule) {
  if (!rule) return "none";
  return fmt::format("'{}' at {:g}", rule->text(), rule->confidence);
}

}  // namespace

Registration read_registration(const std::filesystem::path& file) {
  ErrorList faults("plan");
  const Node root = load_tree(file, faults);
  Registration plan{.file = file, .sha256 = sha256(file)};
  if (root.kind == Node::Kind::map) read_struct(root, "", "", plan.config, faults);
  faults.throw_if_any();
  for (size_t i = 0; i < plan.config.flights.size(); ++i) {
    RegisteredFlights& flights = plan.config.flights[i];
    if (std::string fault = judging_fault(plan.config.tuned_on.seeds, flights.seeds); !fault.empty()) {
      faults.add(position_of(root, fmt::format("flights.{}.seeds", i)), std::move(fault));
    }
    flights.scenario = (file.parent_path() / flights.scenario).lexically_normal().string();
  }
  if (plan.config.rule) {
    try {
      parse_rate_claim(plan.config.rule->until);
    } catch (const InputError& error) {
      faults.add(position_of(root, "rule.until"), error.errors().front());
    }
  }
  faults.throw_if_any();
  return plan;
}

std::optional<Registration> plan_of(const BatchOrders& batch) {
  return batch.plan ? std::optional(read_registration(*batch.plan)) : std::nullopt;
}

BatchOrders orders_of(const Registration& plan, const std::vector<uint64_t>& seeds,
                      const std::vector<std::string>& overrides, const OrderCheck& check) {
  std::vector<CampaignFlights> all;
  for (const RegisteredFlights& flights : plan.config.flights) {
    all.push_back({.scenario = flights.scenario, .seeds = flights.seeds, .tuned_on = {}, .set = {}});
  }
  return orders_of(all, seeds, overrides, check);
}

std::vector<std::string> deviations(const Registration& plan, const std::vector<Order>& orders,
                                    const std::optional<StoppingRule>& rule, double limit_s) {
  std::vector<std::string> found;
  SeedsOf registered, flown;
  std::set<std::string> overrides;
  for (const RegisteredFlights& flights : plan.config.flights) {
    for (const uint64_t seed : parse_seeds(flights.seeds)) registered[key_of(flights.scenario)].push_back(seed);
  }
  for (const Order& order : orders) {
    flown[key_of(order.scenario)].push_back(order.seed);
    overrides.insert(order.overrides.begin(), order.overrides.end());
  }
  compare_seeds(registered, flown, found);
  compare_scenarios(plan.config, orders, found);
  for (const std::string& text : overrides) found.push_back(fmt::format("{} was set", text));

  std::optional<StoppingRule> planned;
  if (plan.config.rule) planned = {parse_rate_claim(plan.config.rule->until), plan.config.rule->confidence};
  if (rule_words(rule) != rule_words(planned)) {
    found.push_back(fmt::format("rule {}, registered {}", rule_words(rule), rule_words(planned)));
  }
  if (limit_s > 0.0) found.push_back(fmt::format("flights over {:g} s of wall time were ended", limit_s));
  if (!plan.config.build.empty() && plan.config.build != build_identity()) {
    found.push_back(fmt::format("build {}, registered {}", build_identity(), plan.config.build));
  }
  return found;
}

void require_planned_number(const BatchOrders& batch, const std::string& rule) {
  if (batch.checks.empty() && !batch.leaderboard) return;
  throw InputError(fmt::format(
      "{}: success_rate, no_worse and leaderboards are for a number of flights planned in advance; stopping "
      "early would falsify them",
      rule));
}

void require_planned_number(const BatchOrders& batch, const Registration& plan) {
  if (plan.config.rule) require_planned_number(batch, plan.file.string() + ": rule");
}

Conduct conduct_of(const BatchOrders& batch, const std::optional<Registration>& plan,
                   const std::optional<StoppingRule>& rule, double limit_s) {
  std::vector<Order> orders;
  std::ranges::remove_copy_if(batch.orders, std::back_inserter(orders), is_refused);
  Conduct conduct{.description = batch.description,
                  .planned = static_cast<int64_t>(orders.size()),
                  .tuned_on = batch.tuned_on,
                  .rule = rule};
  conduct.checks = batch.checks;
  std::vector<uint64_t> seeds;
  for (const Order& order : orders) seeds.push_back(order.seed);
  conduct.seeds = seed_words(std::move(seeds));
  conduct.limit_s = limit_s;
  conduct.plan = plan;
  if (plan) {
    conduct.tuned_on = plan->config.tuned_on.seeds;
    conduct.settings_tried = plan->config.tuned_on.settings_tried;
    conduct.deviations = deviations(*plan, orders, rule, limit_s);
  }
  return conduct;
}

Json to_json(const Conduct& conduct) {
  const auto text = [](const std::string& words) { return words.empty() ? Json(nullptr) : Json(words); };
  Json json{{"planned", conduct.planned}, {"seeds", conduct.seeds}, {"tuned_on", text(conduct.tuned_on)}};
  if (!conduct.description.empty()) json["description"] = conduct.description;
  json["settings_tried"] = conduct.settings_tried ? Json(*conduct.settings_tried) : Json(nullptr);
  json["rule"] = nullptr;
  if (conduct.rule) {
    json["rule"] = conduct.rule->text();
    json["confidence"] = conduct.rule->confidence;
  }
  json["checks"] = checks_json(conduct.checks);
  json["limit_s"] = conduct.limit_s > 0.0 ? Json(conduct.limit_s) : Json(nullptr);
  json["plan"] = nullptr;
  if (conduct.plan) {
    json["plan"] = {{"file", name_text(conduct.plan->file.string())},
                    {"sha256", conduct.plan->sha256},
                    {"question", conduct.plan->config.question},
                    {"deviations", conduct.deviations}};
  }
  return json;
}

Json conduct_data(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "batch.json")) return nullptr;
  const Json batch = Json::parse(read_file_whole(folder / "batch.json"), nullptr, /*allow_exceptions=*/false);
  if (!batch.is_object() || !batch.contains("conduct")) return nullptr;  // half written, or of an earlier version
  Json data = batch.at("conduct");
  data["sequential"] = batch.at("sequential");
  data["verdicts"] = batch.value("verdicts", Json::array());
  if (Json& plan = data.at("plan"); !plan.is_null()) {
    const std::string now = sha256(raw_name(plan.at("file").get<std::string>()));
    plan["now"] = now == plan.at("sha256").get<std::string>() ? "same" : now == "missing" ? "gone" : "changed";
  }
  return data;
}

}  // namespace hedgehop::sim
