#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/batch/campaign_file.h"
#include "sim/evidence/registration.h"

namespace hedgehop::sim {

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
