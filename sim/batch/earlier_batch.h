#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "sim/batch/campaign_file.h"

namespace hedgehop::sim {

/// Returns the orders and checks of an earlier batch from its batch.json. Each order has its id and group of that
/// batch; its scenario is read again. The order of an invalid file carries a fault, because its seeds are unknown.
/// Without the key `conduct.checks` (0.2), there are no checks. Throws InputError that names the file if it is not a
/// batch.json, or if a stopping rule ended the batch.
BatchOrders reread_batch(const std::filesystem::path& batch_json);

/// Returns checks as the key `conduct.checks` of batch.json, from which reread_batch() restores them.
nlohmann::ordered_json checks_json(const std::vector<CampaignCheck>& checks);

}  // namespace hedgehop::sim
