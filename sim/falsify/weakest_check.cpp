#include "sim/falsify/weakest_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/flight/flight.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMinFailure = 1e-6;  // keeps the robustness of a check that fails exactly at its limit below 0
constexpr double kCrash = -1.0;       // below a collision, which is about 0
constexpr double kClearPass = kMaxClearanceM;  // no obstacle within range, or no checks

double scale_of(const std::string& unit) {
  if (unit == "s") return 10.0;
  if (unit == "deg") return 0.1 * 180.0 / std::numbers::pi;
  return 1.0;
}

}  // namespace

double check_robustness(const Json& check) {
  const bool passed = check.at("passed").get<bool>();
  double margin = std::nan("");
  if (check.at("value").is_number() && check.at("limit").is_number()) {
    margin = check["value"].get<double>() - check["limit"].get<double>();
    if (check.value("must", "<=") == "<=") margin = -margin;
    margin /= scale_of(check.value("unit", ""));
  }
  if (std::isnan(margin)) return passed ? kClearPass : kCrash;  // such as a clearance with no obstacle within range
  return passed ? std::max(margin, 0.0) : std::min(margin, -kMinFailure);
}

WeakestCheck weakest_check(const FlightRecord& record, const std::vector<std::string>& names) {
  const bool refused = !record.order.fault.empty() || record.cause.starts_with("exit status 2");
  if (refused) return {"", kClearPass};
  if (record.status != FlightRecord::Status::flown || record.result.at("outcome") == "fault") return {"flight", kCrash};
  WeakestCheck weakest{"", kClearPass};
  for (const Json& check : record.result.at("checks")) {
    const std::string name = check.at("name").get<std::string>();
    if (!names.empty() && std::ranges::find(names, name) == names.end()) continue;
    const double robustness = check_robustness(check);
    if (weakest.name.empty() || robustness < weakest.robustness) weakest = {name, robustness};
  }
  return weakest;
}

double decided_s(const FlightRecord& record, const std::string& name) {
  if (record.status != FlightRecord::Status::flown) return std::numeric_limits<double>::infinity();
  for (const Json& check : record.result.at("checks")) {
    const bool has_moment = check.at("name") == name && check.contains("t_s") && check["t_s"].is_number();
    if (has_moment) return check["t_s"].get<double>();
  }
  return record.result.at("flight_time_s").get<double>();
}

}  // namespace hedgehop::sim
