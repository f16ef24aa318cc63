#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "sim/batch/record.h"

namespace hedgehop::sim {

/// What a page must state beside a rate: `counts` (planned, counted, passed, failed a check, broken, missing,
/// discarded, no checks), `method` and `interval` (95 %) of the success rate, `if_missing` (the interval with missing
/// flights as failures and as passes; null without any), `no_collision` (flights, 3/n and the exact one-sided limit,
/// where none collided or broke; else null), and `conduct` as conduct_data() has it (null for a sweep). Source of the
/// limits without an event: [HanleyLippmanHand1983] p. 1743, the rule of three.
/// @param folder  of the campaign. @param records  of its table.
nlohmann::ordered_json claims_data(const std::filesystem::path& folder, const std::vector<FlightRecord>& records);

}  // namespace hedgehop::sim
