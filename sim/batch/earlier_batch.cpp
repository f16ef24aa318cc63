#include "sim/batch/earlier_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "sim/config/input_error.h"
#include "sim/config/utf8.h"

namespace hedgehop::sim {
namespace {

using OrderedJson = nlohmann::ordered_json;

CampaignCheck recalled_check(const OrderedJson& json) {
  const auto name = json.at("check").get<std::string>();
  const auto confidence = json.at("confidence").get<double>();
  if (name == SuccessRateCheck::kName) {
    return SuccessRateCheck{.at_least = json.at("at_least").get<double>(), .confidence = confidence};
  }
  if (name != NoWorseCheck::kName) throw InputError(fmt::format("conduct.checks: unknown check '{}'", name));
  NoWorseCheck check{.than = raw_name(json.at("than").get<std::string>()), .confidence = confidence, .margin = {}};
  if (const OrderedJson& margin = json.at("margin"); margin.is_number()) check.margin = margin.get<double>();
  return check;
}

/// Takes over the conduct. @param conduct  empty if an earlier version wrote the file.
void recall_conduct(const OrderedJson& conduct, BatchOrders& batch) {
  if (conduct.empty()) return;
  if (!conduct.at("rule").is_null()) {
    throw InputError(fmt::format("flown until '{}' was decided; repeat that command with --resume",
                                 conduct.at("rule").get<std::string>()));
  }
  batch.description = conduct.value("description", "");
  if (const auto& tuned_on = conduct.at("tuned_on"); tuned_on.is_string()) batch.tuned_on = tuned_on.get<std::string>();
  if (const auto& plan = conduct.at("plan"); plan.is_object())
    batch.plan = raw_name(plan.at("file").get<std::string>());
  for (const OrderedJson& check : conduct.value("checks", OrderedJson::array())) {
    batch.checks.push_back(recalled_check(check));
  }
}

/// The id is the flight's folder, which must be inside the folder of the batch.
std::string recalled_id(const OrderedJson& flight) {
  auto id = flight.at("id").get<std::string>();
  const std::filesystem::path folder = id;
  if (id.empty() || folder.is_absolute() ||
      std::ranges::any_of(folder, [](const auto& part) { return part == ".."; })) {
    throw InputError(fmt::format("flights: id '{}' is not a folder inside the batch's", id));
  }
  return id;
}

Order recalled_order(const OrderedJson& flight) {
  Order order{.id = recalled_id(flight),
              .group = flight.at("group").get<std::string>(),
              .scenario = std::filesystem::path(raw_name(flight.at("scenario").get<std::string>())).lexically_normal(),
              .seed = flight.at("seed").get<uint64_t>()};
  for (const auto& text : flight.at("set")) order.overrides.push_back(raw_name(text.get<std::string>()));
  if (is_refused(order)) {
    order.fault = fmt::format("{}: was invalid in the earlier batch, so its seeds are unknown; name this file again",
                              order.scenario.string());
    return order;
  }
  try {
    order.scenario_yaml = resolved_yaml(load_order(order.scenario, order), order.seed);
  } catch (const InputError& error) {
    refuse(order, error.errors());
  }
  return order;
}

}  // namespace

BatchOrders reread_batch(const std::filesystem::path& batch_json) {
  const OrderedJson json = read_batch_json(batch_json);
  BatchOrders batch;
  std::set<std::string> ids;
  try {
    recall_conduct(json.value("conduct", OrderedJson::object()), batch);
    for (const OrderedJson& flight : json.at("flights")) add_order(recalled_order(flight), ids, batch);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(json_fault(batch_json, error, kRecordOfBatch));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", batch_json.string(), error.errors().front()));
  }
  return batch;
}

OrderedJson checks_json(const std::vector<CampaignCheck>& checks) {
  OrderedJson list = OrderedJson::array();
  for (const CampaignCheck& any : checks) {
    if (const auto* rate = std::get_if<SuccessRateCheck>(&any)) {
      list.push_back(OrderedJson{{"check", std::string(SuccessRateCheck::kName)},
                                 {"at_least", rate->at_least},
                                 {"confidence", rate->confidence}});
    } else {
      const auto& no_worse = std::get<NoWorseCheck>(any);
      list.push_back(OrderedJson{{"check", std::string(NoWorseCheck::kName)},
                                 {"than", name_text(no_worse.than)},
                                 {"confidence", no_worse.confidence},
                                 {"margin", no_worse.margin ? OrderedJson(*no_worse.margin) : OrderedJson(nullptr)}});
    }
  }
  return list;
}

}  // namespace hedgehop::sim
