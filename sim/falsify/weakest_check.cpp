#include "sim/falsify/weakest_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/flight/flight.h"

namespace hedgehop::sim {
namespace {

constexpr double kMinFailure = 1e-6;  // keeps the robustness of a check that fails exactly at its limit below 0
constexpr double kFault = -1.0;       // below a collision, which is about 0
constexpr double kClearPass = kMaxClearanceM;  // no obstacle within range, or no checks

double scale_of(const std::string& unit) {
  if (unit == "s") return 10.0;
  if (unit == "deg") return 0.1 * 180.0 / std::numbers::pi;
  return 1.0;
}

}  // namespace

double check_robustness(const CheckResult& check) {
  double margin = check.value - check.limit;
  if (check.must == "<=") margin = -margin;
  margin /= scale_of(check.unit);
  if (!std::isfinite(margin))
    return check.passed ? kClearPass : kFault;  // such as a clearance with no obstacle within range
  return check.passed ? std::max(margin, 0.0) : std::min(margin, -kMinFailure);
}

std::optional<WeakestCheck> weakest_check(const FlightRecord& record, const std::vector<std::string>& names) {
  const Verdict verdict = verdict_of(record);
  if (verdict == Verdict::not_flown) return {};
  if (verdict == Verdict::fault) return WeakestCheck{"flight", kFault};
  WeakestCheck weakest{"", kClearPass};
  for (const CheckResult& check : record.result->flight.checks) {
    if (!names.empty() && std::ranges::find(names, check.name) == names.end()) continue;
    const double robustness = check_robustness(check);
    if (weakest.name.empty() || robustness < weakest.robustness) weakest = {check.name, robustness};
  }
  return weakest;
}

double decided_s(const FlightRecord& record, const std::string& name) {
  if (!record.result) return std::numeric_limits<double>::infinity();
  for (const CheckResult& check : record.result->flight.checks) {
    if (check.name == name && check.t_s) return *check.t_s;
  }
  return record.result->flight.flight_time_s;
}

}  // namespace hedgehop::sim
