#include "sim/pages/page_claims.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/batch/verdict.h"
#include "sim/evidence/anytime_valid.h"
#include "sim/evidence/conduct.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

/// All flights in one group.
GroupSummary total(std::vector<FlightRecord> records) {
  for (FlightRecord& record : records) record.order.group = "all";
  return records.empty() ? GroupSummary{} : summarize(records).front();
}

/// A limit of the rate of what did not happen in n flights.
Json limit_without_event(int64_t n) {
  const auto flights = static_cast<double>(n);
  return {
      {"flights", n}, {"three_over_n", 3.0 / flights}, {"limit", -std::expm1(std::log1p(-kTableConfidence) / flights)}};
}

}  // namespace

Json claims_data(const std::filesystem::path& folder, const std::vector<FlightRecord>& records) {
  const GroupSummary all = total(records);
  const Json conduct = conduct_data(folder);
  const bool sequential = !conduct.is_null() && !conduct.at("sequential").empty();
  const auto interval = [&](Count count) -> Json {
    const Interval i =
        sequential ? anytime_interval(count, kTableConfidence) : wilson_interval(count, kTableConfidence);
    return {i.low, i.high};
  };
  const int64_t planned = conduct.is_null() ? all.flights : conduct.at("planned").get<int64_t>();
  const int64_t broken = all.fault + all.failed;
  Json data{{"counts",
             {{"planned", planned},
              {"counted", all.success.trials},
              {"passed", all.success.successes},
              {"failed_a_check", all.success.trials - all.success.successes - broken},
              {"broken", broken},
              {"missing", all.missing},
              {"discarded", planned - all.flights},
              {"no_checks", all.unchecked}}},
            {"method", sequential ? "anytime" : "wilson"},
            {"interval", interval(all.success)},
            {"if_missing", nullptr},
            {"no_collision", nullptr},
            {"conduct", conduct}};
  if (all.missing > 0) {
    const int64_t trials = all.success.trials + all.missing;
    data["if_missing"] = {interval({all.success.successes, trials}),
                          interval({all.success.successes + all.missing, trials})};
  }
  const int64_t ended = all.flights - all.missing;
  if (ended > 0 && all.collided + broken == 0 && !sequential) data["no_collision"] = limit_without_event(ended);
  return data;
}

}  // namespace hedgehop::sim
