#include "sim/evidence/conduct.h"

#include <nlohmann/json.hpp>

#include "sim/record/whole_file.h"
#include "sim/scenario/inputs.h"

namespace hedgehop::sim {

using Json = nlohmann::ordered_json;

Conduct conduct_of(const BatchOrders& batch, const std::optional<Registration>& plan,
                   const std::optional<StoppingRule>& rule, double limit_s) {
  Conduct conduct{.planned = static_cast<int64_t>(batch.orders.size()), .tuned_on = batch.tuned_on, .rule = rule};
  std::vector<uint64_t> seeds;
  for (const Order& order : batch.orders) seeds.push_back(order.seed);
  conduct.seeds = seed_words(std::move(seeds));
  conduct.limit_s = limit_s;
  conduct.plan = plan;
  if (plan) {
    conduct.tuned_on = plan->config.tuned_on.seeds;
    conduct.settings_tried = plan->config.tuned_on.settings_tried;
    conduct.deviations = deviations(*plan, batch.orders, rule, limit_s);
  }
  return conduct;
}

Json to_json(const Conduct& conduct) {
  const auto text = [](const std::string& words) { return words.empty() ? Json(nullptr) : Json(words); };
  Json json{{"planned", conduct.planned}, {"seeds", conduct.seeds}, {"tuned_on", text(conduct.tuned_on)}};
  json["settings_tried"] = conduct.settings_tried ? Json(*conduct.settings_tried) : Json(nullptr);
  json["rule"] = nullptr;
  if (conduct.rule) {
    json["rule"] = conduct.rule->text();
    json["confidence"] = conduct.rule->confidence;
  }
  json["limit_s"] = conduct.limit_s > 0.0 ? Json(conduct.limit_s) : Json(nullptr);
  json["plan"] = nullptr;
  if (conduct.plan) {
    json["plan"] = {{"file", conduct.plan->file.string()},
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
  if (Json& plan = data.at("plan"); !plan.is_null()) {
    const std::string now = sha256(plan.at("file").get<std::string>());
    plan["now"] = now == plan.at("sha256") ? "same" : now == "missing" ? "gone" : "changed";
  }
  return data;
}

}  // namespace hedgehop::sim
